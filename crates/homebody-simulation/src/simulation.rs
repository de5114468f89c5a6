//! The simulation of one run: it advances step by step, stores what happens, and can go back to a snapshot.

mod input;
pub(crate) mod orders;
mod output;
mod storage;

use crate::adaptive_step::AdaptiveStep;
use crate::error::{BoxError, SimulationError, StepError};
use crate::pace::{Pace, PaceKeeper};
use crate::progress::RunProgress;
use crate::run_metrics::RunMetrics;
use homebody_core::calendar::Calendar;
use homebody_core::event::{Events, Fact, Firing};
use homebody_core::home::Home;
use homebody_core::recording::{Recording, RunDigest};
use homebody_core::run::{DriverProvider, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::scene::Scene;
use homebody_core::sensors::Sensor;
use homebody_core::snapshots::Snapshots;
use homebody_core::time::{HOUR, RunTime, Span};
use homebody_log::{Cancel, RunInfo};
use homebody_routine::behaviour::difference::{Difference, Measured, of_run};
use homebody_routine::household::Household;
use input::KeyInput;
use output::RunOutput;
use std::path::PathBuf;
use std::sync::Arc;

/// Longest part of a run in a batch, with however few events.
const LONGEST_BATCH: Span = HOUR;

/// The simulation of a run.
pub struct Simulation {
    pub(crate) scenario: Arc<Scenario>,
    run: Run,
    /// The recording to write or, of a replay, to compare with.
    pub(crate) recording: Recording,
    /// The files that it was read from; no output replaces them.
    pub(crate) sources: Vec<PathBuf>,
    pub(crate) paced: PaceKeeper,
    step: AdaptiveStep,
    events: Events,
    begin: RunTime,
    metrics: RunMetrics,
    output: Option<RunOutput>,
    /// The digest of a replay without output.
    replayed: Option<RunDigest>,
    /// The keys of the resident who is moved by hand.
    input: Option<KeyInput>,
    snapshots: Option<Snapshots<(Run, Option<RunDigest>)>>,
    /// After going back, the run at the end of the part that is already stored.
    furthest: Option<Run>,
}

/// The events of a part of a run.
#[derive(Clone, Copy, Debug)]
pub struct EventBatch<'r> {
    /// The messages that reached the logger, in their order of arrival.
    pub firings: &'r [Firing],
    /// The ground truth that became known.
    pub facts: &'r [Fact],
    /// The start of the part. A fact may reach beyond the end: a movement is reported as it begins.
    pub begin: RunTime,
    /// The end of the part, which is not in it.
    pub end: RunTime,
    /// No later firing has an earlier time than this: before the end where a sensor's clock is behind.
    pub settled: RunTime,
}

/// A receiver of the batches of a run. A closure that takes the simulation and a batch is one, too.
pub trait BatchSink {
    /// Takes the next batch; batches come in order and leave no gap. `run` knows the names behind the numbers in a batch, and
    /// its calendar.
    ///
    /// # Errors
    ///
    /// An error ends the run; nothing more is called then.
    fn take(&mut self, run: &Simulation, batch: EventBatch) -> Result<(), BoxError>;

    /// Completes the result at the end of the run, or where it was cancelled.
    ///
    /// # Errors
    ///
    /// The result could not be completed.
    fn finish(&mut self, _run: &Simulation) -> Result<(), BoxError> {
        Ok(())
    }
}

impl<F: FnMut(&Simulation, EventBatch) -> Result<(), BoxError>> BatchSink for F {
    fn take(&mut self, run: &Simulation, batch: EventBatch) -> Result<(), BoxError> {
        self(run, batch)
    }
}

impl Simulation {
    /// A run at its start, without pace and without output. No output replaces the files in `sources`.
    pub(crate) fn from_parts(
        scenario: Arc<Scenario>,
        run: Run,
        recording: Recording,
        sources: Vec<PathBuf>,
    ) -> Simulation {
        Simulation {
            scenario,
            run,
            recording,
            sources,
            paced: PaceKeeper::new(Pace::default(), Cancel::new(), None),
            step: AdaptiveStep::new(LONGEST_BATCH),
            events: Events::default(),
            begin: RunTime::START,
            metrics: RunMetrics::default(),
            output: None,
            replayed: None,
            input: None,
            snapshots: None,
            furthest: None,
        }
    }

    /// A recorded run at its start, to compare with its recording.
    pub fn replay(
        recording: Recording,
        scenario: Arc<Scenario>,
        household: &Household,
        sources: Vec<PathBuf>,
    ) -> Simulation {
        let run = recording.run(&scenario, household);
        let replayed = Some(RunDigest::default());
        Simulation { replayed, ..Simulation::from_parts(scenario, run, recording, sources) }
    }

    pub(crate) fn paced(self, paced: PaceKeeper) -> Simulation {
        Simulation { paced, ..self }
    }

    /// Reports to these metrics while it is stored.
    pub fn metered(mut self, metrics: &RunMetrics) -> Simulation {
        self.metrics = metrics.clone();
        self
    }

    /// Sets the size of its steps.
    pub fn stepping(mut self, step: AdaptiveStep) -> Simulation {
        self.step = step;
        self
    }

    /// Keeps a snapshot about every so often, to [`Simulation::rewind`] to.
    pub fn with_snapshots(mut self, every: Span) -> Simulation {
        self.snapshots = Some(Snapshots::new(every));
        self
    }

    /// The same run with other drivers, at its start.
    pub fn driven_by(mut self, drivers: &dyn DriverProvider) -> Simulation {
        self.run = Run::new(&self.scenario, drivers, self.recording.seed, self.recording.length_us);
        self
    }

    /// Simulates one step at most until an instant, and stores its events; after going back, at most to where the output ends.
    ///
    /// # Errors
    ///
    /// A driver or a destination failed. After the error of a driver, [`Simulation::events`] has all events before it.
    pub fn step(&mut self, until: RunTime) -> Result<(), StepError> {
        self.events.clear();
        self.begin = self.run.now();
        if let Some(snapshots) = &mut self.snapshots {
            snapshots.keep(self.begin, || (self.run.clone(), self.replayed.clone()));
        }
        let stored_to = self.furthest.as_ref().map(Run::now);
        let done = self.step.advance(&mut self.run, stored_to.unwrap_or(until).min(until), &mut self.events);
        match &mut self.output {
            Some(output) if stored_to.is_none() => {
                output.store(&self.run, &self.events, self.input.as_ref()).map_err(StepError::Log)?;
            }
            Some(_) => {}
            None => self.replayed.iter_mut().for_each(|digest| digest.add(&self.events.firings)),
        }
        self.furthest.take_if(|furthest| furthest.now() <= self.run.now());
        done.map_err(StepError::Driver)
    }

    /// Simulates the next step at its own pace; false at the end of the run, or when it is cancelled.
    pub(crate) fn next_step(&mut self) -> Result<bool, StepError> {
        self.events.clear();
        self.begin = self.run.now();
        if self.is_over() {
            return Ok(false);
        }
        let Some(until) = self.paced.next(self.begin) else { return Ok(false) };
        match self.step(until) {
            // The events before the error of a driver come first; the next step repeats the error without events.
            Err(StepError::Driver(_)) if !self.events.is_empty() => Ok(true),
            step => step.map(|()| true),
        }
    }

    /// Simulates the next part and returns its events: at most an hour of the run, less at a limited pace, nothing while it is
    /// paused. `None` at its end, or when it is cancelled.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Driver`] if a driver of the caller's own made a decision that is not possible.
    pub fn next_batch(&mut self) -> Result<Option<EventBatch<'_>>, SimulationError> {
        Ok(if self.next_step()? { Some(self.batch()) } else { None })
    }

    /// Simulates up to an instant, or to the end of the run if that is earlier, and returns the events since the last call.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Driver`] if a driver of the caller's own made a decision that is not possible.
    pub fn advance_to(&mut self, until: RunTime) -> Result<EventBatch<'_>, SimulationError> {
        let (begin, mut events) = (self.run.now(), Events::default());
        let until = until.min(self.end());
        while self.run.now() < until && !self.paced.is_cancelled() {
            self.step(until)?;
            events.firings.append(&mut self.events.firings);
            events.facts.append(&mut self.events.facts);
            events.frames.append(&mut self.events.frames);
        }
        (self.begin, self.events) = (begin, events);
        Ok(self.batch())
    }

    /// Simulates the run to its end, and gives all batches to a sink; `progress` is called after each. Returns the progress.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Sink`] if the sink fails, [`SimulationError::Driver`] if a driver of the caller's own does.
    pub fn run_into(
        mut self,
        sink: &mut dyn BatchSink,
        mut progress: impl FnMut(RunProgress),
    ) -> Result<RunProgress, SimulationError> {
        while self.next_step()? {
            sink.take(&self, self.batch()).map_err(|source| SimulationError::Sink { source })?;
            progress(self.progress());
        }
        sink.finish(&self).map_err(|source| SimulationError::Sink { source })?;
        Ok(self.progress())
    }

    /// Goes back to the last snapshot before an instant, from where it continues as before without storing anything twice.
    /// Returns the instant of the snapshot. `None` without one, and if the run was stopped: its output cannot grow any more.
    pub fn rewind(&mut self, to: RunTime) -> Option<RunTime> {
        let came_to = self.furthest.as_ref().unwrap_or(&self.run).now();
        let is_stored = self.output.is_some() && !self.is_replay();
        if is_stored && !self.is_recording() && came_to < self.end() {
            return None;
        }
        let (run, replayed) = self.snapshots.as_ref()?.nearest_before(to)?.clone();
        let before = std::mem::replace(&mut self.run, run);
        if is_stored {
            self.furthest.get_or_insert(before);
        }
        self.replayed = replayed;
        self.events.clear();
        Some(self.run.now())
    }

    /// True of a replay.
    pub fn is_replay(&self) -> bool {
        self.replayed.is_some()
    }

    /// Whether a finished replay has the same firings as its recording; `None` for any other run.
    pub fn matches_recording(&self) -> Option<bool> {
        let digest = self.replayed.as_ref().filter(|_| self.is_over())?;
        Some(digest.firings() == self.recording.firings && digest.hex() == self.recording.sha256)
    }

    /// The events of the last step.
    pub fn events(&self) -> &Events {
        &self.events
    }

    fn batch(&self) -> EventBatch<'_> {
        let Events { firings, facts, .. } = &self.events;
        EventBatch { firings, facts, begin: self.begin, end: self.run.now(), settled: self.run.settled() }
    }

    /// The end of the simulated part.
    pub fn now(&self) -> RunTime {
        self.run.now()
    }

    /// No later firing has an earlier time than this.
    pub fn settled(&self) -> RunTime {
        self.run.settled()
    }

    /// The end of the run.
    pub fn end(&self) -> RunTime {
        RunTime::START + self.run.length()
    }

    /// True at the end of the run.
    pub fn is_over(&self) -> bool {
        self.run.now().since_zero() >= self.run.length()
    }

    /// The simulated part and the whole length.
    pub fn progress(&self) -> RunProgress {
        RunProgress { done: self.run.now().since_zero(), length: self.run.length() }
    }

    /// The state of the home and of all bodies now.
    pub fn scene(&self) -> Scene {
        self.run.scene()
    }

    /// The scene now; at the start of the run that of the first instant, at which all bodies have their places.
    pub fn opening_scene(&self) -> Scene {
        if self.run.now() > RunTime::START {
            return self.run.scene();
        }
        let mut first = self.run.clone();
        // The first step reports an error of a driver.
        let _ = first.advance(RunTime::START + Span::MICROSECOND, &mut Events::default());
        Scene { now: RunTime::START, ..first.scene() }
    }

    /// The sentences of routines that have not come true so far: planned and not done, far from their times, or never in force. The
    /// largest loss comes first. Before the end of the run, what has had no occasion is not judged.
    pub fn differences(&self) -> Vec<Difference> {
        of_run(&self.run, if self.is_over() { Measured::Run } else { Measured::Sample })
    }

    /// The scenario of the run.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The recording of the run, complete once its files are.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The description of the run that its log has.
    pub fn info(&self) -> RunInfo {
        RunInfo::of(&self.scenario, &self.run, &self.recording)
    }

    /// The calendar of the home, which dates its instants.
    pub fn calendar(&self) -> &Calendar {
        &self.scenario.calendar
    }

    /// The home, with its rooms and things in the order in which facts number them.
    pub fn home(&self) -> &Home {
        self.run.home()
    }

    /// The sensors, in the order in which firings number them.
    pub fn placed_sensors(&self) -> &[Sensor] {
        self.run.sensors()
    }

    /// The names of the sensors, in the order in which firings number them.
    pub fn sensors(&self) -> impl Iterator<Item = &str> {
        self.run.sensors().iter().map(|sensor| sensor.name.as_str())
    }

    /// The names of the residents and then of the visitors, in the order in which facts number them.
    pub fn residents(&self) -> Vec<String> {
        self.run.names()
    }

    /// The seed of all randomness.
    pub fn seed(&self) -> u64 {
        self.recording.seed
    }
}
