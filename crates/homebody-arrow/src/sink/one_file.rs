//! One file for each table, which gets its name once it is whole. A killed run leaves none; resumed, it writes all rows anew and compares
//! them with an existing file.

use super::named::name;
use crate::encoded::{FileLayout, Format, TableFile};
use homebody_core::time::RunTime;
use homebody_log::files::fresh::{FreshFile, remove_parts};
use homebody_log::files::lock::FileLock;
use homebody_log::table::Batch;
use homebody_log::table::InstantWriter;
use homebody_log::{Begin, LogError, Sink, Url, Watermark, WriteMode};
use std::sync::Arc;

/// A file of Parquet or Arrow IPC, or one for each table.
pub(crate) struct OneFile {
    url: Url,
    format: Format,
    open: Option<OpenTableFiles>,
}

struct OpenTableFiles {
    files: Vec<TableFile>,
    clock: InstantWriter,
    texts: Vec<Arc<str>>,
    how: WriteMode,
    /// Given back last, once the files have their names or their parts are gone.
    _locks: Vec<FileLock>,
}

impl OneFile {
    pub fn new(url: Url, format: Format) -> OneFile {
        OneFile { url, format, open: None }
    }
}

impl Sink for OneFile {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let (mut files, mut locks) = (Vec::new(), Vec::new());
        for (table, path) in begin.tables.iter().zip(self.url.files(&begin.tables)) {
            locks.push(FileLock::take(&path)?);
            if begin.how == WriteMode::Resume {
                remove_parts(&path)?;
            }
            let file = FreshFile::create(&path, begin.how != WriteMode::Create)?;
            files.push(TableFile::begin(file, &FileLayout::new(self.format, table, begin, true), 0)?);
        }
        self.open =
            Some(OpenTableFiles { files, clock: begin.clock(), texts: Vec::new(), how: begin.how, _locks: locks });
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let stopped = || LogError::Stopped { place: self.url.to_string() };
        let OpenTableFiles { files, clock, texts, .. } = self.open.as_mut().ok_or_else(stopped)?;
        texts.extend(batch.texts_from(texts.len()));
        batch.rows().try_for_each(|row| files[row.table].push(row.cells, clock, texts))
    }

    /// Nothing is sure before the end.
    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        Ok(Watermark::none())
    }

    fn finish(&mut self, _end: RunTime) -> Result<(), LogError> {
        let Some(OpenTableFiles { files, how, _locks, .. }) = self.open.take() else { return Ok(()) };
        files.into_iter().try_for_each(|file| name(file.end()?, how))
    }
}
