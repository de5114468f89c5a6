//! Simulates homes with sensors: opens a scenario, simulates a run or a cohort of it, and stores it or hands over its events.
//!
//! ```no_run
//! fn main() -> Result<(), homebody_simulation::SimulationError> {
//!     let scenario = homebody_simulation::open("scenarios/tigerplace-depression")?;
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
//! [`Simulation::store`] stores the same run in files, and a [`Cohort`] is many runs at once. The caller's own driver can move a
//! resident ([`RunSetup::driver`]), and the caller's own sink can take the events ([`Simulation::run_into`]) or the rows of the log
//! ([`destination`]). Instants and spans are whole microseconds since the run's start, lengths are metres.
//!
//! This crate does not know the command line, the page or Python: [`RunOptions`] are data for all three. Progress is a callback, a
//! [`Cancel`] ends runs, and a [`Pace`](pace::Pace) sets their speed. Reading order:

#![warn(missing_docs)]

mod limits;
mod error;
pub mod catalogue;

mod open_messages;
mod scenario_source;
mod scenario_warnings;
mod idle_sensors;
mod missing_parts;
mod profiles;
mod open_scenario;

/// The program's version, and behind a `+` a digest of its models: another version may simulate a recording differently.
pub const VERSION: &str = env!("HOMEBODY_VERSION");

pub mod interventions;
pub mod pace;
mod custom_drivers;
mod adaptive_step;
mod progress;
mod run_metrics;
mod run_summary;
mod simulation;
pub mod run_length;
mod run_start;
mod run_options;
mod setup;
mod sampled_run;

pub mod destination;
mod sinks;
mod broker;
mod servers;
mod destinations;
mod new_folder;
mod recording_file;
mod recorded_run;
mod incomplete_run;
mod live_home;

mod cohort;

pub use adaptive_step::AdaptiveStep;
pub use broker::{BrokerCleanup, tidy_up};
pub use cohort::incomplete::IncompleteCohort;
pub use cohort::list::{CohortList, ListedMember};
pub use cohort::members::{CohortLayout, CohortMessage, Member, MemberSummary, seed_of_member};
pub use cohort::place::{bring_member, list_of_cohort};
pub use cohort::{Cohort, CohortSetup, CohortSummary};
pub use destination::{Destination, Policy, Sink};
pub use destinations::Destinations;
pub use error::{BoxError, SimulationError, StepError};
pub use homebody_log::destination::Treatment;
pub use homebody_log::policy::SinkNews;
pub use homebody_log::run::places::LIST;
pub use homebody_log::table::truth::TruthKept;
pub use homebody_log::{Cancel, Url, WhenDown};
pub use homebody_routine::behaviour::difference::Difference;
pub use homebody_routine::statement;
pub use incomplete_run::{IncompleteRun, has_no_end};
pub use limits::{LARGE_DAYS, MOST_MEMBERS};
pub use live_home::LiveHome;
pub use new_folder::new_folder;
pub use open_messages::OpenMessage;
pub use open_scenario::{OpenScenario, numbers, open, template};
pub use profiles::Profile;
pub use progress::RunProgress;
pub use recorded_run::RecordedRun;
pub use recording_file::recording;
pub use run_length::RunLength;
pub use run_metrics::{RunMetrics, RunReading};
pub use run_options::{RunOptions, VariantOptions};
pub use run_start::RunStart;
pub use run_summary::RunSummary;
pub use sampled_run::{SAMPLE_TIME, SampledRun, difference_warnings, shortened};
pub use scenario_source::{ScenarioFolder, ScenarioSource, TRUST, Template};
pub use setup::{OptionError, PlannedRun, RunSetup};
pub use simulation::orders::OrderMessage;
pub use simulation::{BatchSink, EventBatch, Simulation};
pub use sinks::install_sinks;
