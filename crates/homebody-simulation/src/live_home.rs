//! A home that is simulated in real time until it is stopped. Its folder resumes it.

use crate::error::SimulationError;
use crate::incomplete_run::IncompleteRun;
use crate::pace::{Pace, PaceKeeper};
use crate::progress::RunProgress;
use crate::run_metrics::RunMetrics;
use crate::run_summary::RunSummary;
use crate::servers;
use crate::setup::RunSetup;
use crate::simulation::Simulation;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{LONGEST, RunTime};
use homebody_log::destination::Treatment;
use homebody_log::run::places::RECORDING;
use homebody_log::{Cancel, LogError, RunPlaces, Url, WriteMode};
use jiff::Timestamp;
use std::fs;
use std::path::{Path, PathBuf};

/// A home in real time.
///
/// Its folder has its log, its ground truth and its recording. After a stop or a crash, it is resumed in the folder: the time since then
/// is simulated as fast as possible, and no row is missing.
pub struct LiveHome {
    run: Simulation,
    places: RunPlaces,
    how: WriteMode,
    folder: PathBuf,
}

impl LiveHome {
    /// True of a folder with a home to resume.
    pub fn is_there(folder: &Path) -> bool {
        folder.join(RECORDING).is_file()
    }

    /// Starts a home in a folder, which is created. `setup` is a run of the scenario, which starts when the home does.
    ///
    /// # Errors
    ///
    /// As [`RunSetup::start`]; [`SimulationError::Log`] if the folder cannot be created.
    pub fn create(setup: RunSetup, folder: &Path) -> Result<LiveHome, SimulationError> {
        let run = setup.length(LONGEST).start()?;
        let unmade = |source| LogError::Unmade { place: folder.display().to_string(), source };
        fs::create_dir_all(folder).map_err(unmade)?;
        let places = RunPlaces::of_folder(folder, &run.scenario)?;
        Ok(LiveHome { run, places, how: WriteMode::Create, folder: folder.into() })
    }

    /// Resumes the home in a folder.
    ///
    /// # Errors
    ///
    /// As [`IncompleteRun::open`].
    pub fn resume(folder: &Path) -> Result<LiveHome, SimulationError> {
        let IncompleteRun { run, places } = IncompleteRun::open(folder)?;
        Ok(LiveHome { run, places, how: WriteMode::Resume, folder: folder.into() })
    }

    /// The seed of all randomness.
    pub fn seed(&self) -> u64 {
        self.run.seed()
    }

    fn start(&self) -> Timestamp {
        self.scenario().calendar.timestamp(RunTime::START)
    }

    /// The scenario of the run.
    pub fn scenario(&self) -> &Scenario {
        &self.run.scenario
    }

    /// Whether the home was resumed.
    pub fn is_resumed(&self) -> bool {
        self.how == WriteMode::Resume
    }

    /// Simulates it in real time until it is cancelled, into its folder and to servers and standard output; `progress` is called after
    /// each batch.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Log`] if a place cannot be written, or the rows in the folder are not the beginning of this run.
    pub fn run(
        mut self,
        out: &[Url],
        servers: &Treatment,
        metrics: &RunMetrics,
        cancel: &Cancel,
        progress: impl FnMut(RunProgress),
    ) -> Result<RunSummary, SimulationError> {
        self.run.paced = PaceKeeper::new(Pace::on_wall(self.start()), cancel.clone(), None);
        self.places.is_followed = true;
        let own = servers::destinations(out, servers, Some(&self.folder), &mut self.run.paced)?;
        self.run.metered(metrics).store_into(self.places, own, servers, self.how, progress)
    }
}
