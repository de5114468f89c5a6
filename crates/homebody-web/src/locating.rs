//! Logs that a page opens: one at a time is located in a home, in a thread of its own.
//!
//! A log is saved in a hidden folder among the runs. Its results get a name there once they are complete, so that a stopped or failed
//! job leaves nothing behind.

use crate::folders::HomeFolders;
use crate::messages::PageMessage;
use crate::request_error::{RequestError, code_of, sentence, without};
use crate::wire::{LocatingState, LocatingView};
use axum::http::StatusCode;
use homebody_core::problem::Diagnose;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, Span};
use homebody_query::{LoadedLog, LogRef};
use homebody_routine::household::Household;
use homebody_simulation::{Cancel, SimulationError};
use homebody_tracking::TrackingError;
use homebody_tracking::located_folder::{GIVEN, locate_into};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, io, thread};
use tempfile::TempDir;

/// Largest log that the page opens, in bytes (our choice).
pub const LARGEST_LOG_BYTES: u64 = 64 << 20;

/// Largest number of rows of such a log (our choice): they take a minute or two.
const MOST_ROWS: usize = 1_000_000;

/// Largest number of days of such a log (our choice).
const MOST_DAYS: i64 = 1100;

/// Time to wait at the end for a log that is being located (our choice).
const LONGEST_FAREWELL: Duration = Duration::from_secs(2);

/// The name of a log whose file has no usable name.
const UNNAMED: &str = "log";

/// The log that is being located, or was last. Clones share it.
#[derive(Clone)]
pub struct LocateService {
    folders: HomeFolders,
    now: Arc<Mutex<Option<LocateJob>>>,
}

struct LocateJob {
    view: LocatingView,
    cancel: Cancel,
    folder: PathBuf,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LogHome {
    Scenario,
    Run(String),
    /// The log is stored unchanged, for the care view.
    Unknown,
}

impl LocateService {
    pub fn new(folders: HomeFolders) -> LocateService {
        LocateService { folders, now: Arc::default() }
    }

    pub fn now(&self) -> Option<LocatingView> {
        self.locked().as_ref().map(|job| job.view.clone())
    }

    pub fn is_active(&self) -> bool {
        self.now().is_some_and(|job| job.is_active())
    }

    pub fn stop(&self) {
        if let Some(job) = self.locked().as_ref() {
            job.cancel.cancel();
        }
    }

    /// Stops the job and waits for it for a short time; then removes its folder.
    pub fn close(&self) {
        self.stop();
        let begun = Instant::now();
        while self.is_active() && begun.elapsed() < LONGEST_FAREWELL {
            thread::sleep(Duration::from_millis(10));
        }
        if let Some(job) = self.locked().as_ref().filter(|job| job.view.is_active()) {
            // A folder that cannot be removed stays hidden.
            let _ = fs::remove_dir_all(&job.folder);
        }
    }

    /// Prepares a job for a log that is being received.
    pub fn begin(&self, log: &str, home: LogHome) -> Result<IncomingLog, RequestError> {
        let mut now = self.locked();
        if let Some(job) = now.as_ref().filter(|job| job.view.is_active()) {
            return Err(RequestError::new(StatusCode::CONFLICT, PageMessage::Locating { log: job.view.log.clone() }));
        }
        let folder = fs::create_dir_all(&self.folders.runs)
            .and_then(|()| tempfile::Builder::new().prefix(".walk-").tempdir_in(&self.folders.runs));
        let folder = folder.map_err(RequestError::internal)?;
        let is_kept = log.len() <= 100 && !log.starts_with('.') && !log.contains(['/', '\\', ':', '\0']);
        let log = if is_kept && !log.is_empty() { log } else { UNNAMED }.to_owned();
        let cancel = Cancel::new();
        let (state, share) = (LocatingState::Coming, 0.0);
        let view = LocatingView { log: log.clone(), state, share, run: None, problem: None, problem_code: None };
        *now = Some(LocateJob { view, cancel: cancel.clone(), folder: folder.path().to_owned() });
        Ok(IncomingLog { locating: self.clone(), folder: Some(folder), log, home, cancel })
    }

    fn locked(&self) -> MutexGuard<'_, Option<LocateJob>> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn update(&self, change: impl FnOnce(&mut LocatingView)) {
        if let Some(job) = self.locked().as_mut() {
            change(&mut job.view);
        }
    }

    fn end(&self, ended: Result<String, TrackingError>, hidden: &Path) {
        self.update(|view| match ended {
            Ok(run) => (view.state, view.share, view.run) = (LocatingState::Done, 1.0, Some(run)),
            Err(TrackingError::Simulation(SimulationError::Cancelled)) => view.state = LocatingState::Stopped,
            Err(error) => {
                // The folder of the log no longer exists.
                let problem = without(hidden, error.diagnostic());
                view.state = LocatingState::Failed;
                view.problem = Some(sentence(&problem));
                view.problem_code = code_of(&problem);
            }
        });
    }
}

impl LocatingView {
    fn is_active(&self) -> bool {
        matches!(self.state, LocatingState::Coming | LocatingState::Walking)
    }
}

/// A log that is being received. Dropped before it is complete, it leaves nothing.
pub struct IncomingLog {
    locating: LocateService,
    folder: Option<TempDir>,
    log: String,
    home: LogHome,
    cancel: Cancel,
}

impl IncomingLog {
    pub fn file(&self) -> PathBuf {
        self.folder.as_ref().map_or_else(PathBuf::new, |folder| folder.path().join(&self.log))
    }

    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// Starts the job, once the log is complete.
    pub fn locate(mut self) {
        let Some(folder) = self.folder.take() else { return };
        let (locating, log, home, cancel) =
            (self.locating.clone(), self.log.clone(), self.home.clone(), self.cancel.clone());
        locating.update(|view| view.state = LocatingState::Walking);
        thread::spawn(move || {
            let hidden = folder.path().to_owned();
            let job = || locating.run(&hidden, &log, &home, &cancel);
            let broken = || TrackingError::Translation(PageMessage::LocatingBroke.into());
            let ended = catch_unwind(AssertUnwindSafe(job)).unwrap_or_else(|_| Err(broken()));
            // The folder is removed before the page sees the end.
            drop(folder);
            locating.end(ended, &hidden);
        });
    }
}

impl Drop for IncomingLog {
    fn drop(&mut self) {
        if let Some(folder) = self.folder.take() {
            let hidden = folder.path().to_owned();
            drop(folder);
            let why = match self.cancel.is_cancelled() {
                true => SimulationError::Cancelled.into(),
                false => TrackingError::Translation(PageMessage::LogIncomplete.into()),
            };
            self.locating.end(Err(why), &hidden);
        }
    }
}

impl LocateService {
    /// Runs the job of the log in a hidden folder. Returns the name of the result among the runs.
    fn run(&self, hidden: &Path, log: &str, home: &LogHome, cancel: &Cancel) -> Result<String, TrackingError> {
        match home {
            LogHome::Unknown => self.keep(hidden, log),
            LogHome::Scenario => self.locate((hidden, log), None, cancel),
            LogHome::Run(run) => self.locate((hidden, log), Some(run), cancel),
        }
    }

    /// Stores the log unchanged, if it can be read.
    fn keep(&self, hidden: &Path, log: &str) -> Result<String, TrackingError> {
        small_enough(&LoadedLog::from_ref(LogRef::find(&hidden.join(log).to_string_lossy())?, None)?)?;
        let failed = |error: io::Error| SimulationError::file(Path::new(log), error.to_string());
        let to = hidden.join("kept");
        fs::create_dir_all(to.join(GIVEN)).map_err(failed)?;
        fs::rename(hidden.join(log), to.join(GIVEN).join(log)).map_err(failed)?;
        let name = self.free_name(log, "log");
        fs::rename(&to, self.folders.runs.join(&name)).map_err(failed)?;
        Ok(name)
    }

    /// Returns the name of the run that was simulated from the log.
    fn locate(
        &self,
        (hidden, log): (&Path, &str),
        home: Option<&str>,
        cancel: &Cancel,
    ) -> Result<String, TrackingError> {
        let scenario = self.scenario(home)?;
        let named = LogRef::find(&hidden.join(log).to_string_lossy())?;
        let read = LoadedLog::from_ref(named, Some(&scenario.file.time_zone))?;
        small_enough(&read)?;
        let to = hidden.join("walked");
        locate_into(&to, (log, &read), &scenario, cancel, |share| self.update(|view| view.share = share))?;
        let failed = |error: io::Error| SimulationError::file(Path::new(log), error.to_string());
        let name = self.free_name(log, "walked");
        fs::rename(&to, self.folders.runs.join(&name)).map_err(failed)?;
        Ok(format!("{name}/{}", homebody_tracking::located_folder::SIMULATED_RUN))
    }

    fn scenario(&self, run: Option<&str>) -> Result<Scenario, TrackingError> {
        let loaded = match run {
            None => Household::load(&self.folders, &self.folders.entry, &[]),
            Some(run) => Household::recorded(&self.folders.recording(run).map_err(TrackingError::Translation)?),
        };
        Ok(loaded?.0)
    }

    fn free_name(&self, log: &str, what: &str) -> String {
        let stem = Path::new(log).file_stem().unwrap_or_default().to_string_lossy();
        let plain: String = stem.chars().take(40).map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let named = |number: u32| format!("{plain}-{what}-{number}");
        (1..).map(named).find(|name| !self.folders.runs.join(name).exists()).unwrap_or(plain)
    }
}

fn small_enough(read: &LoadedLog) -> Result<(), TrackingError> {
    let rows = read.log.events.len();
    if rows > MOST_ROWS {
        return Err(TrackingError::Translation(PageMessage::TooManyRows { rows, limit: MOST_ROWS }.into()));
    }
    let times = || read.log.events.iter().map(|event| event.at);
    let span = times().max().zip(times().min()).map_or(Span::ZERO, |(last, first)| last.saturating_since(first));
    if span > MOST_DAYS * DAY {
        let days = (span / DAY) as usize;
        return Err(TrackingError::Translation(PageMessage::TooManyDays { days, limit: MOST_DAYS }.into()));
    }
    Ok(())
}
