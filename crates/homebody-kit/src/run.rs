//! A run: what it is to be, and living it, by hand or into destinations.

use crate::VERSION;
use crate::error::{BoxError, Error};
use crate::meters::Meters;
use crate::outside::Asked;
use crate::own_driver::{MakeDriver, Provider};
use crate::pace::{Command, Pace, Paced};
use crate::scenario::OpenScenario;
use crate::stretch::Stretch;
use homebody_core::drivers::Driver;
use homebody_core::event::{Events, Fact, Firing};
use homebody_core::home::Home;
use homebody_core::recording::{LONGEST, Recording};
use homebody_core::run::Run;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::load::Scenario;
use homebody_core::scene::Scene;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_log::Cancel;
use homebody_routine::household::Household;
use homebody_routine::living::account::Difference;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// What a run is to be; made by [`OpenScenario::run`]. What is not asked for is as the scenario says.
///
/// ```
/// let scenario = homebody_kit::template("tigerplace-depression")?;
/// let mut run = scenario.run().seed(7).days(2).without(["depression"]).start()?;
/// let mut firings = 0;
/// while let Some(batch) = run.next_batch()? {
///     firings += batch.firings.len();
/// }
/// assert!(firings > 100);
/// # Ok::<(), homebody_kit::Error>(())
/// ```
pub struct RunSetup {
    scenario: OpenScenario,
    seed: Option<u64>,
    length: Length,
    without: Vec<String>,
    numbers: BTreeMap<String, f64>,
    one_of_many: bool,
    drivers: BTreeMap<String, MakeDriver>,
    pace: Pace,
    commands: Option<Receiver<Command>>,
    outside: Option<Receiver<Asked>>,
    cancel: Cancel,
}

/// How long a run is to be.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Length {
    /// As the scenario says.
    Own,
    /// Of the home's own time: a day on which clocks change has 23 or 25 hours.
    Days(f64),
    Span(Micros),
}

impl Length {
    /// That long from the start of a run of this scenario, in microseconds.
    pub fn of(self, scenario: &Scenario) -> Result<Micros, Error> {
        let days = match self {
            Length::Own => scenario.file.days,
            Length::Days(days) => days,
            Length::Span(span) => span as f64 / DAY as f64,
        };
        let wrong = Error::Length { days };
        if !(days > 0.0 && days <= (LONGEST / DAY) as f64) {
            return Err(wrong);
        }
        let span = match self {
            Length::Span(span) => span,
            _ => scenario.calendar.span_of_days(days),
        };
        if span > 0 { Ok(span) } else { Err(wrong) }
    }
}

impl OpenScenario {
    /// A run of it, as its files say unless something else is asked for.
    pub fn run(&self) -> RunSetup {
        RunSetup::new(self.clone())
    }
}

impl RunSetup {
    pub(crate) fn new(scenario: OpenScenario) -> RunSetup {
        RunSetup {
            scenario,
            seed: None,
            length: Length::Own,
            without: Vec::new(),
            numbers: BTreeMap::new(),
            one_of_many: false,
            drivers: BTreeMap::new(),
            pace: Pace::default(),
            commands: None,
            outside: None,
            cancel: Cancel::new(),
        }
    }

    /// The number all randomness comes from.
    pub fn seed(mut self, seed: u64) -> RunSetup {
        self.seed = Some(seed);
        self
    }

    /// How many days of the home's own time it lasts: one on which clocks change has 23 or 25 hours.
    pub fn days(mut self, days: impl Into<f64>) -> RunSetup {
        self.length = Length::Days(days.into());
        self
    }

    /// How long it lasts, in microseconds.
    pub fn length(mut self, length: Micros) -> RunSetup {
        self.length = Length::Span(length);
        self
    }

    /// Conditions that the routines show and this run leaves out. What they do not touch draws the same random numbers with
    /// them and without.
    pub fn without(mut self, conditions: impl IntoIterator<Item = impl Into<String>>) -> RunSetup {
        self.without.extend(conditions.into_iter().map(Into::into));
        self
    }

    /// A number of the models is otherwise than it is, or than the scenario says; [`numbers`](crate::numbers) knows all. It is
    /// in the recording, with the scenario's own file.
    pub fn number(mut self, name: impl Into<String>, value: f64) -> RunSetup {
        self.numbers.insert(name.into(), value);
        self
    }

    /// Its residents are one of many: not quite as their routines are written, but as people differ, each seed in its own
    /// way.
    pub fn one_of_many(mut self) -> RunSetup {
        self.one_of_many = true;
        self
    }

    /// A resident, by name, is moved by this driver instead of what their file says. It is made when the run begins, from
    /// the home and the seed; it draws its random numbers from [`homebody_core::random::Stream`]s of its own names.
    ///
    /// The recording of such a run tells whom it moved, and cannot be lived again: the scenario's files alone are not enough.
    pub fn driver<D: Driver + 'static>(
        mut self,
        resident: impl Into<String>,
        make: impl Fn(&Arc<Home>, u64) -> D + Send + Sync + 'static,
    ) -> RunSetup {
        self.drivers.insert(resident.into(), Arc::new(move |home, seed| Box::new(make(home, seed))));
        self
    }

    /// How fast it goes by the clock on the wall; as fast as it can without this. It changes no byte of a log.
    pub fn pace(mut self, pace: Pace) -> RunSetup {
        self.pace = pace;
        self
    }

    /// What is said through this channel is done while the run is lived. Each command waits until a step before it is done;
    /// when nobody is left to say anything, the run goes on.
    pub fn commands(mut self, commands: impl Into<Option<Receiver<Command>>>) -> RunSetup {
        self.commands = commands.into();
        self
    }

    /// What is asked for through this channel is done to the run while it is stored: see [`outside`](crate::outside).
    pub fn outside(mut self, asked: Receiver<Asked>) -> RunSetup {
        self.outside = Some(asked);
        self
    }

    /// The run ends early once this handle says so.
    pub fn cancel(mut self, cancel: &Cancel) -> RunSetup {
        self.cancel = cancel.clone();
        self
    }

    /// The run at its beginning.
    ///
    /// # Errors
    ///
    /// [`Error::Problems`] if nobody shows a condition that is to be left out, or a number cannot be set like that,
    /// [`Error::Length`] if it can not be this long, [`Error::Resident`] if nobody has the name of whom a driver is to move.
    pub fn start(self) -> Result<LiveRun, Error> {
        let opened = self.scenario.with_numbers(self.numbers)?;
        let OpenScenario { scenario, source, .. } = &opened;
        let length = self.length.of(scenario)?;
        let household = opened.household_without(&self.without)?;
        let household = if self.one_of_many { Arc::new(household.one_of_many()) } else { household };
        let own_drivers = self.drivers.keys().cloned().collect();
        let mut own = BTreeMap::new();
        for (name, make) in self.drivers {
            let index = scenario.residents.iter().position(|resident| resident.file.name == name);
            let known = || scenario.residents.iter().map(|resident| resident.file.name.clone()).collect();
            own.insert(index.ok_or_else(|| Error::Resident { name, known: known() })?, make);
        }
        let seed = self.seed.unwrap_or(scenario.file.seed);
        let recording = Recording::of(scenario, VERSION, source.entry(), seed, length);
        let (without, one_of_many) = (self.without, self.one_of_many);
        let recording = Recording { without, one_of_many, own_drivers, ..recording };
        let provider = Provider { household: &household, own: &own };
        let run = Run::new(scenario, &provider, seed, length);
        let mut pace = self.pace;
        pace.count_from(0);
        let mut paced = Paced::new(pace, self.cancel, self.commands);
        paced.outside.extend(self.outside);
        Ok(LiveRun { paced, ..LiveRun::of(scenario.clone(), run, recording, opened.paths()) })
    }
}

/// Longest part of a run in a batch, with however few events.
const LONGEST_BATCH: Micros = 3600 * SECOND;

/// A run that is being lived.
pub struct LiveRun {
    pub(crate) scenario: Arc<Scenario>,
    pub(crate) run: Run,
    /// What to record of it, or, if it has a digest already, what it is to be the same as.
    pub(crate) recording: Recording,
    /// The files that it comes from, which nothing replaces.
    pub(crate) sources: Vec<PathBuf>,
    pub(crate) paced: Paced,
    pub(crate) stretch: Stretch,
    pub(crate) events: Events,
    /// Where the last batch begins.
    pub(crate) begin: Micros,
    /// What others see of it.
    pub(crate) meters: Meters,
}

impl LiveRun {
    /// The sentences of routines whose lives, as far as the run has come, differ from their words: planned and not done, for
    /// want of time or of a way; far from their times; never in force.
    pub fn differences(&self) -> Vec<Difference> {
        Household::differences(&self.run)
    }
}

/// What has happened in a part of a run.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'r> {
    /// What has reached the logger, in the order in which it has.
    pub firings: &'r [Firing],
    /// The truth that has become known.
    pub facts: &'r [Fact],
    /// From when to when it goes, in microseconds since the run's start. A fact may reach beyond its end: a movement is
    /// told as it begins.
    pub begin: Micros,
    /// Its end is not part of it.
    pub end: Micros,
    /// No firing to come bears an earlier time than this: before the batch's end where a sensor's clock is behind.
    pub settled: Micros,
}

/// How far a run, or a cohort, has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// How much has been lived, in microseconds.
    pub lived: Micros,
    /// Of how much.
    pub length: Micros,
}

/// What takes the batches of a run, as a caller writes it.
///
/// A closure that takes the run and a batch is one, too.
pub trait BatchSink {
    /// Takes what has happened since the last time; batches come in order and leave no gap. `run` knows the names that the
    /// numbers in a batch stand for, and its calendar.
    ///
    /// # Errors
    ///
    /// An error ends the run; nothing more is called then.
    fn take(&mut self, run: &LiveRun, batch: Batch) -> Result<(), BoxError>;

    /// Completes what was taken: the run is over, at its end or where it was cancelled.
    ///
    /// # Errors
    ///
    /// What was taken could not be completed.
    fn finish(&mut self, _run: &LiveRun) -> Result<(), BoxError> {
        Ok(())
    }
}

impl<F: FnMut(&LiveRun, Batch) -> Result<(), BoxError>> BatchSink for F {
    fn take(&mut self, run: &LiveRun, batch: Batch) -> Result<(), BoxError> {
        self(run, batch)
    }
}

impl LiveRun {
    /// A run as fast as it goes, with nobody to cancel it.
    pub(crate) fn of(scenario: Arc<Scenario>, run: Run, recording: Recording, sources: Vec<PathBuf>) -> LiveRun {
        let paced = Paced::new(Pace::default(), Cancel::new(), None);
        let (stretch, events) = (Stretch::new(LONGEST_BATCH), Events::default());
        let meters = Meters::default();
        LiveRun { scenario, run, recording, sources, paced, stretch, events, begin: 0, meters }
    }

    /// Goes at this pace from now on, until it is cancelled.
    pub(crate) fn keep_pace(&mut self, pace: Pace, cancel: &Cancel) {
        self.paced = Paced::new(pace, cancel.clone(), None);
    }

    /// What is to be seen of it while it is lived is told there.
    pub fn metered(mut self, meters: &Meters) -> LiveRun {
        self.meters = meters.clone();
        self
    }

    /// Lives on, and returns what has happened: at most an hour of the run, less where it goes at a pace, nothing at all
    /// while it is paused. `None` once it is over, or cancelled.
    ///
    /// # Errors
    ///
    /// [`Error::Driver`] if a driver of the caller's own decided what nobody can do.
    pub fn next_batch(&mut self) -> Result<Option<Batch<'_>>, Error> {
        Ok(if self.live_on()? { Some(self.batch()) } else { None })
    }

    /// Lives on to an instant, in microseconds since the run's start, or to the end of the run if that is earlier, and returns
    /// what has happened since the last time.
    ///
    /// # Errors
    ///
    /// [`Error::Driver`] if a driver of the caller's own decided what nobody can do.
    pub fn live_until(&mut self, until: Micros) -> Result<Batch<'_>, Error> {
        self.events.clear();
        self.begin = self.run.now();
        let until = until.min(self.run.length());
        while self.run.now() < until && !self.paced.is_cancelled() {
            self.stretch.live(&mut self.run, until, &mut self.events)?;
        }
        Ok(self.batch())
    }

    /// What it looks like now.
    pub fn scene(&self) -> Scene {
        self.run.scene()
    }

    /// Lives the run to its end and gives all of it to a sink; `progress` is called after each batch. Returns how far it has
    /// come.
    ///
    /// # Errors
    ///
    /// [`Error::Sink`] if the sink fails, [`Error::Driver`] if a driver of the caller's own does.
    pub fn give_to(mut self, sink: &mut dyn BatchSink, mut progress: impl FnMut(Progress)) -> Result<Progress, Error> {
        while self.live_on()? {
            sink.take(&self, self.batch()).map_err(|source| Error::Sink { source })?;
            progress(self.progress());
        }
        sink.finish(&self).map_err(|source| Error::Sink { source })?;
        Ok(self.progress())
    }

    /// How far it has come.
    pub fn progress(&self) -> Progress {
        Progress { lived: self.run.now(), length: self.run.length() }
    }

    /// The scenario that it is of.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// What its instants are by the clock of the home.
    pub fn calendar(&self) -> &Calendar {
        &self.scenario.calendar
    }

    /// The home, with its rooms and things in the order in which facts number them.
    pub fn home(&self) -> &Home {
        self.run.home()
    }

    /// The names of its sensors, in the order in which firings number them.
    pub fn sensors(&self) -> impl Iterator<Item = &str> {
        self.run.sensors().iter().map(|sensor| sensor.name.as_str())
    }

    /// The names of its residents, and then of those who visit them, in the order in which facts number them.
    pub fn residents(&self) -> Vec<String> {
        self.run.names()
    }

    /// The number all its randomness comes from.
    pub fn seed(&self) -> u64 {
        self.recording.seed
    }

    /// Lives on as far as its pace allows; false once it is over.
    pub(crate) fn live_on(&mut self) -> Result<bool, Error> {
        self.events.clear();
        self.begin = self.run.now();
        if self.begin >= self.run.length() {
            return Ok(false);
        }
        let Some(until) = self.paced.next(self.begin) else { return Ok(false) };
        let lived = self.stretch.live(&mut self.run, until, &mut self.events);
        // What happened before a driver went wrong is handed on first; asked again, the run says the same with nothing new.
        if self.events.is_empty() {
            lived?;
        }
        Ok(true)
    }

    /// What has happened as it lived on.
    fn batch(&self) -> Batch<'_> {
        let Events { firings, facts, .. } = &self.events;
        Batch { firings, facts, begin: self.begin, end: self.run.now(), settled: self.run.settled() }
    }
}
