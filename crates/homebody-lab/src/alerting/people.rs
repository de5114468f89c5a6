//! People whose homes are watched for a year: half of them get one condition, at a severity and on a day that are drawn.
//!
//! All have what makes alarms false: a holiday, guests for some days, for some a stay in hospital, clocks that change, and in half of the
//! homes every fault of sensors.

use crate::simulated::every_fault;
use homebody_analysis::measures::Measures;
use homebody_core::problem::Problems;
use homebody_core::random::Stream;
use homebody_core::resident::DriverFile;
use homebody_placement::people::{CONDITIONS, LoadedScenario, PeopleError};
use homebody_placement::simulated::SimulatedLog;
use homebody_routine::household::Household;
use homebody_simulation::template;
use serde::Serialize;

/// The templates of the homes in turn, and the pronoun of the first resident. One in five has two residents.
const HOMES: [(&str, &str); 5] =
    [("older-adult", "she"), ("tigerplace", "she"), ("couple-with-cat", "he"), ("house-two-floors", "she"), ("studio", "he")];

const SEVERITIES: [&str; 3] = ["mild", "moderate", "severe"];

/// Days before the first, and after the last possible day on which a condition begins (our choice): at first nobody has a usual level, and
/// at the end nobody can be found.
const BEFORE: u32 = 60;
const AFTER: u32 = 60;

/// A condition of a watched person.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DrawnCondition {
    pub name: &'static str,
    pub severity: &'static str,
    /// The day on which it begins, counted from 0.
    pub onset: u32,
    /// Days from then until its height.
    pub grows_days: u32,
}

/// A person whose home is watched.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WatchedPerson {
    pub number: u32,
    pub home: &'static str,
    pub condition: Option<DrawnCondition>,
    pub has_faults: bool,
    /// Dated sentences of the year, such as a holiday.
    pub events: Vec<String>,
    days: u32,
    seed: u64,
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
        let her = if pronoun == "she" { "her" } else { "his" };
        // Two that overlap would be one.
        let far = |a: u32, b: u32| a.abs_diff(b) > 20;
        let mut events = vec![format!("From day {}, for {away_days} days, {pronoun} is out.", holiday + 1)];
        if far(guests, holiday) {
            events.push(format!("From day {} {her} sister stays for {guest_days} days.", guests + 1));
        }
        if chance < 15 && far(hospital, holiday) && far(hospital, guests) {
            events.push(format!("From day {}, for {hospital_days} days, {pronoun} is out.", hospital + 1));
        }
        let (name, grows_days) = CONDITIONS[number as usize / 2 % CONDITIONS.len()];
        let severity = SEVERITIES[number as usize / 2 / CONDITIONS.len() % SEVERITIES.len()];
        let condition = DrawnCondition { name, severity, onset, grows_days: grows_days as u32 };
        WatchedPerson {
            number,
            home,
            condition: (number % 2 == 1).then_some(condition),
            has_faults: number / 16 % 2 == 1,
            events,
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

    pub fn scenario(&self) -> Result<LoadedScenario, Problems> {
        let template = template(self.home).expect("the homes are templates");
        let pronoun = HOMES.iter().find(|(home, _)| *home == self.home).map_or("she", |(_, pronoun)| pronoun);
        let mut sentences = self.events.clone();
        sentences.extend(self.condition.as_ref().map(|condition| {
            let DrawnCondition { name, severity, onset, grows_days } = condition;
            let grows = if *grows_days > 0 { format!(", over {grows_days} days") } else { String::new() };
            format!("From day {}{grows}, {pronoun} shows {severity} {name}.", onset + 1)
        }));
        let scenario = template.scenario();
        let routine = scenario.residents.first().map(|resident| resident.file.driver.clone());
        let edit = scenario.edit();
        let entry = edit.entry().to_owned();
        let mut texts = edit.into_texts();
        if let Some(DriverFile::Routine(name)) = routine {
            let text = texts.entry(name).or_default();
            // A condition of the template itself would make everybody in it ill.
            *text = text.lines().filter(|line| !line.contains(" shows ")).flat_map(|line| [line, "\n"]).collect();
            sentences.iter().for_each(|sentence| *text += &format!("\n{sentence}\n"));
        }
        let (scenario, household) = Household::load(&texts, &entry, &[])?;
        Ok(LoadedScenario { scenario, household })
    }
}
