//! Runs that were recorded, to be lived again.

use crate::VERSION;
use crate::beside;
use crate::error::Error;
use crate::meters::Meters;
use crate::outside::Asked;
use crate::pace::{Command, Pace, Paced};
use crate::recording_file::recording;
use crate::run::{LiveRun, Progress};
use crate::store::Lived;
use homebody_core::problem::readable;
use homebody_core::recording::{LONGEST, Recording};
use homebody_core::scenario::load::Scenario;
use homebody_log::destination::Treatment;
use homebody_log::places::{LIST, RECORDING, SENSORS, is_all_there};
use homebody_log::source::is_brief;
use homebody_log::truth::TruthKept;
use homebody_log::{Cancel, Destination, How, Places, Url};
use homebody_routine::household::Household;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// A recorded run, checked: all that it depends on is in its recording.
///
/// ```no_run
/// let run = homebody_kit::Recorded::open("runs/tigerplace-1/recording.json")?.start();
/// let lived = run.store(&homebody_kit::Destinations::default(), |_| ())?;
/// assert_eq!(lived.agrees, Some(true), "firing by firing");
/// # Ok::<(), homebody_kit::Error>(())
/// ```
pub struct Recorded {
    recording: Recording,
    scenario: Arc<Scenario>,
    household: Household,
    /// The file that it was read from, which nothing replaces.
    path: PathBuf,
    paced: Paced,
}

impl Recorded {
    /// Reads a recording, as a run leaves it.
    ///
    /// # Errors
    ///
    /// [`Error::NoRecording`], [`Error::File`] or [`Error::Recording`] if there is none in this file, [`Error::Unfinished`] if the
    /// run was killed or is still lived, [`Error::OwnDrivers`] if a driver of the caller's own has moved somebody,
    /// [`Error::Problems`] if something is wrong with the scenario in it.
    pub fn open(path: impl AsRef<Path>) -> Result<Recorded, Error> {
        let path = path.as_ref();
        let recording = recording(path)?;
        if !recording.is_complete() {
            return Err(Error::Unfinished { path: path.into(), folder: left_in(path) });
        }
        must_live_again(path, &recording)?;
        let (scenario, household) = Household::recorded(&recording)?;
        let paced = Paced::new(Pace::default(), Cancel::new(), None);
        Ok(Recorded { recording, scenario: Arc::new(scenario), household, path: path.into(), paced })
    }

    /// What was recorded.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The scenario that was recorded.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// At which pace it is lived again, what is said to it meanwhile, and who may end it.
    pub fn paced(mut self, pace: Pace, commands: Option<Receiver<Command>>, cancel: &Cancel) -> Recorded {
        self.paced = Paced::new(pace, cancel.clone(), commands);
        self
    }

    /// The recorded run at its beginning. Stored into destinations, it says whether every firing is the same.
    pub fn start(self) -> LiveRun {
        let run = self.recording.run(&self.scenario, &self.household);
        LiveRun { paced: self.paced, ..LiveRun::of(self.scenario, run, self.recording, vec![self.path]) }
    }
}

/// A run that was killed or stopped, or of which a file is missing, to be gone on with in the folder that it left.
///
/// It is lived again from its beginning: what is there is compared with it, what is missing is written. In the end the log
/// and the truth have the bytes of a run that nothing has disturbed.
///
/// ```no_run
/// let lived = homebody_kit::Unfinished::open("runs/tigerplace-1")?.go_on(|_| ())?;
/// println!("{} firings", lived.recording.firings);
/// # Ok::<(), homebody_kit::Error>(())
/// ```
pub struct Unfinished {
    pub(crate) run: LiveRun,
    pub(crate) places: Places,
}

/// Whether a run has no end of its own, as a home on the world's clock has none.
pub(crate) fn has_no_end(recording: &Recording) -> bool {
    recording.stopped_of_us.unwrap_or(recording.length_us) == LONGEST
}

impl Unfinished {
    /// Finds out what is left to do in a run's folder.
    ///
    /// # Errors
    ///
    /// [`Error::NotFolder`] if it is a file, [`Error::NoRecording`], [`Error::File`] or [`Error::Recording`] if the folder has no
    /// recording, [`Error::NotBegun`] if at most a part of one is there, [`Error::Complete`] if the run was lived to its end and all that it left is there, [`Error::OtherVersion`] if another version of the program
    /// began it, [`Error::OwnDrivers`] if a driver of the caller's own has moved somebody, [`Error::Problems`] if something is wrong with the scenario in it.
    pub fn open(folder: impl AsRef<Path>) -> Result<Unfinished, Error> {
        let folder = folder.as_ref();
        must_be_folder(folder)?;
        let recording = recording(&folder.join(RECORDING)).map_err(|error| match error {
            Error::NoRecording { .. } if was_not_begun(folder) => Error::NotBegun { folder: folder.into() },
            error => error,
        })?;
        let logger = recording.scenario().map(|scenario| scenario.logger).unwrap_or_default();
        if recording.is_whole() && is_all_there(folder, &logger) {
            return Err(Error::Complete { what: RUN, folder: folder.into() });
        }
        must_live_again(&folder.join(RECORDING), &recording)?;
        let recording = recording.begun_again();
        must_be_of_this_version(RUN, folder, &recording)?;
        let (scenario, household) = Household::recorded(&recording)?;
        let mut places = Places::of_folder(folder, &scenario)?;
        if places.truth.as_ref().is_some_and(is_brief) {
            places.kept = TruthKept::Brief;
        }
        let run = recording.run(&scenario, &household);
        Ok(Unfinished { run: LiveRun::of(Arc::new(scenario), run, recording, Vec::new()), places })
    }

    /// At which pace it is lived, what is said to it meanwhile, and who may end it.
    pub fn paced(mut self, pace: Pace, commands: Option<Receiver<Command>>, cancel: &Cancel) -> Unfinished {
        self.run.paced = Paced::new(pace, cancel.clone(), commands);
        self
    }

    /// Its truth is on a server, and continues there.
    pub fn with_truth(mut self, server: &Url) -> Unfinished {
        self.places.truth = Some(server.clone());
        self
    }

    /// What is asked for through this channel is done to the run: see [`outside`](crate::outside).
    pub fn outside(mut self, asked: Receiver<Asked>) -> Unfinished {
        self.run.paced.outside.push(asked);
        self
    }

    /// What is to be seen of it while it is lived is told there.
    pub fn metered(mut self, meters: &Meters) -> Unfinished {
        self.run.meters = meters.clone();
        self
    }

    /// The scenario that the run is of.
    pub fn scenario(&self) -> &Scenario {
        &self.run.scenario
    }

    /// How long it is to be.
    pub fn progress(&self) -> Progress {
        self.run.progress()
    }

    /// Whether it is a home on the world's clock, which has no end that it could be lived to: see [`LiveHome`](crate::LiveHome).
    pub fn has_no_end(&self) -> bool {
        has_no_end(&self.run.recording)
    }

    /// Lives it to its end, or until it is cancelled; `progress` is called after each batch.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if what is there is not the beginning of this run, or cannot be written: then it stays as it was.
    pub fn go_on(self, progress: impl FnMut(Progress)) -> Result<Lived, Error> {
        self.go_on_with(Vec::new(), progress)
    }

    /// The same to servers as well, which its rows went to before; each gets those that it has not confirmed.
    ///
    /// # Errors
    ///
    /// As [`Unfinished::go_on_with`].
    pub fn go_on_beside(
        mut self,
        servers: &[Url],
        as_said: &Treatment,
        progress: impl FnMut(Progress),
    ) -> Result<Lived, Error> {
        let folder = self.places.recording.as_deref().and_then(Path::parent).map(Path::to_owned);
        let own = beside::destinations(servers, as_said, folder.as_deref(), &mut self.run.paced)?;
        self.run.store_into(&self.places, own, as_said, How::GoOn, progress)
    }

    /// The same with destinations of the caller's own beside, as [`LiveRun::store_with`] has them. They are begun with
    /// [`How::GoOn`]: each says how many rows it holds already, and gets those behind them.
    ///
    /// # Errors
    ///
    /// As [`Unfinished::go_on`]; [`Error::Log`], too, if a destination that is required fails.
    pub fn go_on_with(self, own: Vec<Destination>, progress: impl FnMut(Progress)) -> Result<Lived, Error> {
        self.run.store_into(&self.places, own, &Treatment::default(), How::GoOn, progress)
    }
}

/// The files of a scenario alone do not live a run again in which a driver of the caller's own has moved somebody.
fn must_live_again(path: &Path, recording: &Recording) -> Result<(), Error> {
    match recording.lives_again() {
        true => Ok(()),
        false => Err(Error::OwnDrivers { path: path.into(), residents: recording.own_drivers.clone() }),
    }
}

/// What errors call a run.
const RUN: &str = "run";

/// A file is not taken for the folder of a run or a cohort; the error names the folder that it is in.
pub(crate) fn must_be_folder(path: &Path) -> Result<(), Error> {
    match path.is_file() {
        true => Err(Error::NotFolder { path: path.into(), folder: left_in(path) }),
        false => Ok(()),
    }
}

/// The folder of the run or the cohort that has left a file; of a member, the cohort's.
fn left_in(path: &Path) -> Option<PathBuf> {
    let above = |path: &Path| match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => ".".into(),
    };
    let folder = above(path);
    let cohort = if folder.file_name().is_some() { above(&folder) } else { folder.join("..") };
    // A run that was killed at its very beginning has left its recording alone.
    let is_recording = path.file_name().is_some_and(|name| name == RECORDING);
    let left = [(cohort, LIST), (folder.clone(), LIST), (folder.clone(), SENSORS)];
    let left = left.into_iter().find(|(folder, file)| folder.join(file).is_file()).map(|(folder, _)| folder);
    left.or(is_recording.then_some(folder))
}

/// Another version may live a run otherwise than the one that began it.
pub(crate) fn must_be_of_this_version(what: &'static str, folder: &Path, recording: &Recording) -> Result<(), Error> {
    match recording.version == VERSION {
        true => Ok(()),
        false => Err(Error::OtherVersion { what, folder: folder.into(), version: readable(recording.version.clone()) }),
    }
}

/// Whether a file is the part of a recording or of a cohort's list that was being written.
pub(crate) fn is_part(name: &str) -> bool {
    [RECORDING, LIST].iter().any(|of| name.starts_with(of)) && name.ends_with(".part")
}

/// Whether a folder holds nothing, or only such a part.
fn was_not_begun(folder: &Path) -> bool {
    let Ok(mut entries) = std::fs::read_dir(folder) else { return false };
    entries.all(|entry| entry.is_ok_and(|entry| is_part(&entry.file_name().to_string_lossy())))
}
