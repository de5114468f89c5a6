//! Gives whole files their names. A resumed run compares an existing file with its own: it must have the same rows, or a beginning of
//! them.

use crate::messages::ColumnsMessage;
use crate::source::Batches;
use arrow_array::RecordBatch;
use homebody_core::problem::Diagnostic;
use homebody_log::error::ChangedMessage;
use homebody_log::files::fresh::FreshFile;
use homebody_log::{LogError, WriteMode};
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::Path;

pub(crate) fn name(file: FreshFile, how: WriteMode) -> Result<(), LogError> {
    let path = file.path().to_owned();
    let written = file.part().map(Path::to_owned);
    if let (WriteMode::Resume, Some(written)) = (how, written)
        && path.is_file()
    {
        let same = are_same(&path, &written).map_err(|error| LogError::reading(&path, error))?;
        if same {
            return Ok(());
        }
        begins_with(&path, &written)?;
    }
    file.finish()
}

fn are_same(one: &Path, other: &Path) -> io::Result<bool> {
    if fs::metadata(one)?.len() != fs::metadata(other)?.len() {
        return Ok(false);
    }
    let open = |path| File::open(path).map(|file| BufReader::with_capacity(1 << 16, file));
    let (mut one, mut other) = (open(one)?, open(other)?);
    loop {
        let (here, there) = (one.fill_buf()?, other.fill_buf()?);
        let length = here.len().min(there.len());
        if here[..length] != there[..length] {
            return Ok(false);
        }
        if length == 0 {
            return Ok(here.len() == there.len());
        }
        one.consume(length);
        other.consume(length);
    }
}

/// An error where the rows of a file are not the first ones of what was written anew.
fn begins_with(there: &Path, written: &Path) -> Result<(), LogError> {
    let changed = |why: Diagnostic| LogError::changed(there.display().to_string(), why);
    let (mut old, mut new) = (NamedRows::open(there)?, NamedRows::open(written)?);
    let mut rows = 0;
    loop {
        let Some(here) = old.rest()? else { return Ok(()) };
        let Some(beside) = new.rest()? else {
            return Err(changed(ChangedMessage::MoreRows { rows: rows as u64 }.into()));
        };
        let length = here.num_rows().min(beside.num_rows());
        if here.schema().fields() != beside.schema().fields() {
            return Err(changed(ColumnsMessage::OtherColumns.into()));
        }
        if here.slice(0, length) != beside.slice(0, length) {
            let (first, last) = (rows, rows + length - 1);
            return Err(changed(ColumnsMessage::OtherRows { first, last }.into()));
        }
        rows += length;
        old.taken(length);
        new.taken(length);
    }
}

struct NamedRows {
    batches: Batches,
    now: Option<RecordBatch>,
}

impl NamedRows {
    fn open(path: &Path) -> Result<NamedRows, LogError> {
        Ok(NamedRows { batches: Batches::open(path, None)?, now: None })
    }

    /// The next batch that has not been taken yet; None at the end.
    fn rest(&mut self) -> Result<Option<&RecordBatch>, LogError> {
        while self.now.as_ref().is_none_or(|batch| batch.num_rows() == 0) {
            self.now = self.batches.next().transpose()?;
            if self.now.is_none() {
                return Ok(None);
            }
        }
        Ok(self.now.as_ref())
    }

    fn taken(&mut self, rows: usize) {
        self.now = self.now.take().map(|batch| batch.slice(rows, batch.num_rows() - rows));
    }
}
