//! A log by its name, with the run that left it: reading, searching and checking it.
//!
//! A [`LogRef`] says where a log is, and knows its run. A [`LoadedLog`] is the log on the wall clock of its home, a [`UtcLog`] the log in
//! UTC. This crate does not know who asks, nor how an answer is shown. Reading order:

pub mod search;
mod error;
pub mod catalogue;

mod long_log;
mod home_sensors;
mod log_ref;
mod truth;
mod loaded_log;
mod utc_log;

mod camera_falls;
mod log_search;
mod place_check;

pub use camera_falls::{FallReport, FallSearch, ReportedFall, RunSilhouettes, falls_in, silhouettes_of};
pub use error::QueryError;
pub use home_sensors::{home_sensors, sensor_rooms};
pub use homebody_log::check::{Check, CheckVerdict};
pub use loaded_log::{LoadedLog, LostMessage};
pub use log_ref::{IncompleteLog, LogRef};
pub use log_search::find_in_log;
pub use place_check::{PlaceCheck, PlaceReport};
pub use utc_log::UtcLog;
