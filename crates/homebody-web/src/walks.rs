//! Logs that somebody opens in the page: each is walked back through a home, in a thread of its own, one at a time.
//!
//! A log comes into a hidden folder among the runs. What is made of it gets a name there once it is whole, so that what was
//! stopped, or went wrong, leaves nothing behind.

use crate::messages::PageMessage;
use crate::refusal::{sentence, without};
use crate::shelf::Shelf;
use crate::wire::{WalkState, WalkingView};
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

/// What a log is called whose file has no name that can be kept.
const UNNAMED: &str = "log";

/// The log that is walked back, or was last. A clone is the same.
#[derive(Clone)]
pub struct Walks {
    shelf: Shelf,
    now: Arc<Mutex<Option<Walk>>>,
}

struct Walk {
    view: WalkingView,
    cancel: Cancel,
    /// The hidden folder.
    folder: PathBuf,
}

/// Whose home a log is of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HomeOf {
    Scenario,
    /// A stored run's.
    Run(String),
    /// None that is known: the log is kept as it is, for the care view.
    Nobody,
}

/// Why no log is opened now.
#[derive(Debug)]
pub enum Unwalked {
    /// Another one is being walked back.
    Busy(String),
    /// There is no place for it.
    NoPlace(io::Error),
}

impl Walks {
    pub fn new(shelf: Shelf) -> Walks {
        Walks { shelf, now: Arc::default() }
    }

    /// The log that is walked back, or was last; none where none has come yet.
    pub fn now(&self) -> Option<WalkingView> {
        self.locked().as_ref().map(|walk| walk.view.clone())
    }

    /// Whether a log is coming, or being walked back.
    pub fn is_going_on(&self) -> bool {
        self.now().is_some_and(|walk| walk.is_going_on())
    }

    /// Ends what is being done, soon.
    pub fn stop(&self) {
        if let Some(walk) = self.locked().as_ref() {
            walk.cancel.cancel();
        }
    }

    /// Ends what is being done, and waits until it has left nothing behind, but not long: then what is there is removed.
    pub fn close(&self) {
        self.stop();
        let begun = Instant::now();
        while self.is_going_on() && begun.elapsed() < LONGEST_FAREWELL {
            thread::sleep(Duration::from_millis(10));
        }
        if let Some(walk) = self.locked().as_ref().filter(|walk| walk.view.is_going_on()) {
            // What cannot be removed stays hidden.
            let _ = fs::remove_dir_all(&walk.folder);
        }
    }

    /// Takes a log that is coming, to be walked back through a home.
    pub fn begin(&self, log: &str, home: HomeOf) -> Result<Coming, Unwalked> {
        let mut now = self.locked();
        if let Some(walk) = now.as_ref().filter(|walk| walk.view.is_going_on()) {
            return Err(Unwalked::Busy(walk.view.log.clone()));
        }
        let folder = fs::create_dir_all(&self.shelf.runs)
            .and_then(|()| tempfile::Builder::new().prefix(".walk-").tempdir_in(&self.shelf.runs));
        let folder = folder.map_err(Unwalked::NoPlace)?;
        let is_kept = log.len() <= 100 && !log.starts_with('.') && !log.contains(['/', '\\', ':', '\0']);
        let log = if is_kept && !log.is_empty() { log } else { UNNAMED }.to_owned();
        let cancel = Cancel::new();
        let (state, share) = (WalkState::Coming, 0.0);
        let view = WalkingView { log: log.clone(), state, share, run: None, problem: None, problem_code: None };
        *now = Some(Walk { view, cancel: cancel.clone(), folder: folder.path().to_owned() });
        Ok(Coming { walks: self.clone(), folder: Some(folder), log, home, cancel })
    }

    fn locked(&self) -> MutexGuard<'_, Option<Walk>> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn tell(&self, change: impl FnOnce(&mut WalkingView)) {
        if let Some(walk) = self.locked().as_mut() {
            change(&mut walk.view);
        }
    }

    fn end(&self, ended: Result<String, TrackingError>, hidden: &Path) {
        self.tell(|view| match ended {
            Ok(run) => (view.state, view.share, view.run) = (WalkState::Done, 1.0, Some(run)),
            Err(TrackingError::Simulation(SimulationError::Cancelled)) => view.state = WalkState::Stopped,
            Err(error) => {
                // The folder of the log is gone by now.
                let problem = without(hidden, error.diagnostic());
                view.state = WalkState::Failed;
                view.problem = Some(sentence(&problem));
                view.problem_code = (!problem.code.is_empty()).then(|| problem.code.to_owned());
            }
        });
    }
}

impl WalkingView {
    fn is_going_on(&self) -> bool {
        matches!(self.state, WalkState::Coming | WalkState::Walking)
    }
}

/// A log that is on its way. Dropped before all of it is there, it leaves nothing.
pub struct Coming {
    walks: Walks,
    folder: Option<TempDir>,
    log: String,
    home: HomeOf,
    cancel: Cancel,
}

impl Coming {
    /// The file that its bytes go into.
    pub fn file(&self) -> PathBuf {
        self.folder.as_ref().map_or_else(PathBuf::new, |folder| folder.path().join(&self.log))
    }

    /// Whether nobody wants it any more.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// All of it is there: it is walked back from now on.
    pub fn walk(mut self) {
        let Some(folder) = self.folder.take() else { return };
        let (walks, log, home, cancel) = (self.walks.clone(), self.log.clone(), self.home.clone(), self.cancel.clone());
        walks.tell(|view| view.state = WalkState::Walking);
        thread::spawn(move || {
            let hidden = folder.path().to_owned();
            let walk = || walks.make(&hidden, &log, &home, &cancel);
            let broken = || TrackingError::Translation(PageMessage::LocatingBroke.into());
            let ended = catch_unwind(AssertUnwindSafe(walk)).unwrap_or_else(|_| Err(broken()));
            // First all is tidy, then it is told.
            drop(folder);
            walks.end(ended, &hidden);
        });
    }
}

impl Drop for Coming {
    fn drop(&mut self) {
        if let Some(folder) = self.folder.take() {
            let hidden = folder.path().to_owned();
            drop(folder);
            let why = match self.cancel.is_cancelled() {
                true => SimulationError::Cancelled.into(),
                false => TrackingError::Translation(PageMessage::LogIncomplete.into()),
            };
            self.walks.end(Err(why), &hidden);
        }
    }
}

impl Walks {
    /// What the log in a hidden folder comes to, by its name among the runs.
    fn make(&self, hidden: &Path, log: &str, home: &HomeOf, cancel: &Cancel) -> Result<String, TrackingError> {
        match home {
            HomeOf::Nobody => self.keep(hidden, log),
            HomeOf::Scenario => self.walk((hidden, log), None, cancel),
            HomeOf::Run(run) => self.walk((hidden, log), Some(run), cancel),
        }
    }

    /// Keeps the log as it is, if it can be read.
    fn keep(&self, hidden: &Path, log: &str) -> Result<String, TrackingError> {
        small_enough(&LoadedLog::from_ref(LogRef::find(&hidden.join(log).to_string_lossy())?, None)?)?;
        let failed = |error: io::Error| SimulationError::file(Path::new(log), error.to_string());
        let to = hidden.join("kept");
        fs::create_dir_all(to.join(GIVEN)).map_err(failed)?;
        fs::rename(hidden.join(log), to.join(GIVEN).join(log)).map_err(failed)?;
        let name = self.free_name(log, "log");
        fs::rename(&to, self.shelf.runs.join(&name)).map_err(failed)?;
        Ok(name)
    }

    /// Walks it back; the name of the run that came of it.
    fn walk(&self, (hidden, log): (&Path, &str), home: Option<&str>, cancel: &Cancel) -> Result<String, TrackingError> {
        let scenario = self.home(home)?;
        let named = LogRef::find(&hidden.join(log).to_string_lossy())?;
        let read = LoadedLog::from_ref(named, Some(&scenario.file.time_zone))?;
        small_enough(&read)?;
        let to = hidden.join("walked");
        locate_into(&to, (log, &read), &scenario, cancel, |share| self.tell(|view| view.share = share))?;
        let failed = |error: io::Error| SimulationError::file(Path::new(log), error.to_string());
        let name = self.free_name(log, "walked");
        fs::rename(&to, self.shelf.runs.join(&name)).map_err(failed)?;
        Ok(format!("{name}/{}", homebody_tracking::located_folder::SIMULATED_RUN))
    }

    /// The scenario whose home the log is of.
    fn home(&self, run: Option<&str>) -> Result<Scenario, TrackingError> {
        let loaded = match run {
            None => Household::load(&self.shelf, &self.shelf.entry, &[]),
            Some(run) => Household::recorded(&self.shelf.recording(run).map_err(TrackingError::Translation)?),
        };
        Ok(loaded?.0)
    }

    /// A name among the runs that nothing has yet.
    fn free_name(&self, log: &str, what: &str) -> String {
        let stem = Path::new(log).file_stem().unwrap_or_default().to_string_lossy();
        let plain: String = stem.chars().take(40).map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let named = |number: u32| format!("{plain}-{what}-{number}");
        (1..).map(named).find(|name| !self.shelf.runs.join(name).exists()).unwrap_or(plain)
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
