//! Errors of new scenarios.

use homebody_core::problem::Problems;
use homebody_log::LogError;
use homebody_simulation::SimulationError;
use std::path::PathBuf;

homebody_core::messages! {
    /// Errors of new scenarios.
    #[non_exhaustive]
    pub enum ScaffoldError in "kit" {
        /// The name of a new folder contains an invisible character.
        UnseenName { path: PathBuf } error "invisible-character" ("the name {:?} has an invisible character", path.display().to_string())
            hint ("remove the invisible character");
        => inner {
            /// No scenario can be made of the given files.
            Source(Problems);
            /// A file cannot be read or written, or the scenario has problems.
            Simulation(SimulationError);
        }
    }
}

impl From<SimulationError> for ScaffoldError {
    fn from(error: SimulationError) -> ScaffoldError {
        ScaffoldError::Simulation(error)
    }
}

impl From<LogError> for ScaffoldError {
    fn from(error: LogError) -> ScaffoldError {
        ScaffoldError::Simulation(error.into())
    }
}

impl From<Problems> for ScaffoldError {
    fn from(problems: Problems) -> ScaffoldError {
        ScaffoldError::Simulation(problems.into())
    }
}
