//! Reads logs back: ours, and what real homes recorded. One file for each kind, all in one shape.
//!
//! A log is read into memory, or streamed where it may be of any size. Beside a run's log lies a table of its sensors; what it
//! tells comes with the log.
//!
//! Whatever is in a file, reading does not fail because of a line: what cannot be understood is skipped and told.

mod activities;
mod casas;
mod csv;
mod instant;
mod movements;
mod run_clock;
mod sensors;
mod sqlite;

use crate::error::{LogError, place_of};
use crate::run_info::SensorInfo;
use crate::sink::casas::one_word;
use crate::url::Url;
use activities::Notes;
pub use activities::{Activity, Life, activities, lives};
pub(crate) use activities::{Cause, Causes};
use foldhash::HashMap;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::{DAY, Micros};
use instant::{Instant, Instants};
use jiff::Timestamp;
pub use movements::{Movement, MovementKind, Movements};
pub use run_clock::RunClock;
use serde::Serialize;
pub(crate) use sqlite::text;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// A log in memory, or a part of one that is streamed; its rows in the order in which they were stored.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// The ids of the sensors, in the order in which they came.
    pub sensors: Vec<String>,
    /// What is known of sensors beside their ids, in no particular order; nothing of most.
    pub known: Vec<SensorInfo>,
    /// What sensors said, such as `ON`.
    pub values: Vec<String>,
    /// The rows that are in memory.
    pub events: Vec<Event>,
    /// How many rows have been read.
    pub rows: u64,
    /// The clock that its instants are told by.
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
    /// The same everywhere on earth.
    Utc,
}

/// A line that could not be understood.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Skipped {
    /// Counted from 1; in a database, the row.
    pub line: u64,
    /// What could not be understood, as a part of a sentence.
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
    let mut reading = Reading::new(take);
    reading.log.known = sensors::beside(path)?;
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

/// Rows that are handed over together.
const PART: usize = 8192;

/// A log that is being read, row by row.
struct Reading<'t> {
    /// With the rows that have not been handed over yet.
    log: Log,
    take: &'t mut dyn FnMut(&Log) -> Result<(), LogError>,
    sensors: HashMap<String, u32>,
    values: HashMap<String, u32>,
    instants: Instants,
    notes: Notes,
    /// The instant of the last row.
    last: Micros,
}

impl<'t> Reading<'t> {
    fn new(take: &'t mut dyn FnMut(&Log) -> Result<(), LogError>) -> Reading<'t> {
        let (sensors, values) = (HashMap::default(), HashMap::default());
        let (instants, notes) = (Instants::default(), Notes::default());
        Reading { log: Log::default(), take, sensors, values, instants, notes, last: 0 }
    }

    /// Takes a row as a file writes it.
    fn row(&mut self, line: u64, time: &str, sensor: &str, value: &str) -> Result<(), LogError> {
        match self.instants.read(time) {
            Some(instant) => self.event(line, instant, sensor, value)?,
            None => self.skip(line, format!("{time:?} is no date and time")),
        }
        Ok(())
    }

    /// Takes a row whose instant is known.
    fn event(&mut self, line: u64, instant: Instant, sensor: &str, value: &str) -> Result<(), LogError> {
        let (at, clock) = match instant {
            Instant::Local(at) => (at, Clock::Local),
            Instant::Utc(at) => (at, Clock::Utc),
        };
        let fault = if !is_on_any_clock(at) {
            Some("the time is out of range")
        } else if sensor.is_empty() {
            Some("there is no sensor")
        } else if value.is_empty() {
            Some("there is no value")
        } else if self.log.rows > 0 && self.log.clock != clock {
            Some("some instants have a zone and some have none")
        } else {
            None
        };
        if let Some(fault) = fault {
            self.skip(line, fault.into());
            return Ok(());
        }
        self.log.clock = clock;
        let sensor = number(&mut self.sensors, &mut self.log.sensors, sensor);
        let value = number(&mut self.values, &mut self.log.values, value);
        if self.log.events.len() == PART {
            self.hand_over()?;
        }
        self.log.events.push(Event { at, sensor, value });
        self.log.rows += 1;
        self.last = at;
        Ok(())
    }

    /// Hands over the rows that have come since the last time.
    fn hand_over(&mut self) -> Result<(), LogError> {
        if !self.log.events.is_empty() {
            (self.take)(&self.log)?;
            self.log.events.clear();
        }
        Ok(())
    }

    /// Takes a note, at the last row, that an activity begins or ends.
    fn note(&mut self, name: &str, begins: bool) {
        if self.log.rows > 0 {
            self.log.activities.extend(self.notes.take(name, begins, self.last));
        }
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
