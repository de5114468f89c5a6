//! A data set: a folder for each run and day, `run=5/day=2009-03-02/part-0.parquet`, as in Hive. Of several tables, each has such a
//! folder.
//!
//! The file of a day gets its name once the day is over, so that others can follow a run day by day; a killed run leaves whole days.
//! Resumed, it writes all days anew and compares them with the existing ones. Other runs in the folder stay unchanged.

use super::days::{DayFiles, parquet_files, remove};
use crate::encoded::{FileLayout, Format};
use crate::messages::ColumnsMessage;
use homebody_core::time::RunTime;
use homebody_log::files::lock::FileLock;
use homebody_log::table::InstantWriter;
use homebody_log::table::{Batch, Table};
use homebody_log::{Begin, LogError, Sink, Watermark, WriteMode};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A folder of files by run and day.
pub(crate) struct DataSet {
    folder: PathBuf,
    open: Option<OpenDataSet>,
}

struct OpenDataSet {
    tables: Vec<DayFiles>,
    /// The folders of the files until all rows are in them; empty for files that are written in place.
    hidden: Vec<Hidden>,
    clock: InstantWriter,
    texts: Vec<Arc<str>>,
    /// Files that are replaced: they go when the first new one is whole.
    replaced: Vec<PathBuf>,
    /// Those that go when all new ones are whole.
    replaced_last: Vec<PathBuf>,
    how: WriteMode,
    /// Given back last.
    _lock: FileLock,
}

/// The lock file, which keeps other writers away. Readers of data sets skip its name.
const LOCK: &str = ".homebody";

/// A folder `.run=5.part` that becomes `run=5`: no reader of data sets looks into it.
struct Hidden {
    folder: PathBuf,
    partition: PathBuf,
}

impl Hidden {
    /// Makes the folder, without the files that a killed program has left there. The partition is locked.
    fn begin(partition: &Path) -> Result<Hidden, LogError> {
        let name = partition.file_name().unwrap_or_default().to_string_lossy();
        let folder = partition.with_file_name(format!(".{name}.part"));
        let hidden = Hidden { folder, partition: partition.to_owned() };
        make(&hidden.folder, false)?;
        for left in parquet_files(&hidden.folder)? {
            fs::remove_file(&left).map_err(|error| LogError::file(&left, error))?;
        }
        Ok(hidden)
    }

    /// Moves all files to where they belong.
    fn name(&self) -> Result<(), LogError> {
        for file in parquet_files(&self.folder)? {
            let inner = file.strip_prefix(&self.folder).unwrap_or(&file);
            let to = self.partition.join(inner);
            if let Some(day) = to.parent() {
                make(day, false)?;
            }
            fs::rename(&file, &to).map_err(|error| LogError::file(&to, error))?;
        }
        Ok(())
    }
}

impl Drop for Hidden {
    fn drop(&mut self) {
        if self.folder.is_dir() && !self.folder.is_symlink() {
            let _ = fs::remove_dir_all(&self.folder);
        }
    }
}

impl DataSet {
    pub fn new(folder: PathBuf) -> DataSet {
        DataSet { folder, open: None }
    }

    /// The folder of a table of the run.
    fn partition(&self, table: &Table, begin: &Begin) -> Vec<PathBuf> {
        let of_table = match begin.tables.len() {
            1 => self.folder.clone(),
            _ => self.folder.join(&table.name),
        };
        let of_run = of_table.join(format!("run={}", begin.run.id));
        if of_table == self.folder { vec![of_table, of_run] } else { vec![self.folder.clone(), of_table, of_run] }
    }
}

impl Sink for DataSet {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        #[cfg(not(feature = "cloud"))]
        if self.folder.to_string_lossy().contains("://") {
            return Err(crate::fault::no_store(&self.folder));
        }
        let (mut tables, mut hidden, mut replaced) = (Vec::new(), Vec::new(), Vec::new());
        let mut lock = None;
        for table in begin.tables.iter() {
            let folders = self.partition(table, begin);
            let partition = folders.last().cloned().unwrap_or_default();
            for (depth, folder) in folders.iter().enumerate() {
                // The user's folder may be a link; those below are ours.
                make(folder, depth == 0)?;
            }
            if lock.is_none() {
                lock = Some(FileLock::take(&partition.join(LOCK))?);
            }
            let there = parquet_files(&partition)?;
            match begin.how {
                WriteMode::Create if !there.is_empty() => {
                    return Err(LogError::Exists { place: partition.display().to_string() });
                }
                WriteMode::Overwrite => replaced.extend(there),
                _ => {}
            }
            let layout = FileLayout::new(Format::Parquet, table, begin, false);
            let folder = if begin.is_whole {
                hidden.push(Hidden::begin(&partition)?);
                hidden.last().map_or(partition, |hidden| hidden.folder.clone())
            } else {
                partition
            };
            tables.push(DayFiles::new(folder, layout, table, begin));
        }
        let lock = lock.ok_or_else(|| LogError::Stopped { place: self.folder.display().to_string() })?;
        let (clock, texts, how) = (begin.clock(), Vec::new(), begin.how);
        let (replaced, replaced_last) = if begin.is_whole { (Vec::new(), replaced) } else { (replaced, Vec::new()) };
        self.open = Some(OpenDataSet { tables, hidden, clock, texts, replaced, replaced_last, how, _lock: lock });
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let stopped = || LogError::Stopped { place: self.folder.display().to_string() };
        let OpenDataSet { tables, clock, texts, replaced, .. } = self.open.as_mut().ok_or_else(stopped)?;
        texts.extend(batch.texts_from(texts.len()));
        batch.rows().try_for_each(|row| tables[row.table].push(row.cells, clock, texts, replaced))
    }

    /// Rows in whole days are durable.
    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let tables = self.open.iter().flat_map(|open| &open.tables);
        Ok(Watermark(tables.map(DayFiles::durable).collect()))
    }

    fn finish(&mut self, _end: RunTime) -> Result<(), LogError> {
        let Some(OpenDataSet { tables, hidden, mut replaced, replaced_last, how, _lock, .. }) = self.open.take() else {
            return Ok(());
        };
        for table in tables {
            let (partition, named) = table.end(&mut replaced)?;
            if how == WriteMode::Resume
                && let Some(more) = parquet_files(&partition)?.iter().find(|file| !named.contains(*file))
            {
                return Err(LogError::changed(more.display().to_string(), ColumnsMessage::ExtraFile));
            }
        }
        replaced_last.iter().try_for_each(|old| remove(old))?;
        hidden.iter().try_for_each(Hidden::name)
    }
}

/// Makes a missing folder. A link cannot be a folder of a data set.
fn make(folder: &Path, may_be_link: bool) -> Result<(), LogError> {
    let place = || folder.display().to_string();
    match fs::symlink_metadata(folder) {
        Ok(found) if found.is_symlink() && !may_be_link => Err(LogError::LeadsOut { place: place() }),
        Ok(_) if folder.is_dir() => Ok(()),
        Ok(_) => Err(LogError::destination(place(), ColumnsMessage::NotFolder)),
        Err(error) if error.kind() == ErrorKind::NotFound => match fs::create_dir(folder) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
            Err(error) if error.kind() == ErrorKind::NotFound => Err(LogError::NoFolder { place: place() }),
            made => made.map_err(|error| LogError::file(folder, error)),
        },
        Err(error) => Err(LogError::file(folder, error)),
    }
}
