//! Errors of locating people, and of fitting a scenario.

use homebody_core::problem::{Diagnostic, Problems};
use homebody_log::LogError;
use homebody_query::QueryError;
use homebody_simulation::SimulationError;

homebody_core::messages! {
    /// Errors of locating people by a log, and of fitting a scenario to it.
    #[non_exhaustive]
    pub enum TrackingError in "kit" {
        => inner {
            /// The people of a log cannot be located in a home.
            Translation(Diagnostic);
            /// A scenario cannot be fitted to a log.
            Calibration(Diagnostic);
            /// The log cannot be read.
            Query(QueryError);
            /// A file cannot be read or written, or a run cannot be simulated.
            Simulation(SimulationError);
        }
    }
}

impl From<QueryError> for TrackingError {
    fn from(error: QueryError) -> TrackingError {
        TrackingError::Query(error)
    }
}

impl From<SimulationError> for TrackingError {
    fn from(error: SimulationError) -> TrackingError {
        TrackingError::Simulation(error)
    }
}

impl From<LogError> for TrackingError {
    fn from(error: LogError) -> TrackingError {
        TrackingError::Simulation(error.into())
    }
}

impl From<Problems> for TrackingError {
    fn from(problems: Problems) -> TrackingError {
        TrackingError::Simulation(problems.into())
    }
}
