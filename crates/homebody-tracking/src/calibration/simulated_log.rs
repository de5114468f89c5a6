//! Simulated logs, to compare with a log.

use crate::error::TrackingError;
use homebody_core::time::{DAY, Span};
use homebody_log::{Log, SimulatedRun};
use homebody_simulation::{OpenScenario, SimulationError};

/// The seed of all of them, so that only the fitted parameters change.
pub const SEED: u64 = 1;

/// The log of so many simulated days of a scenario, on the wall clock and with the home's names of the sensors.
pub fn simulated_log(open: &OpenScenario, seed: u64, days: u32) -> Result<Log, TrackingError> {
    log_for(open, seed, i64::from(days) * DAY)
}

/// The log of a simulation of this length, as in [`simulated_log`].
pub fn log_for(open: &OpenScenario, seed: u64, length: Span) -> Result<Log, TrackingError> {
    let scenario = open.scenario();
    let scale = scenario.calendar.scale(length);
    let run = SimulatedRun::new(scenario, open.household(), seed, length)?;
    Ok(run.into_log(|at| scale.run_to_wall(at), |_| {}).map_err(SimulationError::from)?)
}
