//! The destinations of a run: logs, the ground truth in a place of its own, and the recording.

use crate::error::SimulationError;
use crate::progress::RunProgress;
use crate::recording_file::recording;
use crate::run_summary::RunSummary;
use crate::simulation::Simulation;
use crate::{VERSION, servers};
use homebody_core::recording::Recording;
use homebody_log::destination::Treatment;
use homebody_log::run::places::{RUNS, can_be_written};
use homebody_log::{Destination, RunPlaces, Url, WriteMode};
use std::path::{Path, PathBuf};

/// The destinations of a run. Without a named log, all of it goes into a new folder.
#[derive(Clone, Debug)]
pub struct Destinations {
    /// The places of its log. If all are servers, a new folder gets the log, too.
    pub log: Vec<Url>,
    /// The place of its ground truth; none if only a log is named.
    pub truth: Option<Url>,
    /// The file of its recording; none if only a log is named. If it holds the incomplete recording of this very run, the run
    /// resumes in these places.
    pub recording: Option<PathBuf>,
    /// The folder for the new folder of a run without a named log. `None` for no folder: then all goes to the caller's own
    /// destinations.
    pub runs: Option<PathBuf>,
    /// Replaces existing files.
    pub replace: bool,
    /// Replaces the rows of this run in databases of servers.
    pub replace_rows: bool,
    /// The treatment of servers and standard output while they are unavailable.
    pub servers: Treatment,
}

impl Default for Destinations {
    fn default() -> Destinations {
        Destinations {
            log: Vec::new(),
            truth: None,
            recording: None,
            runs: Some(RUNS.into()),
            replace: false,
            replace_rows: false,
            servers: Treatment::default(),
        }
    }
}

impl Destinations {
    /// A new folder in this one, which is created if it does not exist.
    pub fn new_folder_in(runs: impl Into<PathBuf>) -> Destinations {
        Destinations { runs: Some(runs.into()), ..Destinations::default() }
    }

    /// Only the caller's own: see [`Simulation::store_with`].
    pub fn own() -> Destinations {
        Destinations { runs: None, ..Destinations::default() }
    }

    /// One place for the log, and nothing else.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Log`] if the text names no place, such as `sqlite:log.db`, `csv:log.csv` or `casas:log.txt`.
    pub fn log(place: &str) -> Result<Destinations, SimulationError> {
        let place = place.parse().map_err(homebody_log::LogError::NoPlace)?;
        Ok(Destinations { log: vec![place], ..Destinations::default() })
    }

    fn places(&self, run: &Simulation) -> Result<(RunPlaces, WriteMode), SimulationError> {
        let Destinations { log, truth, recording, runs, replace, .. } = self;
        let how = if *replace { WriteMode::Overwrite } else { WriteMode::Create };
        let runs = match runs {
            // Besides servers a folder is needed, to resume the run.
            Some(runs) if log.iter().all(|url| url.server().is_some()) => runs,
            _ => {
                let resumes = !replace && recording.as_deref().is_some_and(|path| run.was_started_in(path));
                let (log, truth, recording) = (log.clone(), truth.clone(), recording.clone());
                return match resumes {
                    true => Ok((RunPlaces::left(log, truth, recording), WriteMode::Resume)),
                    false => Ok((RunPlaces::new(log, truth, recording, &run.sources, *replace)?, how)),
                };
            }
        };
        let mut places = RunPlaces::run(runs, &run.scenario)?;
        places.log.extend(log.iter().cloned());
        places.truth = truth.clone().or(places.truth);
        places.recording = recording.clone().or(places.recording);
        let named: Vec<&Path> = truth.iter().filter_map(Url::file).chain(recording.as_deref()).collect();
        match can_be_written(&named, &run.sources, *replace) {
            Ok(()) => Ok((places, how)),
            Err(error) => {
                places.give_up();
                Err(error.into())
            }
        }
    }
}

impl Simulation {
    /// Simulates the run to its end, or until it is cancelled, and stores all of it; `progress` is called after each batch.
    ///
    /// ```
    /// # let folder = std::env::temp_dir().join(format!("kit-store-{}", std::process::id()));
    /// use homebody_simulation::Destinations;
    /// let run = homebody_simulation::template("tigerplace")?.run().days(0.5).start()?;
    /// let summary = run.store(&Destinations::new_folder_in(&folder), |_| ())?;
    /// assert_eq!(summary.stored.rows, summary.recording.firings);
    /// # let _ = std::fs::remove_dir_all(folder);
    /// # Ok::<(), homebody_simulation::SimulationError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SimulationError::Log`] if a destination cannot be written: nothing is simulated then. If one fails later, the rows before
    /// stay as far as its form allows.
    pub fn store(self, to: &Destinations, progress: impl FnMut(RunProgress)) -> Result<RunSummary, SimulationError> {
        self.store_with(to, Vec::new(), progress)
    }

    /// Stores the run, and gives the rows of the log in batches to destinations of the caller's own: any
    /// [`Sink`](homebody_log::Sink), each with its policy for failures.
    ///
    /// ```
    /// use homebody_simulation::{Destination, Destinations, Policy, Url};
    /// # let folder = std::env::temp_dir().join(format!("kit-own-{}", std::process::id()));
    /// # std::fs::create_dir_all(&folder).unwrap();
    /// let url: Url = format!("csv:{}", folder.join("a.csv").display()).parse()?;
    /// let copy = Destination { policy: Policy::optional(), ..Destination::new(&url) };
    /// let run = homebody_simulation::template("tigerplace")?.run().days(0.5).start()?;
    /// let summary = run.store_with(&Destinations::own(), vec![copy], |_| ())?;
    /// assert!(summary.stored.failed.is_empty() && summary.recorded.is_none());
    /// # let _ = std::fs::remove_dir_all(folder);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::store`]; [`SimulationError::Log`], too, if a destination that is required fails.
    pub fn store_with(
        mut self,
        to: &Destinations,
        own: Vec<Destination>,
        progress: impl FnMut(RunProgress),
    ) -> Result<RunSummary, SimulationError> {
        let (mut places, how) = to.places(&self)?;
        let servers = places.log.extract_if(.., |url| url.server().is_some() || url.is_output());
        let servers: Vec<Url> = servers.collect();
        let folder = self.folder_in(&places);
        let rows = if to.replace_rows { WriteMode::Overwrite } else { WriteMode::Create };
        let servers = servers::destinations(&servers, &to.servers, folder.as_deref(), &mut self.paced)?;
        let servers: Vec<_> = servers.into_iter().map(|server| server.begun_as(rows)).collect();
        places.truth_on_server = rows;
        let own = servers.into_iter().chain(own).collect();
        let stored = self.store_into(places.clone(), own, &to.servers, how, progress);
        if stored.is_err() {
            // The rows before the failure stay.
            places.give_up();
        }
        stored
    }

    /// True of the file of the incomplete recording of this run, which the same command resumes.
    fn was_started_in(&self, path: &Path) -> bool {
        let own = Recording { version: VERSION.into(), ..self.recording.clone() };
        let is_same = |left: &Recording| !left.is_whole() && left.restarted() == own && own.can_replay();
        recording(path).is_ok_and(|left| is_same(&left))
    }
}
