//! The setup of a run: its scenario and options, its drivers and its pace.

use crate::VERSION;
use crate::custom_drivers::{CustomDrivers, MakeDriver};
use crate::error::SimulationError;
use crate::interventions::InterventionRequest;
use crate::open_scenario::OpenScenario;
use crate::pace::{Pace, PaceKeeper, RunCommand};
use crate::run_length::RunLength;
use crate::run_options::RunOptions;
use crate::simulation::Simulation;
use homebody_core::drivers::Driver;
use homebody_core::home::Home;
use homebody_core::recording::Recording;
use homebody_core::run::{DriverProvider, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{RunTime, Span};
use homebody_log::Cancel;
use homebody_routine::household::Household;
use std::collections::BTreeMap;
use std::error::Error;
use std::fmt;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// The setup of a run, made by [`OpenScenario::run`] or [`RunOptions::setup`]. An option that is not set is as the scenario says.
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
    pub(crate) scenario: OpenScenario,
    pub(crate) options: RunOptions,
    drivers: BTreeMap<String, MakeDriver>,
    pace: Pace,
    commands: Option<Receiver<RunCommand>>,
    interventions: Option<Receiver<InterventionRequest>>,
    pub(crate) cancel: Cancel,
}

/// A scenario with the options of a run applied to it.
pub struct PlannedRun {
    /// The scenario, with the start and the parameters of the run.
    pub scenario: OpenScenario,
    /// The routines, without the conditions that are left out.
    pub household: Arc<Household>,
    /// The recording before the run begins: it has the seed and the length.
    pub recording: Recording,
}

impl PlannedRun {
    /// The simulation at its start.
    pub fn simulation(self) -> Simulation {
        let household = self.household.clone();
        self.driven_by(&*household)
    }

    fn driven_by(self, drivers: &dyn DriverProvider) -> Simulation {
        let PlannedRun { scenario, recording, .. } = self;
        let run = Run::new(&scenario.scenario, drivers, recording.seed, recording.length_us);
        let sources = scenario.paths();
        Simulation::from_parts(scenario.scenario, run, recording, sources)
    }
}

impl OpenScenario {
    /// The setup of a run of this scenario.
    pub fn run(&self) -> RunSetup {
        RunSetup::new(self.clone(), RunOptions::default())
    }
}

impl RunOptions {
    /// A run of a scenario with these options.
    ///
    /// ```
    /// use homebody_simulation::{RunOptions, VariantOptions};
    ///
    /// let scenario = homebody_simulation::template("tigerplace-depression")?;
    /// let variant = VariantOptions { seed: Some(7), without: vec!["depression".into()] };
    /// let run = RunOptions { variant, ..RunOptions::default() }.setup(&scenario)?.start()?;
    /// assert_eq!(run.recording().without, ["depression"]);
    /// # Ok::<(), homebody_simulation::SimulationError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] if a parameter is unknown or out of range, or the start is not a date and time.
    pub fn setup(mut self, scenario: &OpenScenario) -> Result<RunSetup, SimulationError> {
        let scenario = self.change_file(scenario)?;
        Ok(RunSetup::new(scenario, self))
    }

    /// Applies the options to the scenario. All runs get their seed, length, start, conditions and parameters here.
    ///
    /// # Errors
    ///
    /// [`OptionError`] with the first wrong option: [`SimulationError::Problems`] if no routine shows a condition that is to be left out, a
    /// parameter is unknown or out of range, or the start is not a date and time; [`SimulationError::Length`] if the length is out of range.
    pub fn plan(mut self, scenario: &OpenScenario) -> Result<PlannedRun, OptionError> {
        let scenario = self.change_file(scenario)?;
        let length = self.span(&scenario).map_err(in_option("days"))?;
        let RunOptions { variant, one_of_many, .. } = self;
        let mut household = scenario.household_without(&variant.without).map_err(in_option("without"))?;
        if one_of_many {
            household = Arc::new(household.one_of_many());
        }
        let seed = variant.seed.unwrap_or(scenario.scenario.file.seed);
        let recording = Recording::new(&scenario.scenario, VERSION, scenario.source.entry(), seed, length);
        let recording = Recording { without: variant.without, one_of_many, ..recording };
        Ok(PlannedRun { scenario, household, recording })
    }

    /// Moves the options that the scenario's own file has into it.
    fn change_file(&mut self, scenario: &OpenScenario) -> Result<OpenScenario, OptionError> {
        let scenario = scenario.with_numbers(std::mem::take(&mut self.numbers)).map_err(in_option("numbers"))?;
        let Some(start) = self.start.take() else { return Ok(scenario) };
        start.in_scenario(&scenario).map_err(in_option("start"))
    }

    fn span(&self, scenario: &OpenScenario) -> Result<Span, SimulationError> {
        let Scenario { file, calendar, .. } = &*scenario.scenario;
        self.length.unwrap_or(RunLength::Days(file.days)).span(calendar)
    }
}

/// An option of a run that the scenario does not allow.
#[derive(Debug)]
pub struct OptionError {
    /// Its name in the schema of [`RunOptions`].
    pub option: &'static str,
    /// The reason.
    pub error: SimulationError,
}

impl fmt::Display for OptionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.error, f)
    }
}

impl Error for OptionError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.error.source()
    }
}

impl From<OptionError> for SimulationError {
    fn from(wrong: OptionError) -> SimulationError {
        wrong.error
    }
}

fn in_option(option: &'static str) -> impl Fn(SimulationError) -> OptionError {
    move |error| OptionError { option, error }
}

impl RunSetup {
    pub(crate) fn new(scenario: OpenScenario, options: RunOptions) -> RunSetup {
        RunSetup {
            scenario,
            options,
            drivers: BTreeMap::new(),
            pace: Pace::default(),
            commands: None,
            interventions: None,
            cancel: Cancel::new(),
        }
    }

    /// Sets the seed of all randomness.
    pub fn seed(mut self, seed: u64) -> RunSetup {
        self.options.variant.seed = Some(seed);
        self
    }

    /// Sets the length in days of the home's time zone: one on which clocks change has 23 or 25 hours.
    pub fn days(mut self, days: impl Into<f64>) -> RunSetup {
        self.options.length = Some(RunLength::Days(days.into()));
        self
    }

    /// Sets the length.
    pub fn length(mut self, length: Span) -> RunSetup {
        self.options.length = Some(RunLength::Span(length));
        self
    }

    /// Leaves out conditions of the routines. All that a condition does not affect draws the same random numbers with it and
    /// without it.
    pub fn without(mut self, conditions: impl IntoIterator<Item = impl Into<String>>) -> RunSetup {
        self.options.variant.without.extend(conditions.into_iter().map(Into::into));
        self
    }

    /// Sets a parameter of the models; [`numbers`](crate::numbers) lists all. The recording has it in the scenario's own file.
    pub fn number(mut self, name: impl Into<String>, value: f64) -> RunSetup {
        self.options.numbers.push((name.into(), value));
        self
    }

    /// Lets the residents differ from their routines as people differ, each seed in its own way.
    pub fn one_of_many(mut self) -> RunSetup {
        self.options.one_of_many = true;
        self
    }

    /// The scenario, with the start and the parameters of the [`RunOptions`] that the setup was made from.
    pub fn scenario(&self) -> &OpenScenario {
        &self.scenario
    }

    /// The conditions that are left out.
    pub fn without_conditions(&self) -> &[String] {
        &self.options.variant.without
    }

    /// The length of the run.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Length`] if it is out of range.
    pub fn span(&self) -> Result<Span, SimulationError> {
        self.options.span(&self.scenario)
    }

    /// The run, as [`RunOptions::plan`] makes it.
    ///
    /// # Errors
    ///
    /// The [`OptionError::error`] of [`RunOptions::plan`].
    pub fn plan(&self) -> Result<PlannedRun, SimulationError> {
        Ok(self.options.clone().plan(&self.scenario)?)
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
        let mut plan = self.plan()?;
        plan.recording.own_drivers = self.drivers.keys().cloned().collect();
        let residents = &plan.scenario.scenario.residents;
        let mut own = BTreeMap::new();
        for (name, make) in self.drivers {
            let index = residents.iter().position(|resident| resident.file.name == name);
            let known = || residents.iter().map(|resident| resident.file.name.clone()).collect();
            own.insert(index.ok_or_else(|| SimulationError::Resident { name, known: known() })?, make);
        }
        let household = plan.household.clone();
        let mut pace = self.pace;
        pace.count_from(RunTime::START);
        let mut paced = PaceKeeper::new(pace, self.cancel, self.commands);
        paced.interventions.extend(self.interventions);
        Ok(plan.driven_by(&CustomDrivers { household: &household, own: &own }).paced(paced))
    }
}
