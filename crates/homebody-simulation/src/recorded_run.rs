//! Runs that were recorded, to replay.

use crate::error::SimulationError;
use crate::pace::{Pace, PaceKeeper, RunCommand};
use crate::recording_file::{must_be_replayable, recording, run_folder_of};
use crate::simulation::Simulation;
use homebody_core::recording::Recording;
use homebody_core::scenario::load::Scenario;
use homebody_log::Cancel;
use homebody_routine::household::Household;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// A recorded run that was checked: its recording contains all that it depends on.
///
/// ```no_run
/// let run = homebody_simulation::RecordedRun::open("runs/tigerplace-1/recording.json")?.start();
/// let summary = run.store(&homebody_simulation::Destinations::default(), |_| ())?;
/// assert_eq!(summary.agrees, Some(true), "firing by firing");
/// # Ok::<(), homebody_simulation::SimulationError>(())
/// ```
pub struct RecordedRun {
    recording: Recording,
    scenario: Arc<Scenario>,
    household: Household,
    /// The file that it was read from, which no output replaces.
    path: PathBuf,
    paced: PaceKeeper,
}

impl RecordedRun {
    /// Reads the recording of a complete run.
    ///
    /// # Errors
    ///
    /// [`SimulationError::NoRecording`], [`SimulationError::File`] or [`SimulationError::Recording`] without a recording in this file,
    /// [`SimulationError::Incomplete`] if the run was killed or is still running, [`SimulationError::OwnDrivers`] if a driver of another
    /// program moved a resident, [`SimulationError::Problems`] with the problems of its scenario.
    pub fn open(path: impl AsRef<Path>) -> Result<RecordedRun, SimulationError> {
        let path = path.as_ref();
        let recording = recording(path)?;
        if !recording.is_complete() {
            return Err(SimulationError::Incomplete { path: path.into(), folder: run_folder_of(path) });
        }
        must_be_replayable(path, &recording)?;
        let (scenario, household) = Household::recorded(&recording)?;
        let paced = PaceKeeper::new(Pace::default(), Cancel::new(), None);
        Ok(RecordedRun { recording, scenario: Arc::new(scenario), household, path: path.into(), paced })
    }

    /// The recording.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The scenario in the recording.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// Sets the pace of the replay, the commands to it, and the handle that ends it.
    pub fn paced(mut self, pace: Pace, commands: Option<Receiver<RunCommand>>, cancel: &Cancel) -> RecordedRun {
        self.paced = PaceKeeper::new(pace, cancel.clone(), commands);
        self
    }

    /// The simulation of the recorded run at its start. Stored into destinations, it compares every firing.
    pub fn start(self) -> Simulation {
        Simulation::replay(self.recording, self.scenario, &self.household, vec![self.path]).paced(self.paced)
    }
}
