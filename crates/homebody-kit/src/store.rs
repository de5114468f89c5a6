//! Living a run into destinations: logs, the truth apart from them, and the recording that lives it again.

use crate::VERSION;
use crate::beside;
use crate::error::Error;
use crate::recording_file::recording;
use crate::run::{LiveRun, Progress};
use homebody_core::recording::Recording;
use homebody_log::destination::Treatment;
use homebody_log::places::{RECORDING, RUNS, TRUTH, can_be_written};
use homebody_log::{Destination, How, Places, RunLog, Stored, Url};
use homebody_routine::living::account::Difference;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Where a run goes. Where no log is named, all of it goes into a new folder.
#[derive(Clone, Debug)]
pub struct Destinations {
    /// The places of its log. Where all of them are servers, it goes into a new folder as well.
    pub log: Vec<Url>,
    /// The place of its ground truth; none where a log is named and this is not.
    pub truth: Option<Url>,
    /// The file of its recording; none where a log is named and this is not. If the recording of this very run is there and
    /// unfinished, the run resumes in these places.
    pub recording: Option<PathBuf>,
    /// The folder in which the new folder of a run is made, where no log is named: `runs` unless something else is said. None
    /// for no folder: then all goes where the caller's own destinations take it.
    pub runs: Option<PathBuf>,
    /// Whether files that exist are replaced.
    pub replace: bool,
    /// Whether a server's database replaces the rows that it has of this run.
    pub replace_rows: bool,
    /// How servers among its places and standard output are treated while they are away or do not answer.
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
    /// A new folder in this one, which is made if it is not there.
    pub fn new_folder_in(runs: impl Into<PathBuf>) -> Destinations {
        Destinations { runs: Some(runs.into()), ..Destinations::default() }
    }

    /// None but the caller's own: see [`LiveRun::store_with`].
    pub fn own() -> Destinations {
        Destinations { runs: None, ..Destinations::default() }
    }

    /// One place for the log, and nothing beside it.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if the text names no place: it is such as `sqlite:log.db`, `csv:log.csv` or `casas:log.txt`.
    pub fn log(place: &str) -> Result<Destinations, Error> {
        let place = place.parse().map_err(homebody_log::LogError::NoPlace)?;
        Ok(Destinations { log: vec![place], ..Destinations::default() })
    }

    /// The places, and how they are begun.
    fn places(&self, run: &LiveRun) -> Result<(Places, How), Error> {
        let Destinations { log, truth, recording, runs, replace, .. } = self;
        let how = if *replace { How::Replace } else { How::New };
        let runs = match runs {
            // What goes to servers is beside the folder, by which the run can be gone on with.
            Some(runs) if log.iter().all(|url| url.server().is_some()) => runs,
            _ => {
                let goes_on = !replace && recording.as_deref().is_some_and(|path| run.was_begun_in(path));
                let (log, truth, recording) = (log.clone(), truth.clone(), recording.clone());
                return match goes_on {
                    true => Ok((Places::left(log, truth, recording), How::GoOn)),
                    false => Ok((Places::of(log, truth, recording, &run.sources, *replace)?, how)),
                };
            }
        };
        let mut places = Places::run(runs, &run.scenario)?;
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

/// What has become of a run that was stored.
#[derive(Debug)]
pub struct Lived {
    /// The sentences of routines whose lives differ from their words.
    pub differences: Vec<Difference>,
    /// As it was lived: its length is where it ended.
    pub recording: Recording,
    /// What the log has got.
    pub stored: Stored,
    /// The names of its sensors, in the order of `stored.by_sensor`.
    pub sensors: Vec<String>,
    /// The place of the truth, if there is one.
    pub truth: Option<Url>,
    /// The file of the recording, if there is one.
    pub recorded: Option<PathBuf>,
    /// The folder in which it can be gone on with ([`Unfinished`](crate::Unfinished)) if it was ended early; `None` where not all
    /// of it went into one.
    pub folder: Option<PathBuf>,
    /// How far it has come: less than its length if it was cancelled.
    pub progress: Progress,
    /// Of a recording that was lived again to its end: whether every firing is the same.
    pub agrees: Option<bool>,
    /// What the recording was, that was lived again.
    pub before: Option<Recording>,
    /// How long that took.
    pub took: Duration,
}

impl Lived {
    /// Whether it was ended early.
    pub fn is_stopped(&self) -> bool {
        self.progress.lived < self.progress.length
    }

    /// How many rows each sensor has in each of the places, by name.
    pub fn rows_by_sensor(&self) -> impl Iterator<Item = (&str, u64)> {
        self.sensors.iter().map(String::as_str).zip(self.stored.by_sensor.iter().copied())
    }
}

impl LiveRun {
    /// Lives the run to its end, or until it is cancelled, and stores all of it; `progress` is called after each batch.
    ///
    /// ```
    /// # let folder = std::env::temp_dir().join(format!("kit-store-{}", std::process::id()));
    /// use homebody_kit::Destinations;
    /// let run = homebody_kit::template("tigerplace")?.run().days(0.5).start()?;
    /// let lived = run.store(&Destinations::new_folder_in(&folder), |_| ())?;
    /// assert_eq!(lived.stored.rows, lived.recording.firings);
    /// # let _ = std::fs::remove_dir_all(folder);
    /// # Ok::<(), homebody_kit::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if a destination cannot be written: nothing is lived then. If one fails on the way, what was stored
    /// before stays as far as its form allows.
    pub fn store(self, to: &Destinations, progress: impl FnMut(Progress)) -> Result<Lived, Error> {
        self.store_with(to, Vec::new(), progress)
    }

    /// The same with destinations of the caller's own beside: any [`Sink`](homebody_log::Sink), each with what becomes of the
    /// run if it fails. They get the rows of the log as the scenario's logger makes them, in batches.
    ///
    /// ```
    /// use homebody_kit::{Destination, Destinations, Policy, Url};
    /// # let folder = std::env::temp_dir().join(format!("kit-own-{}", std::process::id()));
    /// # std::fs::create_dir_all(&folder).unwrap();
    /// let url: Url = format!("csv:{}", folder.join("a.csv").display()).parse()?;
    /// let copy = Destination { policy: Policy::optional(), ..Destination::of(&url) };
    /// let run = homebody_kit::template("tigerplace")?.run().days(0.5).start()?;
    /// let lived = run.store_with(&Destinations::own(), vec![copy], |_| ())?;
    /// assert!(lived.stored.failed.is_empty() && lived.recorded.is_none());
    /// # let _ = std::fs::remove_dir_all(folder);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`LiveRun::store`]; [`Error::Log`], too, if a destination that is required fails.
    pub fn store_with(
        mut self,
        to: &Destinations,
        own: Vec<Destination>,
        progress: impl FnMut(Progress),
    ) -> Result<Lived, Error> {
        let (mut places, how) = to.places(&self)?;
        let servers = places.log.extract_if(.., |url| url.server().is_some() || url.is_output());
        let servers: Vec<Url> = servers.collect();
        let folder = self.folder_in(&places);
        let rows = if to.replace_rows { How::Replace } else { How::New };
        let servers = beside::destinations(&servers, &to.servers, folder.as_deref(), &mut self.paced)?;
        let servers: Vec<_> = servers.into_iter().map(|server| server.begun_as(rows)).collect();
        places.truth_on_server = rows;
        let own = servers.into_iter().chain(own).collect();
        let lived = self.store_into(&places, own, &to.servers, how, progress);
        if lived.is_err() {
            // What was stored before the failure stays.
            places.give_up();
        }
        lived
    }

    /// Whether a file is the recording of this very run, unfinished: then the same command resumes it.
    fn was_begun_in(&self, path: &Path) -> bool {
        let own = Recording { version: VERSION.into(), ..self.recording.clone() };
        let is_it = |left: &Recording| !left.is_whole() && left.begun_again() == own && own.lives_again();
        recording(path).is_ok_and(|left| is_it(&left))
    }

    /// The folder in which the run can be gone on with, where there is one.
    fn folder_in(&self, places: &Places) -> Option<PathBuf> {
        whole_folder(places).filter(|_| self.recording.lives_again())
    }

    pub(crate) fn store_into(
        self,
        places: &Places,
        own: Vec<Destination>,
        servers: &Treatment,
        how: How,
        progress: impl FnMut(Progress),
    ) -> Result<Lived, Error> {
        let folder = self.folder_in(places);
        self.stored(places, own, servers, how, progress).map_err(|error| error.of_run_in(folder))
    }

    fn stored(
        mut self,
        places: &Places,
        own: Vec<Destination>,
        servers: &Treatment,
        how: How,
        mut progress: impl FnMut(Progress),
    ) -> Result<Lived, Error> {
        let started = Instant::now();
        let version = VERSION.into();
        let mut recording = Recording { version, ..self.recording.clone() };
        let cancel = self.paced.cancel().clone();
        let own = own.into_iter().map(|destination| Destination { cancel: cancel.clone(), ..destination });
        let own: Vec<Destination> = own.inspect(|destination| self.meters.hear(destination)).collect();
        let servers = &Treatment { cancel, ..servers.clone() };
        let mut log = RunLog::open_with(places, own, servers, &self.scenario, &self.run, &recording, how)?;
        self.meters.begin(self.scenario.calendar.timestamp(0), log.meters());
        let ended = loop {
            self.hear_outside(&log, &mut recording)?;
            let lived_on = self.live_on();
            // What happened before a driver went wrong is stored, too.
            log.store(&self.run, &self.events)?;
            match lived_on {
                Ok(true) => {
                    self.meters.lived(self.run.now());
                    progress(self.progress());
                }
                Ok(false) => break Ok(()),
                Err(error) => break Err(error),
            }
        };
        let (stored, recording) = log.finish(&self.run, recording)?;
        ended?;
        let before = Some(self.recording.clone()).filter(|before| !before.sha256.is_empty());
        let is_same = |before: &Recording| (&before.sha256, before.firings) == (&recording.sha256, recording.firings);
        let is_whole = self.run.now() == self.run.length();
        Ok(Lived {
            agrees: before.as_ref().filter(|_| is_whole).map(is_same),
            before,
            differences: self.differences(),
            sensors: self.sensors().map(str::to_owned).collect(),
            truth: places.truth.clone(),
            recorded: places.recording.clone(),
            folder: self.folder_in(places),
            progress: self.progress(),
            recording,
            stored,
            took: started.elapsed(),
        })
    }
}

/// The folder that all of a run goes into, where there is one.
fn whole_folder(places: &Places) -> Option<PathBuf> {
    let folder = places.sensors.as_deref()?.parent()?;
    let is_here = |path: &Path, name: &str| path == folder.join(name);
    let is_whole = places.recording.as_deref().is_some_and(|path| is_here(path, RECORDING))
        && places.truth.as_ref().is_some_and(|truth| match truth.file() {
            Some(path) => is_here(path, TRUTH),
            None => truth.server().is_some(),
        });
    is_whole.then(|| folder.to_owned())
}
