//! The flat of the data set, simulated with a routine, as a log with the true activities.

use homebody_core::drivers::error::DriverError;
use homebody_core::problem::{Problem, Problems};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, RunTime, Span, WallTime};
use homebody_log::{Log, LogError, SimulatedRun};
use homebody_routine::household::Household;
use homebody_timeline::TimelineBuilder;
use std::collections::BTreeMap;

macro_rules! files {
    ($($name:literal),*) => { [$(($name, include_str!(concat!("flat/", $name)))),*] };
}

/// All files except the routine.
const FILES: [(&str, &str); 4] = files!("scenario.json", "home.json", "logger.json", "resident.json");
const ENTRY: &str = "scenario.json";
const ROUTINE: &str = "resident.routine";
/// The room whose sensors show the preparation of a meal.
const KITCHEN: &str = "kitchen";

pub struct Flat {
    scenario: Scenario,
    household: Household,
    /// The names of the sensors in the log, in the order of the home.
    pub sensors: Vec<String>,
    pub in_kitchen: Vec<bool>,
}

homebody_core::messages! {
    /// Reasons why the flat of the experiment cannot be simulated.
    pub enum FlatError in "recogniser" {
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
            Run(DriverError);
        }
    }
}

from_errors!(FlatError: Log(LogError), Run(DriverError));

impl Flat {
    pub fn new(routine: &str) -> Result<Flat, FlatError> {
        let mut files: BTreeMap<String, String> =
            FILES.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
        files.insert(ROUTINE.into(), routine.into());
        let rejected = |Problems(problems)| FlatError::Routine(problems.iter().map(Problem::to_string).collect());
        let (scenario, household) = Household::load(&files, ENTRY, &[]).map_err(rejected)?;
        let run = Run::new(&scenario, &household, 0, Span::ZERO);
        let called = |name: &String| scenario.logger.ids.get(name).unwrap_or(name).clone();
        let sensors = run.sensors().iter().map(|sensor| called(&sensor.name)).collect();
        let rooms = &scenario.home.plan().rooms;
        let is_in_kitchen = |room: usize| rooms[room].name == KITCHEN;
        let in_kitchen =
            run.sensors().iter().map(|sensor| sensor.room.is_some_and(|room| is_in_kitchen(room.index()))).collect();
        Ok(Flat { sensors, in_kitchen, scenario, household })
    }

    /// Simulates some days from a midnight on. The wall clock is never set.
    pub fn simulate(&self, seed: u64, days: u32, midnight: WallTime) -> Result<Log, FlatError> {
        let length = i64::from(days) * DAY;
        let wall = |at: RunTime| midnight + at.since_zero();
        let run = SimulatedRun::new(&self.scenario, &self.household, seed, length)?;
        let mut timeline = TimelineBuilder::for_run(run.run());
        let log = run.into_log(wall, |facts| timeline.take(facts))?;
        let activities = timeline.finish(RunTime::START + length).map(wall).into_activities();
        Ok(Log { sensors: self.sensors.clone(), activities, ..log })
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
    fn a_simulated_log_has_an_activity_at_each_instant() {
        let flat = Flat::new("She gets up at 8:00. She takes a shower at 9:00. She leaves home at 15:00 for 2 hours.")
            .unwrap();
        let day = |number: i64| WallTime::EPOCH + number * DAY;
        let log = flat.simulate(1, 2, day(100)).unwrap();
        assert!(log.activities.windows(2).all(|pair| pair[0].end() == pair[1].begin()));
        assert_eq!((log.activities[0].begin(), log.activities.last().unwrap().end()), (day(100), day(102)));
        let says = |sensor: &str| log.events.iter().any(|event| log.sensor(event) == sensor);
        for sensor in
            ["Shower PIR Bathroom", "Seat Pressure Living", "Bed Pressure Bedroom", "Maindoor Magnetic Entrance"]
        {
            assert!(says(sensor), "{sensor}");
        }
    }
}
