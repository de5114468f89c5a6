//! Simulated people with the variety of a cohort, each with or without a condition.

use crate::adequacy::Person;
use crate::simulated::{SimulatedLog, SimulatedLogError};
use homebody_core::link::form::LinkFile;
use homebody_core::problem::Problems;
use homebody_core::random::Stream;
use homebody_core::resident::DriverFile;
use homebody_core::scenario::edit::ScenarioEdit;
use homebody_core::scenario::load::Scenario;
use homebody_routine::household::Household;
use rayon::prelude::*;

/// The day on which conditions begin, counted from 0.
pub const ONSET: usize = 60;

/// The conditions that come with the program, each with the days until its height (our choice): infections take 2 to 5
/// days, heart failure 1 to 3 weeks, depression 3 to 6 and frailty 3 to 8; the value is the middle. Grief and the weeks
/// after a hospital begin at once.
pub const CONDITIONS: [(&str, usize); 8] = [
    ("cognitive-decline", 42),
    ("depression", 28),
    ("frailty", 42),
    ("grief", 0),
    ("heart-failure", 14),
    ("insomnia", 14),
    ("recovery", 0),
    ("urinary-tract-infection", 4),
];
pub const SEVERITIES: [&str; 3] = ["mild", "moderate", "severe"];

homebody_core::messages! {
    /// Reasons why people cannot be simulated.
    pub enum PeopleError in "people" {
        /// An experiment on alerts gives conditions to the first resident of the scenario. A condition changes a routine, and this resident
        /// has another driver:
        ///
        /// ```json
        /// { "driver": { "routine": "resident.routine" } }
        /// ```
        NoRoutine error "no-routine" ("the first resident has no routine, so no condition can be simulated")
            hint ("name a routine as the driver of the first resident, in the file of that resident");
        /// The program that started the work stopped it before its end.
        Stopped error "stopped" ("the work was stopped");
        => inner {
            /// The files of the scenario have problems.
            Problems(Problems);
            /// A simulation failed, or its log cannot be measured.
            Simulation(SimulatedLogError);
        }
    }
}

impl From<Problems> for PeopleError {
    fn from(problems: Problems) -> PeopleError {
        PeopleError::Problems(problems)
    }
}

impl From<SimulatedLogError> for PeopleError {
    fn from(error: SimulatedLogError) -> PeopleError {
        PeopleError::Simulation(error)
    }
}

#[derive(Clone)]
pub struct LoadedScenario {
    pub scenario: Scenario,
    pub household: Household,
}

impl LoadedScenario {
    pub fn from_edit(edit: ScenarioEdit) -> Result<LoadedScenario, Problems> {
        let entry = edit.entry().to_owned();
        let (scenario, household) = Household::load(&edit.into_texts(), &entry, &[])?;
        Ok(LoadedScenario { scenario, household })
    }
}

pub struct People {
    /// Without a condition first, then with each condition, each in all severities.
    kinds: Vec<(Person, LoadedScenario)>,
    count: u32,
    days: u32,
    seed: u64,
}

impl People {
    /// People in the home of a scenario, each with one of the conditions or none, in turn.
    pub fn new(
        home: &LoadedScenario,
        conditions: &[(&'static str, usize)],
        count: u32,
        (days, seed): (u32, u64),
    ) -> Result<People, PeopleError> {
        let none = Person { condition: None, onset: ONSET, height: 0 };
        let mut kinds =
            vec![none; SEVERITIES.len()].into_iter().map(|person| (person, home.clone())).collect::<Vec<_>>();
        for &(condition, height) in conditions {
            for severity in SEVERITIES {
                let person = Person { condition: Some(condition), onset: ONSET, height };
                kinds.push((person, with(home, person, severity)?));
            }
        }
        Ok(People { kinds, count, days, seed })
    }

    pub fn count(&self) -> u32 {
        self.count
    }

    /// Calls a function for each person, on all processors. `goes_on` is called after each person; if it returns false,
    /// the work stops.
    pub fn each<T: Send, E: Send + From<PeopleError>>(
        &self,
        goes_on: impl Fn() -> bool + Sync,
        ask: impl Fn(&PersonRun) -> Result<T, E> + Sync,
    ) -> Result<Vec<(Person, T)>, E> {
        let conditions = self.kinds.len() / SEVERITIES.len();
        let answer = |number: u32| {
            let (condition, severity) = (number as usize % conditions, number as usize / conditions % SEVERITIES.len());
            let (person, home) = &self.kinds[condition * SEVERITIES.len() + severity];
            let unit = Stream::named(self.seed, &format!("experiment/person/{number}")).unit();
            let seed = (unit * (1_u64 << 53) as f64) as u64;
            let answer = ask(&PersonRun { home, number: number as usize, days: self.days, seed });
            if goes_on() { Ok((*person, answer?)) } else { Err(PeopleError::Stopped.into()) }
        };
        (0..self.count).into_par_iter().map(answer).collect()
    }
}

pub struct PersonRun<'a> {
    pub home: &'a LoadedScenario,
    pub number: usize,
    days: u32,
    seed: u64,
}

impl PersonRun<'_> {
    pub fn simulate(&self, link: &LinkFile) -> Result<SimulatedLog, PeopleError> {
        let household = self.home.household.one_of_many();
        let scenario = self.home.scenario.edit().link(link).load()?;
        Ok(SimulatedLog::simulate(&scenario, &household, self.seed, self.days)?)
    }
}

fn with(home: &LoadedScenario, person: Person, severity: &str) -> Result<LoadedScenario, PeopleError> {
    let Some(condition) = person.condition else { return Ok(home.clone()) };
    let sentence = condition_sentence("she", (severity, condition), (person.onset, person.height));
    with_routine(&home.scenario, |routine| routine.push_str(&format!("\n{sentence}\n")))
}

/// The sentence that gives a resident a condition from a day on, counted from 0, which grows for some days.
pub fn condition_sentence(
    pronoun: &str,
    (severity, name): (&str, &str),
    (onset, grows_days): (usize, usize),
) -> String {
    let grows = if grows_days > 0 { format!(", over {grows_days} days") } else { String::new() };
    format!("From day {}{grows}, {pronoun} shows {severity} {name}.", onset + 1)
}

/// A scenario with a changed routine of the first resident.
pub fn with_routine(scenario: &Scenario, change: impl FnOnce(&mut String)) -> Result<LoadedScenario, PeopleError> {
    let routine = scenario.residents.first().map(|resident| resident.file.driver.clone());
    let edit = scenario.edit();
    let entry = edit.entry().to_owned();
    let mut texts = edit.into_texts();
    let text = match routine {
        Some(DriverFile::Routine(name)) => texts.get_mut(&name),
        _ => None,
    };
    change(text.ok_or(PeopleError::NoRoutine)?);
    let (scenario, household) = Household::load(&texts, &entry, &[])?;
    Ok(LoadedScenario { scenario, household })
}
