//! Reports about the logs of stored runs: contents, care and realism, as the commands write them.

use crate::folders::HomeFolders;
use crate::located_log::given_log;
use crate::messages::PageMessage;
use crate::notes::Notes;
use crate::playback::{FileStates, file_states};
use crate::request_error::{RequestError, no_run, unprocessable, without};
use crate::wire::{CareView, KeptLogView, PlaybackContent};
use homebody_analysis::care::care;
use homebody_analysis::density::density;
use homebody_analysis::episodes::WatchOptions;
use homebody_analysis::look::{HomeSensor, Looker, looked};
use homebody_analysis::realism::{ComparedLog, NotComparable, realism};
use homebody_core::problem::{Diagnose, Diagnostic, readable};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::RunTime;
use homebody_log::run::places::TRUTH;
use homebody_picture::{density_map, look_page, realism_page};
use homebody_query::{LoadedLog, LogRef, QueryError, home_sensors};
use homebody_tracking::located_folder::GIVEN;
use homebody_tracking::sensors_of_home;
use jiff::civil::Date;
use std::sync::{Arc, Mutex, PoisonError};

/// Largest number of rows of a log that are analysed (our choice): some years of a home's. They are in memory
/// meanwhile.
const MOST_ROWS: usize = 5_000_000;

/// Clones are the same.
#[derive(Clone)]
pub struct LogReports {
    folders: HomeFolders,
    /// Held while a log is read: one after the other, so that the run on the stage has a core.
    reading: Arc<Mutex<()>>,
    /// The latest reports first.
    cached: Arc<Mutex<Vec<CachedCare>>>,
}

/// A report with the states of its files.
struct CachedCare {
    files: FileStates,
    /// The days on which a new reference begins.
    marked: Vec<Date>,
    care: CareView,
}

/// Largest number of results that are stored (our choice).
const MOST_CACHED: usize = 4;

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum LogChoice {
    /// The original of a located log; else the run's own.
    Given,
    /// The run's own, from the sensors of its home.
    Own,
}

impl LogReports {
    pub fn new(folders: HomeFolders) -> LogReports {
        LogReports { folders, reading: Arc::default(), cached: Arc::default() }
    }

    /// The report of `homebody look`.
    pub fn look(&self, run: &str) -> Result<String, RequestError> {
        let _reading = self.reading.lock().unwrap_or_else(PoisonError::into_inner);
        let (named, scenario) = self.find(run, LogChoice::Given)?;
        let looker = Looker::new(Some(scenario.calendar.local(RunTime::START).time_zone().clone()));
        let (looker, about) = looked(looker, &mut |take| named.stream(take)).map_err(|error| self.error(&error))?;
        let sensors = home_sensors(&scenario);
        let home: (&str, &[HomeSensor]) = (&scenario.file.name, &sensors);
        let is_called = |sensor: &&HomeSensor, id: &str| sensor.name != id && sensor.ids.iter().any(|own| own == id);
        let name = |id: &str| sensors.iter().find(|sensor| is_called(sensor, id)).map(|sensor| sensor.name.clone());
        let look = looker.look(&named.name, named.place.form().name, &about, &name, Some(home));
        let map = if look.rows <= MOST_ROWS as u64 { density_of(named, &scenario.file.time_zone) } else { None };
        Ok(look_page(&look, map.as_deref()))
    }

    /// The report for carers about a run or about a log without a home.
    pub fn care(&self, run: &str) -> Result<CareView, RequestError> {
        let _reading = self.reading.lock().unwrap_or_else(PoisonError::into_inner);
        let (named, scenario) = match self.folders.kept_log(run) {
            Some(folder) => (given_log(&folder)?, None),
            None => self.find(run, LogChoice::Given).map(|(named, scenario)| (named, Some(scenario)))?,
        };
        let files = file_states(&named.place.files());
        let mut cached = self.cached.lock().unwrap_or_else(PoisonError::into_inner);
        let marked = Notes::new(self.folders.clone()).references(run)?;
        let is_known = |known: &&CachedCare| known.care.name == run && known.files == files && known.marked == marked;
        if let Some(known) = cached.iter().find(is_known) {
            return Ok(known.care.clone());
        }
        let zone = scenario.as_ref().map(|scenario| scenario.file.time_zone.as_str());
        let mut read = LoadedLog::alone(named, zone, MOST_ROWS).map_err(|error| self.error(&error))?;
        if read.log.rows > MOST_ROWS as u64 {
            return Err(too_long(run, read.log.rows));
        }
        scenario.iter().for_each(|scenario| _ = read.place_in(scenario));
        let measures = read.measures().map_err(unprocessable)?;
        let subject = read.subject();
        let person = if read.residents().len() > 1 { "the residents" } else { &subject };
        let options = WatchOptions { marked: &marked, ..WatchOptions::default() };
        let care = CareView::new(care(&measures, options, &subject), (run, person), self.playback_content(run));
        cached.retain(|known| known.care.name != run);
        cached.truncate(MOST_CACHED - 1);
        cached.insert(0, CachedCare { files, marked, care: care.clone() });
        Ok(care)
    }

    fn playback_content(&self, run: &str) -> PlaybackContent {
        if self.folders.kept_log(run).is_some() {
            PlaybackContent::NoHome
        } else if self.folders.located_log(run).is_some() {
            PlaybackContent::WalkedBack
        } else if self.folders.file_of_run(run, TRUTH).is_some() {
            PlaybackContent::Lived
        } else {
            PlaybackContent::Sensors
        }
    }

    pub fn kept(&self) -> Vec<KeptLogView> {
        let log = |name: &str| {
            let given = self.folders.kept_log(name)?.join(GIVEN);
            let first = given.read_dir().ok()?.flatten().next()?;
            first.file_name().into_string().ok()
        };
        let logs = self.folders.kept_logs().into_iter();
        logs.filter_map(|name| Some(KeptLogView { log: log(&name)?, name })).collect()
    }

    /// The report of `homebody realism`, which takes the first log for the real one.
    pub fn realism(&self, real: (&str, LogChoice), other: (&str, LogChoice)) -> Result<String, RequestError> {
        let _reading = self.reading.lock().unwrap_or_else(PoisonError::into_inner);
        let (a, b) = (self.read(real)?, self.read(other)?);
        let realism =
            realism(compared(&a), compared(&b)).map_err(|problems| unprocessable(joined_message(&problems)))?;
        Ok(realism_page(&realism))
    }

    /// A log in memory, with the home's names of its sensors.
    fn read(&self, (run, which): (&str, LogChoice)) -> Result<LoadedLog, RequestError> {
        let (named, scenario) = self.find(run, which)?;
        let rows = named.survey().map_err(|error| self.error(&error))?.rows;
        if rows > MOST_ROWS as u64 {
            return Err(too_long(&named.name, rows));
        }
        let zone = scenario.file.time_zone.as_str();
        let mut read = LoadedLog::from_ref(named, Some(zone)).map_err(|error| self.error(&error))?;
        let known = sensors_of_home(&read.log, &scenario);
        for (id, number) in read.log.sensors.iter_mut().zip(known) {
            number.into_iter().for_each(|number| id.clone_from(&scenario.home.placed_sensors()[number].name));
        }
        Ok(read)
    }

    fn find(&self, run: &str, which: LogChoice) -> Result<(LogRef, Scenario), RequestError> {
        let folder = self.folders.run(run).ok_or_else(|| no_run(run))?;
        let recording = self.folders.recording(run).map_err(unprocessable)?;
        let scenario = recording.scenario().map_err(unprocessable)?;
        let walked = self.folders.located_log(run);
        let named = match walked.as_deref().filter(|_| which == LogChoice::Given) {
            Some(walked) => given_log(walked)?,
            None => {
                let mut found = LogRef::find(&folder.to_string_lossy()).map_err(|error| self.error(&error))?;
                found.name = if walked.is_some() { "the run simulated from it" } else { run }.to_owned();
                found
            }
        };
        Ok((named, scenario))
    }

    /// A message without the path of the runs.
    fn error(&self, error: &QueryError) -> RequestError {
        unprocessable(without(&self.folders.runs, error.diagnostic()))
    }
}

/// The map of a log's density, if it has motion sensors and not too many days.
fn density_of(named: LogRef, zone: &str) -> Option<String> {
    let log = LoadedLog::from_ref(named, Some(zone)).ok()?;
    let asked = log.density_asked();
    density((&log.name, &log.log, &asked), None).ok().map(|density| density_map(&density))
}

fn too_long(log: &str, rows: u64) -> RequestError {
    unprocessable(PageMessage::LogTooLong { log: readable(log.to_owned()), rows, limit: MOST_ROWS as u64 })
}

/// The problems of two logs as one message, with the code of the first.
fn joined_message(problems: &[NotComparable]) -> Diagnostic {
    let all: Vec<Diagnostic> = problems.iter().map(NotComparable::diagnostic).collect();
    let joined = |texts: Vec<&str>| {
        let mut different: Vec<&str> = Vec::new();
        texts.into_iter().for_each(|text| {
            if !different.contains(&text) {
                different.push(text)
            }
        });
        different.join("; ")
    };
    let what = joined(all.iter().map(|problem| problem.what.as_str()).collect());
    let hint = joined(all.iter().filter_map(|problem| problem.hint.as_deref()).collect());
    Diagnostic { what, hint: (!hint.is_empty()).then_some(hint), ..all.into_iter().next().unwrap_or_default() }
}

fn compared(log: &LoadedLog) -> ComparedLog<'_> {
    ComparedLog { name: &log.name, log: &log.log, recorded: log.recorded }
}
