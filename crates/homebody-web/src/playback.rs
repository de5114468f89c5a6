//! Stored runs, day by day: the log and, if the run has one, the ground truth.
//!
//! A run is opened once. Its log is read into a temporary file while the page shows the part that is read; its ground truth is
//! queried by day. The last few runs stay open while their files are unchanged.

mod background_read;
mod silhouettes;
mod search;
mod lanes;
mod lived;
mod reading;

use crate::dates::{self, NumberedEpisode};
use crate::draw;
use crate::folders::HomeFolders;
use crate::located_log::{KnownChance, LocatedLog, chances_within, read_summary};
use crate::messages::PageMessage;
pub use crate::request_error::RequestError;
use crate::request_error::{code_of, failed, no_run, not_found, sentence, unprocessable};
use crate::stored_log::StoredRows;
use crate::stored_runs;
use crate::stored_silhouettes::StoredSilhouettes;
use crate::wire::{DateView, DayView, MovementView, PersonDay, PlaybackView, ReadingView, ResidentView, StoredView};
use background_read::PartlyRead;
use homebody_core::posture::Posture;
use homebody_core::problem::{Diagnose, Diagnostic, readable};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::scheme::{self, Scheme};
use homebody_core::time::{HOUR, Interval, MINUTE, RunTime, Span, TimeScale};
use homebody_log::run::places::{RECORDING, SILHOUETTES};
use homebody_log::{LogError, Movement, MovementKind, Movements, Url, scale_of};
use homebody_query::search::KnownStay;
use homebody_routine::household::Household;
use homebody_timeline::{Episode, PersonTimeline};
use homebody_tracking::located_folder::GIVEN;
use lived::{Lived, Lives};
use reading::Reading;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant, SystemTime};

/// Number of runs that stay open (our choice): two next to each other, and the previous one.
const MOST_OPEN: usize = 3;

/// Number of items that are remembered for the list of runs (our choice): some hundred bytes each.
const MOST_LISTED: usize = 20_000;

/// Time to wait for the log of a run that is opened (our choice): most are read by then, and their problems are
/// reported at once.
const OPENS_WITHIN: Duration = Duration::from_millis(800);

/// Largest number of spans of activities of a whole run (our choice). A year would have tens of thousands.
const MOST_SPANS: usize = 6000;

/// Gap within which the same activity counts as one (our choice).
const PAUSE: Span = MINUTE;

/// Time after which an answer about a day is sent, in addition to an hour's reading (our choice). The page requests the
/// rest next.
const PIECE: Duration = Duration::from_millis(150);

/// Largest number of movements in an answer, in addition to an hour's (our choice).
const MOST_MOVEMENTS: usize = 20_000;

const TRUTH: &str = "truth.db";

#[derive(Clone)]
pub struct Playback {
    folders: HomeFolders,
    /// The latest request last.
    opened: Arc<Mutex<Vec<Arc<OpenRun>>>>,
    /// By name.
    listed: Arc<Mutex<HashMap<String, ListedRun>>>,
}

/// A recording as the list of runs shows it, or its problem.
struct ListedRun {
    state: FileStates,
    recorded: Result<RecordingSummary, Diagnostic>,
}

#[derive(Clone, Default)]
struct RecordingSummary {
    scenario: String,
    start: String,
    days: u32,
    seed: Option<u64>,
    without: Vec<String>,
}

struct OpenRun {
    name: String,
    /// The files of the run, with their states before they were read.
    files: Vec<PathBuf>,
    state: FileStates,
    /// Without the parts that come from the log.
    view: PlaybackView,
    reading: Option<Reading>,
    /// With the whole log.
    whole: OnceLock<Arc<PlaybackView>>,
    lived: Option<Lived>,
    /// The whole ground truth, once it was requested.
    lives: OnceLock<Arc<Lives>>,
    movements: Option<Mutex<Movements>>,
    /// By resident; empty unless the log was located.
    chances: Vec<Vec<KnownChance>>,
    truth: Option<Url>,
    scale: TimeScale,
    /// The messages that the link lost, once they were searched.
    lost: OnceLock<Vec<KnownStay<'static, RunTime>>>,
    film: Option<StoredSilhouettes>,
}

pub type FileStates = Vec<Option<(SystemTime, u64)>>;

impl Playback {
    pub fn new(folders: HomeFolders) -> Playback {
        Playback { folders, opened: Arc::default(), listed: Arc::default() }
    }

    /// The latest first.
    pub fn list(&self) -> Vec<StoredView> {
        self.folders.runs().into_iter().map(|name| self.stored(name)).collect()
    }

    pub fn latest(&self, most: usize) -> Vec<StoredView> {
        self.folders.runs().into_iter().take(most).map(|name| self.stored(name)).collect()
    }

    fn stored(&self, name: String) -> StoredView {
        let has_truth = self.folders.file_of_run(&name, TRUTH).is_some();
        let about = stored_runs::about(&self.folders, &name);
        let made_ms = self.folders.run(&name).and_then(|folder| made_ms(&folder));
        let walked_back = self.folders.located_log(&name).map(|folder| read_summary(&folder).log);
        let recorded = self.recorded(&name);
        let walked_back = walked_back.filter(|_| recorded.is_ok());
        let (problem, problem_code) = match &recorded {
            Ok(_) => (None, None),
            Err(why) => (Some(sentence(why)), code_of(why)),
        };
        let RecordingSummary { scenario, start, days, seed, without } = recorded.unwrap_or_default();
        StoredView {
            name,
            scenario,
            start,
            days,
            has_truth,
            walked_back,
            problem,
            problem_code,
            made_ms,
            seed,
            without,
            about,
        }
    }

    /// Reads a recording unless its state is unchanged: a list has a thousand runs, each with its scenario.
    fn recorded(&self, name: &str) -> Result<RecordingSummary, Diagnostic> {
        let path = self.folders.file_of_run(name, RECORDING);
        let files: Vec<PathBuf> = path.into_iter().collect();
        let state = file_states(&files);
        let known = |all: &HashMap<String, ListedRun>| {
            all.get(name).filter(|listed| listed.state == state).map(|listed| listed.recorded.clone())
        };
        let listed =
            |listed: &Mutex<HashMap<String, ListedRun>>| known(&listed.lock().unwrap_or_else(PoisonError::into_inner));
        if let Some(recorded) = listed(&self.listed) {
            return recorded;
        }
        let recorded = self.folders.recording(name).and_then(|recording| {
            let scenario = recording.scenario().map_err(|problems| problems.diagnostic())?;
            Ok(RecordingSummary {
                start: scenario.calendar.wall_clock(RunTime::START),
                days: dates::last_day(&scenario.calendar, recording.length_us) + 1,
                seed: Some(recording.seed),
                without: recording.without,
                scenario: scenario.file.name,
            })
        });
        let mut all = self.listed.lock().unwrap_or_else(PoisonError::into_inner);
        if all.len() >= MOST_LISTED {
            all.clear();
        }
        all.insert(name.to_owned(), ListedRun { state, recorded: recorded.clone() });
        recorded
    }

    /// A run with the part of its log that is read.
    pub fn run(&self, name: &str) -> Result<Arc<PlaybackView>, RequestError> {
        self.open(name)?.current_view()
    }

    pub fn reading(&self, name: &str) -> Result<ReadingView, RequestError> {
        Ok(ReadingView { read_us: self.open(name)?.read_us()?.map(RunTime::micros) })
    }

    /// Day 0 is the first.
    pub fn day(&self, name: &str, day: usize) -> Result<DayView, RequestError> {
        let run = self.open(name)?;
        let interval = run.view.days.get(day).map(DateView::interval).ok_or_else(|| run.no_day())?;
        let rows = match &run.reading {
            Some(reading) => reading.until(interval.end)?.of(day)?,
            None => Vec::new(),
        };
        let mut lives = run.empty_lives();
        let until = run.add_movements(interval, &mut lives)?;
        if let Some(lived) = &run.lived {
            let known = lived.coming().until(interval.end)?;
            for (index, life) in lives.iter_mut().enumerate() {
                let person = &known.lives().people[index];
                life.rooms = overlapping(&person.rooms, interval);
                life.activities = overlapping(&person.activities, interval);
            }
        }
        for (index, life) in lives.iter_mut().enumerate() {
            life.chances = run.chances.get(index).map_or(Vec::new(), |all| chances_within(all, interval));
        }
        let rows = rows.iter().map(|row| (row.at.micros(), row.sensor, row.value)).collect();
        Ok(DayView { rows, lives, until_us: until.micros() })
    }

    /// The movements of a day from an instant on, as many as there is time for.
    pub fn rest_of_day(&self, name: &str, day: usize, from: RunTime) -> Result<DayView, RequestError> {
        let run = self.open(name)?;
        let Interval { begin, end } = run.view.days.get(day).map(DateView::interval).ok_or_else(|| run.no_day())?;
        let mut lives = run.empty_lives();
        let until = run.add_movements(Interval::new(from.clamp(begin, end), end), &mut lives)?;
        Ok(DayView { rows: Vec::new(), lives, until_us: until.micros() })
    }

    /// The open run, read again if its files have changed.
    fn open(&self, name: &str) -> Result<Arc<OpenRun>, RequestError> {
        let recording = self.folders.file_of_run(name, RECORDING).ok_or_else(|| no_run(name))?;
        // Other requests wait: they may be for the same run.
        let mut opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = opened.iter().position(|run| run.name == name) {
            let run = opened.remove(at);
            if run.read_us().is_ok() && run.state == file_states(&run.files) {
                opened.push(run.clone());
                return Ok(run);
            }
        }
        let run = Arc::new(self.read(name, recording)?);
        opened.push(run.clone());
        let old = opened.len().saturating_sub(MOST_OPEN);
        opened.drain(..old);
        Ok(run)
    }

    fn read(&self, name: &str, recording_path: PathBuf) -> Result<OpenRun, RequestError> {
        let recording = self.folders.recording(name).map_err(unprocessable)?;
        let length = recording.length_us;
        let recorded = Household::recorded(&recording);
        let (scenario, household) = recorded.map_err(unprocessable)?;
        let mut view = initial_view(name, &recording.run(&scenario, &household), &scenario);
        view.days = dates::all_days(&scenario.calendar, length);

        let walked = self.folders.located_log(name).map(LocatedLog::open).transpose()?;
        let log = self.log(name, &scenario);
        let truth = self.folders.file_of_run(name, TRUTH);
        let silhouettes = self.folders.file_of_run(name, SILHOUETTES);
        let folder = recording_path.parent().unwrap_or(Path::new("")).to_owned();
        let mut files = vec![recording_path, folder.join(TRUTH), folder.join(SILHOUETTES)];
        files.extend(log.iter().filter_map(|log| log.file().map(Path::to_owned)));
        files.extend(walked.iter().flat_map(LocatedLog::files));
        // States come before reading: a file that changes meanwhile is read again.
        let state = file_states(&files);

        let begun = Instant::now();
        let reading = match (&walked, log) {
            (Some(walked), _) => {
                let rows = walked.rows(&scenario, &mut view, &self.folders.runs)?;
                Some(Reading::whole(rows, &mut view))
            }
            (None, Some(url)) => {
                let beside = &self.folders.runs;
                let rows = StoredRows::new(beside, &view, &scenario.calendar, RunTime::MAX).map_err(failed)?;
                let reading = Reading::begin(url, &scenario, recording.is_complete(), &view, rows)?;
                Some(reading)
            }
            (None, None) => {
                view.remarks.push("The folder of this run has no log.".into());
                None
            }
        };

        let mut run = OpenRun {
            name: name.into(),
            files,
            state,
            view: view.clone(),
            reading,
            whole: OnceLock::new(),
            lived: None,
            lives: OnceLock::new(),
            movements: None,
            chances: Vec::new(),
            truth: truth.as_deref().map(|truth| Url::new(Scheme::Sqlite, truth)),
            scale: scale_of(&scenario, length),
            lost: OnceLock::new(),
            film: None,
        };
        if let Some(path) = silhouettes.filter(|_| walked.is_none()) {
            run.film = Some(StoredSilhouettes::new(path, scenario.clone(), &view));
            view.has_silhouettes = true;
        }
        if let Some(truth) = &truth {
            match run.open_truth(truth) {
                Err(LogError::NoTruth { .. }) if !recording.is_complete() => {}
                learnt => {
                    run.lived = Some(learnt.map_err(unprocessable)??);
                    view.has_truth = true;
                }
            }
        }
        if let Some(walked) = &walked {
            run.chances = walked.chances(&scenario, &mut view)?;
        }
        run.view = view;
        let left = || OPENS_WITHIN.saturating_sub(begun.elapsed());
        if let Some(reading) = &run.reading {
            reading.wait(RunTime::MAX, left()).read_us()?;
        }
        if let Some(lived) = &run.lived {
            lived.coming().wait(RunTime::MAX, left()).read_us()?;
        }
        Ok(run)
    }

    pub fn log_of(&self, name: &str) -> Option<PathBuf> {
        if let Some(kept) = self.folders.kept_log(name) {
            return Some(kept.join(GIVEN).read_dir().ok()?.flatten().next()?.path());
        }
        let scenario = self.folders.recording(name).ok()?.scenario().ok()?;
        self.log(name, &scenario)?.file().map(Path::to_owned)
    }

    fn log(&self, name: &str, scenario: &Scenario) -> Option<Url> {
        let usual = scheme::USUAL.parse().ok();
        let named = scenario.logger.to.iter().filter_map(|url| url.parse().ok()).chain(usual);
        named.into_iter().find_map(|url: Url| {
            let file = self.folders.file_within_run(name, url.file()?)?;
            Some(url.at(file))
        })
    }
}

impl Drop for OpenRun {
    fn drop(&mut self) {
        self.reading.iter().for_each(Reading::stop);
        self.lived.iter().for_each(|lived| lived.coming().stop());
    }
}

impl OpenRun {
    fn no_day(&self) -> RequestError {
        not_found(PageMessage::NoDay { run: readable(self.name.clone()), days: self.view.days.len() })
    }

    /// The instant up to which log and ground truth are read; `None` once both are complete.
    fn read_us(&self) -> Result<Option<RunTime>, RequestError> {
        let log = self.reading.as_ref().map_or(Ok(None), |reading| reading.known().read_us())?;
        let truth = self.lived.as_ref().map_or(Ok(None), |lived| lived.coming().known().read_us())?;
        Ok(log.into_iter().chain(truth).min())
    }

    fn current_view(&self) -> Result<Arc<PlaybackView>, RequestError> {
        if let Some(whole) = self.whole.get() {
            return Ok(whole.clone());
        }
        let mut view = self.view.clone();
        view.read_us = self.read_us()?.map(RunTime::micros);
        match &self.reading {
            Some(reading) => {
                let known = reading.known();
                view.sensors = known.sensors.clone();
                view.values = known.values.clone();
                view.hours = known.rows.hours.clone();
                view.remarks.extend_from_slice(&known.remarks);
            }
            None => view.hours = vec![vec![0; 24]; view.days.len()],
        }
        if let Some(lived) = &self.lived {
            let known = lived.coming().known();
            view.activities = known.lives().activities.clone();
            if view.read_us.is_none() {
                view.spans = longest_spans(&known.lives().people);
            }
        }
        Ok(match view.read_us {
            None => self.whole.get_or_init(|| Arc::new(view)).clone(),
            Some(_) => Arc::new(view),
        })
    }

    fn complete_view(&self) -> Result<Arc<PlaybackView>, RequestError> {
        if let Some(reading) = &self.reading {
            drop(reading.until(RunTime::MAX)?);
        }
        self.lives()?;
        self.current_view()
    }

    fn lives(&self) -> Result<Option<&Lives>, RequestError> {
        if self.lives.get().is_none()
            && let Some(lived) = &self.lived
        {
            let whole = lived.whole()?;
            return Ok(Some(self.lives.get_or_init(|| whole)));
        }
        Ok(self.lives.get().map(|lives| &**lives))
    }

    /// By resident; empty without ground truth.
    fn empty_lives(&self) -> Vec<PersonDay> {
        let count = if self.truth.is_some() { self.view.residents.len() } else { 0 };
        vec![PersonDay::default(); count]
    }

    /// Adds the movements of a span, hour by hour, as long as there is time. Returns the end of the added part.
    fn add_movements(&self, span: Interval<RunTime>, lives: &mut [PersonDay]) -> Result<RunTime, RequestError> {
        let Some(movements) = &self.movements else { return Ok(span.end) };
        let mut movements = movements.lock().unwrap_or_else(PoisonError::into_inner);
        let begun = Instant::now();
        let mut until = span.begin;
        let mut last: Vec<Option<Movement>> = vec![None; lives.len()];
        loop {
            let next = (until - until.since_zero().rem_euclid(HOUR) + HOUR).min(span.end);
            let of = movements.of(Interval::new(until, next)).map_err(unprocessable)?;
            for ((life, of), last) in lives.iter_mut().zip(of).zip(&mut last) {
                for movement in of {
                    match last {
                        // One that goes on over the hour is found in both.
                        Some(before)
                            if before.time.begin >= movement.time.begin || before.time.end >= movement.time.end => {}
                        Some(before) if rests_on(before, &movement) => {
                            before.time.end = movement.time.end;
                            if let Some(told) = life.movements.last_mut() {
                                told.1 = movement.time.end.micros();
                            }
                        }
                        _ => {
                            life.movements.push(movement_view(&movement));
                            *last = Some(movement);
                        }
                    }
                }
            }
            until = next;
            let count: usize = lives.iter().map(|life| life.movements.len()).sum();
            if until >= span.end || begun.elapsed() >= PIECE || count > MOST_MOVEMENTS {
                return Ok(until);
            }
        }
    }

    /// Opens the ground truth and starts to read it in the background.
    fn open_truth(&mut self, truth: &Path) -> Result<Result<Lived, RequestError>, LogError> {
        let names: Vec<String> = self.view.residents.iter().map(|resident| resident.name.clone()).collect();
        let rooms: Vec<String> = self.view.home.rooms.iter().map(|room| room.name.clone()).collect();
        let truth = Url::new(Scheme::Sqlite, truth);
        self.movements = Some(Mutex::new(Movements::open(&truth, &names, self.scale.clone())?));
        Ok(Lived::begin(truth, self.scale.clone(), names, &rooms))
    }
}

/// The creation of a run's folder, in milliseconds since 1970.
fn made_ms(folder: &Path) -> Option<i64> {
    let known = fs::metadata(folder).ok()?;
    let made = known.created().or_else(|_| known.modified()).ok()?;
    i64::try_from(made.duration_since(SystemTime::UNIX_EPOCH).ok()?.as_millis()).ok()
}

/// Whether a body rests as before: manual control records sixty rests a second.
fn rests_on(before: &Movement, next: &Movement) -> bool {
    let is_still = matches!(next.kind, MovementKind::Rest | MovementKind::Away);
    is_still
        && before.time.end == next.time.begin
        && (before.kind, before.to, before.posture) == (next.kind, next.to, next.posture)
}

pub fn file_states(files: &[PathBuf]) -> FileStates {
    let look = |path: &PathBuf| fs::metadata(path).and_then(|meta| Ok((meta.modified()?, meta.len()))).ok();
    files.iter().map(look).collect()
}

/// The parts of the view that need no log.
fn initial_view(name: &str, run: &Run, scenario: &Scenario) -> PlaybackView {
    let radius = |index: usize| run.home().field(index, Posture::Standing).size.radius_m;
    let residents = run.names().into_iter().enumerate();
    PlaybackView {
        name: name.into(),
        scenario: scenario.file.name.clone(),
        home: draw::home(&scenario.home, &run.home().plan, run.sensors()),
        residents: residents.map(|(index, name)| ResidentView { name, radius_m: radius(index) }).collect(),
        start: scenario.calendar.wall_clock(RunTime::START),
        zone: scenario.file.time_zone.clone(),
        length_us: run.length().micros(),
        nights: dates::nights(|at| run.home().sun.elevation_sine(at), run.length()),
        ..PlaybackView::default()
    }
}

/// The activities of each person, no more than [`MOST_SPANS`] in all: one that continues after a pause is one, and the shortest are left out.
fn longest_spans(people: &[PersonTimeline<RunTime, u32>]) -> Vec<Vec<(i64, i64, u32)>> {
    let mut few: Vec<Vec<NumberedEpisode>> = Vec::new();
    for person in people {
        let mut merged: Vec<NumberedEpisode> = Vec::new();
        for &activity in &person.activities {
            match merged.last_mut() {
                Some(last) if last.label == activity.label && activity.begin() - last.end() <= PAUSE => {
                    last.time.end = last.end().max(activity.end());
                }
                _ => merged.push(activity),
            }
        }
        few.push(merged);
    }
    let mut lengths: Vec<Span> = few.iter().flatten().map(Episode::length).collect();
    if lengths.len() > MOST_SPANS {
        lengths.sort_unstable_by(|a, b| b.cmp(a));
        let least = lengths[MOST_SPANS];
        few.iter_mut().for_each(|activities| activities.retain(|activity| activity.length() > least));
    }
    few.iter().map(|activities| activities.iter().map(dates::in_micros).collect()).collect()
}

fn overlapping(episodes: &[NumberedEpisode], time: Interval<RunTime>) -> Vec<(i64, i64, u32)> {
    episodes.iter().filter(|episode| episode.time.overlaps(time)).map(dates::in_micros).collect()
}

fn movement_view(movement: &Movement) -> MovementView {
    let (from, to) = (movement.from.map(draw::at), movement.to.map(draw::at));
    (movement.time.begin.micros(), movement.time.end.micros(), movement.kind, draw::posture(movement.posture), from, to)
}
