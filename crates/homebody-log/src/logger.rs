//! Stores a run's firings in as many places as wished.

use crate::error::LogError;
use crate::fresh::all_can_be_written;
use crate::mapping::{Columns, Shown};
use crate::messages::{Messages, Row};
use crate::sink::Opening;
use crate::url::Url;
use crate::writer::{BATCH, BATCH_WAITS, Writer};
use homebody_core::event::Firing;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::Micros;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// What tells a run from others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunInfo {
    /// The run's number in its database.
    pub id: i64,
    /// The scenario's name.
    pub scenario: String,
    pub seed: u64,
    /// The program's version.
    pub version: String,
}

/// Stores firings as a scenario's `logger.json` says.
///
/// [`Logger::store`] what each advance of the run has brought, then [`Logger::finish`]. A logger that is dropped
/// unfinished has been given up: text files vanish, a database keeps what it holds. After an error the logger is of no
/// more use.
pub struct Logger {
    places: Vec<Url>,
    writers: Vec<Writer<Row>>,
    messages: Messages,
    /// Rows that do not fill a batch yet.
    rows: Vec<Row>,
    sent_at: Instant,
    until: Micros,
    stored: Stored,
    /// The place that failed.
    failed: Option<PathBuf>,
}

/// What a logger has stored.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stored {
    /// Rows in each of the places.
    pub rows: u64,
    /// Rows of each sensor.
    pub by_sensor: Vec<u64>,
    /// Where they are.
    pub places: Vec<Url>,
}

impl Logger {
    /// Opens all places, or none: `sensors` are the names of the home's sensors, in their order.
    ///
    /// Files that exist are replaced with `force` only. Paths are taken as they are; see [`Url::within`].
    pub fn open(
        urls: &[Url],
        file: &LoggerFile,
        sensors: &[String],
        calendar: &Calendar,
        run: &RunInfo,
        force: bool,
    ) -> Result<Logger, LogError> {
        let columns = Columns::new(file)?;
        let shown = Shown::new(file, sensors)?;
        all_can_be_written(&urls.iter().map(Url::path).collect::<Vec<_>>(), force)?;
        let opening = Opening { columns: &columns, shown: &shown, calendar, run, force };
        let sinks = urls.iter().map(|url| opening.open(url)).collect::<Result<Vec<_>, _>>()?;
        Ok(Logger {
            places: urls.to_vec(),
            writers: sinks.into_iter().map(Writer::spawn).collect(),
            messages: Messages::new(&file.messages, sensors.len()),
            rows: Vec::with_capacity(BATCH),
            sent_at: Instant::now(),
            until: 0,
            stored: Stored { rows: 0, by_sensor: vec![0; sensors.len()], places: urls.to_vec() },
            failed: None,
        })
    }

    /// Stores firings: all there are from the last `until` to this one, in their order.
    ///
    /// Rows wait a moment for others. A live run that is paused calls this with no firings now and then, so that
    /// what was last seen reaches the log.
    pub fn store(&mut self, firings: &[Firing], until: Micros) -> Result<(), LogError> {
        if let Some(path) = &self.failed {
            return Err(LogError::Stopped { path: path.clone() });
        }
        for firing in firings {
            self.messages.firing(firing, &mut self.rows);
            if self.rows.len() >= BATCH {
                self.send()?;
            }
        }
        self.until = until;
        self.messages.quiet(until, &mut self.rows);
        if self.sent_at.elapsed() >= BATCH_WAITS { self.send() } else { Ok(()) }
    }

    /// Makes sure of all rows and gives the files their names. Sensors that are held ON stay so.
    pub fn finish(mut self) -> Result<Stored, LogError> {
        self.store(&[], self.until)?;
        self.send()?;
        for writer in std::mem::take(&mut self.writers) {
            writer.finish(self.until)?;
        }
        Ok(std::mem::take(&mut self.stored))
    }

    /// Hands what there is to the writers.
    fn send(&mut self) -> Result<(), LogError> {
        self.sent_at = Instant::now();
        let rows = Arc::new(std::mem::replace(&mut self.rows, Vec::with_capacity(BATCH)));
        for row in rows.iter() {
            self.stored.by_sensor[row.sensor.index()] += 1;
        }
        self.stored.rows += rows.len() as u64;
        for index in 0..self.writers.len() {
            let writer = &mut self.writers[index];
            if let Err(error) = if rows.is_empty() { writer.check() } else { writer.send(rows.clone()) } {
                // With a gap in one place, the others shall not go on.
                self.failed = Some(self.places[index].path().into());
                self.writers.clear();
                return Err(error);
            }
        }
        Ok(())
    }
}
