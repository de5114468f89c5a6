//! The run on the stage: its scenario, the resident who is moved by keys, and its files.

use crate::budget::AT_ONCE;
use crate::folders::HomeFolders;
use crate::live_cameras::LiveCameras;
use crate::live_counts::LiveCounts;
use crate::manual_control::drive;
use crate::messages::StageMessage;
use crate::request_error::{code_of, sentence};
use crate::wire::{FiringView, Key, MapPosture, ResidentView, RunFrame, RunNotice, RunState, RunView};
use crate::{dates, drafts, draw};
use homebody_core::drivers::input::{self, KeysFile, UseFile};
use homebody_core::event::Fact;
use homebody_core::ids::ResidentId;
use homebody_core::posture;
use homebody_core::problem::{Diagnose, Diagnostic, Problem, Problems};
use homebody_core::recording::Recording;
use homebody_core::scenario::load::{Files, Scenario};
use homebody_core::sensors::Sensor;
use homebody_core::snapshots::Snapshots;
use homebody_core::time::{DAY, HOUR, MINUTE, RunTime, Span};
use homebody_log::{LogError, LogRows, RowText, RunPlaces, Stored, WriteMode};
use homebody_routine::household::Household;
use homebody_simulation::{
    AdaptiveStep, OpenScenario, OptionError, PlannedRun, RunOptions, Simulation, SimulationError, StepError,
    VariantOptions,
};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct StartRequest {
    /// The resident who is moved by keys.
    pub driven: Option<u32>,
    pub options: RunOptions,
    /// The input of the keys so far, which is repeated.
    pub input: Vec<KeysFile>,
}

#[derive(Clone, Debug)]
pub enum StartError {
    Problems(Vec<Problem>),
    /// The messages about an option of the run, by its name, with a line for each.
    Option {
        option: &'static str,
        why: String,
        code: Option<String>,
    },
    Other(Diagnostic),
}

impl From<Problems> for StartError {
    fn from(problems: Problems) -> StartError {
        StartError::Problems(problems.0)
    }
}

impl From<Diagnostic> for StartError {
    fn from(why: Diagnostic) -> StartError {
        StartError::Other(why)
    }
}

impl From<StageMessage> for StartError {
    fn from(why: StageMessage) -> StartError {
        StartError::Other(why.diagnostic())
    }
}

impl From<SimulationError> for StartError {
    fn from(error: SimulationError) -> StartError {
        match error {
            SimulationError::Problems(problems) => problems.into(),
            error => StartError::Other(error.diagnostic()),
        }
    }
}

impl From<OptionError> for StartError {
    fn from(OptionError { option, error }: OptionError) -> StartError {
        let message = error.diagnostic();
        let problems = if let SimulationError::Problems(problems) = &error { problems.0.split_first() } else { None };
        let (first, others) = problems.unwrap_or((&message, &[]));
        StartError::in_option(option, first, others)
    }
}

impl From<LogError> for StartError {
    fn from(why: LogError) -> StartError {
        StartError::Other(why.diagnostic())
    }
}

impl StartError {
    pub fn in_option(option: &'static str, first: &Diagnostic, others: &[Diagnostic]) -> StartError {
        // At the field of the option, the place in the file of the scenario says nothing.
        let line = |message: &Diagnostic| sentence(&Diagnostic { file: String::new(), ..message.clone() });
        let lines: Vec<String> = std::iter::once(first).chain(others).map(line).collect();
        StartError::Option { option, why: lines.join("\n"), code: code_of(first) }
    }

    pub fn tell(&self) -> RunNotice {
        let message = |why: String, option: Option<&str>, code: Option<String>| RunNotice::Unbegun {
            why,
            problems: Vec::new(),
            option: option.map(str::to_owned),
            code,
        };
        match self {
            StartError::Other(why) => message(sentence(why), None, code_of(why)),
            StartError::Option { option, why, code } => message(why.clone(), Some(option), code.clone()),
            StartError::Problems(problems) => {
                let why = match problems.len() {
                    1 => "Cannot start a run: the scenario has a problem.".to_owned(),
                    count => format!("Cannot start a run: the scenario has {count} problems."),
                };
                RunNotice::Unbegun { why, problems: drafts::problems(problems), option: None, code: None }
            }
        }
    }
}

/// The run on the stage, with the state that pages see of it.
pub struct StagedRun {
    request: StartRequest,
    /// The versions of its files before the options of the run changed them, as the desk has them.
    files: BTreeMap<String, String>,
    conditions: Vec<String>,
    simulation: Simulation,
    /// The file of keys, if a resident is moved by hand.
    keys: Option<String>,
    held: KeysFile,
    live_counts: Arc<Mutex<LiveCounts>>,
    /// The rows that no page has yet.
    fresh: Vec<FiringView>,
    looks: LiveCameras,
    shown: Shown,
    /// Its files are complete.
    is_over: bool,
    snapshots: Snapshots<(Shown, LiveCounts)>,
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
const SNAPSHOTS: Span = DAY.times(4);

/// Longest step (our choice).
const LONGEST_STEP: Span = MINUTE;

/// Time before the chosen moment that is simulated, too, for the rows that are shown (our choice).
const SHOWN_BEFORE: Span = HOUR.times(6);

impl StagedRun {
    /// A run of the scenario of these files, from its start. It writes files from the first step on.
    pub fn new(files: &dyn Files, entry: &str, request: StartRequest) -> Result<StagedRun, StartError> {
        let mut keys = None;
        let opened = match request.driven {
            None => OpenScenario::from_files(files, entry)?,
            Some(driven) => {
                // A resident who is moved by keys has no routine, so it need not be valid.
                let first = Scenario::load(files, entry)?;
                let (edit, name) = drive(&first, driven as usize, &request.input)?;
                keys = Some(name);
                OpenScenario::from_files(&edit.over(files), entry)?
            }
        };
        let plan = request.options.clone().plan(&opened)?;
        let household = plan.household.clone();
        let simulation = PlannedRun { recording: plan.recording.begun(), ..plan }.simulation();
        let simulation = match (request.driven, &keys) {
            (Some(driven), Some(keys)) => {
                simulation.moved_by_keys(ResidentId(driven), keys.clone(), request.input.clone())
            }
            _ => simulation.with_snapshots(SNAPSHOTS),
        };
        let run = StagedRun::from_simulation(simulation, &household, keys, request)?;
        Ok(StagedRun { files: run.versions(opened.scenario()), ..run })
    }

    pub fn replay(recording: Recording) -> Result<StagedRun, StartError> {
        if !recording.can_replay() {
            return Err(StageMessage::OwnDrivers { residents: recording.own_drivers }.into());
        }
        let (scenario, household) = Household::recorded(&recording)?;
        let variant = VariantOptions { without: recording.without.clone(), ..VariantOptions::default() };
        let request = StartRequest { options: variant.into(), ..StartRequest::default() };
        let simulation = Simulation::replay(recording, Arc::new(scenario), &household, Vec::new());
        Ok(StagedRun::from_simulation(simulation.with_snapshots(SNAPSHOTS), &household, None, request)?)
    }

    fn from_simulation(
        simulation: Simulation,
        household: &Household,
        keys: Option<String>,
        request: StartRequest,
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
            held: request.input.last().cloned().unwrap_or_else(nothing_held),
            files: BTreeMap::new(),
            conditions: household.conditions().keys().chain(&request.options.variant.without).cloned().collect(),
            request,
            simulation: simulation.stepping(AdaptiveStep::new(LONGEST_STEP).within(AT_ONCE)),
            keys,
            fresh: Vec::new(),
            shown: Shown { rows, counts, activities },
            is_over: false,
            snapshots: Snapshots::new(SNAPSHOTS),
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

    /// The folder of its files, once it has some.
    fn folder(&self) -> Option<&Path> {
        self.simulation.places()?.recording.as_ref()?.parent()
    }

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
            driven: self.request.driven,
            conditions: self.conditions.clone(),
            without: self.request.options.variant.without.clone(),
            days: dates::all_days(&scenario.calendar, length),
            nights: dates::nights(|at| home.sun.elevation_sine(at), length),
            length_us: length.micros(),
            seed: simulation.seed(),
            log: simulation.places().iter().flat_map(|places| &places.log).map(ToString::to_string).collect(),
            replay: simulation.is_replay(),
            files: self.files.clone(),
        }
    }

    fn versions(&self, scenario: &Scenario) -> BTreeMap<String, String> {
        let residents = &scenario.file.residents;
        let files = scenario.sources.iter().filter(|(name, _)| Some(*name) != self.keys.as_ref());
        // The file of a resident who is moved by hand is not in use, so its version does not count.
        let files =
            files.filter(|(name, _)| self.request.driven.is_none_or(|who| residents.get(who as usize) != Some(name)));
        files.map(|(name, text)| (name.clone(), drafts::version(text))).collect()
    }

    /// The name of the folder into which it is recorded, until its files are complete.
    pub fn recording_folder(&self) -> Option<String> {
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
        if self.request.driven.is_none() {
            self.snapshots.keep(self.simulation.now(), || (self.shown.clone(), locked(&self.live_counts).clone()));
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
    pub fn rewind(&mut self, to: RunTime) -> bool {
        let Some(now) = self.simulation.rewind((to - SHOWN_BEFORE).max(RunTime::START)) else { return false };
        let Some((shown, live_counts)) = self.snapshots.nearest_before(now).cloned() else { return false };
        (self.shown, self.live_counts) = (shown, Arc::new(Mutex::new(live_counts)));
        self.fresh.clear();
        self.is_over = false;
        true
    }

    /// Writes the keys, also while the run is paused.
    pub fn keep_input(&mut self) -> Result<(), Diagnostic> {
        Ok(self.simulation.keep_input()?)
    }

    pub fn hold(&mut self, keys: &[Key]) {
        self.held.held = keys.iter().map(|&key| key_of(key)).collect();
        self.input(Vec::new());
    }

    pub fn set_posture(&mut self, posture: MapPosture) {
        self.held.posture = match posture {
            MapPosture::Standing => posture::Posture::Standing,
            MapPosture::Sitting => posture::Posture::Sitting,
            MapPosture::Lying => posture::Posture::Lying,
        };
        self.input(Vec::new());
    }

    pub fn use_thing(&mut self, thing: u32, on: bool) {
        if let Some(known) = self.simulation.home().plan.things.get(thing as usize) {
            let thing = known.name.clone();
            self.input(vec![UseFile { thing, on }]);
        }
    }

    fn input(&mut self, uses: Vec<UseFile>) {
        if !self.is_over {
            let at_s = self.simulation.now().seconds();
            self.simulation.apply_input(KeysFile { at_s, uses, ..self.held.clone() });
        }
    }

    /// The same run from its start, with the files that it started with and the input of the keys before an instant. No key is held from
    /// then on.
    pub fn restarted(&self, until: RunTime) -> Result<StagedRun, StartError> {
        let recording = self.simulation.recording();
        if self.simulation.is_replay() {
            return StagedRun::replay(recording.clone());
        }
        let is_before = |line: &&KeysFile| RunTime::START + Span::from_seconds(line.at_s) < until;
        let mut input: Vec<KeysFile> = self.simulation.input_lines().iter().filter(is_before).cloned().collect();
        if let Some(last) = input.last().filter(|line| !line.held.is_empty()) {
            input.push(KeysFile { at_s: until.seconds(), held: Vec::new(), uses: Vec::new(), ..last.clone() });
        }
        let mut request = StartRequest { input, ..self.request.clone() };
        // The files have them: now would be another start.
        (request.options.start, request.options.numbers) = (None, Vec::new());
        let run = StagedRun::new(&recording.files, &recording.entry, request)?;
        Ok(StagedRun { files: self.files.clone(), ..run })
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

    /// The present state, without rows.
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

    /// The counts of the rows so far; they grow with the run.
    pub fn live_counts(&self) -> Arc<Mutex<LiveCounts>> {
        self.live_counts.clone()
    }

    pub fn take_rows(&mut self) -> std::vec::Drain<'_, FiringView> {
        self.fresh.drain(..)
    }
}

#[cfg(test)]
impl StagedRun {
    pub fn driven_by(mut self, drivers: &dyn homebody_core::run::DriverProvider) -> StagedRun {
        self.simulation = self.simulation.driven_by(drivers);
        self
    }
}

/// A panic leaves a complete value.
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
