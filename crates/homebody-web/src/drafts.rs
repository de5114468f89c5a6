//! Drafts of a scenario's files. Requests about a draft write nothing to the disk; saving replaces only the versions that the page has
//! read.

mod draft_run;
pub(crate) mod entries;
mod installing;
mod routines;
mod log;
mod naming;
mod plan;
mod sentence_edits;
mod statements;
mod suggestion_progress;

pub use routines::sentence_view;

use crate::folders::HomeFolders;
use crate::messages::DraftMessage;
use crate::wire::{
    CheckView, Draft, FileView, FilesView, FixView, ProblemView, ResidentRoutineView, Save, SaveFile, SavedView,
    UnderlayView,
};
use crate::write_locks::WriteLocks;
use homebody_core::problem::{Diagnose, Diagnostic, Fix, Problem, readable};
use homebody_core::scenario::load::{Files, Overlay};
use homebody_core::scenario::remarks;
use homebody_log::files::fresh::FreshFile;
use homebody_simulation::OpenScenario;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::{Arc, Mutex};

/// The file with the place of the image below the plan.
const UNDERLAY: &str = "underlay.json";

/// The files of one scenario. Clones are the same.
#[derive(Clone)]
pub struct DraftService {
    pub folders: HomeFolders,
    /// Held while files are compared and replaced, so that no two pages do so at once.
    writing: WriteLocks,
    /// The run of the latest draft. Its lock lets one draft run at a time, so that the run on the stage has a core.
    draft_run: Arc<Mutex<Option<draft_run::DraftRun>>>,
    suggesting: Arc<suggestion_progress::SuggestionProgress>,
}

impl DraftService {
    pub fn new(folders: HomeFolders) -> DraftService {
        DraftService { folders, writing: WriteLocks::default(), draft_run: Arc::default(), suggesting: Arc::default() }
    }

    /// All files that the page can edit, and their roles in the scenario.
    pub fn files(&self) -> FilesView {
        let root = self.json(&self.folders.entry);
        let text = |value: &Value| value.as_str().map(str::to_owned);
        let residents = root["residents"].as_array().into_iter().flatten().filter_map(Value::as_str);
        let lives = residents.filter_map(|file| {
            let resident = self.json(file);
            let routine = text(&resident["driver"]["routine"])?;
            Some(ResidentRoutineView { name: text(&resident["name"]).unwrap_or_else(|| file.to_owned()), routine })
        });
        FilesView {
            entry: self.folders.entry.clone(),
            home: text(&root["home"]),
            logger: text(&root["logger"]),
            lives: lives.collect(),
            files: self.folders.editable().iter().filter_map(|name| self.file(name)).collect(),
        }
    }

    pub fn underlay(&self) -> Option<UnderlayView> {
        serde_json::from_str(&self.folders.read(UNDERLAY).ok()?).ok()
    }

    /// The versions of all files that the page can edit.
    pub fn versions(&self) -> BTreeMap<String, String> {
        let names = self.folders.editable().into_iter();
        names.filter_map(|name| Some((name.clone(), version(&self.folders.read(&name).ok()?)))).collect()
    }

    /// Saves all texts, or none if a file has another version. If a disk fails between two of them, the error names those that were
    /// written.
    pub fn save(&self, save: Save) -> Result<SavedView, Diagnostic> {
        let _lock = self.writing.lock(&self.folders.scenario.join(&self.folders.entry))?;
        let names: BTreeSet<&str> = save.files.iter().map(|file| file.name.as_str()).collect();
        if names.len() < save.files.len() {
            return Err(DraftMessage::SameFile.into());
        }
        let is_made = self.make_folder(&names)?;
        let invalid = |name: &str| DraftMessage::FileName { name: readable(name.to_owned()) };
        let place = |file: &SaveFile| self.folders.place_of(&file.name).ok_or_else(|| invalid(&file.name));
        let places = save.files.iter().map(place).collect::<Result<Vec<_>, _>>().inspect_err(|_| {
            if is_made {
                // The folder is empty.
                let _ = std::fs::remove_dir(&self.folders.scenario);
            }
        })?;
        let there = |name: &str| self.file(name).unwrap_or_else(|| missing_file(name));
        let is_as_seen = |file: &SaveFile| there(&file.name).version == file.version.clone().unwrap_or_default();
        let others = save.files.iter().filter(|file| !is_as_seen(file));
        let changed: Vec<_> = others.map(|file| there(&file.name)).collect();
        if !changed.is_empty() {
            return Ok(SavedView { saved: BTreeMap::new(), changed });
        }
        let failed = |name: &str, error: Diagnostic, written: Vec<String>| {
            let (file, why, solution) = (name.to_owned(), error.what, error.hint);
            Diagnostic::from(DraftMessage::NotWritten { file, why, solution, written })
        };
        let mut fresh = Vec::new();
        for (file, place) in save.files.iter().zip(&places) {
            fresh.push(prepared_file(place, &file.text).map_err(|error| failed(&file.name, error, Vec::new()))?);
        }
        let mut saved = BTreeMap::new();
        for (file, fresh) in save.files.iter().zip(fresh) {
            if let Err(error) = fresh.finish() {
                return Err(failed(&file.name, error.diagnostic(), saved.into_keys().collect()));
            }
            saved.insert(file.name.clone(), version(&file.text));
        }
        Ok(SavedView { saved, changed })
    }

    /// Creates the scenario's folder again if its own file is saved. Returns whether it did.
    fn make_folder(&self, names: &BTreeSet<&str>) -> Result<bool, DraftMessage> {
        let folder = &self.folders.scenario;
        if folder.exists() || !names.contains(self.folders.entry.as_str()) {
            return Ok(false);
        }
        let failed = |error: std::io::Error| DraftMessage::NoFolder { why: error.to_string() };
        std::fs::create_dir(folder).map_err(failed)?;
        Ok(true)
    }

    /// The scenario's files with those of a draft in front.
    pub fn with(&self, draft: Draft) -> Overlay<'_> {
        Overlay { texts: draft.texts, others: &self.folders }
    }

    /// The scenario of a draft, or all its problems.
    pub fn open(&self, files: &Overlay) -> Result<OpenScenario, Vec<Problem>> {
        OpenScenario::from_files(files, &self.folders.entry).map_err(|problems| problems.0)
    }

    /// The problems and warnings of a draft, as `homebody check` reports them.
    pub fn check(&self, draft: Draft) -> CheckView {
        match self.open(&self.with(draft)) {
            Ok(opened) => {
                let scenario = opened.scenario();
                let length = scenario.calendar.span_of_days(scenario.file.days);
                CheckView { problems: Vec::new(), warnings: problems(&remarks::scenario_remarks(scenario, length)) }
            }
            Err(wrong) => CheckView { problems: problems(&wrong), warnings: Vec::new() },
        }
    }

    fn file(&self, name: &str) -> Option<FileView> {
        let text = self.folders.read(name).ok()?;
        Some(FileView { name: name.to_owned(), version: version(&text), text })
    }

    /// Null for a missing or invalid file.
    fn json(&self, name: &str) -> Value {
        self.folders.read(name).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
    }
}

/// Prepares a file with a text. It keeps the byte order mark of the file that it replaces.
fn prepared_file(place: &Path, text: &str) -> Result<FreshFile, Diagnostic> {
    const MARK: &[u8] = "\u{feff}".as_bytes();
    if let Some(folder) = place.parent().filter(|folder| !folder.exists()) {
        std::fs::create_dir(folder).map_err(|error| Diagnostic::from(error.to_string()))?;
    }
    let mut fresh = FreshFile::create(place, true)?;
    let mut begins = [0; MARK.len()];
    let is_marked = File::open(place).is_ok_and(|mut file| file.read_exact(&mut begins).is_ok()) && begins == MARK;
    if is_marked {
        fresh.write(MARK)?;
    }
    fresh.write(text.as_bytes())?;
    Ok(fresh)
}

fn missing_file(name: &str) -> FileView {
    FileView { name: name.to_owned(), text: String::new(), version: String::new() }
}

/// A digest of a text.
pub fn version(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

pub fn problems(problems: &[Problem]) -> Vec<ProblemView> {
    let view = |problem: &Problem| ProblemView {
        code: (!problem.code.is_empty()).then(|| problem.code.to_owned()),
        file: problem.file.clone(),
        line: problem.line,
        column: problem.column,
        width: problem.excerpt.as_ref().map_or(1, |excerpt| excerpt.width),
        what: problem.what.clone(),
        hint: problem.hint.clone(),
        fix: problem.fix.as_deref().map(|fix| fix_view(problem, fix)),
    };
    problems.iter().map(view).collect()
}

fn fix_view(problem: &Problem, fix: &Fix) -> FixView {
    match fix.clone() {
        Fix::Replace { with } => FixView::Replace { with },
        Fix::LetEnter { furniture } => FixView::LetEnter { furniture },
        Fix::Add { piece, room } => {
            FixView::Add { piece, room, rest: problem.hint_before_fix().unwrap_or_default().to_owned() }
        }
    }
}
