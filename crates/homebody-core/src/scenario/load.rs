//! From the text of a scenario folder to a checked scenario, or to everything that is wrong with it.

use super::ScenarioFile;
use super::check;
use super::inside::{FileMessage, WHERE, outside_folder};
use super::logger::LoggerFile;
use super::schema::FileKind;
use super::shape::{self, Misshape, SchemaMessage};
use crate::calendar::Calendar;
use crate::drivers::input::InputFile;
use crate::drivers::path::ResolvedPath;
use crate::drivers::path::form::PathFile;
use crate::geometry::{Point, point};
use crate::home::form::HomeFile;
use crate::home::resolved::ResolvedHome;
use crate::link::form::LinkFile;
use crate::nearest::nearest;
use crate::numbers::{Number, Numbers};
use crate::plan::Plan;
use crate::problem::{Problem, Problems};
use crate::resident::{DriverFile, ResidentFile};
use crate::scenario::source::{JsonSource, NodeValue};
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::fmt;

/// A source of the texts of a scenario's files: a folder, a recording, a test.
pub trait Files {
    /// The text of a file, by its name relative to the scenario's folder, with `/` between folders.
    ///
    /// The loader only asks for names that stay inside the folder.
    fn read(&self, name: &str) -> Result<String, NoText>;

    /// The names of the files there are, to find the one that was meant; not all need be known.
    fn names(&self) -> Vec<String> {
        Vec::new()
    }

    /// The largest size of the files of a scenario together, in bytes: a file counts as often as it is named.
    fn most_bytes(&self) -> usize {
        MOST_BYTES
    }
}

/// Largest number of bytes of the files that a scenario names, each counted every time (our choice).
pub const MOST_BYTES: usize = 16 << 20;

/// Largest number of bytes of a routine or script (our choice): a long one has some thousands. The limit bounds the
/// cost for each resident with the same text.
pub const LARGEST_ROUTINE_BYTES: usize = 256 << 10;

/// Largest number of lines of a routine or script (our choice).
pub const MOST_ROUTINE_LINES: usize = 10_000;

/// The limit that a text is too long for, as a routine or a condition; `None` for a shorter text.
pub fn too_long(text: &str) -> Option<String> {
    longer_than_any(text, "routine")
}

fn longer_than_any(text: &str, noun: &str) -> Option<String> {
    if text.len() > LARGEST_ROUTINE_BYTES {
        return Some(format!("a {noun} has at most {} KB", LARGEST_ROUTINE_BYTES >> 10));
    }
    let is_long = text.lines().nth(MOST_ROUTINE_LINES).is_some();
    is_long.then(|| format!("a {noun} has at most {MOST_ROUTINE_LINES} lines"))
}

/// Why a file has no text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoText {
    /// Nothing has its name.
    Missing,
    /// Something has its name, and cannot be read.
    Unreadable {
        /// Why, as a sentence for people.
        why: String,
        /// The advice, if known.
        hint: Option<String>,
    },
}

impl NoText {
    /// A text that cannot be read, without advice.
    pub fn unreadable(why: impl Into<String>) -> NoText {
        NoText::Unreadable { why: why.into(), hint: None }
    }
}

impl fmt::Display for NoText {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            NoText::Missing => "there is no such file",
            NoText::Unreadable { why, .. } => why,
        })
    }
}

/// Texts that are in memory already, of any size.
impl Files for BTreeMap<String, String> {
    fn read(&self, name: &str) -> Result<String, NoText> {
        self.get(name).cloned().ok_or(NoText::Missing)
    }

    fn names(&self) -> Vec<String> {
        self.keys().cloned().collect()
    }

    fn most_bytes(&self) -> usize {
        usize::MAX
    }
}

/// Texts laid over other files: each stands in the place of the file of its name.
pub struct Overlay<'a> {
    /// The texts, by file name.
    pub texts: BTreeMap<String, String>,
    /// The source of the texts of all other files.
    pub others: &'a dyn Files,
}

impl Files for Overlay<'_> {
    fn read(&self, name: &str) -> Result<String, NoText> {
        self.texts.get(name).map_or_else(|| self.others.read(name), |text| Ok(text.clone()))
    }

    fn names(&self) -> Vec<String> {
        self.texts.keys().cloned().chain(self.others.names()).collect()
    }

    fn most_bytes(&self) -> usize {
        self.others.most_bytes()
    }
}

/// A scenario that has passed every check.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// The name of its own file among the sources.
    pub entry: String,
    /// The scenario's own file.
    pub file: ScenarioFile,
    /// The home, with all names resolved.
    pub home: ResolvedHome,
    /// Nothing where all that sensors say reaches the logger at once.
    pub link: Option<LinkFile>,
    /// The defaults where the scenario links none.
    pub logger: LoggerFile,
    /// In the order of the scenario.
    pub residents: Vec<Resident>,
    /// Which date and time an instant of the run is, in the home's time zone.
    pub calendar: Calendar,
    /// The text of every file that was read, by name: enough to load the scenario again.
    pub sources: BTreeMap<String, String>,
}

/// A resident.
#[derive(Clone, Debug, PartialEq)]
pub struct Resident {
    /// The resident's own file.
    pub file: ResidentFile,
    /// The driver.
    pub driver: ResidentDriver,
}

/// A resident's driver, read from the linked file.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant says what its data are")]
pub enum ResidentDriver {
    /// A path that is acted out.
    Path(ResolvedPath),
    /// Held keys that drive the body through the physics.
    Live {
        /// The held keys and the used things, with their times.
        input: InputFile,
        /// The position of the body at the start, in metres.
        start: Point,
    },
    /// The file and its text. Only its language knows the meaning.
    Routine { file: String, text: String },
    /// The file and its text, as of a routine.
    Script { file: String, text: String },
}

/// The languages of routines and of scripts, which this crate reads as plain text.
pub trait DriverLanguages {
    /// Reads a resident's routine in a valid home, and returns its problems. The reader keeps the result, so a text is
    /// read once. It is not asked about a resident of an invalid home.
    fn read(&mut self, said: &DriverText, home: &HomeFile, plan: &Plan, files: &dyn Files) -> Vec<Problem>;

    /// The same for a resident's script.
    fn read_script(&mut self, said: &DriverText, home: &HomeFile, plan: &Plan) -> Vec<Problem>;

    /// The numbers that a scenario may set, those of this crate among them. `None` if not known: all settings are then
    /// accepted.
    fn numbers(&self) -> Option<Vec<Number>>;
}

/// A routine or a script as it stands in its file.
pub struct DriverText<'a> {
    /// Index of the resident.
    pub of: usize,
    /// The name of its file, for problems.
    pub file: &'a str,
    /// The text of the file.
    pub text: &'a str,
    /// The resident's name, where their own file can be understood.
    pub resident: Option<&'a str>,
    /// The calendar, if the scenario's own file is valid.
    pub calendar: Option<&'a Calendar>,
}

/// Accepts every routine and script unread.
impl DriverLanguages for () {
    fn read(&mut self, _said: &DriverText, _home: &HomeFile, _plan: &Plan, _files: &dyn Files) -> Vec<Problem> {
        Vec::new()
    }

    fn read_script(&mut self, _said: &DriverText, _home: &HomeFile, _plan: &Plan) -> Vec<Problem> {
        Vec::new()
    }

    fn numbers(&self) -> Option<Vec<Number>> {
        None
    }
}

impl Scenario {
    /// As [`Scenario::load_in`], without a look into routines.
    pub fn load(files: &dyn Files, entry: &str) -> Result<Scenario, Problems> {
        Scenario::load_in(&mut (), files, entry)
    }

    /// Reads the entry file and whatever it links, and checks all of it.
    ///
    /// All problems of all files come at once, in the order of the links. The meaning of a file is checked even if the
    /// shape of another is wrong, also of the one that links it.
    pub fn load_in(language: &mut dyn DriverLanguages, files: &dyn Files, entry: &str) -> Result<Scenario, Problems> {
        let (problems, sources, order) = (Vec::new(), BTreeMap::new(), Vec::new());
        let mut loader = Loader { files, language, problems, sources, order, named_bytes: 0 };
        let scenario = loader.scenario(entry);
        let problems = loader.all_problems();
        match scenario {
            Some(scenario) if problems.0.is_empty() => Ok(scenario),
            _ => Err(problems),
        }
    }
}

struct Loader<'a> {
    files: &'a dyn Files,
    language: &'a mut dyn DriverLanguages,
    problems: Vec<Problem>,
    sources: BTreeMap<String, String>,
    order: Vec<(String, FileKind)>,
    /// The size of the files named so far in bytes, each counted as often as it is named.
    named_bytes: usize,
}

/// A file as data, and its text for the places of problems.
struct Read<T> {
    source: JsonSource,
    /// `None` for an invalid shape; linked files are read all the same.
    data: Option<T>,
}

impl Loader<'_> {
    fn read(&mut self, name: &str) -> Result<String, NoText> {
        let most = self.files.most_bytes();
        let too_many = || {
            let what = format!("with it, the files of the scenario have more than {} MB", most >> 20);
            NoText::unreadable(format!("{what}, each counted as often as it is named"))
        };
        if self.named_bytes > most {
            return Err(too_many());
        }
        let text = self.sources.get(name).map_or_else(|| self.files.read(name), |text| Ok(text.clone()))?;
        self.named_bytes = self.named_bytes.saturating_add(text.len());
        if self.named_bytes > most { Err(too_many()) } else { Ok(text) }
    }

    fn unread(&self, name: &str, why: NoText) -> FileMessage {
        let name = name.to_owned();
        match why {
            NoText::Missing => {
                let names = self.files.names();
                let nearest = nearest(&name, names.iter().map(String::as_str)).map(str::to_owned);
                FileMessage::Missing { name, nearest }
            }
            NoText::Unreadable { why, hint } => FileMessage::Unreadable { name, why, help: hint },
        }
    }

    fn scenario(&mut self, entry: &str) -> Option<Scenario> {
        let text = match self.read(entry) {
            Ok(text) => text,
            Err(why) => {
                self.problems.push(Problem::of_file(entry, self.unread(entry, why), None));
                return None;
            }
        };
        let Read { source, data: file } = self.parse::<ScenarioFile>(entry, FileKind::Scenario, &text, None)?;
        let calendar = file.as_ref().and_then(|file| check::scenario::check(&source, file, &mut self.problems));

        let set = file.as_ref().filter(|file| !file.numbers.is_empty());
        if let Some((file, known)) = set.and_then(|file| Some((file, self.language.numbers()?))) {
            check::scenario::check_numbers(&source, file, &known, &mut self.problems);
        }
        let numbers = file.as_ref().map_or_else(Numbers::default, |file| Numbers::new(&file.numbers));

        let root = source.root.to_json();
        let home: Option<Read<HomeFile>> = self.link(&source, &root, "/home", FileKind::Home);
        let home = home.and_then(|Read { source, data }| Some((source, data?)));
        let plan = home.as_ref().and_then(|(source, home)| check::home::check(source, home, &mut self.problems));
        let home = home.map(|(_, home)| home);
        let surroundings = check::HomeInCheck { home: home.as_ref(), plan: plan.as_ref() };

        let link = if root["link"].is_null() {
            Some(None)
        } else {
            let link: Option<Read<LinkFile>> = self.link(&source, &root, "/link", FileKind::Link);
            link.and_then(|Read { source, data }| {
                let link = data?;
                check::link::check(&source, &link, &surroundings, &mut self.problems);
                Some(Some(link))
            })
        };

        let logger = if root["logger"].is_null() {
            Some(LoggerFile::default())
        } else {
            let logger: Option<Read<LoggerFile>> = self.link(&source, &root, "/logger", FileKind::Logger);
            logger.and_then(|Read { source, data }| {
                let logger = data?;
                check::logger::check(&source, &logger, &surroundings, &mut self.problems);
                Some(logger)
            })
        };

        let mut names = check::resident::ResidentNames::default();
        let residents: Vec<Option<Resident>> = (0..root["residents"].as_array().map_or(0, Vec::len))
            .map(|index| {
                let link = format!("/residents/{index}");
                let resident: Read<ResidentFile> = self.link(&source, &root, &link, FileKind::Resident)?;
                if let Some(file) = &resident.data {
                    names.check(&resident.source, file, &mut self.problems);
                    if let Some(home) = surroundings.home {
                        check::resident::check_height(&resident.source, file, home, &mut self.problems);
                    }
                }
                self.resident(index, resident, &surroundings, calendar.as_ref())
            })
            .collect();

        Some(Scenario {
            entry: entry.into(),
            calendar: calendar?,
            home: ResolvedHome::with_plan(home?, plan?, numbers).ok()?,
            link: link?,
            logger: logger?,
            residents: residents.into_iter().collect::<Option<_>>()?,
            sources: std::mem::take(&mut self.sources),
            file: file?,
        })
    }

    fn resident(
        &mut self,
        index: usize,
        resident: Read<ResidentFile>,
        surroundings: &check::HomeInCheck,
        calendar: Option<&Calendar>,
    ) -> Option<Resident> {
        let Read { source, data: file } = resident;
        let root = source.root.to_json();
        let resident = file.as_ref().map(|file| file.name.as_str());
        let home_and_plan = surroundings.home.zip(surroundings.plan);
        let driver = if root.pointer("/driver/path").is_some() {
            let path: Read<PathFile> = self.link(&source, &root, "/driver/path", FileKind::Path)?;
            let data = path.data?;
            // An invalid file does not name the resident of a path: any resident.
            let unknown = || ResidentFile::with_driver(DriverFile::Path(path.source.file.clone()));
            let walker = file.clone().unwrap_or_else(unknown);
            check::path::check(&path.source, &data, &walker, surroundings, &mut self.problems);
            ResidentDriver::Path(ResolvedPath::new(data, surroundings.plan?, walker.pace_mps)?)
        } else if let Some(name) = root["driver"]["routine"].as_str() {
            let text = self.text(&source, "/driver/routine", name, "routine")?;
            if let Some((home, plan)) = home_and_plan {
                let routine = DriverText { of: index, file: name, text: &text, resident, calendar };
                self.problems.extend(self.language.read(&routine, home, plan, self.files));
            }
            ResidentDriver::Routine { file: name.into(), text }
        } else if let Some(name) = root["driver"]["script"].as_str() {
            let text = self.text(&source, "/driver/script", name, "script")?;
            if let Some((home, plan)) = home_and_plan {
                let script = DriverText { of: index, file: name, text: &text, resident, calendar };
                self.problems.extend(self.language.read_script(&script, home, plan));
            }
            ResidentDriver::Script { file: name.into(), text }
        } else {
            let live = match &file {
                Some(ResidentFile { driver: DriverFile::Live(live), .. }) => Some(live),
                _ => None,
            };
            if let Some((file, live)) = file.as_ref().zip(live) {
                check::resident::check_start(&source, live, file, surroundings, &mut self.problems);
            }
            let input: Read<InputFile> = self.link(&source, &root, "/driver/live/keys", FileKind::Input)?;
            let data = input.data?;
            check::input::check(&input.source, &data, surroundings, &mut self.problems);
            ResidentDriver::Live { input: data, start: point(live?.start) }
        };
        Some(Resident { file: file?, driver })
    }

    fn link<T: DeserializeOwned>(
        &mut self,
        from: &JsonSource,
        root: &serde_json::Value,
        link: &str,
        kind: FileKind,
    ) -> Option<Read<T>> {
        let name = root.pointer(link)?.as_str()?;
        self.linked(from, link, name, kind)
    }

    /// Reads a linked file that is not JSON: a routine or a script, as `noun` says.
    fn text(&mut self, from: &JsonSource, link: &str, name: &str, noun: &str) -> Option<String> {
        let text = self.text_of_link(from, link, name, (None, &format!("a {noun}")))?;
        if let Some(why) = longer_than_any(&text, noun) {
            self.problems.push(from.problem(link, FileMessage::TooLong { name: name.to_owned(), why }, None));
            return None;
        }
        self.sources.insert(name.into(), text.clone());
        Some(text)
    }

    /// Reads and checks a file that another links.
    fn linked<T: DeserializeOwned>(
        &mut self,
        from: &JsonSource,
        link: &str,
        name: &str,
        kind: FileKind,
    ) -> Option<Read<T>> {
        let text = self.text_of_link(from, link, name, (Some(kind), kind.noun()))?;
        self.parse(name, kind, &text, Some((from, link)))
    }

    /// The text of a file that another links for this use; a file that is missing is a problem of the link.
    fn text_of_link(
        &mut self,
        from: &JsonSource,
        link: &str,
        name: &str,
        (kind, wanted): (Option<FileKind>, &str),
    ) -> Option<String> {
        let used = self.order.iter().find(|(known, _)| known == name).map(|(_, used)| *used);
        let (message, hint) = match (outside_folder(name, "the scenario's folder"), used) {
            (Some(outside), _) => (outside, Some(WHERE.to_string())),
            (None, Some(used)) if Some(used) != kind => {
                let (used, wanted) = (used.noun().to_owned(), wanted.to_owned());
                (FileMessage::TwoUses { name: name.to_owned(), used, wanted }, None)
            }
            (None, Some(FileKind::Resident)) => (FileMessage::LinkedTwice { name: name.to_owned() }, None),
            _ => match self.read(name) {
                Ok(text) => return Some(text),
                Err(why) => (self.unread(name, why), None),
            },
        };
        self.problems.push(from.problem(link, message, hint));
        None
    }

    fn parse<T: DeserializeOwned>(
        &mut self,
        name: &str,
        kind: FileKind,
        text: &str,
        link: Option<(&JsonSource, &str)>,
    ) -> Option<Read<T>> {
        if !self.order.iter().any(|(known, _)| known == name) {
            self.order.push((name.into(), kind));
        }
        let mut source = match JsonSource::parse(name, text) {
            Ok(source) => source,
            Err(problem) => {
                self.problems.push(problem);
                return None;
            }
        };
        self.sources.insert(name.into(), source.text.clone());
        let Misshape { problems, keys } = shape::check(&source, &kind.schema());
        if !problems.is_empty() {
            let mistaken = mistaken_for(&source, kind).map(|other| {
                self.order.retain(|(known, _)| known != name || link.is_none());
                let (found, wanted) = (other.noun().to_owned(), kind.noun().to_owned());
                let message = FileMessage::WrongKind { name: name.to_owned(), found, wanted };
                match link {
                    Some((from, link)) => from.problem(link, message, None),
                    None => Problem::of_file(name, message, None),
                }
            });
            return match mistaken {
                Some(mistaken) => {
                    self.problems.push(mistaken);
                    None
                }
                None => {
                    // Misspelt keys link files, too. If only keys are wrong, the meaning can be checked already.
                    source.root.take_as_meant(&keys);
                    let is_clear = keys.len() == problems.len();
                    let data = is_clear.then(|| serde_json::from_value(source.root.to_json()).ok()).flatten();
                    self.problems.extend(problems);
                    Some(Read { source, data })
                }
            };
        }
        match serde_json::from_value(source.root.to_json()) {
            Ok(data) => Some(Read { source, data: Some(data) }),
            Err(error) => {
                let message = SchemaMessage::Invalid { why: error.to_string() };
                self.problems.push(Problem::of_file(name, message, None));
                None
            }
        }
    }

    fn all_problems(self) -> Problems {
        let mut problems = self.problems;
        // Routines come last: they are read when the home is known.
        let rank = |file: &str| self.order.iter().position(|(known, _)| known == file).unwrap_or(usize::MAX);
        problems.sort_by_cached_key(|problem| (rank(&problem.file), problem.line, problem.column));
        // A file with two links is checked twice.
        let mut seen: Vec<Problem> = Vec::new();
        for problem in problems {
            let same_place = |other: &&Problem| {
                (&other.file, other.line, other.column) == (&problem.file, problem.line, problem.column)
            };
            if !seen.iter().rev().take_while(same_place).any(|other| *other == problem) {
                seen.push(problem);
            }
        }
        Problems::truncated(&seen)
    }
}

/// The other kind of file of which this one is a valid example.
fn mistaken_for(source: &JsonSource, kind: FileKind) -> Option<FileKind> {
    // A file that says nothing would be a faultless logger.
    let NodeValue::Object(entries) = &source.root.value else { return None };
    if entries.iter().all(|(key, _)| key.name == "$schema") {
        return None;
    }
    let fits = |other: &FileKind| *other != kind && shape::check(source, &other.schema()).problems.is_empty();
    FileKind::ALL.into_iter().find(fits)
}
