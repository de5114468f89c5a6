//! People who differ as those of a cohort do, each with a condition or without one, for experiments on alerts.

use crate::alerting::Person;
use crate::measures::{LoggedLife, NotMeasured};
use crate::walk_back::Home;
use homebody_core::problem::Problems;
use homebody_core::random::Stream;
use homebody_core::scenario::edit::ScenarioEdit;
use homebody_core::scenario::link::LinkFile;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::resident::DriverFile;
use homebody_routine::household::Household;
use rayon::prelude::*;

/// The day on which conditions begin, counted from 0.
pub const ONSET: usize = 60;

/// The conditions that come with the program, with the days in which they grow (ours): infections take 2 to 5 days, heart failure 1
/// to 3 weeks, depression 3 to 6 and frailty 3 to 8, of which this is the middle; grief and the weeks after a hospital begin at
/// once.
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
const SEVERITIES: [&str; 3] = ["mild", "moderate", "severe"];

homebody_core::messages! {
    /// Reasons why the people of an experiment cannot be simulated.
    pub enum NotLived in "people" {
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
            NotMeasured(NotMeasured);
        }
    }
}

impl From<Problems> for NotLived {
    fn from(problems: Problems) -> NotLived {
        NotLived::Problems(problems)
    }
}

impl From<NotMeasured> for NotLived {
    fn from(error: NotMeasured) -> NotLived {
        NotLived::NotMeasured(error)
    }
}

/// A scenario that can be lived.
#[derive(Clone)]
pub struct Opened {
    /// What its files say.
    pub scenario: Scenario,
    /// Who lives there.
    pub household: Household,
}

impl Opened {
    /// Of a scenario that was changed.
    pub fn of(edit: ScenarioEdit) -> Result<Opened, Problems> {
        let entry = edit.entry().to_owned();
        let (scenario, household) = Household::load(&edit.into_texts(), &entry, &[])?;
        Ok(Opened { scenario, household })
    }
}

/// Everybody who is to live: the first resident of a scenario, once for each of those who differ.
pub struct People {
    /// Nobody's condition first, then those that were asked for; of each the severities.
    kinds: Vec<(Person, Opened)>,
    count: u32,
    days: u32,
    seed: u64,
}

impl People {
    /// So many people in the home of a scenario, each with one of the conditions or none, in turn.
    pub fn of(
        opened: &Opened,
        conditions: &[(&'static str, usize)],
        count: u32,
        (days, seed): (u32, u64),
    ) -> Result<People, NotLived> {
        let none = Person { condition: None, onset: ONSET, height: 0 };
        let mut kinds =
            vec![none; SEVERITIES.len()].into_iter().map(|person| (person, opened.clone())).collect::<Vec<_>>();
        for &(condition, height) in conditions {
            for severity in SEVERITIES {
                let person = Person { condition: Some(condition), onset: ONSET, height };
                kinds.push((person, with(opened, person, severity)?));
            }
        }
        Ok(People { kinds, count, days, seed })
    }

    /// How many there are.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Everybody lives, on all processors, and something is asked of each: who it is, their number, and the home they live in.
    /// `one_more` hears of each who has lived, and says whether it goes on.
    pub fn each<T: Send, E: Send + From<NotLived>>(
        &self,
        one_more: impl Fn() -> bool + Sync,
        ask: impl Fn(&Lives) -> Result<T, E> + Sync,
    ) -> Result<Vec<(Person, T)>, E> {
        let conditions = self.kinds.len() / SEVERITIES.len();
        let live = |number: u32| {
            let (condition, severity) = (number as usize % conditions, number as usize / conditions % SEVERITIES.len());
            let (person, opened) = &self.kinds[condition * SEVERITIES.len() + severity];
            let unit = Stream::named(self.seed, &format!("experiment/person/{number}")).unit();
            let lives =
                Lives { opened, days: self.days, seed: (unit * (1_u64 << 53) as f64) as u64, number: number as usize };
            let answer = ask(&lives);
            let goes_on = one_more();
            if goes_on { Ok((*person, answer?)) } else { Err(NotLived::Stopped.into()) }
        };
        (0..self.count).into_par_iter().map(live).collect()
    }
}

/// Somebody who is to live.
pub struct Lives<'a> {
    /// Their home, and what they show.
    pub opened: &'a Opened,
    /// The number of the person.
    pub number: usize,
    days: u32,
    seed: u64,
}

impl Lives<'_> {
    /// Their days, by a link that loses nothing or another.
    pub fn live(&self, link: &LinkFile) -> Result<LoggedLife, NotLived> {
        let household = self.opened.household.one_of_many();
        let scenario = self.opened.scenario.edit().link(link).load()?;
        let home = Home { scenario: &scenario, drivers: &household, people: vec![0] };
        Ok(LoggedLife::live(&home, self.seed, self.days)?)
    }
}

/// The life of somebody with a condition.
fn with(opened: &Opened, person: Person, severity: &str) -> Result<Opened, NotLived> {
    let Some(condition) = person.condition else { return Ok(opened.clone()) };
    let grows = if person.height > 0 { format!(", over {} days", person.height) } else { String::new() };
    let sentence = format!("\nFrom day {}{grows}, she shows {severity} {condition}.\n", person.onset + 1);
    let routine = opened.scenario.residents.first().map(|resident| resident.file.driver.clone());
    let edit = opened.scenario.edit();
    let entry = edit.entry().to_owned();
    let mut texts = edit.into_texts();
    match routine {
        Some(DriverFile::Routine(name)) if texts.contains_key(&name) => {
            texts.entry(name).or_default().push_str(&sentence);
        }
        _ => return Err(NotLived::NoRoutine),
    }
    let (scenario, household) = Household::load(&texts, &entry, &[])?;
    Ok(Opened { scenario, household })
}
