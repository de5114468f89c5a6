//! Errors of reading, searching and checking a log.

use crate::search::SearchError;
use homebody_core::problem::readable;
use homebody_log::LogError;
use homebody_simulation::SimulationError;
use std::path::PathBuf;

homebody_core::messages! {
    /// Errors of a log and the run that left it.
    #[non_exhaustive]
    pub enum QueryError in "kit" {
        /// The folder contains no log.
        NoLog { folder: PathBuf } error "no-log" ("the folder {} contains no log", folder.display())
            hint ("name a log, or the folder of a run that has one");
        /// Silhouettes exist only for runs whose home has cameras.
        NoSilhouettes { log: String } error "no-silhouettes" ("{log} has no silhouettes")
            hint ("name the folder of a run whose home has cameras: sensors of kind \"camera\" in home.json");
        /// The run has not stored a row yet.
        NoRows { folder: PathBuf, resume: PathBuf } error "no-rows" ("the run in {} has no rows yet", folder.display())
            hint ("wait for the first row, or resume an interrupted run: homebody run --resume {}", resume.display());
        /// Each member of a cohort has its own log.
        IsCohort { folder: PathBuf, member: Option<PathBuf> } error "is-cohort" ("{} is a cohort: each member has its own log", folder.display())
            advice (Some(match member {
                Some(member) => format!("name a member, such as {}", member.display()),
                None => "resume the cohort: it has no member yet".into(),
            }));
        /// Time zones have names as in the IANA database, which comes with the program.
        TimeZone { zone: String } error "time-zone" ("there is no time zone {zone:?}")
            hint ("write an IANA name, such as America/Chicago");
        => inner {
            /// The search names nothing that the log can contain.
            Search(SearchError);
            /// A file cannot be read or written, or a run cannot be replayed.
            Simulation(SimulationError);
        }
    }
}

impl QueryError {
    pub(crate) fn zone(name: &str) -> QueryError {
        QueryError::TimeZone { zone: readable(name.to_owned()) }
    }
}

impl From<SearchError> for QueryError {
    fn from(error: SearchError) -> QueryError {
        QueryError::Search(error)
    }
}

impl From<SimulationError> for QueryError {
    fn from(error: SimulationError) -> QueryError {
        QueryError::Simulation(error)
    }
}

impl From<LogError> for QueryError {
    fn from(error: LogError) -> QueryError {
        QueryError::Simulation(error.into())
    }
}
