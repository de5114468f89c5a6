//! What the logs of stored runs hold, and how near they are to each other: the pages that the commands write.

use crate::messages::PageMessage;
use crate::playback::{State, state};
use crate::refusal::{Refusal, damaged, unknown, without};
use crate::shelf::Shelf;
use crate::walked::given;
use crate::wire::{CareView, KeptLogView, WalksView};
use homebody_analysis::alerts::{Rules, USUAL};
use homebody_analysis::care::care;
use homebody_analysis::density::density;
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
use std::sync::{Arc, Mutex, PoisonError};

/// Largest number of rows of a log that are analysed (our choice): some years of a home's. They are in memory
/// meanwhile.
const MOST_ROWS: usize = 5_000_000;

/// The logs of a shelf's runs. A clone is the same.
#[derive(Clone)]
pub struct Logs {
    shelf: Shelf,
    /// Held while a log is read: one after the other, so that the run on the stage has a core.
    reading: Arc<Mutex<()>>,
    /// Whom was told of last, the latest first: who looks at playback comes back.
    told: Arc<Mutex<Vec<ToldCare>>>,
}

/// How somebody is, by files as they were.
struct ToldCare {
    files: State,
    care: CareView,
}

/// Largest number of results that are stored (our choice).
const MOST_TOLD: usize = 4;

/// Which log of a run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// Of one that was walked back the log as it was given; of any other its own.
    Given,
    /// The run's own, which its home's sensors made.
    Own,
}

impl Logs {
    pub fn new(shelf: Shelf) -> Logs {
        Logs { shelf, reading: Arc::default(), told: Arc::default() }
    }

    /// What the log of a run holds, as `homebody look` writes it.
    pub fn look(&self, run: &str) -> Result<String, Refusal> {
        let _reading = self.reading.lock().unwrap_or_else(PoisonError::into_inner);
        let (named, scenario) = self.find(run, Which::Given)?;
        let looker = Looker::new(Some(scenario.calendar.local(RunTime::START).time_zone().clone()));
        let (looker, about) = looked(looker, &mut |take| named.stream(take)).map_err(|error| self.wrong(&error))?;
        let sensors = home_sensors(&scenario);
        let home: (&str, &[HomeSensor]) = (&scenario.file.name, &sensors);
        let is_called = |sensor: &&HomeSensor, id: &str| sensor.name != id && sensor.ids.iter().any(|own| own == id);
        let name = |id: &str| sensors.iter().find(|sensor| is_called(sensor, id)).map(|sensor| sensor.name.clone());
        let look = looker.look(&named.name, named.place.form().name, &about, &name, Some(home));
        let map = if look.rows <= MOST_ROWS as u64 { density_of(named, &scenario.file.time_zone) } else { None };
        Ok(look_page(&look, map.as_deref()))
    }

    /// How the resident of a run is, by its log alone, or that of a log which is kept without a home.
    pub fn care(&self, run: &str) -> Result<CareView, Refusal> {
        let _reading = self.reading.lock().unwrap_or_else(PoisonError::into_inner);
        let (named, scenario) = match self.shelf.kept_log(run) {
            Some(folder) => (given(&folder)?, None),
            None => self.find(run, Which::Given).map(|(named, scenario)| (named, Some(scenario)))?,
        };
        let files = state(&named.place.files());
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = told.iter().find(|known| known.care.name == run && known.files == files) {
            return Ok(known.care.clone());
        }
        let zone = scenario.as_ref().map(|scenario| scenario.file.time_zone.as_str());
        let mut read = LoadedLog::alone(named, zone, MOST_ROWS).map_err(|error| self.wrong(&error))?;
        if read.log.rows > MOST_ROWS as u64 {
            return Err(too_long(run, read.log.rows));
        }
        scenario.iter().for_each(|scenario| _ = read.place_in(scenario));
        let measures = read.measures().map_err(damaged)?;
        let rules = Rules::read(USUAL).map_err(damaged)?;
        let subject = read.subject();
        let person = if read.residents().len() > 1 { "the residents" } else { &subject };
        let care = CareView::of(&care(&measures, &rules, &subject), (run, person), self.walks(run));
        told.retain(|known| known.care.name != run);
        told.truncate(MOST_TOLD - 1);
        told.insert(0, ToldCare { files, care: care.clone() });
        Ok(care)
    }

    /// Who walks when a run is played back.
    fn walks(&self, run: &str) -> WalksView {
        if self.shelf.kept_log(run).is_some() {
            WalksView::NoHome
        } else if self.shelf.walked(run).is_some() {
            WalksView::WalkedBack
        } else if self.shelf.file_of_run(run, TRUTH).is_some() {
            WalksView::Lived
        } else {
            WalksView::Sensors
        }
    }

    /// The logs that are kept without a home.
    pub fn kept(&self) -> Vec<KeptLogView> {
        let log = |name: &str| {
            let given = self.shelf.kept_log(name)?.join(GIVEN);
            let first = given.read_dir().ok()?.flatten().next()?;
            first.file_name().into_string().ok()
        };
        let logs = self.shelf.kept_logs().into_iter();
        logs.filter_map(|name| Some(KeptLogView { log: log(&name)?, name })).collect()
    }

    /// How near the log of a run is to that of another, which is taken for what is real, as `homebody realism` writes it.
    pub fn realism(&self, real: (&str, Which), other: (&str, Which)) -> Result<String, Refusal> {
        let _reading = self.reading.lock().unwrap_or_else(PoisonError::into_inner);
        let (a, b) = (self.read(real)?, self.read(other)?);
        let realism = realism(told(&a), told(&b)).map_err(|problems| damaged(together(&problems)))?;
        Ok(realism_page(&realism))
    }

    /// A log in memory, by the home's own names of its sensors.
    fn read(&self, (run, which): (&str, Which)) -> Result<LoadedLog, Refusal> {
        let (named, scenario) = self.find(run, which)?;
        let rows = named.survey().map_err(|error| self.wrong(&error))?.rows;
        if rows > MOST_ROWS as u64 {
            return Err(too_long(&named.name, rows));
        }
        let zone = scenario.file.time_zone.as_str();
        let mut read = LoadedLog::from_ref(named, Some(zone)).map_err(|error| self.wrong(&error))?;
        let known = sensors_of_home(&read.log, &scenario);
        for (id, number) in read.log.sensors.iter_mut().zip(known) {
            number.into_iter().for_each(|number| id.clone_from(&scenario.home.placed_sensors()[number].name));
        }
        Ok(read)
    }

    /// A log, and the scenario of its home.
    fn find(&self, run: &str, which: Which) -> Result<(LogRef, Scenario), Refusal> {
        let no_run = || unknown(PageMessage::NoRun { run: readable(run.to_owned()) });
        let folder = self.shelf.run(run).ok_or_else(no_run)?;
        let recording = self.shelf.recording(run).map_err(damaged)?;
        let scenario = recording.scenario().map_err(damaged)?;
        let walked = self.shelf.walked(run);
        let named = match walked.as_deref().filter(|_| which == Which::Given) {
            Some(walked) => given(walked)?,
            None => {
                let mut found = LogRef::find(&folder.to_string_lossy()).map_err(|error| self.wrong(&error))?;
                found.name = if walked.is_some() { "the run simulated from it" } else { run }.to_owned();
                found
            }
        };
        Ok((named, scenario))
    }

    /// What is wrong, without where the runs are.
    fn wrong(&self, error: &QueryError) -> Refusal {
        damaged(without(&self.shelf.runs, error.diagnostic()))
    }
}

/// The map of a log's density, where it has motion sensors, and days that are not too many.
fn density_of(named: LogRef, zone: &str) -> Option<String> {
    let log = LoadedLog::from_ref(named, Some(zone)).ok()?;
    let asked = log.density_asked();
    density((&log.name, &log.log, &asked), None).ok().map(|density| density_map(&density))
}

fn too_long(log: &str, rows: u64) -> Refusal {
    damaged(PageMessage::LogTooLong { log: readable(log.to_owned()), rows, limit: MOST_ROWS as u64 })
}

/// The problems of two logs as one message, with the code of the first.
fn together(problems: &[NotComparable]) -> Diagnostic {
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

fn told(log: &LoadedLog) -> ComparedLog<'_> {
    ComparedLog { name: &log.name, log: &log.log, recorded: log.recorded }
}
