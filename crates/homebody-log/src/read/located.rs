//! The place of a log: its form, its file or files, and the files with its activities.

use super::sets::{LogPart, ends, one_log};
use crate::error::{LogError, place_of};
use crate::limits::beginning;
use crate::log::SPANS;
use crate::registry::{form_named, form_of_scheme, form_shown, forms};
use crate::source::messages::FormMessage;
use crate::source::{
    FileStart, LabelTable, LogForm, Shows, TableOptions, casas, csv, foreign_kind, intervals, json, labels, no_text,
    xes,
};
use crate::url::{Url, table_file};
use homebody_core::nearest::nearest;
use homebody_core::problem::readable;
use homebody_core::scenario::inside::RECORDING;
use homebody_core::scenario::scheme::{NoPlace, Scheme, SchemeRow, Stands, TablePlacement, without_password};
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Largest number of files in a folder that is searched: a file a day for ten years.
const MOST_FILES: usize = 4000;

/// Number of files in a folder above which labels are not searched for.
const MOST_BESIDE: usize = 200;

/// Number of file names in a message.
const MOST_NAMED: usize = 20;

/// The place that a log is read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogSource {
    form: &'static LogForm,
    path: PathBuf,
    /// Its files, where it has several: the first is its path.
    parts: Vec<LogPart>,
    options: TableOptions,
}

impl LogSource {
    /// A log in a form.
    pub fn new(form: &'static LogForm, path: impl Into<PathBuf>) -> LogSource {
        LogSource { form, path: path.into(), parts: Vec::new(), options: TableOptions::default() }
    }

    /// The same log with its table read so, where that is a matter of choice.
    pub fn with_options(self, options: TableOptions) -> LogSource {
        let is_text = self.row().is_none_or(|row| row.stands == Stands::Text);
        let form = if options.is_wide && is_text { &csv::WIDE } else { self.form };
        LogSource { form, options, ..self }
    }

    pub(crate) fn options(&self) -> &TableOptions {
        &self.options
    }

    /// The log in a file, by how it begins, or the one in a folder.
    ///
    /// # Errors
    ///
    /// [`LogError::Missing`] without a file, [`LogError::IsFolder`] for a folder without a log, [`LogError::NoLog`] for a folder
    /// with several and for files of other kinds, and errors of the system.
    pub fn recognise(path: &Path) -> Result<LogSource, LogError> {
        match path.is_dir() {
            true => in_folder(path),
            false => {
                let start = FileStart::read(path)?;
                Ok(LogSource::new(form_of(&start)?, path))
            }
        }
    }

    /// In which form it is.
    pub fn form(&self) -> &'static LogForm {
        self.form
    }

    /// Whether it is on a server.
    pub fn is_server(&self) -> bool {
        self.row().is_some_and(|row| row.stands == Stands::Server)
    }

    /// The kind of place that Homebody writes in its form.
    fn row(&self) -> Option<&'static SchemeRow> {
        SchemeRow::named(self.form.name)
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
        let beside = self.activities_beside().map_or_else(|| self.labels_beside(), |beside| vec![beside]);
        let parts = self.parts().into_iter().map(|part| part.path);
        parts.chain(beside.into_iter().map(|beside| beside.path)).collect()
    }

    /// Its files in their order, without files of labels.
    pub(crate) fn parts(&self) -> Vec<LogPart> {
        match self.parts.is_empty() {
            true => vec![LogPart { path: self.path.clone(), begin: None }],
            false => self.parts.clone(),
        }
    }

    /// Whether names are single words in this form.
    pub(crate) fn has_words(&self) -> bool {
        *self.form == casas::FORM
    }

    /// Whether its files are binary tables of columns.
    fn is_columnar(&self) -> bool {
        self.row().is_some_and(|row| row.stands == Stands::File && row.tables == TablePlacement::FileEach)
    }

    /// The file of its activities by the names that data sets and Homebody use.
    pub(crate) fn activities_beside(&self) -> Option<LogSource> {
        self.named_alike().into_iter().find_map(|path| {
            let start = FileStart::read(&path).ok()?;
            let (form, shows) = form_shown(&start)?;
            (shows == Shows::Activities && *form != xes::FORM).then(|| LogSource::new(form, path))
        })
    }

    /// The possible names of a file of its activities.
    fn named_alike(&self) -> Vec<PathBuf> {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        let renamed = |(rows, activities): (&str, &str)| {
            name.contains(rows).then(|| self.path.with_file_name(name.replacen(rows, activities, 1)))
        };
        let has_own = self.row().is_some_and(|row| row.tables == TablePlacement::FileEach);
        let own = has_own.then(|| match self.path.is_dir() {
            true => activities_of_set(&self.path),
            false => activities_of(&self.path),
        });
        own.into_iter().chain(NAMED_ALIKE.into_iter().filter_map(renamed)).collect()
    }

    /// Files in its folder with labels in its span of time, under any name that does not belong to another log.
    pub(crate) fn labels_beside(&self) -> Vec<LogSource> {
        let is_text = !self.is_server() && !self.is_columnar() && self.path.is_file();
        let folder = self.path.parent().filter(|folder| is_text && !folder.join(RECORDING).exists());
        let folder = folder.map(|folder| if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
        let Some(Ok(Some(paths))) = folder.map(files_in) else { return Vec::new() };
        let own: Vec<PathBuf> = self.parts().into_iter().map(|part| part.path).collect();
        let others: Vec<&PathBuf> =
            paths.iter().filter(|path| own.iter().all(|own| own.file_name() != path.file_name())).collect();
        if others.is_empty() || others.len() > MOST_BESIDE {
            return Vec::new();
        }
        let Some((begin, _)) = ends(&own[0]) else { return Vec::new() };
        let Some((_, end)) = ends(&own[own.len() - 1]) else { return Vec::new() };
        let is_of_other = |path: &PathBuf| {
            let of_other = |other: &&PathBuf| LogSource::new(&csv::FORM, (*other).clone()).named_alike().contains(path);
            others.iter().any(of_other)
        };
        let labels = |path: &PathBuf| {
            let start = FileStart::read(path).ok()?;
            foreign_kind(&start).is_none().then_some(())?;
            let form = match form_shown(&start) {
                Some((form, Shows::Activities)) if *form != xes::FORM => form,
                Some((form, Shows::Rows)) if ![csv::FORM, intervals::FORM, csv::INTERVALS].contains(form) => {
                    return None;
                }
                _ => LabelTable::find(&start).map(|_| &labels::FORM)?,
            };
            let (first, last) = ends(path)?;
            (first <= end && begin <= last && !is_of_other(path)).then(|| LogSource::new(form, path))
        };
        others.iter().filter_map(|path| labels(path)).collect()
    }
}

/// Parts of the names of files of rows and of their files of activities.
const NAMED_ALIKE: [(&str, &str); 4] =
    [("SenseData", "ActData"), ("Sensors", "ADLs"), ("devices", "activities"), ("device", "activity")];

/// The file of activities for a log whose form has one table a file.
pub(crate) fn activities_of(log: &Path) -> PathBuf {
    table_file(log, SPANS)
}

pub(crate) fn activities_of_set(folder: &Path) -> PathBuf {
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{SPANS}.parquet"));
    folder.with_file_name(name)
}

/// The form of a text. A text without any sign needs cells, which make a table; else it is an error that describes it.
fn form_of(start: &FileStart) -> Result<&'static LogForm, LogError> {
    let no_log = |why| LogError::no_log(place_of(&start.path), why);
    // The log of a run that has written nothing yet.
    if start.bytes().is_empty() && start.path.with_file_name(RECORDING).is_file() {
        return Ok(&casas::FORM);
    }
    if let Some(what) = foreign_kind(start) {
        return Err(no_log(what));
    }
    match form_shown(start) {
        Some((form, _)) => Ok(form),
        None if json::begins_as_json(start) => Ok(&json::FORM),
        None if start.delimiters() >= 2 => Ok(&csv::FORM),
        None => Err(no_log(no_text(start).or_else(|| casas::objection(start)).unwrap_or_else(|| unknown(start)))),
    }
}

fn unknown(start: &FileStart) -> FormMessage {
    FormMessage::Unknown { first_line: beginning(&start.lines().next().unwrap_or_default()) }
}

/// Whether a path is a folder of a data set, such as `run=5` or `day=2009-03-02`.
fn is_partition(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.split_once('=').is_some_and(|(key, _)| !key.is_empty() && !key.starts_with('.')) && path.is_dir()
}

/// The files of a folder, in the order of their names, and whether it is a data set in folders.
fn files_in(folder: &Path) -> Result<Option<Vec<PathBuf>>, LogError> {
    let unreadable = |error| LogError::file(folder, error);
    let mut paths = Vec::new();
    for entry in folder.read_dir().map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if is_partition(&path) {
            return Ok(None);
        }
        paths.push(path);
        if paths.len() > MOST_FILES {
            return Err(LogError::no_log(place_of(folder), FormMessage::ManyFiles { most: MOST_FILES }));
        }
    }
    paths.sort();
    Ok(Some(paths.into_iter().filter(|path| path.is_file()).collect()))
}

/// The one log in a folder, in one file or several; a file of activities if no file has rows.
fn in_folder(folder: &Path) -> Result<LogSource, LogError> {
    let Some(paths) = files_in(folder)? else { return Ok(LogSource::new(form_of_scheme(Scheme::Parquet), folder)) };
    let (mut rows, mut activities, mut doubtful) = (Vec::new(), Vec::new(), Vec::new());
    for path in paths {
        let Ok(start) = FileStart::read(&path) else { continue };
        let is_foreign = foreign_kind(&start).is_some();
        match form_shown(&start).filter(|_| !is_foreign) {
            Some((form, Shows::Rows)) if LabelTable::find(&start).is_some() => {
                doubtful.push(LogSource::new(form, path))
            }
            Some((form, Shows::Rows)) => rows.push(LogSource::new(form, path)),
            Some((form, _)) => activities.push(LogSource::new(form, path)),
            None => {}
        }
    }
    // A doubtful table holds labels if another file has rows.
    let found = [rows, doubtful, activities].into_iter().find(|found| !found.is_empty()).unwrap_or_default();
    let name = |source: &LogSource| source.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    match &found[..] {
        [one] => Ok(one.clone()),
        [] => Err(LogError::IsFolder { place: place_of(folder) }),
        [first, ..] => {
            let paths: Vec<PathBuf> = found.iter().map(|source| source.path.clone()).collect();
            let is_one_form = found.iter().all(|source| source.form == first.form);
            if let Some(parts) = is_one_form.then(|| one_log(first.form, &paths)).flatten() {
                let path = parts[0].path.clone();
                return Ok(LogSource { parts, ..LogSource::new(first.form, path) });
            }
            let names: Vec<String> = found.iter().take(MOST_NAMED).map(name).collect();
            let has_more = found.len() > MOST_NAMED;
            Err(LogError::no_log(place_of(folder), FormMessage::SeveralLogs { names, has_more }))
        }
    }
}

impl From<&Url> for LogSource {
    fn from(url: &Url) -> LogSource {
        let at = url.server().map_or_else(|| url.path().into(), PathBuf::from);
        LogSource::new(form_of_scheme(url.scheme()), at)
    }
}

impl From<&LogSource> for LogSource {
    fn from(source: &LogSource) -> LogSource {
        source.clone()
    }
}

impl FromStr for LogSource {
    type Err = NoPlace;

    /// A log by its form and its file, such as `mit:activities_data.csv`.
    fn from_str(text: &str) -> Result<LogSource, NoPlace> {
        // One letter before a colon is a drive, not a form.
        let (name, path) = text.split_once(':').filter(|(name, _)| name.len() > 1).unwrap_or((text, ""));
        let what = readable(format!("{:?} names no log", without_password(text)));
        if let Some(row) = SchemeRow::named(name).filter(|row| row.stands == Stands::Server) {
            let (scheme, at) = Scheme::split(text)?;
            return Ok(LogSource::new(form_of_scheme(scheme), format!("{}:{at}", row.name)));
        }
        let Some(form) = form_named(name) else {
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
            false => {
                let path = Path::new(path.strip_prefix("//").unwrap_or(path));
                // A folder is of that form if its files are.
                let set = path.is_dir().then(|| in_folder(path).ok()).flatten();
                Ok(set.filter(|set| set.form == form).unwrap_or_else(|| LogSource::new(form, path)))
            }
        }
    }
}

impl fmt::Display for LogSource {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.is_server() {
            true => write!(f, "{}", self.path.display()),
            false if !self.parts.is_empty() => {
                write!(f, "{}:{}", self.form.name, self.path.parent().unwrap_or(Path::new(".")).display())
            }
            false => write!(f, "{}:{}", self.form.name, self.path.display()),
        }
    }
}
