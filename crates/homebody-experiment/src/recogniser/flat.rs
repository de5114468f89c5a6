//! The flat that the data set describes, lived in by a routine, as a log with the truth of what was done.

use homebody_core::drivers::error::DriverError;
use homebody_core::event::{Events, Fact};
use homebody_core::problem::{Problem, Problems};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_log::{Activity, Event, Log, LogError, Rows};
use homebody_routine::household::Household;
use std::collections::BTreeMap;

macro_rules! files {
    ($($name:literal),*) => { [$(($name, include_str!(concat!("flat/", $name)))),*] };
}

/// All but the routine.
const FILES: [(&str, &str); 4] = files!("scenario.json", "home.json", "logger.json", "resident.json");
const ENTRY: &str = "scenario.json";
const ROUTINE: &str = "resident.routine";
/// The room whose sensors say that a meal is being prepared.
const KITCHEN: &str = "kitchen";

/// The flat with somebody who lives there.
pub struct Flat {
    scenario: Scenario,
    household: Household,
    /// What the log calls the sensors, in the home's order.
    pub sensors: Vec<String>,
    /// Which of them are in the kitchen.
    pub in_kitchen: Vec<bool>,
}

homebody_core::messages! {
    /// Reasons why the flat of the experiment cannot be simulated.
    pub enum NotLived in "recogniser" {
        /// The experiment writes a routine from the activities of the first half of the days. An activity of the data may have a name or a
        /// time that routines do not have.
        Routine(problems: Vec<String>) error "routine" (
            "the routine that the experiment wrote from the first half of the days has problems: {}",
            problems.join("; ")
        );
        => inner {
            /// The log cannot be written.
            Log(LogError);
            /// The simulation failed.
            Life(DriverError);
        }
    }
}

impl From<LogError> for NotLived {
    fn from(error: LogError) -> NotLived {
        NotLived::Log(error)
    }
}

impl From<DriverError> for NotLived {
    fn from(error: DriverError) -> NotLived {
        NotLived::Life(error)
    }
}

impl Flat {
    /// The flat whose resident lives by this routine.
    pub fn new(routine: &str) -> Result<Flat, NotLived> {
        let mut files: BTreeMap<String, String> =
            FILES.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
        files.insert(ROUTINE.into(), routine.into());
        let rejected = |Problems(problems)| NotLived::Routine(problems.iter().map(Problem::to_string).collect());
        let (scenario, household) = Household::load(&files, ENTRY, &[]).map_err(rejected)?;
        let run = Run::new(&scenario, &household, 0, 0);
        let called = |name: &String| scenario.logger.ids.get(name).unwrap_or(name).clone();
        let sensors = run.sensors().iter().map(|sensor| called(&sensor.name)).collect();
        let rooms = &scenario.home.plan().rooms;
        let is_in_kitchen = |room: usize| rooms[room].name == KITCHEN;
        let in_kitchen =
            run.sensors().iter().map(|sensor| sensor.room.is_some_and(|room| is_in_kitchen(room.index()))).collect();
        Ok(Flat { sensors, in_kitchen, scenario, household })
    }

    /// The log of so many days that begins at a midnight, in microseconds since 1970.
    pub fn lived(&self, seed: u64, days: u32, midnight: Micros) -> Result<Log, NotLived> {
        let length = Micros::from(days) * DAY;
        let mut run = Run::new(&self.scenario, &self.household, seed, length);
        let names: Vec<String> = run.sensors().iter().map(|sensor| sensor.name.clone()).collect();
        let mut rows = Rows::new(&self.scenario.logger, seed, &names, &self.scenario.calendar)?;
        let mut log = Log { sensors: self.sensors.clone(), ..Log::default() };
        let mut events = Events::default();
        while run.now() < length {
            let until = (run.now() + 3600 * SECOND).min(length);
            run.advance(until, &mut events)?;
            for row in rows.of(&events.firings, until) {
                let known = log.values.iter().position(|value| *value == row.value);
                let value = known.unwrap_or_else(|| {
                    log.values.push(row.value);
                    log.values.len() - 1
                });
                log.events.push(Event { at: midnight + row.at, sensor: row.sensor.0, value: value as u32 });
            }
            for fact in &events.facts {
                if let Fact::Activity { at, name, .. } = fact {
                    end(&mut log, midnight + at);
                    let name = name.as_deref().unwrap_or_default().to_owned();
                    log.activities.push(Activity { name, begin: midnight + at, end: midnight + at });
                }
            }
            events.clear();
        }
        end(&mut log, midnight + length);
        Ok(log)
    }
}

/// The activity that went on ends.
fn end(log: &mut Log, at: Micros) {
    if let Some(last) = log.activities.last_mut() {
        last.end = at;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flat_has_the_twelve_sensors_that_the_data_set_describes() {
        let flat = Flat::new("She gets up at 8:00.").unwrap();
        assert_eq!(flat.sensors.len(), 12);
        let mut in_kitchen: Vec<&String> =
            flat.sensors.iter().zip(&flat.in_kitchen).filter(|(_, is)| **is).map(|(name, _)| name).collect();
        in_kitchen.sort();
        assert!(in_kitchen.iter().all(|name| name.ends_with("Kitchen")) && in_kitchen.len() == 5, "{in_kitchen:?}");
    }

    #[test]
    fn a_life_in_it_says_what_was_done_all_the_time() {
        let flat = Flat::new("She gets up at 8:00. She takes a shower at 9:00. She leaves home at 15:00 for 2 hours.")
            .unwrap();
        let log = flat.lived(1, 2, 100 * DAY).unwrap();
        assert!(log.activities.windows(2).all(|pair| pair[0].end == pair[1].begin));
        assert_eq!((log.activities[0].begin, log.activities.last().unwrap().end), (100 * DAY, 102 * DAY));
        let says = |sensor: &str| log.events.iter().any(|event| log.sensor(event) == sensor);
        for sensor in
            ["Shower PIR Bathroom", "Seat Pressure Living", "Bed Pressure Bedroom", "Maindoor Magnetic Entrance"]
        {
            assert!(says(sensor), "{sensor}");
        }
    }
}
