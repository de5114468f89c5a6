//! A log by the world's clock, with what the truth tells of its residents: what programs take that compute with instants, where people
//! read those on the wall.

use crate::error::Error;
use crate::log_with_run::NamedLog;
use crate::long_log::MOST_COMPARED;
use homebody_analysis::dates::put_on_wall;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::time::Micros;
use homebody_log::problems::TruthMessage;
use homebody_log::source::{Clock, Value, truth_rows};
use homebody_log::table::ColumnKind;
use homebody_log::truth::{Truth, tables};
use homebody_log::{Activity, Life, Log, LogError, RunClock, Url, activities, lives};
use jiff::Timestamp;
use jiff::tz::TimeZone;

/// A log whose instants, and those of lives, are microseconds since 1970 in UTC; on the wall where nobody knows of which zone it is.
pub struct Instants {
    /// The log, its sensors by the names that they have in their home.
    pub log: Log,
    /// What the truth tells of residents, or the log itself notes, of whom it tells no name.
    pub lives: Vec<Life>,
    /// The zone of the home; None where instants are on the wall.
    pub zone: Option<String>,
}

/// Reads instants of one log as the world's clock has them.
pub struct OnEarth {
    file: RunClock,
    utc: RunClock,
    /// For a log on the wall whose run nobody knows.
    zone: Option<TimeZone>,
    last: Micros,
}

impl OnEarth {
    fn at(&mut self, told: Micros) -> Micros {
        self.last = self.file.instant(told, self.last);
        match &self.zone {
            Some(zone) => off_the_wall(self.last, zone),
            None => self.utc.told(self.last),
        }
    }
}

/// The instant of a time on the wall of a zone; of two the first.
fn off_the_wall(at: Micros, zone: &TimeZone) -> Micros {
    let wall = Timestamp::from_microsecond(at).unwrap_or(Timestamp::MIN).to_zoned(TimeZone::UTC).datetime();
    zone.to_timestamp(wall).map_or(at, Timestamp::as_microsecond)
}

impl NamedLog {
    /// Reads it by the world's clock. `zone` is that of its home, where its run does not tell it.
    ///
    /// # Errors
    ///
    /// [`Error::TimeZone`] if there is no such zone, and those of [`NamedLog::read`].
    pub fn instants(&self, zone: Option<&str>) -> Result<Instants, Error> {
        let asked = zone.map(|name| Calendar::zone(name).map_err(|_| Error::zone(name))).transpose()?;
        let mut log = self.read()?;
        let first = log.events.iter().take(MOST_COMPARED).copied().collect();
        let truth = self.own_truth(&mut log, first)?;
        let known = self.zone();
        let off_the_wall = asked.clone().filter(|_| known.is_none() && log.clock == Clock::Local);
        let clock_of = |file: RunClock| OnEarth {
            file,
            utc: self.clock_of(Clock::Utc),
            zone: off_the_wall.clone(),
            last: Micros::MIN,
        };
        let is_naive = log.clock == Clock::Local && known.is_none() && asked.is_none();
        let mut clock = clock_of(self.clock_of(log.clock));
        log.events.iter_mut().for_each(|event| event.at = clock.at(event.at));
        let mut noted = std::mem::take(&mut log.activities);
        let mut clock = clock_of(self.clock_of(log.clock));
        for Activity { begin, end, .. } in &mut noted {
            (*begin, *end) = (clock.at(*begin), clock.at(*end));
        }
        let mut lives = match truth {
            Some(truth) => lives(&truth, &self.clock())?,
            None => Vec::new(),
        };
        // Those are on the run's own clock already.
        let mut clock = clock_of(RunClock::as_told());
        for part in lives.iter_mut().flat_map(|life| life.activities.iter_mut().chain(&mut life.rooms)) {
            (part.begin, part.end) = (clock.at(part.begin), clock.at(part.end));
        }
        if lives.is_empty() && !noted.is_empty() {
            lives.push(Life { resident: String::new(), activities: noted, rooms: Vec::new() });
        }
        for sensor in &mut log.sensors {
            if let Some(name) = self.name_of(sensor) {
                *sensor = name.to_owned();
            }
        }
        let zone = known.or(asked).or_else(|| log.zone.clone()).unwrap_or(TimeZone::UTC);
        let zone = (!is_naive).then(|| zone.iana_name().unwrap_or("UTC").to_owned());
        Ok(Instants { log, lives, zone })
    }

    /// The truth beside it.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if there is none.
    pub fn truth_that_is_there(&self) -> Result<Url, Error> {
        let no_truth = || LogError::no_truth(self.place.to_string(), TruthMessage::NotBeside);
        Ok(self.truth().ok_or_else(no_truth)?)
    }

    /// Gives the rows of a table of the truth beside it, with instants as [`Instants`] has them.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if there is no such table, or no truth.
    pub fn truth_rows(&self, table: &str, take: &mut dyn FnMut(&[Value<'_>])) -> Result<(), Error> {
        let truth = self.truth_that_is_there()?;
        let all = tables();
        let Some(index) = all.iter().position(|known| known.name == table) else {
            let known = all.iter().map(|table| table.name.clone()).collect();
            let no_table = TruthMessage::NoTable { table: table.into(), known };
            return Err(LogError::no_truth(truth.to_string(), no_table).into());
        };
        let utc = self.clock_of(Clock::Utc);
        let instants: Vec<bool> = all[index].columns.iter().map(|column| column.kind == ColumnKind::Instant).collect();
        truth_rows(&truth, Truth::ALL[index], &self.clock(), &mut |row| {
            let mut cells = row.to_vec();
            for (cell, is_instant) in cells.iter_mut().zip(&instants) {
                if let Value::Integer(at) = cell
                    && *is_instant
                {
                    *at = utc.told(*at);
                }
            }
            take(&cells);
            Ok(())
        })?;
        Ok(())
    }

    /// What residents did, in the order of their beginnings, as the truth or the log tells it. A log in UTC, of a run that nobody knows, is
    /// put on the wall of `zone`, where one is given.
    ///
    /// # Errors
    ///
    /// [`Error::TimeZone`] if there is no such zone, and those of [`NamedLog::read`].
    pub fn with_activities(&self, zone: Option<&str>) -> Result<Log, Error> {
        let asked = zone.map(|name| Calendar::zone(name).map_err(|_| Error::zone(name))).transpose()?;
        let mut log = self.read()?;
        let first = log.events.iter().take(MOST_COMPARED).copied().collect();
        let truth = self.own_truth(&mut log, first)?;
        if let Some(zone) = asked.filter(|_| self.zone().is_none()) {
            put_on_wall(&mut log, &zone);
        }
        if let Some(truth) = truth {
            log.activities = activities(&truth, &self.clock())?;
            // Rows are put on the clock of the run, which is never set, as activities of the truth are.
            let clock = self.clock_of(log.clock);
            let mut last = Micros::MIN;
            for event in &mut log.events {
                last = clock.instant(event.at, last);
                event.at = last;
            }
        }
        Ok(log)
    }
}
