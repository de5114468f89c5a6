//! A log by its name: where it is, and the run that left it.

use crate::error::QueryError;
use crate::home_sensors::know_sensors;
use homebody_core::recording::Recording;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{RunTime, TimeScale};
use homebody_log::log::Clock;
use homebody_log::run::places::{LIST, RECORDING, logs_of, recording_in};
use homebody_log::{Log, LogError, LogSource, RunPlaces, Url, read, scale_of, stream, survey};
use jiff::tz::TimeZone;
use std::fs;
use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq)]
pub struct IncompleteLog {
    pub folder: PathBuf,
    /// The run was killed, so that its log and its ground truth may end at different instants.
    pub is_killed: bool,
}

/// A log before it is read: its place, and its run.
pub struct LogRef {
    pub name: String,
    pub place: LogSource,
    /// The names of its table and columns, by the logger of its run, or else the usual ones.
    pub mapping: LoggerFile,
    /// The recording in its folder.
    pub(crate) run: Option<Recording>,
    pub(crate) scenario: Option<Scenario>,
}

impl LogRef {
    /// Finds a log by its URL, by its path alone, or by the folder of its run.
    ///
    /// # Errors
    ///
    /// [`QueryError::NoLog`] or [`QueryError::IsCohort`] if it is a folder without one log, [`QueryError::NoRows`] if its run has not
    /// stored any row, [`QueryError::Simulation`] if there is no such file.
    pub fn find(text: &str) -> Result<LogRef, QueryError> {
        let path = PathBuf::from(text);
        if path.join(LIST).is_file() {
            return Err(QueryError::IsCohort { member: first_member(&path), folder: path });
        }
        if path.is_dir() {
            let recording = recording_in(&path);
            return match log_in(&path, recording.as_ref()) {
                Some(place) => Ok(LogRef::at(text, LogSource::from(&place), recording)),
                None if recording.as_ref().is_some_and(|run| !run.is_complete()) => Err(no_rows(path)),
                None if recording.is_some() => Err(QueryError::NoLog { folder: path }),
                None => match LogSource::recognise(&path) {
                    Err(LogError::IsFolder { .. }) => Err(QueryError::NoLog { folder: path }),
                    found => Ok(LogRef::at(text, found?, None)),
                },
            };
        }
        let place = match path.exists() {
            true => LogSource::recognise(&path)?,
            // It is a URL with an error, and may contain a password.
            false if text.contains("://") => text.parse().map_err(LogError::NoPlace)?,
            false => text.parse().or_else(|_| LogSource::recognise(&path)).map_err(|error: LogError| error)?,
        };
        let of_set = || recording_in(RunPlaces::in_set_at(place.path())?.recording?.parent()?);
        let beside = place.path().parent().and_then(recording_in).or_else(of_set);
        Ok(LogRef::at(text, place, beside))
    }

    fn at(text: &str, place: LogSource, run: Option<Recording>) -> LogRef {
        let scenario = run.as_ref().and_then(|run| run.scenario().ok());
        let mapping = scenario.as_ref().map(|scenario| scenario.logger.clone()).unwrap_or_default();
        LogRef { name: called(text), place, mapping, run, scenario }
    }

    pub fn scenario(&self) -> Option<&Scenario> {
        self.scenario.as_ref()
    }

    /// Adds the names, kinds and rooms of the log's sensors in the home of its run, if that is known.
    pub fn know_home(&self, log: &mut Log) {
        if let Some(scenario) = &self.scenario {
            know_sensors(log, scenario);
        }
    }

    /// The zone of its run's clocks, if that is known.
    pub fn zone(&self) -> Option<TimeZone> {
        self.scenario.as_ref().map(|scenario| scenario.calendar.local(RunTime::START).time_zone().clone())
    }

    /// The name of a sensor in the home of its run, by its id in the log.
    pub fn name_of(&self, id: &str) -> Option<&str> {
        let ids = self.scenario.iter().flat_map(|scenario| &scenario.logger.ids);
        ids.into_iter().find(|(_, known)| *known == id).map(|(name, _)| name.as_str())
    }

    /// Reads it through: `take` gets its rows part by part, as of [`stream`].
    pub fn stream(&self, take: &mut dyn FnMut(&Log)) -> Result<Log, QueryError> {
        let mut take = |part: &Log| {
            take(part);
            Ok(())
        };
        self.with_rows(stream(&self.place, &self.mapping, &mut take))
    }

    /// Reads it into memory.
    pub fn read(&self) -> Result<Log, QueryError> {
        self.with_rows(read(&self.place, &self.mapping))
    }

    /// Reads it through and keeps no rows.
    pub fn survey(&self) -> Result<Log, QueryError> {
        self.with_rows(survey(&self.place, &self.mapping))
    }

    /// Reports a run without rows as such, whatever its log is without them.
    fn with_rows(&self, read: Result<Log, LogError>) -> Result<Log, QueryError> {
        let file = self.place.path();
        let is_empty = match &read {
            Ok(log) => log.rows == 0 && log.skipped == 0,
            Err(LogError::Missing { .. } | LogError::NoTables { .. }) => true,
            Err(_) => fs::metadata(file).is_ok_and(|found| found.len() == 0),
        };
        match self.run.as_ref().is_some_and(|run| is_empty && !run.is_complete() && self.is_of_its_run()) {
            true => Err(no_rows(file.parent().unwrap_or(Path::new("")).to_owned())),
            false => Ok(read?),
        }
    }

    /// Its run, if that is incomplete.
    pub fn incomplete(&self) -> Option<IncompleteLog> {
        let run = self.run.as_ref().filter(|run| !run.is_whole() && self.is_of_its_run())?;
        let folder = self.place.path().parent()?.to_owned();
        Some(IncompleteLog { folder, is_killed: !run.is_complete() })
    }

    /// The recording in its folder says that the run's log is here.
    fn is_of_its_run(&self) -> bool {
        let file = self.place.path();
        let folder = file.parent().unwrap_or(Path::new(""));
        logs_of(folder, self.scenario.as_ref()).any(|url| url.file() == Some(file))
    }

    /// The clock of the ground truth in its folder. If the run is unknown, it changes no instant.
    pub fn clock(&self) -> TimeScale {
        clock(self.scenario.as_ref(), self.run.as_ref())
    }

    /// The clock of a ground truth that may be elsewhere, by the recording in its folder or in the folder of the log.
    pub fn clock_beside(&self, truth: &Url) -> TimeScale {
        if self.scenario.is_some() {
            return self.clock();
        }
        let run = truth.file().and_then(Path::parent).and_then(recording_in);
        clock(run.as_ref().and_then(|run| run.scenario().ok()).as_ref(), run.as_ref())
    }

    /// The clock of the log itself, which is in the time of `told_by`; `None` if the run is unknown.
    pub fn clock_of(&self, told_by: Clock) -> Option<TimeScale> {
        let (scenario, run) = self.scenario.as_ref().zip(self.run.as_ref())?;
        Some(told_by.scale(&scenario.calendar, run.length_us))
    }
}

fn clock(scenario: Option<&Scenario>, run: Option<&Recording>) -> TimeScale {
    scenario.zip(run).map_or_else(TimeScale::one, |(scenario, run)| scale_of(scenario, run.length_us))
}

/// The error of a run without rows, with the folder to resume: its cohort's, if it is a member of one.
fn no_rows(folder: PathBuf) -> QueryError {
    let cohort = folder.parent().filter(|parent| parent.join(LIST).is_file());
    QueryError::NoRows { resume: cohort.unwrap_or(&folder).to_owned(), folder }
}

/// The log in a run's folder, by its recording or by a usual name.
fn log_in(folder: &Path, recording: Option<&Recording>) -> Option<Url> {
    let scenario = recording.and_then(|run| run.scenario().ok());
    let there = logs_of(folder, scenario.as_ref()).find(|url| url.file().is_some_and(Path::is_file));
    there.or_else(|| RunPlaces::in_set_at(folder)?.log.pop())
}

/// The first member of a cohort in its folder.
fn first_member(folder: &Path) -> Option<PathBuf> {
    let is_member = |path: &PathBuf| path.join(RECORDING).is_file();
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(is_member).min()
}

/// The name of a log: that of its file, or of the folder of its run.
fn called(text: &str) -> String {
    let path =
        PathBuf::from(text.split_once(':').filter(|(scheme, _)| scheme.len() > 1).map_or(text, |(_, path)| path));
    path.file_name().map_or(text.into(), |name| name.to_string_lossy().into_owned())
}
