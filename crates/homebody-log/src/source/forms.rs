//! All forms of logs that are read, and where a log is: in which form, in which file.

use super::form::{Form, Shows};
use super::start::Start;
use super::{casas, csv, each_second, frames, home_assistant, intervals, mit, psql, sqlite, xes};
use crate::error::{LogError, place_of};
use crate::url::{Url, table_file};
use homebody_core::problem::readable;
use homebody_core::scenario::nearest::nearest;
use homebody_core::scenario::scheme::{NoPlace, Scheme};
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// All forms. A file is of the first whose signs it shows.
pub const FORMS: [Form; 11] = [
    home_assistant::FORM,
    sqlite::FORM,
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

    /// In which file it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The files that it is in.
    pub fn files(&self) -> Vec<PathBuf> {
        let beside = self.activities_beside().map(|beside| beside.path);
        std::iter::once(self.path.clone()).chain(beside).collect()
    }

    /// Whether names are single words in this form.
    pub(super) fn has_words(&self) -> bool {
        *self.form == casas::FORM
    }

    /// The file beside it that tells what somebody did, where it tells rows only: as data sets and we name it.
    pub(super) fn activities_beside(&self) -> Option<Source> {
        let name = self.path.file_name()?.to_str()?;
        let renamed = |(rows, activities): (&str, &str)| {
            name.contains(rows).then(|| self.path.with_file_name(name.replacen(rows, activities, 1)))
        };
        let own = (*self.form == csv::FORM).then(|| activities_of(&self.path));
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

/// The file of what somebody did beside a log in CSV.
pub(crate) fn activities_of(log: &Path) -> PathBuf {
    table_file(log, "activity")
}

/// The form that a file shows, and what of it.
fn shown(start: &Start) -> Option<(&'static Form, Shows)> {
    FORMS.iter().map(|form| (form, (form.shows)(start))).find(|(_, shows)| *shows != Shows::Nothing)
}

/// The form that a text without any sign is most likely of: cells make a table.
fn likely(start: &Start) -> (&'static Form, Shows) {
    let form = if start.delimiters() >= 2 { &csv::FORM } else { &casas::FORM };
    (form, Shows::Rows)
}

/// The one log in a folder; if there are none but activities, these.
fn in_folder(folder: &Path) -> Result<Source, LogError> {
    let unreadable = |error| LogError::file(folder, error);
    let mut paths = Vec::new();
    for entry in folder.read_dir().map_err(unreadable)?.take(MOST_FILES) {
        paths.push(entry.map_err(unreadable)?.path());
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
        let form = match url.scheme() {
            Scheme::Sqlite => &sqlite::FORM,
            Scheme::Csv => &csv::FORM,
            Scheme::Casas => &casas::FORM,
        };
        Source::new(form, url.file().unwrap_or(Path::new("")))
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
        let what = readable(format!("{text:?} names no log"));
        let Some(form) = FORMS.iter().find(|form| form.name == name) else {
            let names = FORMS.iter().map(|form| form.name);
            let hint = match nearest(name, names.clone()) {
                Some(near) => readable(format!("did you mean \"{near}:{path}\"?")),
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
        write!(f, "{}:{}", self.form.name, self.path.display())
    }
}
