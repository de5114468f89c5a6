//! A log that somebody names, and what lies beside it where a run left it: the truth, and the recording, which knows the
//! sensors' own names, the time zone, and from when to when the run was.

use crate::error::Error;
use homebody_analysis::dates::{date_of, dates, on_wall, put_on_wall};
use homebody_core::recording::Recording;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::SCHEMES;
use homebody_core::time::Micros;
use homebody_log::places::{LIST, RECORDING};
use homebody_log::source::Clock;
use homebody_log::source::recognise;
use homebody_log::{Life, Log, LogError, Url, lives, read};
use jiff::civil::Date;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A log on the clock on the wall of its home.
pub struct LogWithRun {
    /// What it is called.
    pub name: String,
    /// Its rows; `log.clock` says whether they could be put on the wall.
    pub log: Log,
    /// What the truth tells, where there is one.
    pub lives: Vec<Life>,
    /// From when to when the run was, if that is known.
    pub recorded: Option<Range<Micros>>,
    /// The files that it comes from, which nothing replaces.
    pub sources: Vec<PathBuf>,
}

impl LogWithRun {
    /// Reads a log by its URL, by its path alone, or by the folder of its run. One in UTC is put on the wall of `zone`, or
    /// of its run's; where neither is known, it stays in UTC.
    ///
    /// # Errors
    ///
    /// [`Error::TimeZone`] if no zone has this name, [`Error::NoLog`] or [`Error::IsCohort`] if it is a folder without one log,
    /// [`Error::Log`] if the log or the truth beside it cannot be read.
    pub fn read(text: &str, zone: Option<&str>) -> Result<LogWithRun, Error> {
        let asked = zone.map(Calendar::zone).transpose().map_err(Error::TimeZone)?;
        let url = place_of_log(text)?;
        let mut log = read(&url, &LoggerFile::default())?;
        let beside = |name: &str| Some(url.file()?.with_file_name(name)).filter(|path| path.is_file());
        let (truth, recording) = (beside("truth.db"), beside("recording.json"));
        let mut lives = truth.as_ref().map(|truth| lives(truth)).transpose()?.unwrap_or_default();
        let run = recording.as_ref().and_then(|path| fs::read_to_string(path).ok());
        let run: Option<Recording> = run.and_then(|text| serde_json::from_str(&text).ok());
        let scenario = run.as_ref().and_then(|run| run.scenario().ok());
        if let Some(scenario) = &scenario {
            name_sensors(&mut log, scenario);
        }
        let zone = asked.or_else(|| Some(scenario.as_ref()?.calendar.local(0).time_zone().clone()));
        // One that is being lived, or was killed, says how long it is to be, and not how far it has come.
        let lived = run.as_ref().filter(|run| run.is_complete());
        let span = scenario.as_ref().zip(lived).map(|(scenario, run)| {
            let instant = |at| scenario.calendar.timestamp(at).as_microsecond();
            let zone = scenario.calendar.local(0).time_zone().clone();
            on_wall(instant(0), &zone)..on_wall(instant(run.length_us), &zone)
        });
        if let Some(zone) = zone.filter(|_| log.clock == Clock::Utc) {
            for part in lives.iter_mut().flat_map(|life| life.activities.iter_mut().chain(&mut life.rooms)) {
                (part.begin, part.end) = (on_wall(part.begin, &zone), on_wall(part.end, &zone));
            }
            put_on_wall(&mut log, &zone);
        }
        // A recording that lies there by chance is of another time.
        let recorded = span.filter(|span| log.events.iter().all(|event| span.contains(&event.at)));
        let sources = [url.file().map(Path::to_owned), truth, recording].into_iter().flatten().collect();
        Ok(LogWithRun { name: named(text), log, lives, recorded, sources })
    }

    /// The first and the last of its dates: those of its run, on which nothing may have been said, else those of its rows.
    pub fn dates(&self) -> Option<(Date, Date)> {
        let of_run = self.recorded.as_ref().map(|run| (date_of(run.start), date_of(run.end - 1)));
        of_run.or_else(|| dates(&self.log))
    }
}

/// Gives the sensors their names in the home for the ids that they have in the log.
fn name_sensors(log: &mut Log, scenario: &Scenario) {
    for sensor in &mut log.sensors {
        if let Some((name, _)) = scenario.logger.ids.iter().find(|(_, id)| *id == sensor) {
            sensor.clone_from(name);
        }
    }
}

/// Where a log is that is named by its URL, by its path alone, or by the folder of its run.
///
/// # Errors
///
/// [`Error::NoLog`] or [`Error::IsCohort`] if it is a folder without one log, [`Error::Log`] if it is no log at all.
pub fn place_of_log(text: &str) -> Result<Url, Error> {
    let path = PathBuf::from(text);
    if path.join(LIST).is_file() {
        return Err(Error::IsCohort { member: first_member(&path), folder: path });
    }
    if path.is_dir() {
        return log_in(&path).ok_or(Error::NoLog { folder: path });
    }
    if path.exists() {
        return Ok(recognise(&path)?);
    }
    Ok(text.parse().or_else(|_| recognise(&path)).map_err(|error: LogError| error)?)
}

/// The log in a run's folder: where its recording says that it is, or under a usual name.
fn log_in(folder: &Path) -> Option<Url> {
    let recording = fs::read_to_string(folder.join(RECORDING)).ok();
    let recording: Option<Recording> = recording.and_then(|text| serde_json::from_str(&text).ok());
    let to = recording.and_then(|run| run.scenario().ok()).map(|scenario| scenario.logger.to).unwrap_or_default();
    let said = to.iter().filter_map(|place| place.parse::<Url>().ok());
    let usual = SCHEMES.iter().map(|row| Url::new(row.scheme, row.usual));
    let mut all = said.chain(usual).map(|url| url.within(folder));
    all.find(|url| url.file().is_some_and(Path::is_file))
}

/// The first member of a cohort who was lived.
fn first_member(folder: &Path) -> Option<PathBuf> {
    let is_member = |path: &PathBuf| path.join("recording.json").is_file();
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(is_member).min()
}

/// What a log is called: as its file, or as the folder of its run.
fn named(text: &str) -> String {
    let path =
        PathBuf::from(text.split_once(':').filter(|(scheme, _)| scheme.len() > 1).map_or(text, |(_, path)| path));
    path.file_name().map_or(text.into(), |name| name.to_string_lossy().into_owned())
}
