//! A folder with runs, shared by the tests of playback.

use homebody_core::time::{Interval, RunTime, Span};
use homebody_web::folders::HomeFolders;
use homebody_web::playback::{Playback, RequestError};
use homebody_web::staged_run::{StagedRun, StartRequest};
use homebody_web::wire::{DayView, PlaybackView, SilhouettesView};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// A folder with runs, and their playback.
pub struct Stored {
    pub folder: TempDir,
    pub playback: Playback,
}

impl Stored {
    /// A changed scenario, simulated for some time.
    pub fn lived(scenario: &str, length: Span, change: impl Fn(&str, String) -> String) -> Stored {
        let (stored, mut act, folders) = Stored::begun(scenario, change);
        live(&mut act, RunTime::START + length, &folders);
        act.finish().unwrap();
        stored
    }

    /// A changed scenario at its start.
    pub fn begun(scenario: &str, change: impl Fn(&str, String) -> String) -> (Stored, StagedRun, HomeFolders) {
        let folder = TempDir::new().unwrap();
        let own = folder.path().join("scenario");
        copy(&scenarios().join(scenario), &own, &change);
        copy(&scenarios().join("../conditions"), &folder.path().join("conditions"), &change);
        let folders = HomeFolders {
            scenario: own,
            entry: "scenario.json".into(),
            is_trusted: false,
            runs: folder.path().join("runs"),
        };
        let act = StagedRun::new(&folders, &folders.entry, StartRequest::default()).unwrap();
        (Stored { folder, playback: Playback::new(folders.clone()) }, act, folders)
    }

    pub fn name(&self) -> String {
        self.playback.list()[0].name.clone()
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join("runs").join(self.name()).join(name)
    }

    pub fn view(&self) -> Arc<PlaybackView> {
        self.playback.run(&self.name()).unwrap()
    }

    pub fn film(&self, from_us: i64, to_us: i64, every: Span) -> Result<SilhouettesView, RequestError> {
        let span = Interval::new(RunTime::from_micros(from_us), RunTime::from_micros(to_us));
        self.playback.silhouettes(&self.name(), span, every)
    }

    pub fn days(&self) -> Vec<DayView> {
        let name = self.name();
        (0..self.view().days.len()).map(|day| self.playback.day(&name, day).unwrap()).collect()
    }
}

/// Simulates until an instant, or to the end.
pub fn live(act: &mut StagedRun, until: RunTime, folders: &HomeFolders) {
    let until = until.min(act.end());
    while act.now() < until {
        act.advance(until, folders).unwrap();
    }
}

pub fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

pub fn copy(from: &Path, to: &Path, change: &impl Fn(&str, String) -> String) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        if entry.file_type().unwrap().is_file() {
            fs::write(to.join(&name), change(&name, fs::read_to_string(entry.path()).unwrap())).unwrap();
        }
    }
}

pub fn as_it_is(_: &str, text: String) -> String {
    text
}

/// Rows with the texts of the log.
pub fn words(view: &PlaybackView, days: &[DayView]) -> Vec<(String, String)> {
    let rows = days.iter().flat_map(|day| &day.rows);
    rows.map(|row| (view.sensors[row.1 as usize].clone(), view.values[row.2 as usize].clone())).collect()
}
