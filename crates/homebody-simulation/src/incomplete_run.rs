//! Runs that were killed or stopped, to resume.

use crate::error::SimulationError;
use crate::interventions::InterventionRequest;
use crate::pace::{Pace, PaceKeeper, RunCommand};
use crate::progress::RunProgress;
use crate::recording_file::{must_be_folder, must_be_of_this_version, must_be_replayable, recording, was_not_started};
use crate::run_metrics::RunMetrics;
use crate::run_summary::RunSummary;
use crate::servers;
use crate::simulation::Simulation;
use homebody_core::recording::Recording;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::LONGEST;
use homebody_log::destination::Treatment;
use homebody_log::run::places::{RECORDING, is_all_there};
use homebody_log::table::truth::TruthKept;
use homebody_log::truth::is_brief;
use homebody_log::{Cancel, Destination, RunPlaces, Url, WriteMode};
use homebody_routine::household::Household;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// A run that was killed or stopped, or lacks a file, to resume in its folder.
///
/// It is simulated again from its start: the rows in the folder are compared with it, and the missing ones are written. At the end the
/// log and the ground truth have the bytes of an undisturbed run.
///
/// ```no_run
/// let summary = homebody_simulation::IncompleteRun::open("runs/tigerplace-1")?.resume(|_| ())?;
/// println!("{} firings", summary.recording.firings);
/// # Ok::<(), homebody_simulation::SimulationError>(())
/// ```
pub struct IncompleteRun {
    pub(crate) run: Simulation,
    pub(crate) places: RunPlaces,
}

/// The word for a run in errors.
const RUN: &str = "run";

/// True of a run without an end, as a home in real time.
pub fn has_no_end(recording: &Recording) -> bool {
    recording.stopped_of_us.unwrap_or(recording.length_us) == LONGEST
}

impl IncompleteRun {
    /// Reads the folder of a run.
    ///
    /// # Errors
    ///
    /// [`SimulationError::NotFolder`] if it is a file; [`SimulationError::NoRecording`], [`SimulationError::File`] or
    /// [`SimulationError::Recording`] without a recording in the folder; [`SimulationError::NotBegun`] with only a part of one;
    /// [`SimulationError::Complete`] if the run is complete with all its files; [`SimulationError::OtherVersion`] if another version of
    /// the program started it; [`SimulationError::OwnDrivers`] if a driver of another program moved a resident;
    /// [`SimulationError::Problems`] with the problems of its scenario.
    pub fn open(folder: impl AsRef<Path>) -> Result<IncompleteRun, SimulationError> {
        let folder = folder.as_ref();
        must_be_folder(folder)?;
        let recording = recording(&folder.join(RECORDING)).map_err(|error| match error {
            SimulationError::NoRecording { .. } if was_not_started(folder) => {
                SimulationError::NotBegun { folder: folder.into() }
            }
            error => error,
        })?;
        let logger = recording.scenario().map(|scenario| scenario.logger).unwrap_or_default();
        if recording.is_whole() && is_all_there(folder, &logger) {
            return Err(SimulationError::Complete { what: RUN, folder: folder.into() });
        }
        must_be_replayable(&folder.join(RECORDING), &recording)?;
        let recording = recording.restarted();
        must_be_of_this_version(RUN, folder, &recording)?;
        let (scenario, household) = Household::recorded(&recording)?;
        let mut places = RunPlaces::of_folder(folder, &scenario)?;
        if places.truth.as_ref().is_some_and(is_brief) {
            places.kept = TruthKept::Brief;
        }
        let run = recording.run(&scenario, &household);
        Ok(IncompleteRun { run: Simulation::from_parts(Arc::new(scenario), run, recording, Vec::new()), places })
    }

    /// Sets the pace, the commands to the run, and the handle that ends it.
    pub fn paced(mut self, pace: Pace, commands: Option<Receiver<RunCommand>>, cancel: &Cancel) -> IncompleteRun {
        self.run.paced = PaceKeeper::new(pace, cancel.clone(), commands);
        self
    }

    /// Continues the ground truth on this server.
    pub fn with_truth(mut self, server: &Url) -> IncompleteRun {
        self.places.truth = Some(server.clone());
        self
    }

    /// Applies the [interventions](crate::interventions) of this channel.
    pub fn interventions(mut self, requests: Receiver<InterventionRequest>) -> IncompleteRun {
        self.run.paced.interventions.push(requests);
        self
    }

    /// Reports to these metrics.
    pub fn metered(mut self, metrics: &RunMetrics) -> IncompleteRun {
        self.run = self.run.metered(metrics);
        self
    }

    /// The scenario of the run.
    pub fn scenario(&self) -> &Scenario {
        &self.run.scenario
    }

    /// The progress at the start, with the whole length.
    pub fn progress(&self) -> RunProgress {
        self.run.progress()
    }

    /// True of a home in real time, which has no end: see [`LiveHome`](crate::LiveHome).
    pub fn has_no_end(&self) -> bool {
        has_no_end(&self.run.recording)
    }

    /// Simulates it to its end, or until it is cancelled; `progress` is called after each batch.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Log`] if the rows in the folder are not the beginning of this run, or cannot be written: then they stay.
    pub fn resume(self, progress: impl FnMut(RunProgress)) -> Result<RunSummary, SimulationError> {
        self.resume_with(Vec::new(), progress)
    }

    /// Resumes it with the servers that had its rows before, too; each gets the rows that it has not confirmed.
    ///
    /// # Errors
    ///
    /// As [`IncompleteRun::resume_with`].
    pub fn resume_into(
        mut self,
        servers: &[Url],
        treatment: &Treatment,
        progress: impl FnMut(RunProgress),
    ) -> Result<RunSummary, SimulationError> {
        let folder = self.places.recording.as_deref().and_then(Path::parent).map(Path::to_owned);
        let own = servers::destinations(servers, treatment, folder.as_deref(), &mut self.run.paced)?;
        self.run.store_into(self.places, own, treatment, WriteMode::Resume, progress)
    }

    /// Resumes it with destinations of the caller's own, as [`Simulation::store_with`] has them. They are begun with
    /// [`WriteMode::Resume`]: each says how many rows it has, and gets the later ones.
    ///
    /// # Errors
    ///
    /// As [`IncompleteRun::resume`]; [`SimulationError::Log`], too, if a destination that is required fails.
    pub fn resume_with(
        self,
        own: Vec<Destination>,
        progress: impl FnMut(RunProgress),
    ) -> Result<RunSummary, SimulationError> {
        self.run.store_into(self.places, own, &Treatment::default(), WriteMode::Resume, progress)
    }
}
