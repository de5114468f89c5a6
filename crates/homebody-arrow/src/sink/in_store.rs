//! A data set in an object store. Its files are made in a temporary folder and uploaded once they have their names: a day's file once the
//! day is over. A file is durable once the store has taken it.

use super::data_set::DataSet;
use crate::fault::unwritten;
use crate::store::Store;
use homebody_core::time::RunTime;
use homebody_log::table::Batch;
use homebody_log::{Begin, LogError, Sink, Watermark, WriteMode};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use tempfile::TempDir;

/// A data set in an object store.
pub(crate) struct InStore {
    url: PathBuf,
    open: Option<OpenStore>,
}

struct OpenStore {
    store: Store,
    inner: DataSet,
    /// By name, how the file was that the store has taken.
    sent: BTreeMap<String, (u64, Option<SystemTime>)>,
    /// Files of a run that is replaced: they go when the first new one is there.
    replaced: Vec<String>,
    /// Given back last.
    folder: TempDir,
}

impl InStore {
    pub fn new(url: PathBuf) -> InStore {
        InStore { url, open: None }
    }

    fn begun(&mut self) -> Result<&mut OpenStore, LogError> {
        let stopped = LogError::Stopped { place: self.url.display().to_string() };
        self.open.as_mut().ok_or(stopped)
    }
}

impl Sink for InStore {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let store = Store::open(&self.url)?;
        let folder =
            tempfile::tempdir().map_err(|error| unwritten(Path::new("a folder for temporary files"), error))?;
        let mut there = Vec::new();
        for table in begin.tables.iter() {
            let of_table = if begin.tables.len() == 1 { String::new() } else { format!("{}/", table.name) };
            there.extend(store.files(&format!("{of_table}run={}", begin.run.id))?);
        }
        let mut open = OpenStore {
            store,
            inner: DataSet::new(folder.path().to_owned()),
            sent: BTreeMap::new(),
            replaced: Vec::new(),
            folder,
        };
        let how = match begin.how {
            WriteMode::Create if !there.is_empty() => {
                return Err(LogError::Exists { place: format!("parquet:{}/{}", self.url.display(), there[0]) });
            }
            WriteMode::Resume => {
                for name in there {
                    let file = open.folder.path().join(&name);
                    open.store.get(&name, &file)?;
                    open.sent.insert(name, looks(&file));
                }
                WriteMode::Resume
            }
            WriteMode::Create | WriteMode::Overwrite => {
                open.replaced = there;
                WriteMode::Create
            }
        };
        let watermark = open.inner.begin(&Begin { how, ..begin.clone() })?;
        self.open = Some(open);
        Ok(watermark)
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.begun()?.inner.write(batch)
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let open = self.begun()?;
        let watermark = open.inner.make_durable()?;
        open.send()?;
        Ok(watermark)
    }

    fn finish(&mut self, end: RunTime) -> Result<(), LogError> {
        let open = self.begun()?;
        open.inner.finish(end)?;
        open.send()?;
        self.open = None;
        Ok(())
    }
}

impl OpenStore {
    /// Sends what has a name and is not there yet. After an error the same is tried again.
    fn send(&mut self) -> Result<(), LogError> {
        let mut names = Vec::new();
        named(self.folder.path(), self.folder.path(), &mut names)?;
        names.sort();
        for name in names {
            let file = self.folder.path().join(&name);
            let now = looks(&file);
            if self.sent.get(&name) == Some(&now) {
                continue;
            }
            self.store.put(&name, &file)?;
            self.sent.insert(name, now);
            while let Some(old) = self.replaced.last() {
                if !self.sent.contains_key(old) {
                    self.store.remove(old)?;
                }
                self.replaced.pop();
            }
        }
        Ok(())
    }
}

/// By what a file is known to be the same.
fn looks(file: &Path) -> (u64, Option<SystemTime>) {
    fs::metadata(file).map_or((0, None), |found| (found.len(), found.modified().ok()))
}

fn named(folder: &Path, whole: &Path, names: &mut Vec<String>) -> Result<(), LogError> {
    let unread = |error| LogError::reading(folder, error);
    for entry in fs::read_dir(folder).map_err(unread)? {
        let path = entry.map_err(unread)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match name {
            name if name.starts_with('.') => {}
            _ if path.is_dir() => named(&path, whole, names)?,
            name if name.ends_with(".parquet") => {
                let inner = path.strip_prefix(whole).unwrap_or(&path);
                names.push(inner.to_string_lossy().replace('\\', "/"));
            }
            _ => {}
        }
    }
    Ok(())
}
