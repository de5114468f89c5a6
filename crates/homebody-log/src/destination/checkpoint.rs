//! Checkpoints for destinations that cannot count their rows of a run, such as standard output or a broker: a file in the run's folder
//! counts the confirmed rows, so that a resumed run does not send them again.
//!
//! Rows that were sent and not noted before the program died are sent again, with the same numbers: such a destination gets each row at
//! least once.

use super::spool::file_name;
use crate::error::{CountMessage, LogError, place_of};
use crate::files::plain::read_text;
use crate::files::{FreshFile, WriteMode};
use crate::sink::{Begin, Sink, Watermark};
use crate::table::Batch;
use homebody_core::problem::readable;
pub use homebody_core::scenario::inside::CONFIRMED as NOTES;
use homebody_core::time::RunTime;
use serde::{Deserialize, Serialize};
use std::io;
use std::path::{Path, PathBuf};

pub(crate) struct CheckpointedSink {
    inner: Box<dyn Sink>,
    path: PathBuf,
    noted: Option<Note>,
    /// By table, the number of rows that were left out this time: its count starts there.
    left_out: Vec<u64>,
    /// By table, how many rows it was given since.
    given: Vec<u64>,
}

/// Largest number of rows of a run. A century with a thousand a second takes a third of them.
const MOST_ROWS: u64 = 10_000_000_000_000;

/// Largest size of a note (our choice).
const LONGEST_NOTE_BYTES: u64 = 1 << 20;

/// The confirmed rows of a run at a destination.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Note {
    /// The run's id.
    pub run: i64,
    /// By table, how many rows are confirmed.
    pub rows: Vec<u64>,
}

impl Note {
    /// Reads the note of a file.
    ///
    /// # Errors
    ///
    /// If the file is missing or damaged.
    pub fn read(path: &Path) -> Result<Note, io::Error> {
        Ok(serde_json::from_str(&read_text(path, LONGEST_NOTE_BYTES)?)?)
    }
}

impl CheckpointedSink {
    pub fn new(place: &str, inner: Box<dyn Sink>, folder: &Path) -> CheckpointedSink {
        let path = folder.join(format!("{}{NOTES}", file_name(place)));
        CheckpointedSink { inner, path, noted: None, left_out: Vec::new(), given: Vec::new() }
    }

    /// The note of this run; none without a file, or with that of another run.
    ///
    /// A number that no run reaches would hold all rows back, so it is an error. A damaged file is an error, too: it would hide which rows
    /// were given before.
    fn read(&self, run: i64) -> Result<Option<Note>, LogError> {
        let place = || place_of(&self.path);
        match Note::read(&self.path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => {
                let reason = readable(error.to_string());
                Err(LogError::Checkpoint(CountMessage::Unreadable { place: place(), reason }))
            }
            Ok(note) => match note.rows.iter().find(|&&rows| rows > MOST_ROWS) {
                Some(&rows) => Err(LogError::Checkpoint(CountMessage::TooMany { place: place(), rows })),
                None => Ok(Some(note).filter(|note| note.run == run)),
            },
        }
    }

    /// Notes what has been confirmed by now, and returns it: what was left out, and what was given since.
    fn note(&mut self, confirmed: &Watermark) -> Result<Watermark, LogError> {
        let tables = self.left_out.len().max(confirmed.0.len());
        let left_out = |table: usize| self.left_out.get(table).copied().unwrap_or(0);
        // One that has gone away has not forgotten what it has confirmed.
        let before = |table: usize| self.noted.as_ref().and_then(|noted| noted.rows.get(table)).copied().unwrap_or(0);
        let rows = (0..tables).map(|table| (left_out(table) + confirmed.of(table)).max(before(table)));
        let rows: Vec<u64> = rows.collect();
        let Some(noted) = self.noted.as_mut().filter(|noted| noted.rows != rows) else { return Ok(Watermark(rows)) };
        noted.rows.clone_from(&rows);
        // It has its name once it is whole.
        FreshFile::write_whole(&self.path, &serde_json::to_vec(noted)?, true)?;
        Ok(Watermark(rows))
    }
}

impl Sink for CheckpointedSink {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let known = if begin.how == WriteMode::Resume { self.read(begin.run.id)? } else { None };
        let there = self.inner.begin(begin)?;
        let noted = known.unwrap_or(Note { run: begin.run.id, rows: Vec::new() });
        let known = Watermark(noted.rows.clone());
        let tables = there.0.len().max(known.0.len());
        self.left_out = (0..tables).map(|table| known.of(table).saturating_sub(there.of(table))).collect();
        self.noted = Some(noted);
        Ok(Watermark((0..tables).map(|table| there.of(table).max(known.of(table))).collect()))
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.inner.write(batch)?;
        for row in batch.rows() {
            if self.given.len() <= row.table {
                self.given.resize(row.table + 1, 0);
            }
            self.given[row.table] += 1;
        }
        Ok(())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let confirmed = self.inner.make_durable()?;
        self.note(&confirmed)
    }

    fn finish(&mut self, end: RunTime) -> Result<(), LogError> {
        let confirmed = self.inner.make_durable()?;
        self.note(&confirmed)?;
        self.inner.finish(end)?;
        let all = Watermark(self.given.clone());
        self.note(&all).map(drop)
    }

    fn is_behind(&self) -> bool {
        self.inner.is_behind()
    }
}
