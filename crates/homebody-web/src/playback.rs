//! Runs that are stored, day by day: what the log says, and beside it, where there is one, what the truth knows.
//!
//! A run is opened once: its log is read into a file without a name, while the page shows what has come of it; its truth is asked day by
//! day. The last few that were opened are kept, as long as their files stay as they are.

mod coming;
mod filmed;
mod finding;
mod lanes;
mod lived;
mod reading;

use crate::dates::{self, NumberedEpisode};
use crate::draw;
use crate::film::Film;
use crate::keeping;
use crate::messages::PageMessage;
pub use crate::refusal::Refusal;
use crate::refusal::{damaged, failed, sentence, unknown};
use crate::shelf::Shelf;
use crate::stored_log::StoredRows;
use crate::walked::{KnownChance, Walked, chances_of, reported};
use crate::wire::{
    DateView, DayView, LifeView, MotionState, MovementView, PlaybackView, ReadingView, ResidentView, StoredView,
};
use coming::Grows;
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

/// What a run's truth is called in its folder.
const TRUTH: &str = "truth.db";

/// The stored runs of a shelf.
#[derive(Clone)]
pub struct Playback {
    shelf: Shelf,
    /// The last one that was asked for comes last.
    opened: Arc<Mutex<Vec<Arc<Opened>>>>,
    /// What is listed of each, by name.
    listed: Arc<Mutex<HashMap<String, Listed>>>,
}

/// What a recording says in a list of runs, or what is wrong with it.
struct Listed {
    state: State,
    recorded: Result<Recorded, Diagnostic>,
}

#[derive(Clone)]
struct Recorded {
    scenario: String,
    start: String,
    days: u32,
    seed: u64,
    without: Vec<String>,
}

/// A run in memory.
struct Opened {
    name: String,
    /// What it was read from, and what that was like.
    files: Vec<PathBuf>,
    state: State,
    /// What is known without the log.
    view: PlaybackView,
    /// The log, if there is one.
    reading: Option<Reading>,
    /// With all of the log.
    whole: OnceLock<Arc<PlaybackView>>,
    /// What its truth tells, if it has one.
    lived: Option<Lived>,
    /// All of that, once it was wanted.
    lives: OnceLock<Arc<Lives>>,
    movements: Option<Mutex<Movements>>,
    /// By resident; none but of a log that was walked back.
    chances: Vec<Vec<KnownChance>>,
    truth: Option<Url>,
    scale: TimeScale,
    /// The messages that never reached the logger, once somebody has looked for them.
    lost: OnceLock<Vec<KnownStay<'static, RunTime>>>,
    /// What its cameras have kept.
    film: Option<Film>,
}

/// When a run's files were written, and how long they are.
pub type State = Vec<Option<(SystemTime, u64)>>;

impl Playback {
    pub fn new(shelf: Shelf) -> Playback {
        Playback { shelf, opened: Arc::default(), listed: Arc::default() }
    }

    /// All runs, the latest first.
    pub fn list(&self) -> Vec<StoredView> {
        self.shelf.runs().into_iter().map(|name| self.stored(name)).collect()
    }

    /// The latest runs.
    pub fn latest(&self, most: usize) -> Vec<StoredView> {
        self.shelf.runs().into_iter().take(most).map(|name| self.stored(name)).collect()
    }

    fn stored(&self, name: String) -> StoredView {
        let has_truth = self.shelf.file_of_run(&name, TRUTH).is_some();
        let about = keeping::about(&self.shelf, &name);
        let made_ms = self.shelf.run(&name).and_then(|folder| made_ms(&folder));
        let walked_back = self.shelf.walked(&name).map(|folder| reported(&folder).log);
        match self.recorded(&name) {
            Ok(Recorded { scenario, start, days, seed, without }) => StoredView {
                made_ms,
                about,
                seed: Some(seed),
                without,
                scenario,
                start,
                days,
                walked_back,
                name,
                has_truth,
                problem: None,
                problem_code: None,
            },
            Err(why) => StoredView {
                made_ms,
                about,
                seed: None,
                without: Vec::new(),
                name,
                scenario: String::new(),
                start: String::new(),
                days: 0,
                has_truth,
                walked_back: None,
                problem: Some(sentence(&why)),
                problem_code: (!why.code.is_empty()).then(|| why.code.to_owned()),
            },
        }
    }

    /// What a run's recording says, which is read once as long as it stays as it is: of a thousand runs each has a scenario.
    fn recorded(&self, name: &str) -> Result<Recorded, Diagnostic> {
        let path = self.shelf.file_of_run(name, RECORDING);
        let files: Vec<PathBuf> = path.into_iter().collect();
        let state = state(&files);
        let known = |all: &HashMap<String, Listed>| {
            all.get(name).filter(|listed| listed.state == state).map(|listed| listed.recorded.clone())
        };
        let listed =
            |listed: &Mutex<HashMap<String, Listed>>| known(&listed.lock().unwrap_or_else(PoisonError::into_inner));
        if let Some(recorded) = listed(&self.listed) {
            return recorded;
        }
        let recorded = self.shelf.recording(name).and_then(|recording| {
            let scenario = recording.scenario().map_err(|problems| problems.diagnostic())?;
            Ok(Recorded {
                start: scenario.calendar.wall_clock(RunTime::START),
                days: dates::last(&scenario.calendar, recording.length_us) + 1,
                seed: recording.seed,
                without: recording.without,
                scenario: scenario.file.name,
            })
        });
        let mut all = self.listed.lock().unwrap_or_else(PoisonError::into_inner);
        if all.len() >= MOST_LISTED {
            all.clear();
        }
        all.insert(name.to_owned(), Listed { state, recorded: recorded.clone() });
        recorded
    }

    /// A run as a whole, with what is known of its log by now.
    pub fn run(&self, name: &str) -> Result<Arc<PlaybackView>, Refusal> {
        self.open(name)?.known()
    }

    /// How far the log of a run is read.
    pub fn reading(&self, name: &str) -> Result<ReadingView, Refusal> {
        Ok(ReadingView { read_us: self.open(name)?.read_us()?.map(RunTime::micros) })
    }

    /// A day of a run, the first being 0.
    pub fn day(&self, name: &str, day: usize) -> Result<DayView, Refusal> {
        let run = self.open(name)?;
        let interval = run.view.days.get(day).map(DateView::interval).ok_or_else(|| run.no_day())?;
        let rows = match &run.reading {
            Some(reading) => reading.until(interval.end)?.of(day)?,
            None => Vec::new(),
        };
        let mut lives = run.nobody_yet();
        let until = run.moved(interval, &mut lives)?;
        if let Some(lived) = &run.lived {
            let known = lived.coming().until(interval.end)?;
            for (index, life) in lives.iter_mut().enumerate() {
                let person = &known.lives().people[index];
                life.rooms = overlapping(&person.rooms, interval);
                life.activities = overlapping(&person.activities, interval);
            }
        }
        for (index, life) in lives.iter_mut().enumerate() {
            life.chances = run.chances.get(index).map_or(Vec::new(), |all| chances_of(all, interval));
        }
        let rows = rows.iter().map(|row| (row.at.micros(), row.sensor, row.value)).collect();
        Ok(DayView { rows, lives, until_us: until.micros() })
    }

    /// Of a day whose movements are too many for one answer those from an instant on, again as many as there is time for.
    pub fn rest_of_day(&self, name: &str, day: usize, from: RunTime) -> Result<DayView, Refusal> {
        let run = self.open(name)?;
        let Interval { begin, end } = run.view.days.get(day).map(DateView::interval).ok_or_else(|| run.no_day())?;
        let mut lives = run.nobody_yet();
        let until = run.moved(Interval::new(from.clamp(begin, end), end), &mut lives)?;
        Ok(DayView { rows: Vec::new(), lives, until_us: until.micros() })
    }

    /// The run in memory, read anew where its files have changed.
    fn open(&self, name: &str) -> Result<Arc<Opened>, Refusal> {
        let no_run = || unknown(PageMessage::NoRun { run: readable(name.to_owned()) });
        let recording = self.shelf.file_of_run(name, RECORDING).ok_or_else(no_run)?;
        // Whoever else wants a run waits until this one is open: it may be the same.
        let mut opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = opened.iter().position(|run| run.name == name) {
            let run = opened.remove(at);
            if run.read_us().is_ok() && run.state == state(&run.files) {
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

    fn read(&self, name: &str, recording_path: PathBuf) -> Result<Opened, Refusal> {
        let recording = self.shelf.recording(name).map_err(damaged)?;
        let length = recording.length_us;
        let recorded = Household::recorded(&recording);
        let (scenario, household) = recorded.map_err(damaged)?;
        let mut view = whole(name, &recording.run(&scenario, &household), &scenario);
        view.days = dates::all(&scenario.calendar, length);

        let walked = self.shelf.walked(name).map(Walked::at).transpose()?;
        let log = self.log(name, &scenario);
        let truth = self.shelf.file_of_run(name, TRUTH);
        let silhouettes = self.shelf.file_of_run(name, SILHOUETTES);
        let folder = recording_path.parent().unwrap_or(Path::new("")).to_owned();
        let mut files = vec![recording_path, folder.join(TRUTH), folder.join(SILHOUETTES)];
        files.extend(log.iter().filter_map(|log| log.file().map(Path::to_owned)));
        files.extend(walked.iter().flat_map(Walked::files));
        // Looked at before they are read: what changes meanwhile is read again.
        let state = state(&files);

        let begun = Instant::now();
        let reading = match (&walked, log) {
            (Some(walked), _) => {
                let rows = walked.rows(&scenario, &mut view, &self.shelf.runs)?;
                Some(Reading::whole(rows, &mut view))
            }
            (None, Some(url)) => {
                let beside = &self.shelf.runs;
                let rows = StoredRows::new(beside, &view, &scenario.calendar, RunTime::MAX).map_err(failed)?;
                let reading = Reading::begin(url, &scenario, recording.is_complete(), &view, rows)?;
                Some(reading)
            }
            (None, None) => {
                view.remarks.push("The folder of this run has no log.".into());
                None
            }
        };

        let mut run = Opened {
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
            run.film = Some(Film::new(path, scenario.clone(), &view));
            view.has_silhouettes = true;
        }
        if let Some(truth) = &truth {
            match run.learn(truth) {
                Err(LogError::NoTruth { .. }) if !recording.is_complete() => {}
                learnt => {
                    run.lived = Some(learnt.map_err(damaged)??);
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

    /// The file of a run's log, if it is in the run's folder.
    pub fn log_of(&self, name: &str) -> Option<PathBuf> {
        let scenario = self.shelf.recording(name).ok()?.scenario().ok()?;
        self.log(name, &scenario)?.file().map(Path::to_owned)
    }

    /// Where a run's log is, the first of them that is in its folder.
    fn log(&self, name: &str, scenario: &Scenario) -> Option<Url> {
        let usual = scheme::USUAL.parse().ok();
        let named = scenario.logger.to.iter().filter_map(|url| url.parse().ok()).chain(usual);
        named.into_iter().find_map(|url: Url| {
            let file = self.shelf.file_within_run(name, url.file()?)?;
            Some(url.at(file))
        })
    }
}

impl Drop for Opened {
    fn drop(&mut self) {
        self.reading.iter().for_each(Reading::stop);
        self.lived.iter().for_each(|lived| lived.coming().stop());
    }
}

impl Opened {
    /// The run does not have the day that was asked for.
    fn no_day(&self) -> Refusal {
        unknown(PageMessage::NoDay { run: readable(self.name.clone()), days: self.view.days.len() })
    }

    /// Up to when log and truth are read; `None` once all of both is. Or why they cannot be.
    fn read_us(&self) -> Result<Option<RunTime>, Refusal> {
        let log = self.reading.as_ref().map_or(Ok(None), |reading| reading.known().read_us())?;
        let truth = self.lived.as_ref().map_or(Ok(None), |lived| lived.coming().known().read_us())?;
        Ok(log.into_iter().chain(truth).min())
    }

    /// What is known by now.
    fn known(&self) -> Result<Arc<PlaybackView>, Refusal> {
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
                view.spans = few(&known.lives().people);
            }
        }
        Ok(match view.read_us {
            None => self.whole.get_or_init(|| Arc::new(view)).clone(),
            Some(_) => Arc::new(view),
        })
    }

    /// What is known once all is read.
    fn whole(&self) -> Result<Arc<PlaybackView>, Refusal> {
        if let Some(reading) = &self.reading {
            drop(reading.until(RunTime::MAX)?);
        }
        self.lives()?;
        self.known()
    }

    /// All that the truth tells of lives, if there is one.
    fn lives(&self) -> Result<Option<&Lives>, Refusal> {
        if self.lives.get().is_none()
            && let Some(lived) = &self.lived
        {
            let whole = lived.whole()?;
            return Ok(Some(self.lives.get_or_init(|| whole)));
        }
        Ok(self.lives.get().map(|lives| &**lives))
    }

    /// Lives of which nothing is told yet; none where there is no truth.
    fn nobody_yet(&self) -> Vec<LifeView> {
        let count = if self.truth.is_some() { self.view.residents.len() } else { 0 };
        vec![LifeView::default(); count]
    }

    /// Tells lives what bodies did in a span, hour by hour, as long as there is time for an answer. Returns up to when.
    fn moved(&self, span: Interval<RunTime>, lives: &mut [LifeView]) -> Result<RunTime, Refusal> {
        let Some(movements) = &self.movements else { return Ok(span.end) };
        let mut movements = movements.lock().unwrap_or_else(PoisonError::into_inner);
        let begun = Instant::now();
        let mut until = span.begin;
        let mut last: Vec<Option<Movement>> = vec![None; lives.len()];
        loop {
            let next = (until - until.since_zero().rem_euclid(HOUR) + HOUR).min(span.end);
            let of = movements.of(Interval::new(until, next)).map_err(damaged)?;
            for ((life, of), last) in lives.iter_mut().zip(of).zip(&mut last) {
                for movement in of {
                    match last {
                        // One that goes on over the hour is found in both.
                        Some(before)
                            if before.time.begin >= movement.time.begin || before.time.end >= movement.time.end => {}
                        Some(before) if goes_on(before, &movement) => {
                            before.time.end = movement.time.end;
                            if let Some(told) = life.movements.last_mut() {
                                told.1 = movement.time.end.micros();
                            }
                        }
                        _ => {
                            life.movements.push(told(&movement));
                            *last = Some(movement);
                        }
                    }
                }
            }
            until = next;
            let told: usize = lives.iter().map(|life| life.movements.len()).sum();
            if until >= span.end || begun.elapsed() >= PIECE || told > MOST_MOVEMENTS {
                return Ok(until);
            }
        }
    }

    /// Opens the truth, and begins to read what it tells of the whole run.
    fn learn(&mut self, truth: &Path) -> Result<Result<Lived, Refusal>, LogError> {
        let names: Vec<String> = self.view.residents.iter().map(|resident| resident.name.clone()).collect();
        let rooms: Vec<String> = self.view.home.rooms.iter().map(|room| room.name.clone()).collect();
        let truth = Url::new(Scheme::Sqlite, truth);
        self.movements = Some(Mutex::new(Movements::open(&truth, &names, self.scale.clone())?));
        Ok(Lived::begin(truth, self.scale.clone(), names, &rooms))
    }
}

/// When a run's folder was made, in milliseconds since 1970.
fn made_ms(folder: &Path) -> Option<i64> {
    let known = fs::metadata(folder).ok()?;
    let made = known.created().or_else(|_| known.modified()).ok()?;
    i64::try_from(made.duration_since(SystemTime::UNIX_EPOCH).ok()?.as_millis()).ok()
}

/// Whether a body keeps still where it has kept still: who is moved by keys is told of sixty times a second.
fn goes_on(before: &Movement, next: &Movement) -> bool {
    let is_still = matches!(next.kind, MovementKind::Rest | MovementKind::Away);
    is_still
        && before.time.end == next.time.begin
        && (before.kind, before.to, before.posture) == (next.kind, next.to, next.posture)
}

pub fn state(files: &[PathBuf]) -> State {
    let look = |path: &PathBuf| fs::metadata(path).and_then(|meta| Ok((meta.modified()?, meta.len()))).ok();
    files.iter().map(look).collect()
}

/// What is known of a run before its log is read.
fn whole(name: &str, run: &Run, scenario: &Scenario) -> PlaybackView {
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
        sensors: Vec::new(),
        values: Vec::new(),
        days: Vec::new(),
        hours: Vec::new(),
        nights: dates::nights(|at| run.home().sun.elevation_sine(at), run.length()),
        has_truth: false,
        activities: Vec::new(),
        spans: Vec::new(),
        walk: None,
        has_silhouettes: false,
        remarks: Vec::new(),
        read_us: None,
    }
}

/// The activities of each person, no more than [`MOST_SPANS`] in all: one that continues after a pause is one, and the shortest are left out.
fn few(people: &[PersonTimeline<RunTime, u32>]) -> Vec<Vec<(i64, i64, u32)>> {
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
    few.iter().map(|activities| activities.iter().map(dates::told).collect()).collect()
}

fn overlapping(episodes: &[NumberedEpisode], time: Interval<RunTime>) -> Vec<(i64, i64, u32)> {
    episodes.iter().filter(|episode| episode.time.overlaps(time)).map(dates::told).collect()
}

fn told(movement: &Movement) -> MovementView {
    let doing = match movement.kind {
        MovementKind::Stride => MotionState::Stride,
        MovementKind::InPlace => MotionState::InPlace,
        MovementKind::Rest => MotionState::Rest,
        MovementKind::Away => MotionState::Away,
    };
    let (from, to) = (movement.from.map(draw::at), movement.to.map(draw::at));
    (movement.time.begin.micros(), movement.time.end.micros(), doing, draw::posture(movement.posture), from, to)
}
