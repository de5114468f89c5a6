//! One run on the stage: the scenario that it is of, who is driven in it, and the files that it leaves.

use crate::budget::AT_ONCE;
use crate::folders::HomeFolders;
use crate::live_cameras::LiveCameras;
use crate::live_counts::LiveCounts;
use crate::manual_control::drive;
use crate::messages::StageMessage;
use crate::request_error::sentence;
use crate::wire::{FiringView, Key, MapPosture, ResidentView, RunFrame, RunNotice, RunState, RunView};
use crate::{dates, drafts, draw};
use homebody_core::drivers::input::{self, KeysFile, UseFile};
use homebody_core::event::Fact;
use homebody_core::ids::ResidentId;
use homebody_core::posture;
use homebody_core::problem::{Diagnose, Diagnostic, Problem, Problems};
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::load::{Files, Scenario};
use homebody_core::sensors::Sensor;
use homebody_core::snapshots::Snapshots;
use homebody_core::time::{DAY, HOUR, MINUTE, RunTime, Span};
use homebody_log::{LogError, LogRows, RowText, RunPlaces, Stored, WriteMode};
use homebody_routine::household::Household;
use homebody_simulation::{AdaptiveStep, Simulation, StepError, VERSION};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
    pub fn tell(&self) -> RunNotice {
        match self {
            Unbegun::Why(why) => {
                let code = (!why.code.is_empty()).then(|| why.code.to_owned());
                RunNotice::Unbegun { why: sentence(why), problems: Vec::new(), code }
            }
            Unbegun::Problems(problems) => {
                let why = match problems.len() {
                    1 => "Cannot start a run: the scenario has a problem.".to_owned(),
                    count => format!("Cannot start a run: the scenario has {count} problems."),
                };
                RunNotice::Unbegun { why, problems: drafts::problems(problems), code: None }
            }
        }
    }
}

/// The run on the stage, with the state that pages see of it.
pub struct StagedRun {
    start: Start,
    /// The conditions of its residents.
    conditions: Vec<String>,
    simulation: Simulation,
    /// The file of keys, if a resident is moved by hand.
    keys: Option<String>,
    /// The keys that are held.
    held: KeysFile,
    live_counts: Arc<Mutex<LiveCounts>>,
    /// The rows of the log that no page has got yet.
    fresh: Vec<FiringView>,
    looks: LiveCameras,
    shown: Shown,
    /// Its files are complete.
    is_over: bool,
    /// The state at the snapshots of the simulation.
    moments: Snapshots<(Shown, LiveCounts)>,
}

/// The state that pages see besides the simulation.
#[derive(Clone)]
struct Shown {
    rows: LogRows,
    /// The number of rows of each sensor.
    counts: Vec<u64>,
    activities: Vec<Option<String>>,
}

/// Initial distance between snapshots (our choice): a simulation between them takes some milliseconds.
const MOMENTS: Span = DAY.times(4);

/// Longest step (our choice).
const LONGEST_STEP: Span = MINUTE;

/// Time before the chosen moment that is simulated, too, for the rows that are shown (our choice).
const SHOWN_BEFORE: Span = HOUR.times(6);

impl StagedRun {
    /// A run of the scenario of these files, from its start. It writes files from the first step on.
    pub fn new(files: &dyn Files, entry: &str, start: Start) -> Result<StagedRun, Unbegun> {
        let load = |files: &dyn Files| Household::load(files, entry, &start.without);
        let mut keys = None;
        let (scenario, household) = match start.driven {
            None => load(files)?,
            Some(driven) => {
                // A resident who is moved by keys has no routine, so it need not be valid.
                let first = Scenario::load(files, entry)?;
                let (edit, name) = drive(&first, driven as usize, &start.input)?;
                keys = Some(name);
                load(&edit.over(files))?
            }
        };
        let seed = start.seed.unwrap_or(scenario.file.seed);
        let length = scenario.calendar.span_of_days(scenario.file.days);
        let recording = Recording::new(&scenario, VERSION, entry, seed, length);
        let recording = Recording { without: start.without.clone(), ..recording }.begun();
        let run = Run::new(&scenario, &household, seed, recording.length_us);
        let simulation = Simulation::from_parts(Arc::new(scenario), run, recording, Vec::new());
        let simulation = match (start.driven, &keys) {
            (Some(driven), Some(keys)) => {
                simulation.moved_by_keys(ResidentId(driven), keys.clone(), start.input.clone())
            }
            _ => simulation.with_snapshots(MOMENTS),
        };
        Ok(StagedRun::stage(simulation, &household, keys, start)?)
    }

    /// A recording, to replay.
    pub fn again(recording: Recording) -> Result<StagedRun, Unbegun> {
        if !recording.lives_again() {
            return Err(StageMessage::OwnDrivers { residents: recording.own_drivers }.into());
        }
        let (scenario, household) = Household::recorded(&recording)?;
        let start = Start { without: recording.without.clone(), ..Start::default() };
        let simulation = Simulation::replay(recording, Arc::new(scenario), &household, Vec::new());
        Ok(StagedRun::stage(simulation.with_snapshots(MOMENTS), &household, None, start)?)
    }

    fn stage(
        simulation: Simulation,
        household: &Household,
        keys: Option<String>,
        start: Start,
    ) -> Result<StagedRun, LogError> {
        let scenario = simulation.scenario();
        let sensors: Vec<String> = simulation.sensors().map(str::to_owned).collect();
        let rows = LogRows::new(&scenario.logger, simulation.seed(), &sensors, &scenario.calendar)?;
        let is_motion = simulation.placed_sensors().iter().map(Sensor::senses_motion).collect();
        let live_counts = LiveCounts::new(&scenario.calendar, simulation.progress().length, is_motion);
        let (counts, activities) = (vec![0; sensors.len()], vec![None; simulation.residents().len()]);
        Ok(StagedRun {
            live_counts: Arc::new(Mutex::new(live_counts)),
            looks: LiveCameras::from_home(&scenario.home),
            held: start.input.last().cloned().unwrap_or_else(nothing_held),
            conditions: household.conditions().keys().chain(&start.without).cloned().collect(),
            start,
            simulation: simulation.stepping(AdaptiveStep::new(LONGEST_STEP).within(AT_ONCE)),
            keys,
            fresh: Vec::new(),
            shown: Shown { rows, counts, activities },
            is_over: false,
            moments: Snapshots::new(MOMENTS),
        })
    }

    pub fn now(&self) -> RunTime {
        self.simulation.now()
    }

    pub fn end(&self) -> RunTime {
        self.simulation.end()
    }

    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// Where its files go, once it has some.
    fn folder(&self) -> Option<&Path> {
        self.simulation.places()?.recording.as_ref()?.parent()
    }

    /// The run as it is told to the pages.
    pub fn view(&self) -> RunView {
        let (simulation, scenario) = (&self.simulation, self.simulation.scenario());
        let (home, length) = (simulation.home(), simulation.progress().length);
        let names = simulation.residents().into_iter();
        let radius = |index: usize| home.field(index, posture::Posture::Standing).size.radius_m;
        RunView {
            id: self.folder().and_then(|folder| Some(folder.file_name()?.to_string_lossy().into_owned())),
            scenario: scenario.file.name.clone(),
            home: draw::home(&scenario.home, &home.plan, simulation.placed_sensors()),
            residents: names.enumerate().map(|(index, name)| ResidentView { name, radius_m: radius(index) }).collect(),
            driven: self.start.driven,
            conditions: self.conditions.clone(),
            without: self.start.without.clone(),
            days: dates::all_days(&scenario.calendar, length),
            nights: dates::nights(|at| home.sun.elevation_sine(at), length),
            length_us: length.micros(),
            seed: simulation.seed(),
            log: simulation.places().iter().flat_map(|places| &places.log).map(ToString::to_string).collect(),
            replay: simulation.is_replay(),
            files: self.versions(),
        }
    }

    /// The versions of the files that it goes by, as the desk has them.
    fn versions(&self) -> BTreeMap<String, String> {
        let made = |name: &String| Some(name) == self.keys.as_ref();
        let (is_replay, residents) = (self.simulation.is_replay(), &self.simulation.scenario().file.residents);
        let files = self.simulation.recording().files.iter().filter(|(name, _)| !is_replay && !made(name));
        // The file of a resident who is moved by hand is not in use, so its version does not count.
        let files =
            files.filter(|(name, _)| self.start.driven.is_none_or(|who| residents.get(who as usize) != Some(name)));
        files.map(|(name, text)| (name.clone(), drafts::version(text))).collect()
    }

    /// The name of the folder into which it is recorded, until its files are complete.
    pub fn goes_on_in(&self) -> Option<String> {
        let folder = self.folder().filter(|_| self.simulation.is_recording())?;
        Some(folder.file_name()?.to_string_lossy().into_owned())
    }

    /// Simulates a step at most until an instant. True if files were opened for it, so that its view has changed.
    pub fn advance(&mut self, until: RunTime, folders: &HomeFolders) -> Result<bool, Diagnostic> {
        let until = until.min(self.end());
        if until <= self.now() || self.is_over {
            return Ok(false);
        }
        let opens = self.simulation.places().is_none() && !self.simulation.is_replay();
        if opens {
            let places = RunPlaces::run(&folders.runs, self.simulation.scenario())?;
            self.simulation.open_output(places, WriteMode::Create)?;
        }
        if self.start.driven.is_none() {
            self.moments.keep(self.simulation.now(), || (self.shown.clone(), locked(&self.live_counts).clone()));
        }
        let step = self.simulation.step(until);
        if let Err(StepError::Log(error)) = step {
            return Err(error.diagnostic());
        }
        self.show_step();
        step.map(|()| opens).map_err(|error| error.diagnostic())
    }

    /// Takes the events of the last step into the state that pages see.
    fn show_step(&mut self) {
        let events = self.simulation.events();
        locked(&self.live_counts).add(&events.firings, self.simulation.now());
        self.looks.take(&events.frames);
        for fact in &events.facts {
            if let Fact::Activity { resident, name, .. } = fact {
                self.shown.activities[resident.index()].clone_from(name);
            }
        }
        for row in self.shown.rows.of(&events.firings, self.simulation.settled()) {
            self.shown.counts[row.sensor.index()] += 1;
            self.fresh.push(firing_view(row));
        }
    }

    /// Goes back to a snapshot before an instant, from where it continues as before. False if a new run is needed: with a resident who is
    /// moved by hand everything may change from there on, and a stopped run has no open files.
    pub fn go_back(&mut self, to: RunTime) -> bool {
        let Some(now) = self.simulation.rewind((to - SHOWN_BEFORE).max(RunTime::START)) else { return false };
        let Some((shown, live_counts)) = self.moments.nearest_before(now).cloned() else { return false };
        (self.shown, self.live_counts) = (shown, Arc::new(Mutex::new(live_counts)));
        self.fresh.clear();
        self.is_over = false;
        true
    }

    /// Writes the keys, also while the run is paused.
    pub fn keep_input(&mut self) -> Result<(), Diagnostic> {
        Ok(self.simulation.keep_input()?)
    }

    /// From now on these keys are held.
    pub fn hold(&mut self, keys: &[Key]) {
        self.held.held = keys.iter().map(|&key| key_of(key)).collect();
        self.input(Vec::new());
    }

    /// Who is driven is so from now on.
    pub fn be(&mut self, posture: MapPosture) {
        self.held.posture = match posture {
            MapPosture::Standing => posture::Posture::Standing,
            MapPosture::Sitting => posture::Posture::Sitting,
            MapPosture::Lying => posture::Posture::Lying,
        };
        self.input(Vec::new());
    }

    /// Who is driven uses a thing.
    pub fn use_thing(&mut self, thing: u32, on: bool) {
        if let Some(known) = self.simulation.home().plan.things.get(thing as usize) {
            let thing = known.name.clone();
            self.input(vec![UseFile { thing, on }]);
        }
    }

    /// Applies input now.
    fn input(&mut self, uses: Vec<UseFile>) {
        if !self.is_over {
            let at_s = self.simulation.now().seconds();
            self.simulation.apply_input(KeysFile { at_s, uses, ..self.held.clone() });
        }
    }

    /// The same run from its start, whatever its files have become since, with what was done at the keys before an instant;
    /// from then on no key is held.
    pub fn anew(&self, until: RunTime) -> Result<StagedRun, Unbegun> {
        let recording = self.simulation.recording();
        if self.simulation.is_replay() {
            return StagedRun::again(recording.clone());
        }
        let is_before = |line: &&KeysFile| RunTime::START + Span::from_seconds(line.at_s) < until;
        let mut input: Vec<KeysFile> = self.simulation.input_lines().iter().filter(is_before).cloned().collect();
        if let Some(last) = input.last().filter(|line| !line.held.is_empty()) {
            input.push(KeysFile { at_s: until.seconds(), held: Vec::new(), uses: Vec::new(), ..last.clone() });
        }
        StagedRun::new(&recording.files, &recording.entry, Start { input, ..self.start.clone() })
    }

    /// Completes all files. Returns the note about it.
    pub fn finish(&mut self) -> Result<Option<String>, Diagnostic> {
        if std::mem::replace(&mut self.is_over, true) {
            return Ok(None);
        }
        if self.simulation.is_replay() {
            return match self.simulation.matches_recording() {
                None => Ok(None),
                Some(true) => Ok(Some("The replay matches the recording, event by event.".into())),
                Some(false) => Err(StageMessage::Differs.diagnostic()),
            };
        }
        let stored = self.simulation.finish()?;
        Ok(self.note(stored))
    }

    /// Ends a run that failed, and completes its files as far as everything is stored.
    pub fn give_up(&mut self) -> Result<Option<String>, Diagnostic> {
        self.is_over = true;
        let stored = self.simulation.give_up()?;
        Ok(self.note(stored))
    }

    fn note(&self, stored: Option<Stored>) -> Option<String> {
        let folder = self.folder().map(|folder| folder.display().to_string()).unwrap_or_default();
        stored.map(|stored| format!("Stored {} rows in {folder}.", stored.rows))
    }

    /// What the run looks like now; rows are apart.
    pub fn frame(&mut self, state: RunState, speed: Option<f64>) -> RunFrame {
        let scene = self.simulation.opening_scene();
        let body = |(index, seen): (usize, &Option<_>)| {
            seen.as_ref().map(|seen| draw::body(seen, self.shown.activities[index].clone()))
        };
        let sensors = self.shown.counts.len();
        RunFrame {
            now_us: scene.now.micros(),
            clock: self.simulation.calendar().wall_clock(scene.now),
            state: if self.is_over { RunState::Over } else { state },
            speed,
            bodies: scene.bodies.iter().enumerate().map(body).collect(),
            seeing: scene.seeing.iter().filter(|sensor| sensor.index() < sensors).map(|sensor| sensor.0).collect(),
            on: scene.on.iter().map(|thing| thing.0).collect(),
            sun: self.simulation.home().sun.elevation_sine(scene.now),
            told: self.shown.counts.iter().sum(),
            counts: self.shown.counts.clone(),
            firings: Vec::new(),
            looks: self.looks.at(scene.now, &scene.awake),
        }
    }

    /// What the log has got so far, counted; it goes on growing.
    pub fn live_counts(&self) -> Arc<Mutex<LiveCounts>> {
        self.live_counts.clone()
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
        self.simulation = self.simulation.driven_by(drivers);
        self
    }
}

/// What a panic leaves in it is whole.
fn locked<T>(held: &Mutex<T>) -> MutexGuard<'_, T> {
    held.lock().unwrap_or_else(PoisonError::into_inner)
}

fn firing_view(row: RowText) -> FiringView {
    let RowText { seq, at, sensor, time, id, value } = row;
    FiringView { seq, at_us: at.micros(), sensor: sensor.0, value: value.clone(), row: Some([time, id, value]) }
}

fn nothing_held() -> KeysFile {
    KeysFile { at_s: 0.0, held: Vec::new(), posture: posture::Posture::Standing, uses: Vec::new() }
}

fn key_of(key: Key) -> input::DriveKey {
    match key {
        Key::Up => input::DriveKey::Up,
        Key::Down => input::DriveKey::Down,
        Key::Left => input::DriveKey::Left,
        Key::Right => input::DriveKey::Right,
        Key::Fast => input::DriveKey::Fast,
        Key::Slow => input::DriveKey::Slow,
    }
}
