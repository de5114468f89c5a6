//! The folders that a page can read: one scenario, and its runs.
//!
//! Requests name files and runs, and the server looks these names up in listings; it never uses paths of a request. Entries that are
//! not plain files in their folder, such as links, do not exist for it.

use crate::messages::PageMessage;
use homebody_core::problem::{Diagnose, Diagnostic, readable};
use homebody_core::recording::Recording;
use homebody_core::scenario::load::{Files, NoText};
use homebody_log::files::plain;
use homebody_log::run::places::RECORDING;
use homebody_routine::language::lexicon::OWN_FILE;
use homebody_simulation::ScenarioFolder;
use homebody_tracking::located_folder::{GIVEN, REPORT, ROOMS, SIMULATED_RUN};
use std::path::{Component, Path, PathBuf};
use std::time::SystemTime;
use std::{fs, io};

#[derive(Clone, Debug)]
pub struct HomeFolders {
    pub scenario: PathBuf,
    pub entry: String,
    /// Whether the scenario is the user's own: then links may lead out of its folder, and its files may have any size.
    pub is_trusted: bool,
    /// The folder of all runs, which may not exist yet.
    pub runs: PathBuf,
}

impl HomeFolders {
    fn files(&self) -> ScenarioFolder {
        ScenarioFolder::new(&self.scenario, self.is_trusted)
    }

    /// The names of the files that the page can edit: those of the scenario's folder and of its folder of conditions.
    pub fn editable(&self) -> Vec<String> {
        let named = |folder: &str| {
            let files = plain_files(&self.scenario.join(folder)).unwrap_or_default();
            let names = files.into_iter().map(move |(name, _)| name);
            names.filter(|name| is_editable(name)).collect::<Vec<_>>()
        };
        let conditions = named(CONDITIONS).into_iter().map(|name| format!("{CONDITIONS}/{name}"));
        let names = named("").into_iter().chain(conditions);
        names.filter(|name| self.read(name).is_ok()).collect()
    }

    /// The place of a file that the page can edit; `None` for an invalid name.
    pub fn place_of(&self, name: &str) -> Option<PathBuf> {
        let own = name.strip_prefix(CONDITIONS).and_then(|rest| rest.strip_prefix('/')).unwrap_or(name);
        let is_plain = own.len() <= LONGEST_NAME && !own.starts_with('.') && !own.contains(['/', '\\', ':', '\0']);
        if is_plain && is_editable(own) { plain::within(&self.scenario, Path::new(name)) } else { None }
    }

    /// An image in the scenario's folder.
    pub fn picture(&self, name: &str) -> Option<PathBuf> {
        let is_picture = PICTURES.iter().any(|ending| name.ends_with(ending));
        is_picture.then(|| plain_file(&self.scenario, Path::new(name)))?
    }

    /// The names of all runs with a recording, the latest first. Members of a cohort are in its folder: `cohort-1/0001`.
    pub fn runs(&self) -> Vec<String> {
        let mut runs = Vec::new();
        for (changed, name) in folders(&self.runs) {
            let folder = self.runs.join(&name);
            if folder.join(RECORDING).is_file() {
                runs.push((changed, name));
                continue;
            }
            let members = folders(&folder).into_iter();
            let members = members.filter(|(_, member)| folder.join(member).join(RECORDING).is_file());
            runs.extend(members.map(|(changed, member)| (changed, format!("{name}/{member}"))));
        }
        runs.sort_by(|a, b| b.cmp(a));
        runs.into_iter().map(|(_, name)| name).collect()
    }

    pub fn run(&self, name: &str) -> Option<PathBuf> {
        let run = self.runs().into_iter().find(|run| run == name)?;
        Some(self.runs.join(run))
    }

    /// The folder of a located log, if the run is the one that was simulated from it.
    pub fn located_log(&self, run: &str) -> Option<PathBuf> {
        let folder = run.strip_suffix(SIMULATED_RUN)?.strip_suffix('/')?;
        let folder = self.run(run)?.parent().filter(|parent| parent.ends_with(folder))?.to_owned();
        let is_file = |name: &str| plain_file(&folder, Path::new(name)).is_some();
        let given = plain::within(&folder, Path::new(GIVEN)).filter(|given| given.is_dir());
        (is_file(ROOMS) && is_file(REPORT) && given.is_some()).then_some(folder)
    }

    /// The names of the logs that are stored for the care view only, in order.
    pub fn kept_logs(&self) -> Vec<String> {
        let folders = folders(&self.runs).into_iter().map(|(_, name)| name);
        let mut logs: Vec<String> = folders.filter(|name| self.kept_log(name).is_some()).collect();
        logs.sort();
        logs
    }

    /// The folder of such a log. It has the original log, and no results.
    pub fn kept_log(&self, name: &str) -> Option<PathBuf> {
        let (_, name) = folders(&self.runs).into_iter().find(|(_, folder)| folder == name)?;
        let folder = self.runs.join(name);
        let is_there = |name: &str| folder.join(name).symlink_metadata().is_ok();
        let given = plain::within(&folder, Path::new(GIVEN)).filter(|given| given.is_dir());
        (given.is_some() && !is_there(SIMULATED_RUN) && !is_there(RECORDING)).then_some(folder)
    }

    /// A plain file in a run's folder.
    pub fn file_of_run(&self, run: &str, file: &str) -> Option<PathBuf> {
        let files = plain_files(&self.run(run)?).ok()?;
        files.into_iter().find(|(name, _)| name == file).map(|(_, path)| path)
    }

    /// A plain file in a run's folder or in plain folders there, by its path.
    pub fn file_within_run(&self, run: &str, path: &Path) -> Option<PathBuf> {
        plain_file(&self.run(run)?, path)
    }

    pub fn recording(&self, run: &str) -> Result<Recording, Diagnostic> {
        let no_run = || PageMessage::NoRun { run: readable(run.to_owned()) };
        let path = self.file_of_run(run, RECORDING).ok_or_else(no_run)?;
        homebody_simulation::recording(&path).map_err(|error| error.diagnostic())
    }
}

impl Files for HomeFolders {
    fn read(&self, name: &str) -> Result<String, NoText> {
        let leads_out = |part: Component| !matches!(part, Component::Normal(_));
        match Path::new(name).components().any(leads_out) {
            true => Err(NoText::Missing),
            false => self.files().read(name),
        }
    }

    fn names(&self) -> Vec<String> {
        self.files().names()
    }

    fn most_bytes(&self) -> usize {
        self.files().most_bytes()
    }
}

/// The folder of a scenario's own conditions.
const CONDITIONS: &str = "conditions";

/// The endings of images that the page shows.
const PICTURES: [&str; 4] = [".png", ".jpg", ".jpeg", ".svg"];

/// Largest number of characters of a file's name (our choice).
const LONGEST_NAME: usize = 100;

/// Whether people edit the file.
fn is_editable(name: &str) -> bool {
    name.ends_with(".json") || name.ends_with(".routine") || name == OWN_FILE
}

/// A plain file below a folder, by its path.
fn plain_file(folder: &Path, path: &Path) -> Option<PathBuf> {
    plain::within(folder, path).filter(|file| file.is_file())
}

/// The folders in a folder with their last changes, without links and without hidden folders, which are incomplete.
fn folders(within: &Path) -> Vec<(Option<SystemTime>, String)> {
    let folders = fs::read_dir(within).into_iter().flatten().flatten();
    let folders = folders.filter(|folder| folder.file_type().is_ok_and(|kind| kind.is_dir()));
    let changed = |folder: &fs::DirEntry| folder.metadata().and_then(|meta| meta.modified()).ok();
    let named = folders.filter_map(|folder| Some((changed(&folder), folder.file_name().into_string().ok()?)));
    named.filter(|(_, name)| !name.starts_with('.')).collect()
}

/// The plain files of a folder by name, without links.
fn plain_files(folder: &Path) -> io::Result<Vec<(String, PathBuf)>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if let (true, Ok(name)) = (entry.file_type()?.is_file(), entry.file_name().into_string()) {
            files.push((name, entry.path()));
        }
    }
    files.sort();
    Ok(files)
}
