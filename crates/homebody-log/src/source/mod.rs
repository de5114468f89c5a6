//! Reads logs back: ours, and what real homes recorded. One file for each kind, all in one shape.
//!
//! A log is read into memory, or streamed where it may be of any size. Beside a run's log lies a table of its sensors; what it
//! tells comes with the log.
//!
//! Whatever is in a file, reading does not fail because of a line: what cannot be understood is skipped and told. Only what is
//! longer than anything that a log has ends it, before it fills the memory.

mod activities;
mod casas;
mod causes;
mod columns;
mod csv;
mod database;
mod instant;
mod lives;
mod log;
mod movements;
mod reading;
mod recorded_truth;
mod records;
mod run_clock;
mod sensors;
mod sqlite;
mod start;
mod turns;

use crate::error::{LogError, place_of};
pub use crate::skipped::Skipped;
use crate::url::Url;
use crate::word::one_word;
pub use activities::Activity;
pub(crate) use causes::{Cause, Causes};
pub(crate) use database::text;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::Scheme;
pub(crate) use lives::lives_of;
pub use lives::{Life, activities, lives};
pub use log::{Clock, Event, Log};
pub use movements::{Movement, MovementKind, Movements};
use reading::Reading;
pub(crate) use recorded_truth::{LABEL_TABLES, RecordedTruth};
pub use recorded_truth::{truth_at, truth_beside};
pub use run_clock::RunClock;
use start::Start;
use std::path::Path;

/// Reads a log into memory; `file` tells the names of a database's table and columns, or of a CSV file's columns, where they
/// are neither ours nor to be guessed.
pub fn read(url: &Url, file: &LoggerFile) -> Result<Log, LogError> {
    let mut events = Vec::new();
    let log = stream(url, file, &mut |part| {
        events.extend_from_slice(&part.events);
        Ok(())
    })?;
    Ok(Log { events, ..log })
}

/// Reads a log through and keeps none of its rows: its sensors, values and clock, how many rows it has, and what was left out.
pub fn survey(url: &Url, file: &LoggerFile) -> Result<Log, LogError> {
    stream(url, file, &mut |_| Ok(()))
}

/// Reads a log of any size in little memory. `take` gets its rows in parts, in their order: each time a log with the rows of
/// that part, and with the sensors and values that have come so far. What is returned has all but the rows.
pub fn stream(
    url: &Url,
    file: &LoggerFile,
    take: &mut dyn FnMut(&Log) -> Result<(), LogError>,
) -> Result<Log, LogError> {
    let path = url.file().unwrap_or(Path::new(""));
    let mut reading = Reading::new(path, take);
    reading.log.known = sensors::known_beside(path, &mut reading.log.remarks)?;
    match url.scheme() {
        Scheme::Sqlite => sqlite::read(path, file, &mut reading)?,
        Scheme::Csv => csv::read(path, file, &mut reading)?,
        Scheme::Casas => casas::read(path, &mut reading)?,
    }
    reading.hand_over()?;
    match reading.log.problems.first() {
        Some(first) if reading.log.rows == 0 => {
            Err(LogError::NoLog { place: place_of(path), why: format!("line {}: {}", first.line, first.why) })
        }
        _ => Ok(reading.log),
    }
}

/// What a run's log in this place calls sensors of these names.
pub fn ids(url: &Url, file: &LoggerFile, sensors: &[String]) -> Vec<String> {
    let ids = sensors.iter().map(|name| file.ids.get(name).unwrap_or(name));
    match url.scheme() {
        Scheme::Casas => ids.map(|id| one_word(id)).collect(),
        Scheme::Sqlite | Scheme::Csv => ids.cloned().collect(),
    }
}

/// What kind of log a file holds, by how it begins.
pub fn recognise(path: &Path) -> Result<Url, LogError> {
    let start = Start::of(path)?;
    let scheme = match start.is_sqlite() {
        true => Scheme::Sqlite,
        false if start.delimiters() >= 2 => Scheme::Csv,
        false => Scheme::Casas,
    };
    Ok(Url::new(scheme, path))
}
