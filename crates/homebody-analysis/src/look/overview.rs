//! What a log holds, as plain data.

use crate::signs::{Evidence, Kind};
use homebody_log::error::Skipped;
use homebody_log::log::{Clock, ColumnUse};
use jiff::civil::Date;
use serde::Serialize;

/// What a log holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogOverview {
    /// What the log is called.
    pub name: String,
    /// The form in which it was read.
    pub form: String,
    /// How many rows were understood.
    pub rows: u64,
    /// The earliest instant of a row, or of an activity in a log without rows; `None` without either.
    pub first: Option<String>,
    /// The latest.
    pub last: Option<String>,
    /// The clock that instants are told by.
    pub clock: Clock,
    /// The dates of the counts by day, one after the other; none where they are too many.
    pub days: Vec<Date>,
    /// The use of each column of a table, and why; empty for forms without columns.
    pub columns: Vec<ColumnUse>,
    /// Sensors, by name, numbers in it by their size.
    pub sensors: Vec<SensorLook>,
    /// What somebody did, by label, as the log itself notes it.
    pub activities: Vec<ActivityLook>,
    /// Rows that say what was said already: see the table above.
    pub repeated: u64,
    /// Rows before which another is missing.
    pub missing: u64,
    /// Rows that are there twice.
    pub doubled: u64,
    /// How often the clock was set back.
    pub set_back: u64,
    /// The most that it was set back by.
    pub set_back_most_s: f64,
    /// The first of the silences, in the order of time.
    pub silences: Vec<LogSilence>,
    /// How many silences there are.
    pub silences_in_all: u64,
    /// The first of the recorder's gaps, in the order of time. They do not count as silences.
    pub gaps: Vec<LogSilence>,
    /// How many gaps there are.
    pub gaps_in_all: u64,
    /// The lines that were not understood, as far as they are listed.
    pub refused: Vec<u64>,
    /// How many lines were not understood.
    pub refused_in_all: u64,
    /// Why, for those that are listed.
    pub why_refused: Vec<Skipped>,
    /// What else is left out: a sentence each.
    pub remarks: Vec<String>,
    /// How it fits a home, where one was given.
    pub home: Option<OfHome>,
}

/// What a log says of one sensor.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorLook {
    /// What the log calls it.
    pub id: String,
    /// What the home, a map or a table beside the log calls it.
    pub name: Option<String>,
    /// What it is taken for.
    pub kind: Kind,
    /// By which evidence.
    pub by: Evidence,
    /// The evidence in words.
    pub because: String,
    /// How many rows it has.
    pub rows: u64,
    /// On how many dates it says something.
    pub days: u64,
    /// How many rows it has on each of the log's dates; empty where these are not listed.
    pub by_day: Vec<u32>,
    /// Its earliest row.
    pub first: String,
    /// Its latest row.
    pub last: String,
    /// What it says most often, with how often; of numbers none.
    pub values: Vec<(String, u64)>,
    /// The least and the most of the numbers that it tells.
    pub range: Option<[f64; 2]>,
    /// Rows that say what was said already.
    pub repeated: u64,
    /// Rows before which another is missing.
    pub missing: u64,
    /// Rows that are there twice.
    pub doubled: u64,
    /// Rows that say that its state is not known.
    pub unknown: u64,
    /// Rows that restore a state after a stretch that is not known.
    pub restored: u64,
    /// What is the matter with it.
    pub trouble: Option<SensorTrouble>,
}

/// What is the matter with a sensor.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SensorTrouble {
    /// It says nothing more.
    Dead {
        /// Its last row.
        since: String,
    },
    /// It is on, and does not go off.
    StuckOn {
        /// When it came on.
        since: String,
        /// For how long it was on.
        hours: f64,
    },
    /// It tells the same number again and again.
    StuckAt {
        /// The number.
        value: String,
    },
}

/// How often, and for how long in all, somebody did something.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ActivityLook {
    /// Its label.
    pub label: String,
    /// How often.
    pub times: u64,
    /// For how long in all.
    pub hours: f64,
}

/// A time without any row, or without a recorder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogSilence {
    /// The last row before it.
    pub from: String,
    /// The first after it.
    pub to: String,
    /// How long it is.
    pub hours: f64,
    /// Where it is on the days: parts of a day after the first one's midnight.
    #[serde(skip)]
    pub at_days: [f64; 2],
}

/// A sensor of a home.
#[derive(Clone, Debug, PartialEq)]
pub struct HomeSensor {
    /// What the home calls it.
    pub name: String,
    /// What logs of the home call it.
    pub ids: Vec<String>,
    /// What its rows make it look like.
    pub kind: Kind,
}

/// How the sensors of a log fit those of a home.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OfHome {
    /// What the home is called.
    pub name: String,
    /// How many of the log's sensors the home has.
    pub known: usize,
    /// The share of the log's rows that are of these; `None` where there are no rows.
    pub known_share: Option<f64>,
    /// The others.
    pub unknown: Vec<UnlistedSensor>,
    /// Those of the home that the log does not have.
    pub unheard: Vec<String>,
    /// Those that say something else than their kind does in the home.
    pub misfits: Vec<Misfit>,
}

/// A sensor that the home does not have.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnlistedSensor {
    /// What the log calls it.
    pub id: String,
    /// How many rows it has.
    pub rows: u64,
    /// Which share of all rows they are.
    pub share: f64,
}

/// A sensor that is of another kind than in the home.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Misfit {
    /// What the log calls it.
    pub id: String,
    /// What the home calls it.
    pub name: String,
    /// What it is taken for.
    pub is: Kind,
    /// What the home has there.
    pub of_home: Kind,
}
