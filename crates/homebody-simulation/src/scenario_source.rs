//! The source of a scenario: a folder on disk, a template that comes with the program, or texts in memory.

use crate::error::SimulationError;
use crate::open_messages::OpenMessage;
use homebody_core::nearest::nearest;
use homebody_core::problem::Problems;
use homebody_core::scenario::load::{Files, MOST_BYTES, NoText, Scenario};
use homebody_log::files::plain;
use homebody_log::limits::LARGEST_OF_SCENARIO_BYTES;
use homebody_routine::household::RoutineLanguage;
use include_dir::{Dir, include_dir};
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The scenarios that come with the program.
static OWN: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../scenarios");

/// The usual name of a scenario's own file.
const ENTRY: &str = "scenario.json";

/// The unchecked files of a scenario.
#[derive(Clone)]
pub struct ScenarioSource {
    files: Arc<dyn Files + Send + Sync>,
    entry: String,
    /// The folder that it is in, if it is on disk.
    folder: Option<PathBuf>,
    /// The file that the system could not read.
    unread: UnreadFile,
}

/// The scenario folder whose name is most like this one's, in the folder that this one would be in.
fn similar_scenario(path: &Path) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    let folder = path.parent()?;
    let entries = fs::read_dir(if folder.as_os_str().is_empty() { Path::new(".") } else { folder }).ok()?;
    let scenarios = entries.flatten().filter(|entry| entry.path().join(ENTRY).is_file());
    let mut names: Vec<String> = scenarios.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    nearest(name, names.iter().map(String::as_str)).map(|near| folder.join(near))
}

impl ScenarioSource {
    /// A scenario on disk, named by its folder or by its `scenario.json`. It may be hostile: its files must be regular files in the
    /// folder, each of at most [`LARGEST_OF_SCENARIO_BYTES`].
    ///
    /// # Errors
    ///
    /// [`SimulationError::Unreadable`] without such a folder or file, [`SimulationError::File`] after an error of the system.
    pub fn at(path: impl AsRef<Path>) -> Result<ScenarioSource, SimulationError> {
        let path = path.as_ref();
        let meta = fs::metadata(path).map_err(|error| match error.kind() {
            ErrorKind::NotFound => {
                let template =
                    path.to_str().filter(|name| !name.is_empty()).and_then(|name| Template::named(name).ok());
                let template = template.map(|template| template.name().to_owned());
                let near = similar_scenario(path).map(|near| near.display().to_string());
                SimulationError::unreadable(path, OpenMessage::NoScenario { template, near })
            }
            _ => SimulationError::io(path, error),
        })?;
        let entry = match meta.is_dir() {
            true => ENTRY.to_owned(),
            false => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        };
        let folder = if meta.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
        let file = folder.join(&entry);
        if !file.is_file() {
            let message = if file.exists() { OpenMessage::NotPlain } else { OpenMessage::NoEntry };
            return Err(SimulationError::unreadable(&file, message));
        }
        Ok(ScenarioSource::of_folder(ScenarioFolder::new(folder, false), entry))
    }

    /// The same as a trusted one: links may lead out of its folder, and files may have any size.
    pub fn trusted(self) -> ScenarioSource {
        match self.folder {
            Some(path) => ScenarioSource::of_folder(ScenarioFolder::new(path, true), self.entry),
            None => self,
        }
    }

    fn of_folder(folder: ScenarioFolder, entry: String) -> ScenarioSource {
        let (path, unread) = (folder.path.clone(), folder.unread.clone());
        ScenarioSource { files: Arc::new(folder), entry, folder: Some(path), unread }
    }

    /// A scenario whose files are these texts, by name; `entry` is the name of its own file among them.
    pub fn from_texts(texts: BTreeMap<String, String>, entry: impl Into<String>) -> ScenarioSource {
        ScenarioSource { files: Arc::new(texts), entry: entry.into(), folder: None, unread: UnreadFile::default() }
    }

    /// The name of the scenario's own file.
    pub fn entry(&self) -> &str {
        &self.entry
    }

    /// Its folder, if it is on disk.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Its files.
    pub fn files(&self) -> &(dyn Files + Send + Sync) {
        &*self.files
    }

    /// The files on disk that a scenario from here was loaded from.
    pub fn paths(&self, scenario: &Scenario) -> Vec<PathBuf> {
        let folder = self.folder.iter();
        folder.flat_map(|folder| scenario.sources.keys().map(|name| folder.join(name))).collect()
    }

    /// Checks the scenario, without a check of its routines in its home.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`]: everything that is wrong with its files; [`SimulationError::File`] if the system could not read one.
    pub fn scenario(&self) -> Result<Scenario, SimulationError> {
        let loaded = Scenario::load_in(&mut RoutineLanguage::default(), &*self.files, &self.entry);
        loaded.map_err(|problems| self.why(problems))
    }

    /// The reason why it was not loaded: an error of the system comes before problems of the files.
    pub(crate) fn why(&self, problems: Problems) -> SimulationError {
        let mut unread = self.unread.lock().unwrap_or_else(PoisonError::into_inner);
        unread.take().map_or(SimulationError::Problems(problems), |(path, error)| SimulationError::io(&path, error))
    }
}

/// A scenario that comes with the program, as a template of new ones.
#[derive(Clone, Copy, Debug)]
pub struct Template(&'static Dir<'static>);

impl Template {
    /// All of them, in the order of their names.
    pub fn all() -> impl Iterator<Item = Template> {
        OWN.dirs().map(Template)
    }

    /// The template of this name.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Template`] without one.
    pub fn named(name: &str) -> Result<Template, SimulationError> {
        OWN.get_dir(name).map(Template).ok_or_else(|| SimulationError::Template {
            name: name.to_owned(),
            known: Template::all().map(|template| template.name()).collect(),
        })
    }

    /// Its name.
    pub fn name(self) -> String {
        self.0.path().display().to_string()
    }

    /// Its files, each with its name and its text.
    pub fn files(self) -> impl Iterator<Item = (String, String)> {
        self.0.files().map(|file| {
            let name = file.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
            (name, String::from_utf8_lossy(file.contents()).into_owned())
        })
    }

    /// Its files as those of a scenario.
    pub fn source(self) -> ScenarioSource {
        ScenarioSource::from_texts(self.files().collect(), ENTRY)
    }
}

/// The hint of problems that a [trusted](ScenarioSource::trusted) scenario does not have.
pub const TRUST: &str = "if the scenario is your own, or you know who made it, trust it";

/// The hint for a file that is not text.
const UTF_8: &str = "save it as UTF-8";

/// Largest number of file names that are searched for a similar one (our choice).
const MOST_NAMES: usize = 1000;

/// The files of a scenario's folder, which may be hostile: regular files in the folder, each of at most
/// [`LARGEST_OF_SCENARIO_BYTES`].
#[derive(Clone, Debug)]
pub struct ScenarioFolder {
    /// The path.
    pub path: PathBuf,
    /// Whether links may lead out of it, and its files may have any size.
    pub is_trusted: bool,
    unread: UnreadFile,
}

/// The first file that the system could not read for lack of resources, with its error.
type UnreadFile = Arc<Mutex<Option<(PathBuf, io::Error)>>>;

/// The errors of POSIX for lack of resources: EMFILE, ENFILE, ENOMEM, EIO.
const NO_RESOURCES: [i32; 4] = [24, 23, 12, 5];

impl ScenarioFolder {
    /// The files of a folder.
    pub fn new(path: impl Into<PathBuf>, is_trusted: bool) -> ScenarioFolder {
        ScenarioFolder { path: path.into(), is_trusted, unread: UnreadFile::default() }
    }
}

impl Files for ScenarioFolder {
    fn read(&self, name: &str) -> Result<String, NoText> {
        let whole = self.path.join(name);
        let (path, largest) = match self.is_trusted {
            true => (Some(whole.clone()), u64::MAX),
            false => (plain::within(&self.path, Path::new(name)), LARGEST_OF_SCENARIO_BYTES),
        };
        let of_ones_own = |why: &str| NoText::Unreadable { why: why.into(), hint: Some(TRUST.into()) };
        let no_way = || match whole.exists() {
            true => of_ones_own("it is a link to a place outside of the scenario's folder"),
            false => NoText::unreadable("it is a link to a file that does not exist"),
        };
        let path = path.ok_or_else(no_way)?;
        plain::read_text(&path, largest).map_err(|error| match error.kind() {
            _ if error.raw_os_error().is_some_and(|code| cfg!(unix) && NO_RESOURCES.contains(&code)) => {
                let why = NoText::unreadable(error.to_string());
                self.unread.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert((path, error));
                why
            }
            // No file has a name that no file can have.
            ErrorKind::NotFound | ErrorKind::NotADirectory | ErrorKind::InvalidFilename => NoText::Missing,
            ErrorKind::IsADirectory => NoText::unreadable("it is a folder"),
            ErrorKind::FileTooLarge => of_ones_own(&error.to_string()),
            ErrorKind::InvalidData => NoText::Unreadable { why: error.to_string(), hint: Some(UTF_8.into()) },
            _ => NoText::unreadable(error.to_string()),
        })
    }

    fn names(&self) -> Vec<String> {
        let files = fs::read_dir(&self.path).into_iter().flatten().flatten().take(MOST_NAMES);
        files.filter_map(|file| file.file_name().into_string().ok()).collect()
    }

    fn most_bytes(&self) -> usize {
        if self.is_trusted { usize::MAX } else { MOST_BYTES }
    }
}
