//! A folder of homes: what there is in it, and what becomes of each.
//!
//! A home is a folder with a `scenario.json`, and its runs are in its folder `runs`, so that a home that is renamed, put aside or
//! fetched back takes them along. The page knows homes by names that are looked up there, never by paths. What is made comes into a
//! hidden folder first and gets its name once it is whole.

use crate::aside::{self, Unmoved};
use crate::copied;
use crate::desk::entries::entries;
use crate::messages::{LibraryMessage, PageMessage};
use crate::playback::Playback;
use crate::refusal::{Refusal, damaged, replaced, unknown};
use crate::shelf::Shelf;
use crate::turns::{Turn, Turns};
use crate::wire::{AsideView, CardView, HomeEntryView, LibraryView, MadeView, NewHome, TemplateView};
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

/// What a scenario's own file is called in a library.
const ENTRY: &str = "scenario.json";

/// The file at which servers of one library take turns; no listing shows it.
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

/// A folder of homes. A clone is the same one.
#[derive(Clone, Debug)]
pub struct Library {
    folder: PathBuf,
    /// Whether its homes are one's own: see [`Shelf::is_trusted`].
    is_trusted: bool,
    /// Held while something gets a name or loses it, so that no two pages take one.
    naming: Turns,
    /// Pictures of runs, by home and run, as long as the recording stays as it is.
    pictures: Arc<Mutex<HashMap<(String, String), Picture>>>,
}

/// When a recording was written, and what its log was like.
type Picture = (Option<SystemTime>, Vec<Vec<u32>>);

impl Library {
    pub fn new(folder: PathBuf, is_trusted: bool) -> Library {
        Library { folder, is_trusted, naming: Turns::default(), pictures: Arc::default() }
    }

    /// Everything in it.
    pub fn view(&self) -> LibraryView {
        let mut homes: Vec<HomeEntryView> = self.names().into_iter().map(|name| self.entry(name)).collect();
        homes.sort_by(|a, b| b.changed_ms.cmp(&a.changed_ms).then_with(|| a.name.cmp(&b.name)));
        let more = homes.len().saturating_sub(MOST_HOMES);
        homes.truncate(MOST_HOMES);
        let aside = aside::keys(&self.folder).into_iter();
        let aside = aside.filter_map(|key| Some(AsideView { name: aside::name_of(&key)?, key }));
        LibraryView {
            folder: self.folder.canonicalize().unwrap_or_else(|_| self.folder.clone()).display().to_string(),
            trouble: self.trouble(),
            homes,
            more: more as u32,
            aside: aside.collect(),
            templates: Template::all().map(template).collect(),
            runs_beside: self.runs_beside() as u32,
        }
    }

    /// The files and runs of a home.
    pub fn home(&self, name: &str) -> Result<Shelf, Refusal> {
        let is_there = is_inside(name) && is_folder(&self.folder.join(name)) && self.is_home(name);
        let shelf = is_there.then(|| self.shelf(name)).ok_or_else(|| no_home(name))?;
        self.has_own_runs(name)?;
        Ok(shelf)
    }

    /// Refuses a home whose folder of runs is a link: they would be listed, written and put aside somewhere else.
    pub fn has_own_runs(&self, name: &str) -> Result<(), Refusal> {
        match fs::symlink_metadata(self.shelf(name).runs).is_ok_and(|found| found.is_symlink()) {
            true => Err(damaged(LibraryMessage::LinkedRuns { name: shown(name) })),
            false => Ok(()),
        }
    }

    /// What is shown of a home.
    pub fn card(&self, name: &str) -> Result<CardView, Refusal> {
        let shelf = self.home(name)?;
        let root = json_of(&shelf, ENTRY);
        let home = root["home"].as_str().and_then(|file| shelf.read(file).ok());
        let names = root["residents"].as_array().into_iter().flatten().filter_map(Value::as_str);
        let residents = names.filter_map(|file| json_of(&shelf, file)["name"].as_str().map(str::to_owned)).collect();
        let problems = Household::load(&shelf, ENTRY, &[]).err().map_or(0, |problems| problems.0.len());
        let runs = shelf.runs().len();
        Ok(CardView {
            home: home.filter(|text| text.len() <= LARGEST_DRAWN_BYTES),
            residents,
            problems: problems as u32,
            runs: runs as u32,
            latest: Playback::new(shelf).latest(MOST_RUNS),
            goes_on: None,
        })
    }

    /// How many rows the log of a run has in each hour of the clock, by day; of a long run some days are one.
    pub fn picture(&self, name: &str, run: &str) -> Result<Vec<Vec<u32>>, Refusal> {
        let shelf = self.home(name)?;
        let no_run = || unknown(PageMessage::NoRun { run: readable(run.to_owned()) });
        let folder = shelf.run(run).ok_or_else(no_run)?;
        let written =
            fs::metadata(folder.join(homebody_log::run::places::RECORDING)).and_then(|meta| meta.modified()).ok();
        let key = (name.to_owned(), run.to_owned());
        // Held while one is drawn: a page of many homes asks for one after the other.
        let mut pictures = self.pictures.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, hours)) = pictures.get(&key).filter(|(at, _)| *at == written) {
            return Ok(hours.clone());
        }
        let view = Playback::new(shelf).run(run)?;
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

    /// Begins a home: empty, or from a template.
    pub fn begin(&self, name: &str, from: &NewHome) -> Result<MadeView, Refusal> {
        let texts = match from {
            NewHome::Empty => homebody_scaffold::empty(name),
            NewHome::Template { name: template } => {
                homebody_scaffold::from_template(Template::named(template).map_err(unknown)?, name)
            }
        };
        self.make(name, |folder| homebody_scaffold::write(folder, &texts))?;
        Ok(MadeView { name: name.to_owned(), remarks: Vec::new() })
    }

    /// Begins a home from the bytes of a plan of Sweet Home 3D.
    pub fn import(&self, name: &str, bytes: &[u8]) -> Result<MadeView, Refusal> {
        self.is_free(name)?;
        let imported = sweet_home(bytes, name, None).map_err(damaged)?;
        let week = NewScenario::week(name, imported.home_json);
        let lack = homebody_scaffold::lack(&week);
        // What it lacks the page lists among its problems, and puts there by a button: its hints are for people with files.
        let lack = lack.iter().filter_map(|lack| lack.lines().next()).map(str::to_owned).collect();
        self.write_lived(name, &homebody_scaffold::inhabited_texts(&week), imported.remarks, lack)
    }

    /// Begins a schematic home from a log, whose file is called so.
    pub fn from_log(&self, name: &str, file: &str, log: &Path) -> Result<MadeView, Refusal> {
        self.is_free(name)?;
        // Where the log lies meanwhile tells nobody anything.
        let log_path = log.display().to_string();
        let told = |error: Diagnostic| damaged(without_options(replaced(error, &log_path, file)));
        let read = LoadedLog::read(&log.to_string_lossy(), None).map_err(|error| told(error.diagnostic()))?;
        let table = BTreeMap::new();
        let given = GivenLog { named: file, file, read: &read, time_zone: None, table, picture: None };
        let made = homebody_scaffold::from_log(name, &given).map_err(|error| told(error.diagnostic()))?;
        self.write_lived(name, &made.scenario.texts, made.remarks, made.scenario.lack)
    }

    fn write_lived(
        &self,
        name: &str,
        texts: &ScenarioTexts,
        mut remarks: Vec<String>,
        lack: Vec<String>,
    ) -> Result<MadeView, Refusal> {
        self.make(name, |folder| homebody_scaffold::write(folder, texts))?;
        remarks.extend(lack.iter().map(|lack| format!("The home is not ready for a resident yet: {lack}")));
        Ok(MadeView { name: name.to_owned(), remarks })
    }

    /// A place for a log that is coming; gone when it is dropped.
    pub fn hidden(&self) -> Result<TempDir, Refusal> {
        tempfile::Builder::new().prefix(".new-").tempdir_in(&self.folder).map_err(|error| self.unwritten(&error))
    }

    /// Copies a home, without its runs.
    pub fn duplicate(&self, name: &str, to: &str) -> Result<MadeView, Refusal> {
        let from = self.home(name)?;
        self.is_free(to)?;
        let hidden = self.hidden()?;
        let fresh = hidden.path().join(to);
        copied::copy(&from.scenario, &fresh, &[RUNS]).map_err(damaged)?;
        call_itself(&fresh, name, to).map_err(damaged)?;
        self.take_name(&fresh, to)?;
        Ok(MadeView { name: to.to_owned(), remarks: Vec::new() })
    }

    /// Calls a home otherwise. Nobody has it open.
    pub fn rename(&self, name: &str, to: &str) -> Result<(), Refusal> {
        let from = self.home(name)?;
        self.take_name(&from.scenario, to)?;
        call_itself(&self.folder.join(to), name, to).map_err(damaged)
    }

    /// Puts a home aside with its runs, and says under which key it is fetched back. Nobody has it open.
    pub fn put_aside(&self, name: &str) -> Result<String, Refusal> {
        let _naming = self.naming()?;
        self.home(name)?;
        let undeleted =
            |error: io::Error| damaged(PageMessage::NotDeleted { name: name.into(), why: error.to_string() });
        aside::put(&self.folder, name).map_err(undeleted)
    }

    /// Fetches back what was put aside.
    pub fn fetch_back(&self, key: &str) -> Result<String, Refusal> {
        let _naming = self.naming()?;
        aside::fetch_back(&self.folder, key).map_err(|why| match why {
            Unmoved::Unknown => unknown(PageMessage::NothingDeleted { kind: "home", key: shown(key) }),
            Unmoved::Taken(name) => damaged(PageMessage::NameTaken { kind: "home", name }),
            Unmoved::Failed(error) => damaged(PageMessage::NotRestored { key: shown(key), why: error.to_string() }),
        })
    }

    /// Whether a new home can have this name.
    pub fn is_free(&self, name: &str) -> Result<(), Refusal> {
        let why = wrong_name(name);
        if !why.is_empty() {
            return Err(damaged(LibraryMessage::InvalidName { name: shown(name), why }));
        }
        match fs::symlink_metadata(self.folder.join(name)) {
            Ok(_) => Err(damaged(LibraryMessage::NameUsed { name: name.to_owned() })),
            Err(_) => Ok(()),
        }
    }

    /// Makes a home of a name: it is there whole, or not at all.
    fn make(&self, name: &str, write: impl FnOnce(&Path) -> Result<(), ScaffoldError>) -> Result<(), Refusal> {
        self.is_free(name)?;
        let hidden = self.hidden()?;
        let fresh = hidden.path().join(name);
        homebody_scaffold::create(&fresh, |part, _| write(part)).map_err(damaged)?;
        self.take_name(&fresh, name)
    }

    /// A folder becomes the home of a name.
    fn take_name(&self, folder: &Path, name: &str) -> Result<(), Refusal> {
        let _naming = self.naming()?;
        self.is_free(name)?;
        fs::rename(folder, self.folder.join(name)).map_err(|error| self.unwritten(&error))
    }

    /// The names of all homes.
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
        let shelf = self.shelf(&name);
        let root = json_of(&shelf, ENTRY);
        let text = |key: &str| root[key].as_str().unwrap_or_default().to_owned();
        HomeEntryView { title: text("name"), about: text("about"), changed_ms: changed_ms(&shelf.scenario), name }
    }

    fn shelf(&self, name: &str) -> Shelf {
        let scenario = self.folder.join(name);
        Shelf { runs: scenario.join(RUNS), scenario, entry: ENTRY.into(), is_trusted: self.is_trusted }
    }

    /// How many folders of runs lie beside the homes, as `homebody run` leaves them where it is started.
    fn runs_beside(&self) -> usize {
        let beside = Shelf { runs: self.folder.join(RUNS), ..self.shelf("") };
        beside.runs().len()
    }

    /// Why no home can be put into it, if that is so. A file without a name leaves no trace.
    fn trouble(&self) -> Option<String> {
        let error = tempfile::tempfile_in(&self.folder).err()?;
        Some(format!("Cannot write to this folder: {error}. You can view homes, but not change them or store runs."))
    }

    fn unwritten(&self, error: &io::Error) -> Refusal {
        let folder = self.folder.display().to_string();
        damaged(LibraryMessage::NotWritable { folder, why: error.to_string() })
    }

    fn naming(&self) -> Result<Turn<'_>, Refusal> {
        self.naming.take(&self.folder.join(NAMING)).map_err(damaged)
    }
}

fn no_home(name: &str) -> Refusal {
    unknown(LibraryMessage::NoHome { name: shown(name) })
}

/// As much of a name as is read.
fn shown(name: &str) -> String {
    let short: String = name.chars().take(MOST_LETTERS).collect();
    readable(if short.len() < name.len() { format!("{short}…") } else { short })
}

/// Whether a name is that of something in a folder, and leads nowhere else.
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

fn json_of(files: &Shelf, name: &str) -> Value {
    files.read(name).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
}

fn template(template: Template) -> TemplateView {
    let text = template.files().find(|(name, _)| name == ENTRY).map(|(_, text)| text);
    let root: Value = text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
    TemplateView { name: template.name(), about: root["about"].as_str().unwrap_or_default().to_owned() }
}

/// When a file of a home was changed last, in milliseconds since 1970.
fn changed_ms(folder: &Path) -> Option<i64> {
    let files = fs::read_dir(folder).ok()?.flatten().filter_map(|entry| entry.metadata().ok());
    let times = files.filter(fs::Metadata::is_file).filter_map(|found| found.modified().ok());
    let since = times.max()?.duration_since(SystemTime::UNIX_EPOCH).ok()?;
    i64::try_from(since.as_millis()).ok()
}

/// A problem of a log, without a hint at options of the command: a page has none, and drawing instead.
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

/// A scenario that was called as its folder is called as the folder is now: runs are named after it.
fn call_itself(folder: &Path, before: &str, now: &str) -> Result<(), LibraryMessage> {
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
