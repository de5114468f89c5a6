//! Checks of a place: a log, a ground truth, a broker, the folder of a run or of a cohort.

use crate::error::QueryError;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Diagnostic;
use homebody_core::recording::Recording;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{Scheme, TablePlacement};
use homebody_log::destination::{NOTES, Note};
use homebody_log::examine::{Check, CheckOptions, CheckVerdict, examine, examine_log};
use homebody_log::files::lock::FolderLock;
use homebody_log::run::places::{LIST, RECORDING, SENSORS, TRUTH, logs_of};
use homebody_log::truth::is_truth_set;
use homebody_log::{LogError, LogSource, Url, truth_beside};
use homebody_routine::household::Household;
use homebody_simulation::{RecordedRun, SimulationError, VERSION, has_no_end, recording};
use serde::Serialize;
use std::fs;
use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PlaceReport {
    pub place: String,
    pub checks: Vec<Check>,
}

#[derive(Clone, Debug, Default)]
pub struct PlaceCheck {
    /// The names of a log's table and columns; by default those of its run, or the usual ones.
    pub mapping: Option<LoggerFile>,
    /// A check may write; it removes what it has written.
    pub may_write: bool,
    /// A run is replayed and compared, firing by firing.
    pub replays: bool,
}

impl PlaceCheck {
    /// Checks a place: a URL, a file, or the folder of a run, of a cohort or of a data set.
    ///
    /// # Errors
    ///
    /// Only an invalid name of a place; all else is a check.
    pub fn examine(&self, text: &str) -> Result<PlaceReport, QueryError> {
        let path = Path::new(text);
        let checks = match path {
            _ if path.join(LIST).is_file() => self.cohort(path)?,
            _ if path.join(RECORDING).is_file() || path.join(SENSORS).is_file() => self.run(path)?,
            _ if is_truth_set(path) => self.place(&Url::new(Scheme::Parquet, path), None)?,
            _ if path.exists() => match LogSource::recognise(path) {
                Ok(log) => examine_log(&log, &self.asked(&self.mapping(None)))?,
                Err(error) => vec![Check::of_error("file", &error)],
            },
            // A word without a colon is a path.
            _ if !text.contains(':') => {
                vec![Check::of_error("file", &LogError::Missing { place: path.display().to_string() })]
            }
            _ => self.place(&text.parse::<Url>().map_err(LogError::NoPlace)?, None)?,
        };
        let place = homebody_core::scenario::scheme::without_password(text).into_owned();
        Ok(PlaceReport { place, checks })
    }

    fn mapping(&self, run: Option<&LoggerFile>) -> LoggerFile {
        self.mapping.clone().or_else(|| run.cloned()).unwrap_or_default()
    }

    fn asked<'a>(&self, mapping: &'a LoggerFile) -> CheckOptions<'a> {
        CheckOptions { mapping, may_write: self.may_write }
    }

    fn place(&self, url: &Url, run: Option<&LoggerFile>) -> Result<Vec<Check>, QueryError> {
        Ok(examine(url, &self.asked(&self.mapping(run)))?)
    }

    fn cohort(&self, folder: &Path) -> Result<Vec<Check>, QueryError> {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
        let mut members: Vec<PathBuf> = entries.filter(|path| path.is_dir()).collect();
        members.sort();
        let mut checks = Vec::new();
        let mut whole = 0;
        for member in members {
            let name = member.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let found = self.run(&member)?;
            let before = checks.len();
            let told = found.into_iter().filter(|check| check.verdict != CheckVerdict::Ok);
            checks.extend(told.map(|check| check.of(&name)));
            whole += usize::from(checks.len() == before);
        }
        let says = format!("{whole} members without a problem");
        checks.push(Check::ok("members", says));
        Ok(checks)
    }

    fn run(&self, folder: &Path) -> Result<Vec<Check>, QueryError> {
        let mut checks = Vec::new();
        if let Err(error) = FolderLock::take(folder) {
            let says = error.to_string();
            let says = says.split('\n').next().unwrap_or_default().to_owned();
            checks.push(Check::warning("lock", says, "wait until it ends, and run the check again"));
        }
        let run = match recording(&folder.join(RECORDING)) {
            Ok(run) => run,
            Err(error) => {
                checks.push(wrong("recording", &error));
                return Ok(checks);
            }
        };
        checks.push(self.recorded(folder, &run));
        let scenario = match Household::recorded(&run) {
            Ok((scenario, _)) => scenario,
            Err(problems) => {
                let says = format!("its scenario cannot be simulated: {}", problems.render().replace('\n', "; "));
                checks.push(Check::wrong(
                    "recording",
                    says,
                    "replay it with the version that wrote it, which the recording names",
                ));
                return Ok(checks);
            }
        };
        checks.extend(self.logs(folder, &run, &scenario)?);
        checks.extend(self.truth(folder, &run, &scenario)?);
        if !folder.join(SENSORS).is_file() {
            let says = format!("there is no {SENSORS}, the table of the sensors with their names and places");
            checks.push(Check::wrong("sensors", says, format!("homebody run --resume {} writes it", folder.display())));
        }
        checks.extend(notes(folder, &run));
        checks.extend(left(folder));
        if self.replays && run.is_complete() && run.can_replay() {
            checks.push(replayed(folder));
        }
        Ok(checks)
    }

    /// Checks that the run is complete, or that this program can resume it.
    fn recorded(&self, folder: &Path, run: &Recording) -> Check {
        let resume = match has_no_end(run) {
            _ if !run.can_replay() => "run it again with the program that has its driver".into(),
            true => format!("homebody live SCENARIO --folder {} resumes it", folder.display()),
            false => format!("homebody run --resume {} resumes it", folder.display()),
        };
        let version = &run.version;
        match () {
            () if !run.is_complete() => {
                Check::warning("recording", "the run is not complete: it was interrupted, or is still running", resume)
            }
            () if !run.is_whole() => Check::warning("recording", "the run was stopped before its end", resume),
            () if version != VERSION => Check::warning(
                "recording",
                format!("version {version} wrote it: this version reads it, and its replay may differ"),
                "keep that version to replay it",
            ),
            () => Check::ok("recording", format!("{} firings, complete, written by this version", run.firings)),
        }
    }

    fn logs(&self, folder: &Path, run: &Recording, scenario: &Scenario) -> Result<Vec<Check>, QueryError> {
        let said = scenario.logger.to.len();
        let logs: Vec<Url> = logs_of(folder, Some(scenario)).collect();
        let is_there = |url: &&Url| url.path().exists() && (url.file().is_some() || url.is_data_set());
        // Without a named log, it is one of the usual ones.
        let usual = logs.iter().skip(said).find(is_there).into_iter();
        let logs: Vec<&Url> = if said > 0 { logs.iter().take(said).collect() } else { usual.collect() };
        let mut checks = Vec::new();
        for url in &logs {
            let is_local = url.file().is_some() || url.is_data_set();
            let found = self.place(url, Some(&scenario.logger))?;
            let rows = found.iter().find_map(|check| check.rows);
            checks.extend(found.into_iter().map(|check| check.of(&short(url))));
            if let (Some(told), Some(rows), true) = (run.rows, rows, is_local)
                && told != rows
            {
                let says = format!("{}: it has {rows} rows, and the recording says {told}", short(url));
                checks.push(Check::wrong("rows", says, "homebody replay RECORDING --out URL writes the log again"));
            }
        }
        if logs.is_empty() {
            let hint = format!("homebody run --resume {} writes it again", folder.display());
            checks.push(Check::wrong("log", "the folder has no log", hint));
        }
        Ok(checks)
    }

    fn truth(&self, folder: &Path, run: &Recording, scenario: &Scenario) -> Result<Vec<Check>, QueryError> {
        let Some(url) = truth_beside(&folder.join(TRUTH)) else {
            let hint = format!("homebody run --resume {} writes it again", folder.display());
            return Ok(vec![Check::wrong("truth", "the folder has no ground truth", hint)]);
        };
        // A file of one table is not a log.
        if url.scheme().row().tables == TablePlacement::FileEach && !url.is_data_set() {
            return Ok(vec![Check::ok("truth", format!("{}: each table has its file", short(&url)))]);
        }
        let found = self.place(&url, Some(&scenario.logger))?;
        let firings = found.iter().find_map(|check| check.rows);
        let mut checks: Vec<Check> = found.into_iter().map(|check| check.of(&short(&url))).collect();
        if let Some(firings) = firings.filter(|firings| run.is_complete() && *firings != run.firings) {
            let says = format!("{}: it has {firings} firings, and the recording says {}", short(&url), run.firings);
            checks.push(Check::wrong("truth", says, "homebody replay RECORDING --truth FILE writes it again"));
        }
        Ok(checks)
    }
}

fn short(url: &Url) -> String {
    match url.file().is_some() || url.is_data_set() {
        true => url.path().file_name().unwrap_or_default().to_string_lossy().into_owned(),
        false => homebody_core::scenario::scheme::without_password(&url.to_string()).into_owned(),
    }
}

fn wrong(about: &str, error: &SimulationError) -> Check {
    let message = error.diagnostic();
    let hint = message.hint.clone().unwrap_or_else(|| "start the run again".to_owned());
    Check::wrong(about, Diagnostic { hint: None, ..message }.to_string(), hint)
}

/// Replays a run without output.
fn replayed(folder: &Path) -> Check {
    let again = RecordedRun::open(folder.join(RECORDING)).and_then(|recorded| {
        let mut run = recorded.start();
        while run.next_batch()?.is_some() {}
        Ok(run.matches_recording() == Some(true))
    });
    match again {
        Ok(true) => Check::ok("replay", "the replay has the same firings"),
        Ok(false) => Check::wrong(
            "replay",
            "the replay has other firings",
            "the recording was changed, or another version wrote it: start the run again",
        ),
        Err(error) => wrong("replay", &error),
    }
}

fn notes(folder: &Path, run: &Recording) -> Vec<Check> {
    let hint = "remove it; Homebody then sends the confirmed rows again, with the same numbers";
    let note = |path: &Path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match Note::read(path) {
            Err(why) => Check::wrong("confirmed", format!("{name} is not a valid note: {why}"), hint),
            Ok(note) if note.run != run.run_id() => {
                Check::wrong("confirmed", format!("{name} belongs to another run"), hint)
            }
            Ok(note) => match (note.rows.first(), run.rows) {
                (Some(&noted), Some(rows)) if noted > rows => {
                    let says = format!("{name}: {noted} rows are confirmed, but the run has {rows}");
                    Check::wrong("confirmed", says, hint)
                }
                (Some(&noted), Some(rows)) if noted < rows && run.is_whole() => Check::warning(
                    "confirmed",
                    format!("{name}: {noted} of {rows} rows are confirmed"),
                    format!("homebody run --resume {} --out URL sends the rest", folder.display()),
                ),
                (noted, _) => Check::ok("confirmed", format!("{name}: {} rows", noted.copied().unwrap_or(0))),
            },
        }
    };
    files(folder).filter(|path| path.to_string_lossy().ends_with(NOTES)).map(|path| note(&path)).collect()
}

fn left(folder: &Path) -> Vec<Check> {
    let is_left = |path: &PathBuf| [".part", ".anew", ".old"].iter().any(|end| path.to_string_lossy().ends_with(end));
    let left = files(folder).filter(is_left);
    left.map(|path| {
        let says = format!(
            "{} is an incomplete file of an interrupted program",
            path.file_name().unwrap_or_default().to_string_lossy()
        );
        Check::warning("files", says, format!("homebody run --resume {} removes it", folder.display()))
    })
    .collect()
}

fn files(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let mut all: Vec<PathBuf> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.is_file())
        .collect();
    all.sort();
    all.into_iter()
}
