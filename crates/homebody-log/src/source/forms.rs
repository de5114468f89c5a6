//! All forms of logs that are read, and where a log is: in which form, in which file.

use super::form::{Form, Shows};
use super::reading::Reading;
use super::start::Start;
use super::{
    casas, csv, each_second, esphome, frames, home_assistant, influx_csv, influx_lines, intervals, json, jsonl, mit,
    mosquitto, psql, sqlite, tasmota, xes, zigbee2mqtt,
};
use crate::elsewhere;
use crate::error::{LogError, place_of};
use crate::spans::SPANS;
use crate::url::{Url, table_file};
use homebody_core::problem::readable;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::nearest::nearest;
use homebody_core::scenario::scheme::{NoPlace, SCHEMES, Scheme, SchemeRow, Stands, without_password};
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// All forms that every build has. A file is of the first whose signs it shows.
pub const FORMS: [Form; 19] = [
    home_assistant::FORM,
    sqlite::FORM,
    jsonl::FORM,
    json::FORM,
    zigbee2mqtt::FORM,
    esphome::FORM,
    tasmota::FORM,
    mosquitto::FORM,
    influx_lines::FORM,
    influx_csv::FORM,
    xes::FORM,
    psql::FORM,
    mit::FORM,
    intervals::FORM,
    each_second::ARAS,
    each_second::OPENSHS,
    frames::FORM,
    csv::FORM,
    casas::FORM,
];

/// The forms that this build has, with those of crates of their own.
pub fn forms() -> impl Iterator<Item = &'static Form> + Clone {
    const OWN: &[Form] = &FORMS;
    OWN.iter().chain(elsewhere::installed().iter().flat_map(|elsewhere| elsewhere.forms))
}

/// The form of a kind of place. Where this build cannot read it, reading it is an error that says so.
fn of_scheme(scheme: Scheme) -> &'static Form {
    let row = scheme.row();
    let absent = ABSENT.iter().find(|form| form.name == row.name);
    forms().find(|form| form.name == row.name).or(absent).unwrap_or(&UNREAD)
}

/// Kinds of places that a build may not be able to read.
const ABSENT: &[Form] = &[absent::<4>(), absent::<5>(), absent::<6>()];

/// Kinds of places from which nothing is read.
const UNREAD: Form = Form {
    name: "mqtt",
    what: "a broker, which keeps no log",
    shows: |_| Shows::Nothing,
    read: |path, _, _| Err(LogError::NoLog { place: place_of(path), why: "a broker keeps no log".into() }),
};

/// The form of a row of the table of kinds.
const fn absent<const ROW: usize>() -> Form {
    fn read<const ROW: usize>(path: &Path, _: &LoggerFile, _: &mut Reading) -> Result<(), LogError> {
        Err(elsewhere::not_built_in(&Url::new(SCHEMES[ROW].scheme, path)))
    }
    Form { name: SCHEMES[ROW].name, what: SCHEMES[ROW].what, shows: |_| Shows::Nothing, read: read::<ROW> }
}

/// No more files of a folder are looked at (ours): a data set has a few.
const MOST_FILES: usize = 200;

/// Where a log is read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    form: &'static Form,
    path: PathBuf,
}

impl Source {
    /// A log in a form.
    pub fn new(form: &'static Form, path: impl Into<PathBuf>) -> Source {
        Source { form, path: path.into() }
    }

    /// The log in a file, by how it begins, or the one in a folder.
    ///
    /// # Errors
    ///
    /// [`LogError::Missing`] if there is nothing, [`LogError::IsFolder`] if it is a folder without a log, [`LogError::NoLog`] if
    /// it is one of several, and what the system says.
    pub fn recognise(path: &Path) -> Result<Source, LogError> {
        match path.is_dir() {
            true => in_folder(path),
            false => {
                let start = Start::of(path)?;
                let (form, _) = shown(&start).unwrap_or_else(|| likely(&start));
                Ok(Source::new(form, path))
            }
        }
    }

    /// In which form it is.
    pub fn form(&self) -> &'static Form {
        self.form
    }

    /// Whether it is on a server.
    pub fn is_server(&self) -> bool {
        SCHEMES.iter().any(|row| row.stands == Stands::Server && row.name == self.form.name)
    }

    /// In which file it is; of a server, what it is reached by.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The files that it is in.
    pub fn files(&self) -> Vec<PathBuf> {
        if self.is_server() {
            return Vec::new();
        }
        let beside = self.activities_beside().map(|beside| beside.path);
        std::iter::once(self.path.clone()).chain(beside).collect()
    }

    /// Whether names are single words in this form.
    pub(super) fn has_words(&self) -> bool {
        *self.form == casas::FORM
    }

    /// Whether it is of columns, in files that are no text.
    fn is_columnar(&self) -> bool {
        [Scheme::Parquet, Scheme::Arrow].iter().any(|scheme| scheme.row().name == self.form.name)
    }

    /// The file beside it that tells what somebody did, where it tells rows only: as data sets and we name it.
    pub(super) fn activities_beside(&self) -> Option<Source> {
        let name = self.path.file_name()?.to_str()?;
        let renamed = |(rows, activities): (&str, &str)| {
            name.contains(rows).then(|| self.path.with_file_name(name.replacen(rows, activities, 1)))
        };
        let has_own = *self.form == csv::FORM || *self.form == jsonl::FORM || self.is_columnar();
        let own = has_own.then(|| match self.path.is_dir() {
            true => activities_of_set(&self.path),
            false => activities_of(&self.path),
        });
        own.into_iter().chain(NAMED_ALIKE.into_iter().filter_map(renamed)).find_map(|path| {
            let start = Start::of(&path).ok()?;
            let (form, shows) = shown(&start)?;
            (shows == Shows::Activities && *form != xes::FORM).then(|| Source::new(form, path))
        })
    }
}

/// How a file of rows is called, and that of activities beside it.
const NAMED_ALIKE: [(&str, &str); 4] =
    [("SenseData", "ActData"), ("Sensors", "ADLs"), ("devices", "activities"), ("device", "activity")];

/// The file of what somebody did beside a log whose form has one table a file.
pub(crate) fn activities_of(log: &Path) -> PathBuf {
    table_file(log, SPANS)
}

/// The same beside a data set.
pub(crate) fn activities_of_set(folder: &Path) -> PathBuf {
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{SPANS}.parquet"));
    folder.with_file_name(name)
}

/// The form that a file shows, and what of it.
fn shown(start: &Start) -> Option<(&'static Form, Shows)> {
    forms().map(|form| (form, (form.shows)(start))).find(|(_, shows)| *shows != Shows::Nothing)
}

/// The form that a text without any sign is most likely of: cells make a table.
fn likely(start: &Start) -> (&'static Form, Shows) {
    let form = match () {
        () if json::begins_as_json(start) => &json::FORM,
        () if start.delimiters() >= 2 => &csv::FORM,
        () => &casas::FORM,
    };
    (form, Shows::Rows)
}

/// Whether a path is a folder of a data set, such as `run=5` or `day=2009-03-02`.
fn is_partition(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.split_once('=').is_some_and(|(key, _)| !key.is_empty() && !key.starts_with('.')) && path.is_dir()
}

/// The one log in a folder; if there are none but activities, these.
fn in_folder(folder: &Path) -> Result<Source, LogError> {
    let unreadable = |error| LogError::file(folder, error);
    let mut paths = Vec::new();
    for entry in folder.read_dir().map_err(unreadable)?.take(MOST_FILES) {
        let entry = entry.map_err(unreadable)?;
        if is_partition(&entry.path()) {
            return Ok(Source::new(of_scheme(Scheme::Parquet), folder));
        }
        paths.push(entry.path());
    }
    paths.sort();
    let (mut rows, mut activities) = (Vec::new(), Vec::new());
    for path in paths.into_iter().filter(|path| path.is_file()) {
        match Start::of(&path).map(|start| shown(&start)) {
            Ok(Some((form, Shows::Rows))) => rows.push(Source::new(form, path)),
            Ok(Some((form, _))) => activities.push(Source::new(form, path)),
            _ => {}
        }
    }
    let found = if rows.is_empty() { activities } else { rows };
    let name = |source: &Source| source.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    match &found[..] {
        [one] => Ok(one.clone()),
        [] => Err(LogError::IsFolder { place: place_of(folder) }),
        several => {
            let names: Vec<String> = several.iter().map(name).collect();
            let why = format!("it is a folder of several logs: name one of {}", names.join(", "));
            Err(LogError::NoLog { place: place_of(folder), why: readable(why) })
        }
    }
}

impl From<&Url> for Source {
    fn from(url: &Url) -> Source {
        let at = url.server().map_or_else(|| url.path().into(), PathBuf::from);
        Source::new(of_scheme(url.scheme()), at)
    }
}

impl From<&Source> for Source {
    fn from(source: &Source) -> Source {
        source.clone()
    }
}

impl FromStr for Source {
    type Err = NoPlace;

    /// A log by its form and its file, such as `mit:activities_data.csv`.
    fn from_str(text: &str) -> Result<Source, NoPlace> {
        // One letter before a colon is a drive, not a form.
        let (name, path) = text.split_once(':').filter(|(name, _)| name.len() > 1).unwrap_or((text, ""));
        let what = readable(format!("{:?} names no log", without_password(text)));
        if let Some(row) = SchemeRow::named(name).filter(|row| row.stands == Stands::Server) {
            let (scheme, at) = Scheme::split(text)?;
            return Ok(Source::new(of_scheme(scheme), format!("{}:{at}", row.name)));
        }
        let Some(form) = forms().chain(ABSENT).find(|form| form.name == name) else {
            let names = forms().map(|form| form.name);
            let hint = match nearest(name, names.clone()) {
                Some(near) => readable(format!("did you mean \"{near}:{}\"?", without_password(path))),
                None => format!(
                    "write a path, or one of {} before a colon and the path",
                    names.collect::<Vec<_>>().join(", ")
                ),
            };
            return Err(NoPlace { what, hint });
        };
        match path.trim().is_empty() {
            true => Err(NoPlace { what, hint: format!("write {name}:FILE") }),
            false => Ok(Source::new(form, path.strip_prefix("//").unwrap_or(path))),
        }
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.is_server() {
            true => write!(f, "{}", self.path.display()),
            false => write!(f, "{}:{}", self.form.name, self.path.display()),
        }
    }
}
