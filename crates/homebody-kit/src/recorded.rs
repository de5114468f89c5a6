//! Runs that were recorded, to be lived again.

use crate::cancel::Cancel;
use crate::error::Error;
use crate::pace::{Command, Pace, Paced};
use crate::run::LiveRun;
use homebody_core::recording::{LONGEST, Recording};
use homebody_core::scenario::load::Scenario;
use homebody_routine::household::Household;
use std::fs;
use std::io::ErrorKind;
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
    /// [`Error::NoRecording`], [`Error::File`] or [`Error::Recording`] if there is none in this file, [`Error::Problems`] if
    /// something is wrong with the scenario in it.
    pub fn open(path: impl AsRef<Path>) -> Result<Recorded, Error> {
        let path = path.as_ref();
        let text = fs::read_to_string(path).map_err(|error| match error.kind() {
            ErrorKind::NotFound => Error::NoRecording { path: path.into() },
            ErrorKind::IsADirectory => {
                let why = "it is a folder\n  hint: name the recording.json in it".into();
                Error::File { path: path.into(), why, source: Some(error) }
            }
            _ => Error::io(path, error),
        })?;
        let wrong = |why: String| Error::Recording { path: path.into(), why };
        let recording: Recording = serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        if !(0..=LONGEST).contains(&recording.length_us) {
            return Err(wrong("a run is at most 100 years long".into()));
        }
        if recording.sha256.is_empty() {
            return Err(wrong("the SHA-256 of its firings is missing".into()));
        }
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
