//! A log that is being read: what its rows say, taken one by one, whatever they are read from.

use super::activities::Notes;
use super::instant::{Instant, Instants};
use super::log::{Clock, Event, Log};
use crate::error::{LogError, place_of};
use crate::limits::{LONGEST_ID, LONGEST_VALUE, beginning};
use crate::plain;
use crate::skipped::Skipped;
use foldhash::HashMap;
use homebody_core::time::{DAY, Micros};
use jiff::Timestamp;
use std::fs::File;
use std::path::Path;

/// How many skipped lines are told one by one.
const MOST_TOLD: usize = 100;

/// Rows that are handed over together.
const PART: usize = 8192;

/// A log that is being read, row by row.
pub(super) struct Reading<'t> {
    /// With the rows that have not been handed over yet.
    pub log: Log,
    path: &'t Path,
    take: &'t mut dyn FnMut(&Log) -> Result<(), LogError>,
    sensors: HashMap<String, u32>,
    values: HashMap<String, u32>,
    pub instants: Instants,
    notes: Notes,
    /// The instant of the last row.
    last: Micros,
}

impl<'t> Reading<'t> {
    pub fn new(path: &'t Path, take: &'t mut dyn FnMut(&Log) -> Result<(), LogError>) -> Reading<'t> {
        let (sensors, values) = (HashMap::default(), HashMap::default());
        let (instants, notes) = (Instants::default(), Notes::default());
        Reading { log: Log::default(), path, take, sensors, values, instants, notes, last: 0 }
    }

    /// Takes a row as a file writes it.
    pub fn row(&mut self, line: u64, time: &str, sensor: &str, value: &str) -> Result<(), LogError> {
        match self.instants.read(time) {
            Some(instant) => self.event(line, instant, sensor, value)?,
            None => self.skip(line, format!("{} is no date and time", beginning(time))),
        }
        Ok(())
    }

    /// Takes a row whose instant is known.
    pub fn event(&mut self, line: u64, instant: Instant, sensor: &str, value: &str) -> Result<(), LogError> {
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
        for (what, text, most) in [("sensor", sensor, LONGEST_ID), ("value", value, LONGEST_VALUE)] {
            // Characters are counted only where they may be too many.
            if text.len() > most && text.chars().count() > most {
                let what = format!("the {what} {} has more than {most} characters", beginning(text));
                return Err(LogError::too_long(self.path, line, what));
            }
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
    pub fn hand_over(&mut self) -> Result<(), LogError> {
        if !self.log.events.is_empty() {
            (self.take)(&self.log)?;
            self.log.events.clear();
        }
        Ok(())
    }

    /// Takes a note, at the last row, that an activity begins or ends.
    pub fn note(&mut self, name: &str, begins: bool) {
        if self.log.rows > 0 {
            self.log.activities.extend(self.notes.take(name, begins, self.last));
        }
    }

    pub fn skip(&mut self, line: u64, why: String) {
        self.log.skipped += 1;
        if self.log.problems.len() < MOST_TOLD {
            self.log.problems.push(Skipped { line, why });
        }
    }
}

/// A file that may hold a log.
pub(super) fn open(path: &Path) -> Result<File, LogError> {
    plain::open(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => LogError::Missing { place: place_of(path) },
        _ => LogError::file(path, error),
    })
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
