//! A home that is lived on the world's clock, for as long as nobody stops it, in a folder by which it goes on after a stop.

use crate::beside;
use crate::error::Error;
use crate::meters::Meters;
use crate::pace::Pace;
use crate::recorded::Unfinished;
use crate::run::{LiveRun, Progress, RunSetup};
use crate::store::Lived;
use homebody_core::recording::LONGEST;
use homebody_core::scenario::load::Scenario;
use homebody_log::destination::Treatment;
use homebody_log::places::RECORDING;
use homebody_log::{Cancel, How, LogError, Places, Url};
use jiff::Timestamp;
use std::fs;
use std::path::{Path, PathBuf};

/// A home on the world's clock.
///
/// Its folder holds its log, its truth and its recording. Stopped or killed, it is opened in the folder again: what would have
/// happened meanwhile is lived as fast as it goes, and no row is missing.
pub struct LiveHome {
    run: LiveRun,
    places: Places,
    how: How,
    folder: PathBuf,
}

impl LiveHome {
    /// Whether a home is there already that is gone on with.
    pub fn is_there(folder: &Path) -> bool {
        folder.join(RECORDING).is_file()
    }

    /// Begins a home in a folder, which is made. `setup` is a run of the scenario, whose start is where its life begins.
    ///
    /// # Errors
    ///
    /// As [`RunSetup::start`]; [`Error::Log`] if the folder cannot be made.
    pub fn begin(setup: RunSetup, folder: &Path) -> Result<LiveHome, Error> {
        let run = setup.length(LONGEST).start()?;
        let unmade = |source| LogError::Unmade { place: folder.display().to_string(), source };
        fs::create_dir_all(folder).map_err(unmade)?;
        let places = Places::of_folder(folder, &run.scenario)?;
        Ok(LiveHome { run, places, how: How::New, folder: folder.into() })
    }

    /// Goes on with the home that is in a folder.
    ///
    /// # Errors
    ///
    /// As [`Unfinished::open`].
    pub fn go_on(folder: &Path) -> Result<LiveHome, Error> {
        let Unfinished { run, places } = Unfinished::open(folder)?;
        Ok(LiveHome { run, places, how: How::GoOn, folder: folder.into() })
    }

    /// The number all its randomness comes from.
    pub fn seed(&self) -> u64 {
        self.run.seed()
    }

    /// When its life begins.
    pub fn begins(&self) -> Timestamp {
        self.scenario().calendar.timestamp(0)
    }

    /// The scenario that is lived.
    pub fn scenario(&self) -> &Scenario {
        &self.run.scenario
    }

    /// Whether it goes on with a home that was there already.
    pub fn goes_on(&self) -> bool {
        self.how == How::GoOn
    }

    /// Lives it on the world's clock until it is cancelled, into its folder and, beside it, to servers and standard output; `progress` is
    /// called after each batch.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if a place cannot be written, or what is there is not the beginning of this life.
    pub fn live(
        mut self,
        out: &[Url],
        servers: &Treatment,
        meters: &Meters,
        cancel: &Cancel,
        progress: impl FnMut(Progress),
    ) -> Result<Lived, Error> {
        let pace = Pace::on_wall(self.run.scenario.calendar.timestamp(0));
        self.run.keep_pace(pace, cancel);
        self.run.meters = meters.clone();
        self.places.is_followed = true;
        let own = beside::destinations(out, servers, Some(&self.folder), &mut self.run.paced)?;
        self.run.store_into(&self.places, own, servers, self.how, progress)
    }
}
