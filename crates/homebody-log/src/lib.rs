//! Where a log goes and where it comes from: databases and files, ours and real networks'.
//!
//! A run gives its firings to a [`Logger`], which stores them in as many places as wished, and its
//! facts to a [`TruthLog`], which keeps the ground truth in a file of its own; a [`RunLog`] is both, and the recording. No firing's file ever
//! holds a fact. Both hand their rows to writer threads, so that the simulation does not wait for disks;
//! an error of such a thread comes out of the next call.
//!
//! Nothing is half written: a CSV or CASAS file has its name only once it is whole, and what an SQLite
//! database holds is a gap-free beginning of the run, whatever killed the program. A [`Log`] is read back from
//! all of these, and from what real homes recorded.
//!
//! This crate does not know how firings come about, nor what a log means. Reading order:

#![warn(missing_docs)]

pub mod url;

pub mod limits;
pub mod skipped;
pub mod error;
pub mod catalogue;

pub mod fresh;
pub mod plain;
pub mod written;
pub mod lock;
pub mod places;

pub mod table;
pub mod sensor_info;
pub mod run_info;
mod sensor_table;
mod replaced;
mod cancel;
mod deadline;
pub mod meter;
mod waiting;
mod timed;
pub mod policy;
pub mod sink;
mod timed_sink;
mod check;
mod numbered;
pub mod elsewhere;

pub mod clock;
pub mod word;
pub mod spreadsheet;
mod mapping;
mod messages;
pub mod problems;
mod reason;
mod packed;
pub mod spool;
pub mod remembered;
pub mod destination;
mod writer;

pub mod logger;
pub mod truth;

/// Fleets: many homes that tell one place.
pub mod fleet;

pub mod silhouettes;
pub mod run_log;
pub mod rows;

pub mod preview;

pub mod source;
pub mod examine;
mod spans;
pub mod transfer;
pub mod convert;
pub mod anonymise;
pub mod label;

pub mod records;

pub use anonymise::{Anonymised, Anonymising, anonymise};
pub use cancel::Cancel;
pub use convert::convert;
pub use deadline::Deadline;
pub use destination::Destination;
pub use error::{Failed, LogError, Reason};
pub use label::{Labelled, label};
pub use logger::{Logger, RowsOfFirings, Stored};
pub use mapping::read_mapping;
pub use meter::Meter;
pub use places::Places;
pub use policy::Policy;
pub use rows::{RowText, Rows};
pub use run_info::RunInfo;
pub use run_log::RunLog;
pub use sensor_info::{SaidBy, SensorInfo};
pub use sink::{Begin, How, Sink, Watermark};
pub use source::{
    Activity, Event, Life, LifeSpan, Log, Movement, MovementKind, Movements, Pair, RunClock, SensorMap, Source,
    SpanKind, activities, ids, life_spans, lives, read, stream, survey, truth_at, truth_beside, truth_of,
};
pub use spool::WhenDown;
pub use transfer::Transfer;
pub use truth::TruthLog;
pub use url::Url;
