//! Lives that are lived to be held against a log.

use crate::error::Error;
use crate::scenario::OpenScenario;
use homebody_analysis::dates::midnight;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::{DAY, Micros};
use homebody_log::{Event, Log, Rows};

/// Always the same life, so that what changes is what is fitted.
pub const SEED: u64 = 1;

/// The log of so many days of a life in a scenario, on the clock on the wall and by the home's own names of sensors.
///
/// # Errors
///
/// [`Error::Log`] if its logger has wrong names, and what a driver says that cannot go on.
pub fn lived(open: &OpenScenario, seed: u64, days: u32) -> Result<Log, Error> {
    lived_for(open, seed, Micros::from(days) * DAY)
}

/// The log of so much of a life, as [`lived`] has it.
pub fn lived_for(open: &OpenScenario, seed: u64, length: Micros) -> Result<Log, Error> {
    let scenario = open.scenario();
    let mut run = Run::new(scenario, open.household(), seed, length);
    let names: Vec<String> = run.sensors().iter().map(|sensor| sensor.name.clone()).collect();
    let logger = LoggerFile { time: TimeFormat::Local, ..scenario.logger.clone() };
    let mut rows = Rows::new(&logger, seed, &names, &scenario.calendar)?;
    let midnight = midnight(scenario.calendar.local(0).date());
    let mut log = Log { sensors: names, ..Log::default() };
    let mut events = Events::default();
    while run.now() < length {
        run.advance((run.now() + DAY / 24).min(length), &mut events)?;
        for row in rows.of(&events.firings, run.settled()) {
            let known = log.values.iter().position(|value| *value == row.value);
            let value = known.unwrap_or_else(|| {
                log.values.push(row.value);
                log.values.len() - 1
            });
            log.events.push(Event { at: midnight + row.at, sensor: row.sensor.0, value: value as u32 });
        }
        events.clear();
    }
    Ok(log)
}
