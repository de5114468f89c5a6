//! The overview of a log, as plain data.

use crate::signs::{Evidence, Kind};
use homebody_log::error::Skipped;
use homebody_log::log::{Clock, ColumnUse};
use jiff::civil::Date;
use serde::Serialize;

/// The content of a log.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogOverview {
    pub name: String,
    pub form: String,
    /// The number of rows that were understood.
    pub rows: u64,
    /// The earliest instant of a row, or of an activity in a log without rows; `None` without either.
    pub first: Option<String>,
    /// The same of the latest.
    pub last: Option<String>,
    /// The clock of the instants.
    pub clock: Clock,
    /// The dates of the counts by day, one after the other; empty where they are too many.
    pub days: Vec<Date>,
    /// The use of each column of a table, and why; empty for forms without columns.
    pub columns: Vec<ColumnUse>,
    /// The sensors, in the natural order of their names.
    pub sensors: Vec<SensorLook>,
    pub activities: Vec<ActivityLook>,
    /// Rows that repeat the state: see the table above.
    pub repeated: u64,
    /// Rows after a missing one.
    pub missing: u64,
    /// Rows that are there twice.
    pub doubled: u64,
    /// The number of times that the clock was set back.
    pub set_back: u64,
    /// The largest time that it was set back by.
    pub set_back_most_s: f64,
    /// The first of the silences, in the order of time.
    pub silences: Vec<LogSilence>,
    pub silences_in_all: u64,
    /// The first of the recorder's gaps, in the order of time. They do not count as silences.
    pub gaps: Vec<LogSilence>,
    pub gaps_in_all: u64,
    /// The listed lines that were not understood.
    pub refused: Vec<u64>,
    /// The number of lines that were not understood.
    pub refused_in_all: u64,
    /// The reasons, for the listed lines.
    pub why_refused: Vec<Skipped>,
    /// Other things that are left out, in sentences.
    pub remarks: Vec<String>,
    /// The fit to a home, if there is one.
    pub home: Option<OfHome>,
}

/// The content of a log about one sensor.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorLook {
    /// The id in the log.
    pub id: String,
    /// The name in the home, a map or a table next to the log.
    pub name: Option<String>,
    /// The kind of the sensor.
    pub kind: Kind,
    /// The evidence for the kind.
    pub by: Evidence,
    /// The evidence in words.
    pub because: String,
    pub rows: u64,
    /// The number of dates with a row.
    pub days: u64,
    /// The rows on each of the log's dates; empty where these are not listed.
    pub by_day: Vec<u32>,
    /// Its earliest row.
    pub first: String,
    /// Its latest row.
    pub last: String,
    /// The most frequent values, with their counts; empty for numbers.
    pub values: Vec<(String, u64)>,
    /// The least and the greatest number.
    pub range: Option<[f64; 2]>,
    /// Rows that repeat the state.
    pub repeated: u64,
    /// Rows after a missing one.
    pub missing: u64,
    /// Rows that are there twice.
    pub doubled: u64,
    /// Rows with an unknown state.
    pub unknown: u64,
    /// Rows that restore a state after an unknown time.
    pub restored: u64,
    /// The fault of the sensor, if there is one.
    pub trouble: Option<SensorTrouble>,
}

/// A fault of a sensor.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SensorTrouble {
    /// It sends no more rows.
    Dead { since: String },
    /// It is on, and does not go off.
    StuckOn {
        /// The begin of the ON.
        since: String,
        hours: f64,
    },
    /// It repeats the same number.
    StuckAt { value: String },
}

/// The number and the total length of an activity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ActivityLook {
    pub label: String,
    pub times: u64,
    pub hours: f64,
}

/// A time without any row, or without a recorder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogSilence {
    /// The last row before it.
    pub from: String,
    /// The first after it.
    pub to: String,
    pub hours: f64,
    /// Its place on the days: parts of a day after the first one's midnight.
    #[serde(skip)]
    pub at_days: [f64; 2],
}

#[derive(Clone, Debug, PartialEq)]
pub struct HomeSensor {
    pub name: String,
    /// The ids in logs of the home.
    pub ids: Vec<String>,
    /// The kind that its rows suggest.
    pub kind: Kind,
}

/// The fit of the sensors of a log to those of a home.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OfHome {
    /// The name of the home.
    pub name: String,
    /// The number of the log's sensors that the home has.
    pub known: usize,
    /// The share of the log's rows from these; `None` without rows.
    pub known_share: Option<f64>,
    /// The other sensors.
    pub unknown: Vec<UnlistedSensor>,
    /// The sensors of the home that the log lacks.
    pub unheard: Vec<String>,
    /// The sensors of another kind than in the home.
    pub misfits: Vec<Misfit>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnlistedSensor {
    /// The id in the log.
    pub id: String,
    pub rows: u64,
    /// Its share of all rows.
    pub share: f64,
}

/// A sensor that is of another kind than in the home.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Misfit {
    /// The id in the log.
    pub id: String,
    /// The name in the home.
    pub name: String,
    /// The kind by the log.
    pub is: Kind,
    pub of_home: Kind,
}
