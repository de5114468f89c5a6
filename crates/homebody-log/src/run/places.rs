//! The files of a run: where they go, and that they can, before the run begins.

use super::sensor_table;
use crate::error::{LogError, place_of};
use crate::files::{WriteMode, all_can_be_written, open, plain, same_file, whole};
use crate::limits::LARGEST_RECORDING_BYTES;
use crate::table::truth::TruthKept;
use crate::url::Url;
use homebody_core::recording::Recording;
pub use homebody_core::scenario::inside::{LIST, RECORDING, SENSORS, SILHOUETTES, TRUTH};
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{self, NoPlace, SCHEMES, Scheme, SchemeRow, Stands, TablePlacement};
use std::collections::BTreeSet;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The folder that runs go into where nothing else is asked for.
pub const RUNS: &str = "runs";

/// The places of a run.
#[derive(Clone, Debug)]
pub struct RunPlaces {
    /// The places of its log, any number.
    pub log: Vec<Url>,
    /// The place of its truth; `None` if it is not kept.
    pub truth: Option<Url>,
    /// The tables of its truth that are kept.
    pub kept: TruthKept,
    /// The file of its recording; `None` if it is not kept.
    pub recording: Option<PathBuf>,
    /// The table of the sensors, in a run's folder.
    pub sensors: Option<PathBuf>,
    /// Whether text files of its log have their names before they are whole, so that others can follow them: for a home that runs until it
    /// is stopped, and then resumes.
    pub is_followed: bool,
    /// The treatment of an existing truth on a server.
    pub truth_on_server: WriteMode,
    /// The folders made for the run, outer ones first.
    made: Vec<PathBuf>,
}

impl RunPlaces {
    /// The requested places, after a check that all can be written.
    pub fn new(
        log: Vec<Url>,
        truth: Option<Url>,
        recording: Option<PathBuf>,
        sources: &[PathBuf],
        force: bool,
    ) -> Result<RunPlaces, LogError> {
        let places = RunPlaces { log, truth, recording, ..RunPlaces::nowhere() };
        let files = places.files();
        can_be_written(&files.iter().map(PathBuf::as_path).collect::<Vec<_>>(), sources, force)?;
        Ok(places)
    }

    /// The places of an unfinished run without a folder, to resume it.
    pub fn left(log: Vec<Url>, truth: Option<Url>, recording: Option<PathBuf>) -> RunPlaces {
        RunPlaces { log, truth, recording, ..RunPlaces::nowhere() }
    }

    /// Removes the folders that were made, as far as nothing is in them.
    pub fn give_up(&self) {
        for folder in self.made.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }

    /// The files of a run in a new folder among `runs`.
    pub fn run(runs: &Path, scenario: &Scenario) -> Result<RunPlaces, LogError> {
        let mut places = RunPlaces::nowhere();
        places.default_to_folder(runs, scenario)?;
        Ok(places)
    }

    /// The places of the run in this folder, to resume it.
    pub fn of_folder(folder: &Path, scenario: &Scenario) -> Result<RunPlaces, LogError> {
        let mut places = RunPlaces::nowhere();
        places.put_into(folder, scenario)?;
        places.lead_nowhere_else(folder)?;
        Ok(places)
    }

    /// Checks that no file of a folder of unknown origin leads elsewhere.
    fn lead_nowhere_else(&self, folder: &Path) -> Result<(), LogError> {
        let sets = self.log.iter().filter(|url| url.is_data_set()).map(Url::path);
        if let Some(set) = sets.into_iter().find(|set| set.is_symlink()) {
            return Err(LogError::LeadsOut { place: place_of(set) });
        }
        self.files().iter().try_for_each(|path| leads_nowhere_else(folder, path))
    }

    fn nowhere() -> RunPlaces {
        RunPlaces {
            log: Vec::new(),
            truth: None,
            kept: TruthKept::All,
            recording: None,
            sensors: None,
            is_followed: false,
            truth_on_server: WriteMode::Create,
            made: Vec::new(),
        }
    }

    /// A new folder for a cohort of a scenario, with nothing in it.
    pub fn cohort(scenario: &Scenario) -> Result<PathBuf, LogError> {
        let mut places = RunPlaces::nowhere();
        places.make_numbered(Path::new(RUNS), &scenario.file.name)
    }

    /// The files of one member of a cohort, all in a folder of its own.
    pub fn member(cohort: &Path, member: &str, scenario: &Scenario, kept: TruthKept) -> Result<RunPlaces, LogError> {
        let mut places = RunPlaces { kept, ..RunPlaces::nowhere() };
        let folder = cohort.join(member);
        // The resumed cohort may be of unknown origin.
        if fs::symlink_metadata(&folder).is_ok_and(|found| found.is_symlink()) {
            return Err(LogError::LeadsOut { place: place_of(&folder) });
        }
        places.make(&folder)?;
        places.put_into(&folder, scenario)?;
        places.lead_nowhere_else(&folder)?;
        Ok(places)
    }

    /// The files of one member of a cohort whose logs, and whose truths apart from them, are each a set that is parted by member:
    /// `log/member=0001/log.parquet`, and what a run's folder has besides in `members/0001`.
    pub fn in_set(cohort: &Path, member: &str, form: Scheme, kept: TruthKept) -> Result<RunPlaces, LogError> {
        let mut places = RunPlaces::of_set(cohort, member, form, kept);
        for file in places.files() {
            if let Some(folder) = file.parent() {
                places.make(folder)?;
            }
        }
        places.lead_nowhere_else(cohort)?;
        Ok(places)
    }

    /// The same without making folders.
    pub fn of_set(cohort: &Path, member: &str, form: Scheme, kept: TruthKept) -> RunPlaces {
        let parted = |set: &str| cohort.join(set).join(format!("member={member}"));
        let usual = Path::new(form.row().usual);
        let ending = usual.extension().unwrap_or_default();
        let truth = match form.row().tables {
            TablePlacement::One | TablePlacement::OneWithNotes => Url::new(Scheme::Sqlite, parted("truth").join(TRUTH)),
            _ => Url::new(form, parted("truth").join(Path::new(TRUTH).with_extension(ending))),
        };
        let besides = cohort.join("members").join(member);
        RunPlaces {
            log: vec![Url::new(form, parted("log").join(usual))],
            truth: Some(truth),
            kept,
            recording: Some(besides.join(RECORDING)),
            sensors: Some(besides.join(SENSORS)),
            ..RunPlaces::nowhere()
        }
    }

    /// The places of the member of a set whose recording is in this folder, `members/0001`, or whose log is this file,
    /// `log/member=0001/log.parquet`; None if there is no such member.
    pub fn in_set_at(path: &Path) -> Option<RunPlaces> {
        let (folder, log) = if path.is_dir() { (path, None) } else { (path.parent()?, Some(path)) };
        let name = folder.file_name()?.to_str()?;
        let member = name.strip_prefix("member=").unwrap_or(name);
        let cohort = folder.parent()?.parent()?;
        let set = |form| RunPlaces::of_set(cohort, member, form, TruthKept::All);
        let of = |row: &SchemeRow| (row.stands != Stands::Server).then(|| set(row.scheme));
        let is_it = |places: &RunPlaces| match log {
            Some(log) => places.log.iter().any(|url| url.path() == log),
            None => places.recording.as_deref() == Some(&folder.join(RECORDING)),
        };
        let there = |places: &RunPlaces| places.log.iter().all(|url| url.path().is_file());
        SCHEMES.iter().filter_map(of).filter(is_it).find(there)
    }

    /// Makes a folder for the run, and puts everything into it that has no place yet.
    fn default_to_folder(&mut self, runs: &Path, scenario: &Scenario) -> Result<(), LogError> {
        let folder = self.make_numbered(runs, &scenario.file.name)?;
        self.put_into(&folder, scenario)
    }

    /// Puts everything into a folder that has no place yet.
    fn put_into(&mut self, folder: &Path, scenario: &Scenario) -> Result<(), LogError> {
        for url in logs_in(folder, &scenario.logger) {
            let url = url?;
            if let Some(inner) = url.file().and_then(Path::parent).filter(|inner| inner.starts_with(folder)) {
                self.make(inner)?;
            }
            self.log.push(url);
        }
        self.truth.get_or_insert_with(|| Url::new(Scheme::Sqlite, folder.join(TRUTH)));
        self.recording.get_or_insert_with(|| folder.join(RECORDING));
        self.sensors = Some(folder.join(SENSORS));
        Ok(())
    }

    /// Makes a new folder in `parent`, named after the scenario and numbered.
    fn make_numbered(&mut self, parent: &Path, name: &str) -> Result<PathBuf, LogError> {
        self.make(parent)?;
        let name = folder_name(name);
        let mut number = 1;
        loop {
            let folder = parent.join(format!("{name}-{number}"));
            match fs::create_dir(&folder) {
                Err(error) if error.kind() == ErrorKind::AlreadyExists => number += 1,
                Err(error) => return Err(no_folder(&folder, error)),
                Ok(()) => {
                    self.made.push(folder.clone());
                    return Ok(folder);
                }
            }
        }
    }

    fn make(&mut self, folder: &Path) -> Result<(), LogError> {
        let is_missing = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.is_dir();
        let missing: Vec<&Path> = folder.ancestors().take_while(is_missing).collect();
        if !missing.is_empty() && open::leads_out(folder) {
            return Err(LogError::LeadsOut { place: place_of(folder) });
        }
        for folder in missing.into_iter().rev() {
            match fs::create_dir(folder) {
                Ok(()) => self.made.push(folder.into()),
                // Another run may be making it, too.
                Err(_) if folder.is_dir() => {}
                Err(error) => return Err(no_folder(folder, error)),
            }
        }
        Ok(())
    }

    /// All files that are going to be written, those of the truth's tables too.
    pub fn files(&self) -> Vec<PathBuf> {
        let logs = self.log.iter().filter_map(Url::file).map(Path::to_owned);
        let truth = self.truth.iter().flat_map(|truth| truth.files(&self.kept.tables()));
        logs.chain(truth).chain(self.recording.clone()).chain(self.sensors.clone()).collect()
    }

    /// The tables of sensors of the logs, each once; none in a run's folder, which has its own.
    pub(crate) fn tables_of_sensors(&self) -> Vec<PathBuf> {
        let logs = self.log.iter().filter(|_| self.sensors.is_none());
        logs.filter_map(sensor_table::beside_url).collect::<BTreeSet<_>>().into_iter().collect()
    }
}

/// Looks at all files that a command is going to write, before the first is touched. None of the `sources`, which the
/// command reads, is replaced, also where that is forced.
pub fn can_be_written(files: &[&Path], sources: &[PathBuf], force: bool) -> Result<(), LogError> {
    let is_source = |path: &&&Path| sources.iter().any(|source| same_file(source, path));
    if let Some(path) = files.iter().find(is_source) {
        return Err(LogError::IsSource { place: place_of(path) });
    }
    all_can_be_written(files, force)
}

/// Makes sure that a file of a run's folder is a plain one, and in no folder that is a link to elsewhere. One that is not there
/// yet is fine.
fn leads_nowhere_else(folder: &Path, path: &Path) -> Result<(), LogError> {
    let place = || place_of(path);
    match fs::symlink_metadata(path).map(|found| found.file_type()) {
        Ok(kind) if kind.is_symlink() => return Err(LogError::LeadsOut { place: place() }),
        Ok(kind) if !kind.is_file() => return Err(LogError::NoPlain { place: place() }),
        _ => {}
    }
    match path.strip_prefix(folder).ok().and_then(|name| plain::within(folder, name)) {
        None => Err(LogError::LeadsOut { place: place() }),
        Some(_) => Ok(()),
    }
}

/// Checks that a file to write is not one that a run has left in its folder, or will write there.
///
/// # Errors
///
/// [`LogError::OfRun`] if it is one, by any path.
pub fn not_of_a_run(to: &Url) -> Result<(), LogError> {
    let Some(file) = to.file() else { return Ok(()) };
    // Of a link, both where it is and where it leads to.
    for place in [whole(file), file.canonicalize().ok()].into_iter().flatten() {
        for folder in place.ancestors().skip(1) {
            if !folder.join(RECORDING).is_file() {
                continue;
            }
            let recording = recording_in(folder);
            let is_under_way = recording.as_ref().is_some_and(|recording| !recording.is_complete());
            let is_it = |known: &PathBuf| (is_under_way || known.exists()) && same_file(known, &place);
            if files_of_run(folder, recording.as_ref()).iter().any(is_it) {
                return Err(LogError::OfRun { place: place_of(file), folder: place_of(folder) });
            }
        }
    }
    Ok(())
}

fn logs_in(folder: &Path, logger: &LoggerFile) -> impl Iterator<Item = Result<Url, NoPlace>> {
    let usual = if logger.to.is_empty() { Some(scheme::USUAL) } else { None };
    logger.to.iter().map(String::as_str).chain(usual).map(move |place| Ok(place.parse::<Url>()?.within(folder)))
}

/// Whether a folder has all files of a complete run.
pub fn is_all_there(folder: &Path, logger: &LoggerFile) -> bool {
    let is_local = |url: &Url| url.file().is_some() || url.is_data_set();
    let logs = logs_in(folder, logger).filter_map(|url| url.ok().filter(is_local).map(|url| url.path().to_owned()));
    logs.chain([RECORDING, TRUTH, SENSORS].map(|name| folder.join(name))).all(|file| file.exists())
}

/// The files of a run in its folder, whether they exist or not.
fn files_of_run(folder: &Path, recording: Option<&Recording>) -> Vec<PathBuf> {
    let scenario = recording.and_then(|recording| recording.scenario().ok());
    let places = RunPlaces {
        log: logs_of(folder, scenario.as_ref()).collect(),
        truth: Some(Url::new(Scheme::Csv, folder.join(TRUTH).with_extension("csv"))),
        recording: Some(folder.join(RECORDING)),
        sensors: Some(folder.join(SENSORS)),
        ..RunPlaces::nowhere()
    };
    places.files().into_iter().chain([folder.join(TRUTH), folder.join(SILHOUETTES)]).collect()
}

/// The possible places of a run's log in its folder: those of its scenario, or those with a usual name.
pub fn logs_of(folder: &Path, scenario: Option<&Scenario>) -> impl Iterator<Item = Url> {
    let to = scenario.map(|scenario| &scenario.logger.to[..]).unwrap_or_default();
    let said = to.iter().filter_map(|place| place.parse::<Url>().ok());
    said.chain(SCHEMES.iter().map(|row| Url::new(row.scheme, row.usual))).map(|url| url.within(folder))
}

/// The recording in a run's folder, if one can be read.
pub fn recording_in(folder: &Path) -> Option<Recording> {
    serde_json::from_str(&plain::read_text(&folder.join(RECORDING), LARGEST_RECORDING_BYTES).ok()?).ok()
}

fn folder_name(name: &str) -> String {
    // No file system takes more than 255 bytes.
    let plain = name.chars().take(50).map(|c| if c.is_alphanumeric() { c.to_ascii_lowercase() } else { '-' });
    let plain: String = plain.collect();
    let words: Vec<&str> = plain.split('-').filter(|word| !word.is_empty()).collect();
    if words.is_empty() { "run".into() } else { words.join("-") }
}

fn no_folder(folder: &Path, source: std::io::Error) -> LogError {
    LogError::Unmade { place: place_of(folder), source }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_named_after_its_scenario() {
        assert_eq!(folder_name("tigerplace"), "tigerplace");
        assert_eq!(folder_name("Mrs. Öz, 2nd floor"), "mrs-Öz-2nd-floor");
        assert_eq!(folder_name("../.."), "run");
        assert!(folder_name(&"好".repeat(300)).len() < 200);
    }
}
