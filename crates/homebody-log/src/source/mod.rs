//! Reads logs back: ours, and what real homes recorded. One file for each kind, all in one shape.
//!
//! Whatever is in a file, reading does not fail because of a line: what cannot be understood is skipped and told.

mod activities;
mod casas;
mod csv;
mod instant;
mod movements;
mod run_clock;
mod sqlite;

use crate::error::{LogError, place_of};
use crate::sink::casas::one_word;
use crate::url::Url;
use activities::Notes;
pub use activities::{Activity, Life, activities, lives};
pub(crate) use activities::{Cause, told_causes};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::{DAY, Micros};
use instant::{Instant, Instants};
use jiff::Timestamp;
pub use movements::{Movement, MovementKind, Movements};
pub use run_clock::RunClock;
use serde::Serialize;
pub(crate) use sqlite::text;
use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// A log in memory, its rows in the order in which they were stored.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    pub sensors: Vec<String>,
    /// What sensors said, such as `ON`.
    pub values: Vec<String>,
    pub events: Vec<Event>,
    pub clock: Clock,
    /// What residents did, where the log notes it.
    pub activities: Vec<Activity>,
    /// What else is left out than lines: a sentence each.
    pub remarks: Vec<String>,
    /// The first of the lines that were skipped.
    pub problems: Vec<Skipped>,
    /// How many lines were skipped.
    pub skipped: u64,
}

/// One row of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Microseconds since 1970 on the log's clock.
    pub at: Micros,
    /// Index into the log's sensors.
    pub sensor: u32,
    /// Index into the log's values.
    pub value: u32,
}

/// Which clock a log's instants are told by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The one on the wall, of a zone that the log does not tell.
    #[default]
    Local,
    Utc,
}

/// A line that could not be understood.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Skipped {
    /// Counted from 1; in a database, the row.
    pub line: u64,
    pub why: String,
}

/// How many skipped lines are told one by one.
const TOLD: usize = 100;

impl Log {
    /// The sensor's name.
    pub fn sensor(&self, event: &Event) -> &str {
        &self.sensors[event.sensor as usize]
    }

    /// What the sensor said.
    pub fn value(&self, event: &Event) -> &str {
        &self.values[event.value as usize]
    }
}

/// Reads a log; `file` tells the names of a database's table and columns, or of a CSV file's columns, where they are
/// neither ours nor to be guessed.
pub fn read(url: &Url, file: &LoggerFile) -> Result<Log, LogError> {
    let path = url.file().unwrap_or(Path::new(""));
    let mut reading = Reading::default();
    match url.scheme() {
        Scheme::Sqlite => sqlite::read(path, file, &mut reading)?,
        Scheme::Csv => csv::read(path, file, &mut reading)?,
        Scheme::Casas => casas::read(path, &mut reading)?,
    }
    match reading.log.problems.first() {
        Some(first) if reading.log.events.is_empty() => {
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
    let mut start = Vec::new();
    open(path)?.take(4096).read_to_end(&mut start).map_err(|error| LogError::file(path, error))?;
    if start.starts_with(b"SQLite format 3\0") {
        return Ok(Url::new(Scheme::Sqlite, path));
    }
    let first = start.split(|&byte| byte == b'\n').find(|line| !line.trim_ascii().is_empty()).unwrap_or_default();
    let commas = first.iter().filter(|&&byte| byte == b',').count();
    Ok(Url::new(if commas >= 2 { Scheme::Csv } else { Scheme::Casas }, path))
}

fn open(path: &Path) -> Result<File, LogError> {
    let opened = File::open(path).and_then(|file| match file.metadata()?.is_dir() {
        true => Err(std::io::ErrorKind::IsADirectory.into()),
        false => Ok(file),
    });
    opened.map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => LogError::Missing { place: place_of(path) },
        _ => LogError::file(path, error),
    })
}

/// A log that is being read, row by row.
#[derive(Default)]
struct Reading {
    log: Log,
    sensors: HashMap<String, u32>,
    values: HashMap<String, u32>,
    instants: Instants,
    notes: Notes,
}

impl Reading {
    /// Takes a row as a file writes it.
    fn row(&mut self, line: u64, time: &str, sensor: &str, value: &str) {
        match self.instants.read(time) {
            Some(instant) => self.event(line, instant, sensor, value),
            None => self.skip(line, format!("{time:?} is no date and time")),
        }
    }

    /// Takes a row whose instant is known.
    fn event(&mut self, line: u64, instant: Instant, sensor: &str, value: &str) {
        let (at, clock) = match instant {
            Instant::Local(at) => (at, Clock::Local),
            Instant::Utc(at) => (at, Clock::Utc),
        };
        if !is_on_any_clock(at) {
            return self.skip(line, "the time is out of range".into());
        }
        if sensor.is_empty() || value.is_empty() {
            return self.skip(line, format!("there is no {}", if sensor.is_empty() { "sensor" } else { "value" }));
        }
        if self.log.events.is_empty() {
            self.log.clock = clock;
        } else if self.log.clock != clock {
            return self.skip(line, "some instants have a zone and some have none".into());
        }
        let sensor = number(&mut self.sensors, &mut self.log.sensors, sensor);
        let value = number(&mut self.values, &mut self.log.values, value);
        self.log.events.push(Event { at, sensor, value });
    }

    /// Takes a note, at the last row, that an activity begins or ends.
    fn note(&mut self, name: &str, begins: bool) {
        let Some(last) = self.log.events.last() else { return };
        self.log.activities.extend(self.notes.take(name, begins, last.at));
    }

    fn skip(&mut self, line: u64, why: String) {
        self.log.skipped += 1;
        if self.log.problems.len() < TOLD {
            self.log.problems.push(Skipped { line, why });
        }
    }
}

/// Whether the instant can be told in every zone: some write 9999-12-31 for never.
fn is_on_any_clock(at: Micros) -> bool {
    (Timestamp::MIN.as_microsecond() + DAY..Timestamp::MAX.as_microsecond() - DAY).contains(&at)
}

/// The number of a text, a new one if it is new.
fn number(known: &mut HashMap<String, u32>, all: &mut Vec<String>, text: &str) -> u32 {
    if let Some(&number) = known.get(text) {
        return number;
    }
    let number = all.len() as u32;
    known.insert(text.into(), number);
    all.push(text.into());
    number
}

/// What a column is called in the logs that are known, ours first. Names are compared in lower case.
const TIMES: [&str; 9] =
    ["fired_at", "time", "timestamp", "datetime", "date_time", "last_changed", "last_changed_ts", "at", "ts"];
const SENSORS: [&str; 8] = ["sensor", "device", "entity_id", "sensor_id", "device_id", "item", "name", "code"];
const VALUES: [&str; 5] = ["value", "state", "message", "status", "event"];

/// Where a row's time, sensor and value are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Places {
    time: usize,
    sensor: usize,
    value: usize,
}

impl Places {
    /// By the names of a mapping or, failing them, the usual ones.
    fn by_name(names: &[String], file: &LoggerFile) -> Option<Places> {
        let exactly = |wanted: &str| names.iter().position(|name| name == wanted);
        let usual = |wanted: &[&str]| {
            wanted.iter().find_map(|wanted| names.iter().position(|name| name.trim().eq_ignore_ascii_case(wanted)))
        };
        let columns = &file.columns;
        let mapped = || {
            Some(Places {
                time: exactly(&columns.time)?,
                sensor: exactly(&columns.sensor)?,
                value: exactly(&columns.value)?,
            })
        };
        let guessed = || Some(Places { time: usual(&TIMES)?, sensor: usual(&SENSORS)?, value: usual(&VALUES)? });
        mapped().or_else(guessed)
    }
}
