//! One run on the stage: the scenario that it is of, who is driven in it, and the files that it leaves.

use crate::dates;
use crate::desk;
use crate::draw;
use crate::driven::drive;
use crate::effort::AT_ONCE;
use crate::growth::Growth;
use crate::input_keeper::{InputKeeper, input_text};
use crate::looks::Looks;
use crate::messages::StageMessage;
use crate::refusal::sentence;
use crate::shelf::Shelf;
use crate::wire::{FiringView, Frame, Key, Posture, ResidentView, RunView, State, Tell};
use homebody_core::drivers::input::Input;
use homebody_core::event::{Events, Fact};
use homebody_core::ids::ResidentId;
use homebody_core::problem::{Diagnose, Diagnostic, Problem, Problems};
use homebody_core::recording::{Recording, RunDigest};
use homebody_core::run::Run;
use homebody_core::scenario::input::{self, KeysFile, UseFile};
use homebody_core::scenario::load::{Files, Scenario};
use homebody_core::scenario::path;
use homebody_core::scene::Scene;
use homebody_core::sensors::Sensor;
use homebody_core::snapshots::Snapshots;
use homebody_core::time::{DAY, Micros, SECOND, micros, seconds};
use homebody_kit::Stretch;
use homebody_log::{How, LogError, Places, RowText, Rows, RunLog, Stored};
use homebody_routine::household::Household;
use std::collections::{BTreeMap, VecDeque};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// What a run is begun with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Start {
    /// The resident who is moved by keys.
    pub driven: Option<u32>,
    pub without: Vec<String>,
    pub seed: Option<u64>,
    /// What was done at the keys already, to be done again.
    pub input: Vec<KeysFile>,
}

/// Why a run cannot be begun.
#[derive(Clone, Debug)]
pub enum Unbegun {
    /// What is wrong with the scenario.
    Problems(Vec<Problem>),
    /// Another reason.
    Why(Diagnostic),
}

impl From<Problems> for Unbegun {
    fn from(problems: Problems) -> Unbegun {
        Unbegun::Problems(problems.0)
    }
}

impl From<Diagnostic> for Unbegun {
    fn from(why: Diagnostic) -> Unbegun {
        Unbegun::Why(why)
    }
}

impl From<StageMessage> for Unbegun {
    fn from(why: StageMessage) -> Unbegun {
        Unbegun::Why(why.diagnostic())
    }
}

impl From<LogError> for Unbegun {
    fn from(why: LogError) -> Unbegun {
        Unbegun::Why(why.diagnostic())
    }
}

impl Unbegun {
    pub fn tell(&self) -> Tell {
        match self {
            Unbegun::Why(why) => {
                let code = (!why.code.is_empty()).then(|| why.code.to_owned());
                Tell::Unbegun { why: sentence(why), problems: Vec::new(), code }
            }
            Unbegun::Problems(problems) => {
                let why = match problems.len() {
                    1 => "Cannot start a run: the scenario has a problem.".to_owned(),
                    count => format!("Cannot start a run: the scenario has {count} problems."),
                };
                Tell::Unbegun { why, problems: desk::problems(problems), code: None }
            }
        }
    }
}

/// A run that is being lived, with everything that belongs to it.
pub struct StagedRun {
    pub start: Start,
    scenario: Scenario,
    /// The conditions that its residents show.
    conditions: Vec<String>,
    run: Run,
    recording: Recording,
    /// The file that the keys are recorded into, if somebody is driven.
    keys: Option<String>,
    /// How much of what is done at the keys was in the scenario when the run began.
    known_input: usize,
    /// The keys that are held.
    held: KeysFile,
    files: Option<Written>,
    /// Whether it is a recording lived again, which leaves no files.
    is_replay: bool,
    /// Of a replay: the files of any other run have their own.
    digest: RunDigest,
    rows: Rows,
    growth: Arc<Mutex<Growth>>,
    /// What the log has got that nobody has taken to show yet.
    fresh: Vec<FiringView>,
    /// How many rows it has got of each sensor.
    counts: Vec<u64>,
    looks: Looks,
    activities: Vec<Option<String>>,
    /// Its files are complete.
    is_over: bool,
    events: Events,
    /// How much is lived at once where it goes as fast as it can, before the clock is looked at again.
    stretch: Stretch,
    /// What it was like every few days. Nobody is driven in it.
    moments: Snapshots<Moment>,
    /// Who has gone back looks at what is stored already: how far the run had come before.
    furthest: Option<Run>,
}

/// What a run was like at an instant, to go back to.
#[derive(Clone)]
struct Moment {
    run: Run,
    digest: RunDigest,
    rows: Rows,
    growth: Growth,
    counts: Vec<u64>,
    activities: Vec<Option<String>>,
}

/// Initial distance between saved moments (our choice): a simulation between them takes some milliseconds.
const MOMENTS: Micros = 4 * DAY;

/// Longest stretch that is simulated at once (our choice).
const LONGEST_STRETCH: Micros = 60 * SECOND;

/// Time before the chosen moment that is simulated, too, for the rows that are shown (our choice).
const SHOWN_BEFORE: Micros = 6 * 3600 * SECOND;

struct Written {
    places: Places,
    /// Until they are complete.
    log: Option<RunLog>,
    /// Until then, if somebody is driven.
    input: Option<InputKeeper>,
    /// What has happened and waits to be stored until the recording has the input that caused it.
    waiting: VecDeque<Waiting>,
    /// Up to here all is stored.
    stored_to: Micros,
}

/// What has happened in a part of a run.
struct Waiting {
    /// How many lines of input there were.
    lines: usize,
    now: Micros,
    settled: Micros,
    events: Events,
}

impl Written {
    /// Takes what has happened by now, and stores all of which the recording has the input.
    fn store(&mut self, run: &Run, events: &Events, input: &[KeysFile]) -> Result<(), LogError> {
        let Some(log) = &mut self.log else { return Ok(()) };
        let Some(keeper) = &mut self.input else {
            log.store(run, events)?;
            self.stored_to = run.now();
            return Ok(());
        };
        if !events.is_empty() || run.now() > self.waiting.back().map_or(self.stored_to, |last| last.now) {
            let (now, settled) = (run.now(), run.settled());
            self.waiting.push_back(Waiting { lines: input.len(), now, settled, events: events.clone() });
        }
        let kept = keeper.keep(input)?;
        while let Some(first) = self.waiting.front().filter(|first| first.lines <= kept) {
            log.store_settled(first.settled, &first.events)?;
            self.stored_to = first.now;
            self.waiting.pop_front();
        }
        Ok(())
    }

    /// Stores all that has waited: the recording is completed next. Returns the log, and up to when it is stored.
    fn end(&mut self) -> Result<Option<(RunLog, Micros)>, LogError> {
        self.input = None;
        let Some(mut log) = self.log.take() else { return Ok(None) };
        for Waiting { now, settled, events, .. } in self.waiting.drain(..) {
            log.store_settled(settled, &events)?;
            self.stored_to = now;
        }
        Ok(Some((log, self.stored_to)))
    }
}

impl StagedRun {
    /// A run of the scenario of these files, from its start. It leaves files from when it is first advanced.
    pub fn new(files: &dyn Files, entry: &str, start: Start) -> Result<StagedRun, Unbegun> {
        let load = |files: &dyn Files| Household::load(files, entry, &start.without);
        let mut keys = None;
        let (scenario, household) = match start.driven {
            None => load(files)?,
            Some(driven) => {
                // Who is moved by keys lives by no routine: it need not be understood.
                let first = Scenario::load(files, entry)?;
                let (edit, name) = drive(&first, driven as usize, &start.input)?;
                keys = Some(name);
                load(&edit.over(files))?
            }
        };
        let seed = start.seed.unwrap_or(scenario.file.seed);
        let length = scenario.calendar.span_of_days(scenario.file.days);
        let recording = Recording::of(&scenario, homebody_kit::VERSION, entry, seed, length);
        let recording = Recording { without: start.without.clone(), ..recording }.begun();
        let mut run = Run::new(&scenario, &household, seed, recording.length_us);
        if let Some(driven) = start.driven {
            run.open_input(ResidentId(driven));
        }
        Ok(StagedRun::of(scenario, &household, run, recording, keys, start, false)?)
    }

    /// A recording, to be lived again.
    pub fn again(recording: Recording) -> Result<StagedRun, Unbegun> {
        if !recording.lives_again() {
            return Err(StageMessage::OwnDrivers { residents: recording.own_drivers }.into());
        }
        let (scenario, household) = Household::recorded(&recording)?;
        let run = recording.run(&scenario, &household);
        let start = Start { without: recording.without.clone(), ..Start::default() };
        Ok(StagedRun::of(scenario, &household, run, recording, None, start, true)?)
    }

    fn of(
        scenario: Scenario,
        household: &Household,
        run: Run,
        recording: Recording,
        keys: Option<String>,
        start: Start,
        is_replay: bool,
    ) -> Result<StagedRun, LogError> {
        let sensors: Vec<String> = run.sensors().iter().map(|sensor| sensor.name.clone()).collect();
        let rows = Rows::new(&scenario.logger, recording.seed, &sensors, &scenario.calendar)?;
        let bodies = run.names().len();
        let held = start.input.last().cloned().unwrap_or_else(nothing_held);
        let conditions = household.conditions().keys().chain(&start.without).cloned().collect();
        let is_motion = run.sensors().iter().map(Sensor::senses_motion).collect();
        let growth = Growth::new(&scenario.calendar, run.length(), is_motion);
        Ok(StagedRun {
            growth: Arc::new(Mutex::new(growth)),
            known_input: start.input.len(),
            looks: Looks::of(&scenario.home),
            start,
            scenario,
            conditions,
            run,
            recording,
            keys,
            held,
            files: None,
            is_replay,
            digest: RunDigest::default(),
            rows,
            fresh: Vec::new(),
            counts: vec![0; sensors.len()],
            activities: vec![None; bodies],
            is_over: false,
            events: Events::default(),
            stretch: Stretch::new(LONGEST_STRETCH).within(AT_ONCE),
            moments: Snapshots::new(MOMENTS),
            furthest: None,
        })
    }

    pub fn now(&self) -> Micros {
        self.run.now()
    }

    pub fn length(&self) -> Micros {
        self.run.length()
    }

    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// Where its files go, once it has some.
    fn folder(&self) -> Option<&Path> {
        self.files.as_ref()?.places.recording.as_ref()?.parent()
    }

    /// The run as it is told to the pages.
    pub fn view(&self) -> RunView {
        let names = self.run.names().into_iter();
        let radius = |index: usize| self.run.home().field(index, path::Posture::Standing).size.radius_m;
        RunView {
            id: self.folder().and_then(|folder| Some(folder.file_name()?.to_string_lossy().into_owned())),
            scenario: self.scenario.file.name.clone(),
            home: draw::home(&self.scenario.home, &self.run.home().plan, self.run.sensors()),
            residents: names.enumerate().map(|(index, name)| ResidentView { name, radius_m: radius(index) }).collect(),
            driven: self.start.driven,
            conditions: self.conditions.clone(),
            without: self.start.without.clone(),
            days: dates::all(&self.scenario.calendar, self.run.length()),
            nights: dates::nights(|at| self.run.home().sun.elevation_sine(at), self.run.length()),
            length_us: self.run.length(),
            seed: self.recording.seed,
            log: self.files.iter().flat_map(|files| &files.places.log).map(ToString::to_string).collect(),
            replay: self.is_replay,
            files: self.versions(),
        }
    }

    /// The versions of the files that it goes by, as the desk has them.
    fn versions(&self) -> BTreeMap<String, String> {
        let made = |name: &String| Some(name) == self.keys.as_ref();
        let files = self.recording.files.iter().filter(|(name, _)| !self.is_replay && !made(name));
        // Who is driven lives by another driver than their file says.
        let files = files.filter(|(name, _)| {
            self.start.driven.is_none_or(|who| self.scenario.file.residents.get(who as usize) != Some(name))
        });
        files.map(|(name, text)| (name.clone(), desk::version(text))).collect()
    }

    /// The name of the folder into which it is being recorded, until its files are complete.
    pub fn goes_on_in(&self) -> Option<String> {
        let is_open = self.files.as_ref().is_some_and(|files| files.log.is_some());
        self.folder().filter(|_| is_open).and_then(|folder| Some(folder.file_name()?.to_string_lossy().into_owned()))
    }

    /// Lives a stretch: at most until `until`, and at most as far as it had come before somebody went back. True if files have
    /// been begun for it, so that its view is another.
    pub fn advance(&mut self, until: Micros, shelf: &Shelf) -> Result<bool, Diagnostic> {
        let until = until.min(self.run.length());
        if until <= self.run.now() || self.is_over {
            return Ok(false);
        }
        let begins = self.files.is_none() && !self.is_replay;
        if begins {
            self.files = Some(self.open(shelf)?);
        }
        if self.start.driven.is_none() {
            let mut moments = std::mem::replace(&mut self.moments, Snapshots::new(MOMENTS));
            moments.keep(self.run.now(), || self.moment());
            self.moments = moments;
        }
        let stored = self.furthest.as_ref().map(Run::now);
        let lived = self.stretch.live(&mut self.run, stored.unwrap_or(until).min(until), &mut self.events);
        if self.is_replay {
            self.digest.add(&self.events.firings);
        }
        if let Some(files) = self.files.as_mut().filter(|_| stored.is_none()) {
            files.store(&self.run, &self.events, &self.start.input)?;
        }
        self.furthest.take_if(|furthest| furthest.now() <= self.run.now());
        self.growth.lock().unwrap_or_else(PoisonError::into_inner).add(&self.events.firings, self.run.now());
        self.looks.take(&self.events.frames);
        for fact in &self.events.facts {
            if let Fact::Activity { resident, name, .. } = fact {
                self.activities[resident.index()].clone_from(name);
            }
        }
        for row in self.rows.of(&self.events.firings, self.run.settled()) {
            self.counts[row.sensor.index()] += 1;
            self.fresh.push(firing_view(row));
        }
        self.events.clear();
        lived.map(|()| begins).map_err(|error| error.diagnostic())
    }

    fn moment(&self) -> Moment {
        Moment {
            run: self.run.clone(),
            digest: self.digest.clone(),
            rows: self.rows.clone(),
            growth: self.growth.lock().unwrap_or_else(PoisonError::into_inner).clone(),
            counts: self.counts.clone(),
            activities: self.activities.clone(),
        }
    }

    /// Goes back to a moment before `to`, from which it continues as it did: what its log has already is not stored again.
    /// False if the run must be lived anew: in one in which somebody is driven all may go another way from then on, and one
    /// that was stopped has no log any more that could go on.
    pub fn go_back(&mut self, to: Micros) -> bool {
        let came_to = self.furthest.as_ref().unwrap_or(&self.run).now();
        let has_log = self.files.as_ref().is_some_and(|files| files.log.is_some());
        if !(self.is_replay || has_log || came_to == self.run.length()) {
            return false;
        }
        let Some(moment) = self.moments.nearest_before((to - SHOWN_BEFORE).max(0)).cloned() else { return false };
        let before = std::mem::replace(&mut self.run, moment.run);
        if !self.is_replay {
            self.furthest.get_or_insert(before);
        }
        (self.digest, self.rows, self.counts) = (moment.digest, moment.rows, moment.counts);
        self.activities = moment.activities;
        self.growth = Arc::new(Mutex::new(moment.growth));
        self.fresh.clear();
        self.is_over = false;
        true
    }

    fn open(&self, shelf: &Shelf) -> Result<Written, LogError> {
        let places = Places::run(&shelf.runs, &self.scenario)?;
        let log = RunLog::open(&places, &self.scenario, &self.run, &self.recording, How::New)?;
        let input = match (&places.recording, &self.keys) {
            (Some(place), Some(keys)) => {
                let unmade = |source| LogError::File { place: place.display().to_string(), source };
                let keeper = InputKeeper::new(place.clone(), self.recording.clone(), keys.clone(), self.known_input);
                Some(keeper.map_err(unmade)?)
            }
            _ => None,
        };
        Ok(Written { places, log: Some(log), input, waiting: VecDeque::new(), stored_to: 0 })
    }

    /// Has what was done at the keys written, also while the run is paused.
    pub fn keep_input(&mut self) -> Result<(), Diagnostic> {
        let Some(files) = self.files.as_mut().filter(|files| files.input.is_some()) else { return Ok(()) };
        Ok(files.store(&self.run, &Events::default(), &self.start.input)?)
    }

    /// From now on these keys are held.
    pub fn hold(&mut self, keys: &[Key]) {
        self.held.held = keys.iter().map(|&key| key_of(key)).collect();
        self.input(Vec::new());
    }

    /// Who is driven is so from now on.
    pub fn be(&mut self, posture: Posture) {
        self.held.posture = match posture {
            Posture::Standing => path::Posture::Standing,
            Posture::Sitting => path::Posture::Sitting,
            Posture::Lying => path::Posture::Lying,
        };
        self.input(Vec::new());
    }

    /// Who is driven uses a thing.
    pub fn use_thing(&mut self, thing: u32, on: bool) {
        if let Some(known) = self.run.home().plan.things.get(thing as usize) {
            let thing = known.name.clone();
            self.input(vec![UseFile { thing, on }]);
        }
    }

    /// What is done at the keys happens in the run, and is kept for the recording.
    fn input(&mut self, uses: Vec<UseFile>) {
        let Some(driven) = self.start.driven.filter(|_| !self.is_over && !self.is_replay) else { return };
        let line = KeysFile { at_s: seconds(self.run.now()), uses, ..self.held.clone() };
        self.run.input(ResidentId(driven), Input::written(&line, &self.run.home().plan));
        self.start.input.push(line);
    }

    /// The same run from its start, whatever its files have become since, with what was done at the keys before an instant;
    /// from then on no key is held.
    pub fn anew(&self, until: Micros) -> Result<StagedRun, Unbegun> {
        if self.is_replay {
            return StagedRun::again(self.recording.clone());
        }
        let mut input: Vec<KeysFile> =
            self.start.input.iter().filter(|line| micros(line.at_s) < until).cloned().collect();
        if let Some(last) = input.last().filter(|line| !line.held.is_empty()) {
            input.push(KeysFile { at_s: seconds(until), held: Vec::new(), uses: Vec::new(), ..last.clone() });
        }
        StagedRun::new(&self.recording.files, &self.recording.entry, Start { input, ..self.start.clone() })
    }

    /// Completes all files; what is said about it.
    pub fn finish(&mut self) -> Result<Option<String>, Diagnostic> {
        if std::mem::replace(&mut self.is_over, true) {
            return Ok(None);
        }
        if self.is_replay {
            let is_whole = self.run.now() == self.run.length();
            let is_same = self.digest.firings() == self.recording.firings && self.digest.hex() == self.recording.sha256;
            return match (is_whole, is_same) {
                (false, _) => Ok(None),
                (true, true) => Ok(Some("The replay matches the recording, event by event.".into())),
                (true, false) => Err(StageMessage::Differs.diagnostic()),
            };
        }
        self.complete(|log, _, recording, run| log.finish(run, recording))
    }

    /// Ends a run that broke: nothing is asked of it any more, and what it has stored is completed as far as it came.
    pub fn give_up(&mut self) -> Result<Option<String>, Diagnostic> {
        (self.is_over, self.furthest) = (true, None);
        self.events.clear();
        self.complete(|log, now, recording, _| log.give_up(now, recording))
    }

    fn complete(
        &mut self,
        end: impl FnOnce(RunLog, Micros, Recording, &Run) -> Result<(Stored, Recording), LogError>,
    ) -> Result<Option<String>, Diagnostic> {
        let Some(files) = &mut self.files else { return Ok(None) };
        let Some((log, now)) = files.end()? else { return Ok(None) };
        let mut recording = self.recording.clone();
        if let Some(keys) = &self.keys {
            recording.files.insert(keys.clone(), input_text(&self.start.input));
        }
        let furthest = self.furthest.as_ref().unwrap_or(&self.run);
        let (stored, recording) = end(log, now, recording, furthest)?;
        self.recording = recording;
        let folder = self.folder().map(|folder| folder.display().to_string());
        Ok(Some(format!("Stored {} rows in {}.", stored.rows, folder.unwrap_or_default())))
    }

    /// What the run looks like now; rows are apart.
    pub fn frame(&mut self, state: State, speed: Option<f64>) -> Frame {
        let mut scene = self.run.scene();
        if scene.now == 0 {
            // Where everybody is as it begins, the first instant tells.
            let mut first = self.run.clone();
            // What is wrong with it, it says when it is lived.
            let _ = first.advance(1, &mut Events::default());
            scene = Scene { now: 0, ..first.scene() };
        }
        let body = |(index, seen): (usize, &Option<_>)| {
            seen.as_ref().map(|seen| draw::body(seen, self.activities[index].clone()))
        };
        let sensors = self.run.sensors().len();
        Frame {
            now_us: scene.now,
            clock: self.scenario.calendar.wall_clock(scene.now),
            state: if self.is_over { State::Over } else { state },
            speed,
            bodies: scene.bodies.iter().enumerate().map(body).collect(),
            seeing: scene.seeing.iter().filter(|sensor| sensor.index() < sensors).map(|sensor| sensor.0).collect(),
            on: scene.on.iter().map(|thing| thing.0).collect(),
            sun: self.run.home().sun.elevation_sine(scene.now),
            told: self.counts.iter().sum(),
            counts: self.counts.clone(),
            firings: Vec::new(),
            looks: self.looks.at(scene.now, &scene.awake),
        }
    }

    /// What the log has got so far, counted; it goes on growing.
    pub fn growth(&self) -> Arc<Mutex<Growth>> {
        self.growth.clone()
    }

    /// The rows that the log has got since they were taken last.
    pub fn take_rows(&mut self) -> std::vec::Drain<'_, FiringView> {
        self.fresh.drain(..)
    }
}

#[cfg(test)]
impl StagedRun {
    /// The same with other drivers.
    pub fn driven_by(mut self, drivers: &dyn homebody_core::run::DriverProvider) -> StagedRun {
        self.run = Run::new(&self.scenario, drivers, self.recording.seed, self.recording.length_us);
        self
    }
}

fn firing_view(row: RowText) -> FiringView {
    let RowText { seq, at, sensor, time, id, value } = row;
    FiringView { seq, at_us: at, sensor: sensor.0, value: value.clone(), row: Some([time, id, value]) }
}

fn nothing_held() -> KeysFile {
    KeysFile { at_s: 0.0, held: Vec::new(), posture: path::Posture::Standing, uses: Vec::new() }
}

fn key_of(key: Key) -> input::Key {
    match key {
        Key::Up => input::Key::Up,
        Key::Down => input::Key::Down,
        Key::Left => input::Key::Left,
        Key::Right => input::Key::Right,
        Key::Fast => input::Key::Fast,
        Key::Slow => input::Key::Slow,
    }
}
