//! Destinations and sources of logs: databases and files, ours and those of real networks.
//!
//! A run gives its firings to a [`Logger`], which stores them in any number of places, and its facts to a [`TruthLog`], which keeps the
//! ground truth in a separate file; a [`RunLog`] is both, and the recording. A file of firings never holds a fact. Both hand their rows to
//! writer threads, so that the simulation does not wait for disks; an error of such a thread comes out of the next call.
//!
//! No file is left half written: a CSV or CASAS file has its name only once it is whole, and an SQLite database holds a gap-free beginning
//! of the run, even if the program was killed. A [`Log`] is read back from all of these, and from recordings of real homes.
//!
//! This crate does not know how firings come about, nor what a log means. Reading order: each module needs only those before it.

#![warn(missing_docs)]

pub mod limits;
pub mod text;
pub mod error;

pub mod table;
pub mod url;
pub mod log;

pub mod files;
pub mod policy;
pub mod check;
pub mod run;

pub mod sink;
pub mod source;
pub mod preview;
pub mod registry;

pub mod read;
pub mod truth;

pub mod simulated;

pub mod destination;
pub mod silhouettes;
pub mod run_log;
pub mod fleet;

pub mod transfer;
pub mod examine;
pub mod records;
pub mod catalogue;

pub use destination::Destination;
pub use destination::spool::WhenDown;
pub use error::{DestinationError, LogError, Reason};
pub use files::WriteMode;
pub use log::{Event, Log, SaidBy, SensorInfo, ValuePair};
pub use policy::Policy;
pub use policy::cancel::Cancel;
pub use policy::deadline::Deadline;
pub use policy::metrics::SinkMetrics;
pub use read::{LogSource, SensorMap, ids, read, read_mapping, scale_of, stream, survey};
pub use run::RunInfo;
pub use run::places::RunPlaces;
pub use run_log::RunLog;
pub use run_log::logger::{Logger, RowsOfFirings, Stored};
pub use run_log::truth_log::TruthLog;
pub use simulated::SimulatedRun;
pub use sink::{Begin, Sink, Watermark};
pub use table::{LogRows, RowText};
pub use transfer::Transfer;
pub use transfer::anonymise::{Anonymised, Anonymising, anonymise};
pub use transfer::convert::convert;
pub use transfer::label::{Labelled, label};
pub use truth::{Movement, MovementKind, Movements, each_episode, read_timeline, truth_at, truth_beside, truth_of};
pub use url::Url;
