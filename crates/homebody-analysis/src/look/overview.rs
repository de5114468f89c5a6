use crate::signs::{Evidence, Kind};
use homebody_log::error::Skipped;
use homebody_log::log::{Clock, ColumnUse};
use jiff::civil::Date;
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogOverview {
    pub name: String,
    pub form: String,
    pub rows: u64,
    /// The earliest instant of a row, or of an activity in a log without rows; `None` without either.
    pub first: Option<String>,
    pub last: Option<String>,
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
    pub doubled: u64,
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
    pub why_refused: Vec<Skipped>,
    /// Other things that are left out, in sentences.
    pub remarks: Vec<String>,
    pub home: Option<OfHome>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorLook {
    pub id: String,
    /// The name in the home, a map or a table next to the log.
    pub name: Option<String>,
    pub kind: Kind,
    pub by: Evidence,
    pub because: String,
    pub rows: u64,
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
    pub repeated: u64,
    /// Rows after a missing one.
    pub missing: u64,
    pub doubled: u64,
    pub unknown: u64,
    /// Rows that restore a state after an unknown time.
    pub restored: u64,
    pub trouble: Option<SensorTrouble>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SensorTrouble {
    /// It sends no more rows.
    Dead { since: String },
    /// It is on, and does not go off.
    StuckOn { since: String, hours: f64 },
    /// It repeats the same number.
    StuckAt { value: String },
}

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
    pub ids: Vec<String>,
    pub kind: Kind,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct OfHome {
    pub name: String,
    pub known: usize,
    /// The share of the log's rows from these; `None` without rows.
    pub known_share: Option<f64>,
    pub unknown: Vec<UnlistedSensor>,
    pub unheard: Vec<String>,
    pub misfits: Vec<Misfit>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnlistedSensor {
    pub id: String,
    pub rows: u64,
    /// Its share of all rows.
    pub share: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Misfit {
    pub id: String,
    pub name: String,
    /// The kind by the log.
    pub is: Kind,
    pub of_home: Kind,
}
