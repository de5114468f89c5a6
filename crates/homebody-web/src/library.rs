//! A folder of homes.
//!
//! A home is a folder with a `scenario.json` and a folder `runs`, so that a home keeps its runs when it is renamed, deleted or
//! restored. Requests name homes, and the server looks these names up; it never uses paths of a request. A new home is created in a
//! hidden folder and gets its name once it is complete.

use crate::drafts::entries::entries;
use crate::folder_copy;
use crate::folders::HomeFolders;
use crate::messages::LibraryMessage;
use crate::playback::Playback;
use crate::request_error::{RequestError, no_run, not_found, replaced, unprocessable};
use crate::trash;
use crate::wire::{CardView, DeletedHome, HomeEntryView, LibraryView, MadeView, NewHome, TemplateView};
use crate::write_locks::{WriteLock, WriteLocks};
use homebody_core::problem::{Diagnose, Diagnostic, is_unseen, readable};
use homebody_core::scenario::load::Files;
use homebody_import::sweet_home;
use homebody_log::files::fresh::FreshFile;
use homebody_log::run::places::RUNS;
use homebody_query::LoadedLog;
use homebody_routine::household::Household;
use homebody_scaffold::{GivenLog, NewScenario, ScaffoldError, ScenarioTexts};
use homebody_simulation::Template;
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;
use std::{fs, io};
use tempfile::TempDir;

const ENTRY: &str = "scenario.json";

/// The lock of a library among servers; hidden in listings.
const NAMING: &str = ".homebody";

/// Largest number of homes that are shown, those that were changed last (our choice).
const MOST_HOMES: usize = 1000;

/// Largest number of a home's runs on the first page (our choice).
const MOST_RUNS: usize = 3;

/// Largest numbers of letters and bytes of a home's name (our choice): most systems take 255 bytes, and names of
/// set-aside files have some more.
const MOST_LETTERS: usize = 100;
const MOST_NAME_BYTES: usize = 200;

/// Largest home that is drawn on the first page (our choice).
const LARGEST_DRAWN_BYTES: usize = 1 << 20;

/// Largest number of stored pictures of runs (our choice): each is some kilobytes.
const MOST_PICTURES: usize = 2000;

/// Largest number of days that the picture of a run tells apart (our choice).
const MOST_COLUMNS: usize = 60;

/// Clones are the same library.
#[derive(Clone, Debug)]
pub struct Library {
    folder: PathBuf,
    /// See [`HomeFolders::is_trusted`].
    is_trusted: bool,
    /// Held while a name is taken or freed.
    naming: WriteLocks,
    /// By home and run, for unchanged recordings.
    pictures: Arc<Mutex<HashMap<(String, String), Picture>>>,
}

/// The time of a recording, and the events of its log by day and hour.
type Picture = (Option<SystemTime>, Vec<Vec<u32>>);

impl Library {
    pub fn new(folder: PathBuf, is_trusted: bool) -> Library {
        Library { folder, is_trusted, naming: WriteLocks::default(), pictures: Arc::default() }
    }

    pub fn view(&self) -> LibraryView {
        let mut homes: Vec<HomeEntryView> = self.names().into_iter().map(|name| self.entry(name)).collect();
        homes.sort_by(|a, b| b.changed_ms.cmp(&a.changed_ms).then_with(|| a.name.cmp(&b.name)));
        let more = homes.len().saturating_sub(MOST_HOMES);
        homes.truncate(MOST_HOMES);
        let deleted = trash::deleted(&self.folder).into_iter().map(|(key, name)| DeletedHome { key, name });
        LibraryView {
            folder: self.folder.canonicalize().unwrap_or_else(|_| self.folder.clone()).display().to_string(),
            trouble: self.trouble(),
            homes,
            more: more as u32,
            aside: deleted.collect(),
            templates: Template::all().map(template).collect(),
            runs_beside: self.runs_outside_homes() as u32,
        }
    }

    pub fn home(&self, name: &str) -> Result<HomeFolders, RequestError> {
        let is_there = is_inside(name) && is_folder(&self.folder.join(name)) && self.is_home(name);
        let folders = is_there.then(|| self.folders(name)).ok_or_else(|| no_home(name))?;
        self.has_own_runs(name)?;
        Ok(folders)
    }

    /// Rejects a home whose folder of runs is a link: its runs would be listed, written and deleted somewhere else.
    pub fn has_own_runs(&self, name: &str) -> Result<(), RequestError> {
        match fs::symlink_metadata(self.folders(name).runs).is_ok_and(|found| found.is_symlink()) {
            true => Err(unprocessable(LibraryMessage::LinkedRuns { name: shortened_name(name) })),
            false => Ok(()),
        }
    }

    pub fn card(&self, name: &str) -> Result<CardView, RequestError> {
        let folders = self.home(name)?;
        let root = json_of(&folders, ENTRY);
        let home = root["home"].as_str().and_then(|file| folders.read(file).ok());
        let names = root["residents"].as_array().into_iter().flatten().filter_map(Value::as_str);
        let residents = names.filter_map(|file| json_of(&folders, file)["name"].as_str().map(str::to_owned)).collect();
        let problems = Household::load(&folders, ENTRY, &[]).err().map_or(0, |problems| problems.0.len());
        let runs = folders.runs().len();
        Ok(CardView {
            home: home.filter(|text| text.len() <= LARGEST_DRAWN_BYTES),
            residents,
            problems: problems as u32,
            runs: runs as u32,
            latest: Playback::new(folders).latest(MOST_RUNS),
            goes_on: None,
        })
    }

    /// The number of rows of a run's log in each hour of the clock, by day; a long run joins several days.
    pub fn picture(&self, name: &str, run: &str) -> Result<Vec<Vec<u32>>, RequestError> {
        let folders = self.home(name)?;
        let folder = folders.run(run).ok_or_else(|| no_run(run))?;
        let written =
            fs::metadata(folder.join(homebody_log::run::places::RECORDING)).and_then(|meta| meta.modified()).ok();
        let key = (name.to_owned(), run.to_owned());
        // Held while a picture is made: a page of many homes requests one after the other.
        let mut pictures = self.pictures.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, hours)) = pictures.get(&key).filter(|(at, _)| *at == written) {
            return Ok(hours.clone());
        }
        let view = Playback::new(folders).run(run)?;
        let together = view.hours.len().div_ceil(MOST_COLUMNS).max(1);
        let column = |days: &[Vec<u32>]| -> Vec<u32> {
            let of_hour = |hour: usize| days.iter().filter_map(|day| day.get(hour)).sum::<u32>() / days.len() as u32;
            (0..24).map(of_hour).collect()
        };
        let hours: Vec<Vec<u32>> = view.hours.chunks(together).map(column).collect();
        if pictures.len() >= MOST_PICTURES {
            pictures.clear();
        }
        pictures.insert(key, (written, hours.clone()));
        Ok(hours)
    }

    pub fn begin(&self, name: &str, from: &NewHome) -> Result<MadeView, RequestError> {
        let texts = match from {
            NewHome::Empty => homebody_scaffold::empty(name),
            NewHome::Template { name: template } => {
                homebody_scaffold::from_template(Template::named(template).map_err(not_found)?, name)
            }
        };
        self.make(name, |folder| homebody_scaffold::write(folder, &texts))?;
        Ok(MadeView { name: name.to_owned(), remarks: Vec::new() })
    }

    pub fn import(&self, name: &str, bytes: &[u8]) -> Result<MadeView, RequestError> {
        self.is_free(name)?;
        let imported = sweet_home(bytes, name, None).map_err(unprocessable)?;
        let week = NewScenario::week(name, imported.home_json);
        let lack = homebody_scaffold::lack(&week);
        // The page lists missing parts among problems and adds them by buttons; hints are for people who edit files.
        let lack = lack.iter().filter_map(|lack| lack.lines().next()).map(str::to_owned).collect();
        self.write_inhabited(name, &homebody_scaffold::inhabited_texts(&week), imported.remarks, lack)
    }

    /// Creates a schematic home from a log. `file` is the original name of the log.
    pub fn from_log(&self, name: &str, file: &str, log: &Path) -> Result<MadeView, RequestError> {
        self.is_free(name)?;
        // Messages do not show the temporary path.
        let log_path = log.display().to_string();
        let failed = |error: Diagnostic| unprocessable(without_options(replaced(error, &log_path, file)));
        let read = LoadedLog::read(&log.to_string_lossy(), None).map_err(|error| failed(error.diagnostic()))?;
        let table = BTreeMap::new();
        let given = GivenLog { named: file, file, read: &read, time_zone: None, table, picture: None };
        let made = homebody_scaffold::from_log(name, &given).map_err(|error| failed(error.diagnostic()))?;
        self.write_inhabited(name, &made.scenario.texts, made.remarks, made.scenario.lack)
    }

    fn write_inhabited(
        &self,
        name: &str,
        texts: &ScenarioTexts,
        mut remarks: Vec<String>,
        lack: Vec<String>,
    ) -> Result<MadeView, RequestError> {
        self.make(name, |folder| homebody_scaffold::write(folder, texts))?;
        remarks.extend(lack.iter().map(|lack| format!("The home is not ready for a resident yet: {lack}")));
        Ok(MadeView { name: name.to_owned(), remarks })
    }

    /// A temporary folder for a log that is being received.
    pub fn hidden(&self) -> Result<TempDir, RequestError> {
        tempfile::Builder::new().prefix(".new-").tempdir_in(&self.folder).map_err(|error| self.unwritten(&error))
    }

    pub fn duplicate(&self, name: &str, to: &str) -> Result<MadeView, RequestError> {
        let from = self.home(name)?;
        self.is_free(to)?;
        let hidden = self.hidden()?;
        let fresh = hidden.path().join(to);
        folder_copy::copy_folder(&from.scenario, &fresh, &[RUNS]).map_err(unprocessable)?;
        rename_scenario(&fresh, name, to).map_err(unprocessable)?;
        self.take_name(&fresh, to)?;
        Ok(MadeView { name: to.to_owned(), remarks: Vec::new() })
    }

    pub fn rename(&self, name: &str, to: &str) -> Result<(), RequestError> {
        let from = self.home(name)?;
        self.take_name(&from.scenario, to)?;
        rename_scenario(&self.folder.join(to), name, to).map_err(unprocessable)
    }

    /// Deletes a closed home with its runs, and returns its key in the trash.
    pub fn delete(&self, name: &str) -> Result<String, RequestError> {
        let _naming = self.naming()?;
        self.home(name)?;
        trash::delete(&self.folder, name)
    }

    pub fn restore(&self, key: &str) -> Result<String, RequestError> {
        let _naming = self.naming()?;
        trash::restore(&self.folder, "home", key)
    }

    pub fn is_free(&self, name: &str) -> Result<(), RequestError> {
        let why = wrong_name(name);
        if !why.is_empty() {
            return Err(unprocessable(LibraryMessage::InvalidName { name: shortened_name(name), why }));
        }
        match fs::symlink_metadata(self.folder.join(name)) {
            Ok(_) => Err(unprocessable(LibraryMessage::NameUsed { name: name.to_owned() })),
            Err(_) => Ok(()),
        }
    }

    /// Creates a complete home, or none.
    fn make(&self, name: &str, write: impl FnOnce(&Path) -> Result<(), ScaffoldError>) -> Result<(), RequestError> {
        self.is_free(name)?;
        let hidden = self.hidden()?;
        let fresh = hidden.path().join(name);
        homebody_scaffold::create(&fresh, |part, _| write(part)).map_err(unprocessable)?;
        self.take_name(&fresh, name)
    }

    fn take_name(&self, folder: &Path, name: &str) -> Result<(), RequestError> {
        let _naming = self.naming()?;
        self.is_free(name)?;
        fs::rename(folder, self.folder.join(name)).map_err(|error| self.unwritten(&error))
    }

    fn names(&self) -> Vec<String> {
        let folders = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let folders = folders.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
        let names = folders.filter_map(|entry| entry.file_name().into_string().ok());
        names.filter(|name| !name.starts_with('.') && self.is_home(name)).collect()
    }

    fn is_home(&self, name: &str) -> bool {
        let entry = fs::symlink_metadata(self.folder.join(name).join(ENTRY));
        entry.is_ok_and(|entry| entry.is_file())
    }

    fn entry(&self, name: String) -> HomeEntryView {
        let folders = self.folders(&name);
        let root = json_of(&folders, ENTRY);
        let text = |key: &str| root[key].as_str().unwrap_or_default().to_owned();
        HomeEntryView { title: text("name"), about: text("about"), changed_ms: changed_ms(&folders.scenario), name }
    }

    fn folders(&self, name: &str) -> HomeFolders {
        let scenario = self.folder.join(name);
        HomeFolders { runs: scenario.join(RUNS), scenario, entry: ENTRY.into(), is_trusted: self.is_trusted }
    }

    /// The number of runs next to the homes, which `homebody run` leaves in its working folder.
    fn runs_outside_homes(&self) -> usize {
        let folders = HomeFolders { runs: self.folder.join(RUNS), ..self.folders("") };
        folders.runs().len()
    }

    /// The reason why homes cannot be written. The test file has no name and leaves no trace.
    fn trouble(&self) -> Option<String> {
        let error = tempfile::tempfile_in(&self.folder).err()?;
        Some(format!("Cannot write to this folder: {error}. You can view homes, but not change them or store runs."))
    }

    fn unwritten(&self, error: &io::Error) -> RequestError {
        let folder = self.folder.display().to_string();
        unprocessable(LibraryMessage::NotWritable { folder, why: error.to_string() })
    }

    fn naming(&self) -> Result<WriteLock<'_>, RequestError> {
        self.naming.lock(&self.folder.join(NAMING)).map_err(unprocessable)
    }
}

fn no_home(name: &str) -> RequestError {
    not_found(LibraryMessage::NoHome { name: shortened_name(name) })
}

fn shortened_name(name: &str) -> String {
    let short: String = name.chars().take(MOST_LETTERS).collect();
    readable(if short.len() < name.len() { format!("{short}…") } else { short })
}

/// Whether a name is that of an entry of a folder.
fn is_inside(name: &str) -> bool {
    !name.is_empty() && !name.starts_with('.') && !name.contains(['/', '\\', '\0'])
}

/// The faults of a name for a new home: it is the name of a folder on any system.
fn wrong_name(name: &str) -> Vec<String> {
    let mut wrong = Vec::new();
    if name.trim().is_empty() {
        wrong.push("it is empty".to_owned());
    }
    if name.chars().count() > MOST_LETTERS || name.len() > MOST_NAME_BYTES {
        wrong.push(format!("it is longer than {MOST_LETTERS} characters"));
    }
    if name.starts_with('.') {
        wrong.push("it starts with a dot".into());
    }
    if name != name.trim() || name.ends_with('.') {
        wrong.push("it starts or ends with a space, or ends with a dot".into());
    }
    if name.chars().any(|c| is_unseen(c) || "/\\:*?\"<>|".contains(c)) {
        wrong.push("it contains one of / \\ : * ? \" < > | or an invisible character".into());
    }
    if name == RUNS {
        wrong.push("the folder of that name is reserved for runs".into());
    }
    wrong
}

fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_dir())
}

fn json_of(files: &HomeFolders, name: &str) -> Value {
    files.read(name).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
}

fn template(template: Template) -> TemplateView {
    let text = template.files().find(|(name, _)| name == ENTRY).map(|(_, text)| text);
    let root: Value = text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
    TemplateView { name: template.name(), about: root["about"].as_str().unwrap_or_default().to_owned() }
}

/// The last change of a home's files, in milliseconds since 1970.
fn changed_ms(folder: &Path) -> Option<i64> {
    let files = fs::read_dir(folder).ok()?.flatten().filter_map(|entry| entry.metadata().ok());
    let times = files.filter(fs::Metadata::is_file).filter_map(|found| found.modified().ok());
    let since = times.max()?.duration_since(SystemTime::UNIX_EPOCH).ok()?;
    i64::try_from(since.as_millis()).ok()
}

/// Replaces hints at options of the command: in the page a person draws instead.
fn without_options(problem: Diagnostic) -> Diagnostic {
    let drawing = "start an empty home, draw its rooms, and place sensors with these names";
    if problem.code.is_empty() {
        // Several problems have a line each, and their hints have more.
        let is_option = |line: &str| line.trim_start().starts_with("hint: ") && line.contains(" --");
        let line = |line: &str| if is_option(line) { format!("  hint: {drawing}") } else { line.to_owned() };
        return problem.text().lines().map(line).collect::<Vec<String>>().join("\n").into();
    }
    let hint = problem.hint.map(|hint| if hint.contains(" --") { drawing.to_owned() } else { hint });
    Diagnostic { hint, ..problem }
}

/// Renames a scenario that has the name of its folder, because runs are named after it.
fn rename_scenario(folder: &Path, before: &str, now: &str) -> Result<(), LibraryMessage> {
    let unnamed = |why: &dyn Display| LibraryMessage::NotNamed { file: ENTRY.into(), why: why.to_string() };
    let path = folder.join(ENTRY);
    let text = fs::read_to_string(&path).map_err(|error| unnamed(&error))?;
    let Some(own) = entries(&text).into_iter().find(|entry| entry.is(&["name"]) && entry.text() == Some(before)) else {
        return Ok(());
    };
    let mut fresh = text.clone();
    fresh.replace_range(own.name_range(), &json!(now).to_string());
    FreshFile::write_whole(&path, fresh.as_bytes(), true).map_err(|error| unnamed(&error))
}
