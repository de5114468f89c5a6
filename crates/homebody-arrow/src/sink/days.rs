//! The files of one table of a run, by day.
//!
//! The day of a row is that of its first instant, in the home's zone. A log's day is over at the first row of a later one. In the truth, a
//! row may come at the end of an interval that began the day before: there, a day stays open a day longer. A row that comes later begins a
//! further file of its day. Tables without instants have one file, at the end.

use super::named::name;
use crate::encoded::{FileLayout, TableFile};
use crate::messages::ColumnsMessage;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::{DAY, RunTime, WallTime};
use homebody_log::files::fresh::{FreshFile, remove_parts};
use homebody_log::table::InstantWriter;
use homebody_log::table::{Cell, ColumnKind, Table};
use homebody_log::{Begin, LogError, WriteMode};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest number of open days of a table (our choice): each takes some memory.
const MOST_OPEN: usize = 4;

/// Largest number of files of a day (our choice): a log that needs more is not in the order of time.
const MOST_PARTS: u32 = 1000;

pub(super) struct DayFiles {
    partition: PathBuf,
    layout: FileLayout,
    /// The column whose instant says the day; None for a table without instants.
    by: Option<usize>,
    wall: InstantWriter,
    /// The number of days before the latest that stay open.
    stays_open: i64,
    /// By day since 1970; one of a table without instants is 0.
    open: BTreeMap<i64, OpenDayFile>,
    latest: Option<i64>,
    /// The run's first day: where a table without rows has its file.
    first_day: i64,
    parts: BTreeMap<i64, u32>,
    named: BTreeSet<PathBuf>,
    come: u64,
    how: WriteMode,
}

struct OpenDayFile {
    file: TableFile,
    /// The number of rows of the table before its first.
    rows_before: u64,
    /// The number of rows of the table at its last write.
    used: u64,
}

impl DayFiles {
    pub fn new(partition: PathBuf, layout: FileLayout, table: &Table, begin: &Begin) -> DayFiles {
        let mut wall = InstantWriter::new(&begin.run.calendar, TimeFormat::Local);
        DayFiles {
            partition,
            layout,
            by: table.columns.iter().position(|column| column.kind == ColumnKind::Instant),
            stays_open: i64::from(begin.tables.len() > 1),
            open: BTreeMap::new(),
            latest: None,
            first_day: wall.wall(RunTime::START).day_number(),
            wall,
            parts: BTreeMap::new(),
            named: BTreeSet::new(),
            come: 0,
            how: begin.how,
        }
    }

    /// Adds a row. `replaced` are files that go when the first new one is whole.
    pub fn push(
        &mut self,
        cells: &[Cell],
        clock: &mut InstantWriter,
        texts: &[Arc<str>],
        replaced: &mut Vec<PathBuf>,
    ) -> Result<(), LogError> {
        let day = match self.by.and_then(|by| cells.get(by)) {
            Some(&Cell::Instant(at)) => self.wall.wall(at).day_number(),
            Some(_) => self.latest.unwrap_or(self.first_day),
            None => 0,
        };
        if !self.open.contains_key(&day) {
            self.close_for(day, replaced)?;
            self.begin(day)?;
        }
        self.come += 1;
        let open = self.open.get_mut(&day).expect("begun where it was not open");
        open.used = self.come;
        open.file.push(cells, clock, texts)
    }

    /// Closes what is over as a day begins, and one more where too many are open.
    fn close_for(&mut self, day: i64, replaced: &mut Vec<PathBuf>) -> Result<(), LogError> {
        if self.latest.is_none_or(|latest| day > latest) {
            self.latest = Some(day);
            let over: Vec<i64> = self.open.range(..day - self.stays_open).map(|(day, _)| *day).collect();
            over.into_iter().try_for_each(|day| self.close(day, replaced))?;
        }
        let longest_unused = self.open.iter().min_by_key(|(_, open)| open.used).map(|(day, _)| *day);
        match longest_unused.filter(|_| self.open.len() >= MOST_OPEN) {
            Some(day) => self.close(day, replaced),
            None => Ok(()),
        }
    }

    fn begin(&mut self, day: i64) -> Result<(), LogError> {
        let parts = self.parts.entry(day).or_default();
        let number = *parts;
        *parts += 1;
        if number >= MOST_PARTS {
            return Err(LogError::cannot_hold(self.partition.display().to_string(), ColumnsMessage::Disorder));
        }
        let folder = match self.by {
            Some(_) => self.partition.join(format!("day={}", (WallTime::EPOCH + day * DAY).date())),
            None => self.partition.clone(),
        };
        match fs::create_dir(&folder) {
            Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(LogError::file(&folder, error)),
            _ if folder.is_symlink() => return Err(LogError::LeadsOut { place: folder.display().to_string() }),
            _ => {}
        }
        let path = folder.join(format!("part-{number}.parquet"));
        // A program that died on its way has left some.
        remove_parts(&path)?;
        let file = FreshFile::create_hidden(&path, self.how != WriteMode::Create)?;
        let file = TableFile::begin(file, &self.layout, self.come)?;
        self.open.insert(day, OpenDayFile { file, rows_before: self.come, used: self.come });
        Ok(())
    }

    fn close(&mut self, day: i64, replaced: &mut Vec<PathBuf>) -> Result<(), LogError> {
        let Some(OpenDayFile { file, .. }) = self.open.remove(&day) else { return Ok(()) };
        let path = file.path().to_owned();
        let file = file.end()?;
        for old in replaced.drain(..) {
            remove(&old)?;
        }
        name(file, self.how)?;
        self.named.insert(path);
        Ok(())
    }

    /// Up to where all rows are in files that have their names.
    pub fn durable(&self) -> u64 {
        self.open.values().map(|open| open.rows_before).min().unwrap_or(self.come)
    }

    /// Names what is open. Returns where the files are, and all of them.
    pub fn end(mut self, replaced: &mut Vec<PathBuf>) -> Result<(PathBuf, BTreeSet<PathBuf>), LogError> {
        if self.come == 0 {
            // A table without rows still has its columns.
            self.begin(if self.by.is_some() { self.first_day } else { 0 })?;
        }
        while let Some((&day, _)) = self.open.first_key_value() {
            self.close(day, replaced)?;
        }
        Ok((std::mem::take(&mut self.partition), std::mem::take(&mut self.named)))
    }
}

impl Drop for DayFiles {
    fn drop(&mut self) {
        let files: Vec<PathBuf> = self.open.values().map(|open| open.file.path().to_owned()).collect();
        self.open.clear();
        // Folders that are empty now were made for files that have been given up.
        for folder in files.iter().filter_map(|file| file.parent()).filter(|_| self.by.is_some()) {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Removes a file, and its folder if nothing else is in it.
pub(super) fn remove(file: &Path) -> Result<(), LogError> {
    match fs::remove_file(file) {
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(LogError::file(file, error)),
        _ => {}
    }
    if let Some(folder) = file.parent() {
        let _ = fs::remove_dir(folder);
    }
    Ok(())
}

/// The files of Parquet in a folder of a run and in those of its days.
pub(super) fn parquet_files(partition: &Path) -> Result<Vec<PathBuf>, LogError> {
    let mut files = Vec::new();
    let unread = |error| LogError::reading(partition, error);
    for entry in fs::read_dir(partition).map_err(unread)? {
        let path = entry.map_err(unread)?.path();
        let inner = match path.is_dir() && !path.is_symlink() {
            true => fs::read_dir(&path).map_err(unread)?.map(|entry| entry.map(|entry| entry.path())).collect(),
            false => vec![Ok(path)],
        };
        for path in inner {
            let path = path.map_err(unread)?;
            if path.extension().is_some_and(|ending| ending == "parquet") {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}
