//! The whole program as a library: open a scenario, live it, and take what happens as it comes or have it stored.
//!
//! ```no_run
//! fn main() -> Result<(), homebody_kit::Error> {
//!     let scenario = homebody_kit::open("scenarios/tigerplace-depression")?;
//!     let mut run = scenario.run().seed(7).days(7).without(["depression"]).start()?;
//!     let mut firings = 0;
//!     while let Some(batch) = run.next_batch()? {
//!         firings += batch.firings.len();
//!     }
//!     println!("{firings}");
//!     Ok(())
//! }
//! ```
//!
//! The same run goes into files with [`LiveRun::store`], and many lives side by side are a [`Cohort`]. A resident can be
//! moved by a driver of the caller's own ([`RunSetup::driver`]), and a sink of the caller's own can take what happens
//! ([`LiveRun::give_to`]), or the rows of the log ([`destination`]). Instants and spans are whole microseconds since the run's
//! start, lengths are metres.
//!
//! This crate does not know the command line, nor who looks at a run: progress is a callback, a [`Cancel`] ends runs from
//! elsewhere, and a [`Pace`](pace::Pace) says how fast they go. Reading order:

#![warn(missing_docs)]

mod error;
pub mod catalogue;

mod source;
mod scenario;

/// The program's version, and behind a `+` a digest of its models: what is recorded by one build and lived by another with other
/// models may come out otherwise.
pub const VERSION: &str = env!("HOMEBODY_VERSION");

pub mod outside;
pub mod pace;
mod own_driver;
mod own_truth;
mod stretch;
mod meters;
mod run;
pub mod destination;
pub mod elsewhere;
mod broker;
mod beside;
mod touched;
mod store;
mod whole_folder;
mod recording_file;
mod recorded;
mod live_home;

/// Scenarios that begin: empty, from a template, or from the log of a home.
pub mod begun;

mod profiles;
mod cohort_list;
mod cohort_members;
mod cohort_place;
mod cohort;
mod cohort_left;
mod cohort_unfinished;
pub mod fleet;

mod idle_sensors;
mod long_log;
mod life_messages;
mod open_messages;
mod lifeless;
mod log_with_run;
mod instants;
mod translation;
mod following;
mod health;
mod examined;

/// What is looked for over a whole log or run.
pub mod find;
mod found_in_log;
mod falls;

/// A log that was walked back, as a folder.
pub mod walked;

mod calibration;

pub use broker::{Tidied, tidy_up};
pub use calibration::{Calibration, CalibrationMessage, Fitted, Rates, Sight, calibrate, lived};
pub use cohort::{Cohort, CohortSetup, LARGE_DAYS, LivedCohort};
pub use cohort_list::{CohortList, ListedMember};
pub use cohort_members::{CohortLayout, CohortMessage, Member, MemberLived};
pub use cohort_place::{bring_member, list_of_cohort};
pub use cohort_unfinished::UnfinishedCohort;
pub use destination::{Destination, Policy, Sink};
pub use error::{BoxError, Error};
pub use examined::{Examined, Examining};
pub use falls::{Fallen, FallsFound, LogWithSilhouettes, Looked, falls_in, silhouettes_of};
pub use following::{Following, Learnt, Presence};
pub use found_in_log::find_in_log;
pub use health::{Found, Health, health};
pub use homebody_infer::{Ailment, Ill, Kind, Spell};
pub use homebody_log::destination::Treatment;
pub use homebody_log::examine::{Check, Verdict};
pub use homebody_log::meter::News;
pub use homebody_log::places::LIST;
pub use homebody_log::truth::TruthKept;
pub use homebody_log::{Cancel, Url, WhenDown};
pub use homebody_routine::living::account::Difference;
pub use instants::Instants;
pub use live_home::LiveHome;
pub use log_with_run::{LogWithRun, Lost, NamedLog, Unended, home_sensors, sensor_rooms};
pub use meters::{Meters, Seen};
pub use profiles::{MOST_MEMBERS, Profile};
pub use recorded::{Recorded, Unfinished};
pub use recording_file::recording;
pub use run::{Batch, BatchSink, LiveRun, Progress, RunSetup};
pub use scenario::{OpenScenario, numbers, open, template};
pub use source::{Folder, Source, TRUST, Template};
pub use store::{Destinations, Lived};
pub use stretch::Stretch;
pub use touched::OrderMessage;
pub use translation::{Doubt, LEAST_CHANGE, Place, Translation, Whereabouts, sensors_of_home, walk_back};
