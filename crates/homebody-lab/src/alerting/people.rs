//! People whose homes are watched for a year: half of them get one condition, at a severity and on a day that are drawn.
//!
//! All have what makes alarms false: a holiday, guests for some days, for some a stay in hospital, clocks that change, and in half of the
//! homes every fault of sensors.

use crate::simulated::every_fault;
use homebody_analysis::measures::{DayMeasures, MEASURES, Measures};
use homebody_core::random::Stream;
use homebody_placement::people::{
    CONDITIONS, LoadedScenario, PeopleError, SEVERITIES, condition_sentence, with_routine,
};
use homebody_placement::simulated::SimulatedLog;
use homebody_simulation::template;
use jiff::civil::Date;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The templates of the homes in turn, and the pronoun of the first resident. One in five has two residents.
const HOMES: [(&str, &str); 5] =
    [("older-adult", "she"), ("tigerplace", "she"), (WITH_TWO, "he"), ("house-two-floors", "she"), ("studio", "he")];
const WITH_TWO: &str = "couple-with-cat";

/// Days before the first, and after the last possible day on which a condition begins (our choice): at first no person has a reference, and
/// at the end no person can be found.
const BEFORE: u32 = 60;
const AFTER: u32 = 60;
/// Share of the people with a stay in hospital (our choice).
const IN_HOSPITAL_PERCENT: u32 = 15;

/// A condition of a watched person.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnCondition {
    pub name: &'static str,
    pub severity: &'static str,
    /// The day on which it begins, counted from 0.
    pub onset: usize,
    /// Days from then until its height.
    pub grows_days: usize,
}

/// A person whose home is watched.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchedPerson {
    pub number: u32,
    pub home: &'static str,
    pub condition: Option<DrawnCondition>,
    pub has_faults: bool,
    pub events: Vec<YearEvent>,
    pronoun: &'static str,
    days: u32,
    seed: u64,
}

/// Some days that are not usual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct YearEvent {
    pub kind: YearEventKind,
    /// The first day, counted from 0.
    pub from: usize,
    pub days: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum YearEventKind {
    Away,
    Guest,
}

impl WatchedPerson {
    /// Somebody else is at home while the person is away.
    pub fn has_company(&self) -> bool {
        self.home == WITH_TWO
    }

    /// The day before which any news is false.
    pub fn healthy_until(&self, days: usize) -> usize {
        self.condition.as_ref().map_or(days, |condition| condition.onset)
    }
}

impl WatchedPerson {
    /// Draws a person of a year. The even ones have no condition; the odd ones have the eight conditions in turn, each in all severities.
    pub fn draw(number: u32, (days, seed): (u32, u64)) -> WatchedPerson {
        let mut stream = Stream::named(seed, &format!("alerts/person/{number}"));
        let mut day = |from: u32, until: u32| from + (stream.unit() * f64::from(until - from)) as u32;
        let onset = day(BEFORE, days - AFTER);
        let (holiday, guests, hospital) = (day(40, days - 30), day(40, days - 30), day(40, days - 30));
        let [away_days, guest_days, hospital_days, chance] = [day(5, 15), day(2, 8), day(3, 9), day(0, 100)];
        let run_seed = (stream.unit() * (1_u64 << 53) as f64) as u64;
        let (home, pronoun) = HOMES[number as usize % HOMES.len()];
        let away =
            |from: u32, days: u32| YearEvent { kind: YearEventKind::Away, from: from as usize, days: days as usize };
        // Two that overlap would be one.
        let is_far = |a: u32, b: u32| a.abs_diff(b) > 20;
        let mut events = vec![away(holiday, away_days)];
        if is_far(guests, holiday) {
            events.push(YearEvent { kind: YearEventKind::Guest, ..away(guests, guest_days) });
        }
        if chance < IN_HOSPITAL_PERCENT && is_far(hospital, holiday) && is_far(hospital, guests) {
            events.push(away(hospital, hospital_days));
        }
        let (name, grows_days) = CONDITIONS[number as usize / 2 % CONDITIONS.len()];
        let severity = SEVERITIES[number as usize / 2 / CONDITIONS.len() % SEVERITIES.len()];
        let condition = DrawnCondition { name, severity, onset: onset as usize, grows_days };
        WatchedPerson {
            number,
            home,
            condition: (number % 2 == 1).then_some(condition),
            has_faults: number / 16 % 2 == 1,
            events,
            pronoun,
            days,
            seed: run_seed,
        }
    }

    /// The measures of each day, by the log of the sensors alone.
    pub fn measures(&self) -> Result<Measures, PeopleError> {
        let home = self.scenario()?;
        let household = home.household.one_of_many();
        let scenario = match self.has_faults {
            true => {
                let half = f64::from(self.days) / 2.0;
                let from_day = half * [0.0, 0.5, 1.0][self.number as usize % 3];
                let link = every_fault(&home.scenario, self.number as usize, (from_day, half));
                home.scenario.edit().link(&link).load()?
            }
            false => home.scenario,
        };
        Ok(SimulatedLog::simulate(&scenario, &household, self.seed, self.days)?.measures()?)
    }

    pub fn scenario(&self) -> Result<LoadedScenario, PeopleError> {
        let template = template(self.home).expect("the homes are templates");
        let pronoun = self.pronoun;
        let her = if pronoun == "she" { "her" } else { "his" };
        let event = |YearEvent { kind, from, days }: &YearEvent| match kind {
            YearEventKind::Away => format!("From day {}, for {days} days, {pronoun} is out.", from + 1),
            YearEventKind::Guest => format!("From day {} {her} sister stays for {days} days.", from + 1),
        };
        let mut sentences: Vec<String> = self.events.iter().map(event).collect();
        sentences.extend(self.condition.as_ref().map(|DrawnCondition { name, severity, onset, grows_days }| {
            condition_sentence(pronoun, (severity, name), (*onset, *grows_days))
        }));
        with_routine(template.scenario(), |routine| {
            // A condition of the template itself would make everybody in it ill.
            *routine = routine.lines().filter(|line| !line.contains(" shows ")).flat_map(|line| [line, "\n"]).collect();
            sentences.iter().for_each(|sentence| *routine += &format!("\n{sentence}\n"));
        })
    }
}

/// A person with the measures of each day, as a file keeps them: the simulation need not be repeated.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct StoredPerson {
    number: u32,
    seed: u64,
    days: Vec<StoredDay>,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct StoredDay {
    date: Date,
    is_whole: bool,
    values: BTreeMap<String, f64>,
}

impl StoredPerson {
    pub fn new(number: u32, seed: u64, measures: &Measures) -> StoredPerson {
        let value = |(value, measure): (&Option<f64>, &homebody_analysis::measures::DailyMeasure)| {
            Some((measure.name.to_owned(), (*value)?))
        };
        let day = |day: &DayMeasures| StoredDay {
            date: day.date,
            is_whole: day.is_whole,
            values: day.values.iter().zip(MEASURES).filter_map(value).collect(),
        };
        StoredPerson { number, seed, days: measures.days.iter().map(day).collect() }
    }

    pub fn person(&self) -> WatchedPerson {
        WatchedPerson::draw(self.number, (self.days.len() as u32, self.seed))
    }

    pub fn measures(&self) -> Measures {
        let day = |day: &StoredDay| DayMeasures {
            date: day.date,
            is_whole: day.is_whole,
            values: MEASURES.iter().map(|measure| day.values.get(measure.name).copied()).collect(),
        };
        Measures { measures: MEASURES, days: self.days.iter().map(day).collect(), ..Measures::default() }
    }
}
