//! Errors of fleets.

use homebody_core::problem::Problems;
use homebody_log::LogError;
use homebody_simulation::SimulationError;

homebody_core::messages! {
    /// Errors of fleets.
    #[non_exhaustive]
    pub enum FleetError in "kit" {
        => inner {
            /// The options are out of range, or a fleet cannot write to these places.
            Setup(Problems);
            /// A scenario has problems, or a place cannot be written.
            Simulation(SimulationError);
        }
    }
}

impl From<SimulationError> for FleetError {
    fn from(error: SimulationError) -> FleetError {
        FleetError::Simulation(error)
    }
}

impl From<LogError> for FleetError {
    fn from(error: LogError) -> FleetError {
        FleetError::Simulation(error.into())
    }
}
