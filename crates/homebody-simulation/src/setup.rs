//! The options of a run: its seed, its length, its drivers and its pace.

use crate::VERSION;
use crate::custom_drivers::{CustomDrivers, MakeDriver};
use crate::error::SimulationError;
use crate::interventions::InterventionRequest;
use crate::open_scenario::OpenScenario;
use crate::pace::{Pace, PaceKeeper, RunCommand};
use crate::simulation::Simulation;
use homebody_core::drivers::Driver;
use homebody_core::home::Home;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, LONGEST, RunTime, Span};
use homebody_log::Cancel;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// The options of a run, made by [`OpenScenario::run`]. An option that is not set is as the scenario says.
///
/// ```
/// let scenario = homebody_simulation::template("tigerplace-depression")?;
/// let mut run = scenario.run().seed(7).days(2).without(["depression"]).start()?;
/// let mut firings = 0;
/// while let Some(batch) = run.next_batch()? {
///     firings += batch.firings.len();
/// }
/// assert!(firings > 100);
/// # Ok::<(), homebody_simulation::SimulationError>(())
/// ```
pub struct RunSetup {
    scenario: OpenScenario,
    seed: Option<u64>,
    length: RunLength,
    without: Vec<String>,
    numbers: BTreeMap<String, f64>,
    one_of_many: bool,
    drivers: BTreeMap<String, MakeDriver>,
    pace: Pace,
    commands: Option<Receiver<RunCommand>>,
    interventions: Option<Receiver<InterventionRequest>>,
    cancel: Cancel,
}

/// The length of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RunLength {
    /// That of the scenario.
    Own,
    /// Days of the home's time zone: one on which clocks change has 23 or 25 hours.
    Days(f64),
    Span(Span),
}

impl RunLength {
    /// The length of a run of this scenario.
    pub fn span(self, scenario: &Scenario) -> Result<Span, SimulationError> {
        let days = match self {
            RunLength::Own => scenario.file.days,
            RunLength::Days(days) => days,
            RunLength::Span(span) => span.ratio(DAY),
        };
        let wrong = SimulationError::Length { days };
        if !(days > 0.0 && days <= (LONGEST / DAY) as f64) {
            return Err(wrong);
        }
        let span = match self {
            RunLength::Span(span) => span,
            _ => scenario.calendar.span_of_days(days),
        };
        if span > Span::ZERO { Ok(span) } else { Err(wrong) }
    }
}

impl OpenScenario {
    /// The options of a run of this scenario.
    pub fn run(&self) -> RunSetup {
        RunSetup::new(self.clone())
    }
}

impl RunSetup {
    pub(crate) fn new(scenario: OpenScenario) -> RunSetup {
        RunSetup {
            scenario,
            seed: None,
            length: RunLength::Own,
            without: Vec::new(),
            numbers: BTreeMap::new(),
            one_of_many: false,
            drivers: BTreeMap::new(),
            pace: Pace::default(),
            commands: None,
            interventions: None,
            cancel: Cancel::new(),
        }
    }

    /// Sets the seed of all randomness.
    pub fn seed(mut self, seed: u64) -> RunSetup {
        self.seed = Some(seed);
        self
    }

    /// Sets the length in days of the home's time zone: one on which clocks change has 23 or 25 hours.
    pub fn days(mut self, days: impl Into<f64>) -> RunSetup {
        self.length = RunLength::Days(days.into());
        self
    }

    /// Sets the length.
    pub fn length(mut self, length: Span) -> RunSetup {
        self.length = RunLength::Span(length);
        self
    }

    /// Leaves out conditions of the routines. All that a condition does not affect draws the same random numbers with it and
    /// without it.
    pub fn without(mut self, conditions: impl IntoIterator<Item = impl Into<String>>) -> RunSetup {
        self.without.extend(conditions.into_iter().map(Into::into));
        self
    }

    /// Sets a parameter of the models; [`numbers`](crate::numbers) lists all. The recording has it in the scenario's own file.
    pub fn number(mut self, name: impl Into<String>, value: f64) -> RunSetup {
        self.numbers.insert(name.into(), value);
        self
    }

    /// Lets the residents differ from their routines as people differ, each seed in its own way.
    pub fn one_of_many(mut self) -> RunSetup {
        self.one_of_many = true;
        self
    }

    /// Moves a resident, by name, with the caller's own driver. It is made when the run begins, from the home and the seed; it
    /// draws its random numbers from [`homebody_core::random::Stream`]s of its own names.
    ///
    /// The recording of such a run names the resident, and cannot be replayed: it does not contain the driver.
    pub fn driver<D: Driver + 'static>(
        mut self,
        resident: impl Into<String>,
        make: impl Fn(&Arc<Home>, u64) -> D + Send + Sync + 'static,
    ) -> RunSetup {
        self.drivers.insert(resident.into(), Arc::new(move |home, seed| Box::new(make(home, seed))));
        self
    }

    /// Sets the speed against real time; as fast as possible without it. It changes no byte of a log.
    pub fn pace(mut self, pace: Pace) -> RunSetup {
        self.pace = pace;
        self
    }

    /// Obeys the commands of this channel during the run. A command waits until the step before it is done; when the channel is
    /// closed, a paused run continues.
    pub fn commands(mut self, commands: impl Into<Option<Receiver<RunCommand>>>) -> RunSetup {
        self.commands = commands.into();
        self
    }

    /// Applies the [interventions](crate::interventions) of this channel while the run is stored.
    pub fn interventions(mut self, requests: Receiver<InterventionRequest>) -> RunSetup {
        self.interventions = Some(requests);
        self
    }

    /// Ends the run early when this handle is cancelled.
    pub fn cancel(mut self, cancel: &Cancel) -> RunSetup {
        self.cancel = cancel.clone();
        self
    }

    /// The simulation at its start.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] if no routine shows a condition that is to be left out, or a parameter is out of range;
    /// [`SimulationError::Length`] if the length is out of range; [`SimulationError::Resident`] if a driver is set for an unknown
    /// resident.
    pub fn start(self) -> Result<Simulation, SimulationError> {
        Simulation::new(self)
    }
}

impl Simulation {
    /// The simulation of a run with these options, at its start.
    ///
    /// # Errors
    ///
    /// Those of [`RunSetup::start`].
    pub fn new(setup: RunSetup) -> Result<Simulation, SimulationError> {
        let opened = setup.scenario.with_numbers(setup.numbers)?;
        let OpenScenario { scenario, source, .. } = &opened;
        let length = setup.length.span(scenario)?;
        let household = opened.household_without(&setup.without)?;
        let household = if setup.one_of_many { Arc::new(household.one_of_many()) } else { household };
        let own_drivers = setup.drivers.keys().cloned().collect();
        let mut own = BTreeMap::new();
        for (name, make) in setup.drivers {
            let index = scenario.residents.iter().position(|resident| resident.file.name == name);
            let known = || scenario.residents.iter().map(|resident| resident.file.name.clone()).collect();
            own.insert(index.ok_or_else(|| SimulationError::Resident { name, known: known() })?, make);
        }
        let seed = setup.seed.unwrap_or(scenario.file.seed);
        let recording = Recording::new(scenario, VERSION, source.entry(), seed, length);
        let (without, one_of_many) = (setup.without, setup.one_of_many);
        let recording = Recording { without, one_of_many, own_drivers, ..recording };
        let provider = CustomDrivers { household: &household, own: &own };
        let run = Run::new(scenario, &provider, seed, length);
        let mut pace = setup.pace;
        pace.count_from(RunTime::START);
        let mut paced = PaceKeeper::new(pace, setup.cancel, setup.commands);
        paced.interventions.extend(setup.interventions);
        Ok(Simulation::from_parts(scenario.clone(), run, recording, opened.paths()).paced(paced))
    }
}
