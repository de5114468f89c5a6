//! Logs of runs that are simulated in memory, without a destination.

use crate::error::LogError;
use crate::log::{Event, Log};
use crate::table::{LogRows, RowText};
use homebody_core::drivers::error::DriverError;
use homebody_core::event::{Events, Fact};
use homebody_core::run::{DriverProvider, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::{HOUR, RunTime, Span, WallTime};
use std::collections::HashMap;

/// A run of a scenario, and the rows of its log.
pub struct SimulatedRun {
    run: Run,
    rows: LogRows,
}

impl SimulatedRun {
    /// A run at its start.
    ///
    /// # Errors
    ///
    /// If the logger has wrong names.
    pub fn new(
        scenario: &Scenario,
        drivers: &dyn DriverProvider,
        seed: u64,
        length: Span,
    ) -> Result<SimulatedRun, LogError> {
        let run = Run::new(scenario, drivers, seed, length);
        let logger = LoggerFile { time: TimeFormat::Local, ..scenario.logger.clone() };
        let rows = LogRows::new(&logger, seed, &sensor_names(&run), &scenario.calendar)?;
        Ok(SimulatedRun { run, rows })
    }

    /// The run.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// Simulates to the end of the run, and hands over the facts and rows of each hour.
    ///
    /// # Errors
    ///
    /// If a driver gives an impossible step.
    pub fn each_hour(
        &mut self,
        mut take: impl FnMut(&[Fact], &mut dyn Iterator<Item = RowText>),
    ) -> Result<(), DriverError> {
        let end = RunTime::START + self.run.length();
        let mut events = Events::default();
        while self.run.now() < end {
            self.run.advance((self.run.now() + HOUR).min(end), &mut events)?;
            take(&events.facts, &mut self.rows.of(&events.firings, self.run.settled()));
            events.clear();
        }
        Ok(())
    }

    /// Simulates to the end of the run. The log has the home's own names of sensors, and instants on a wall clock. The facts of each hour are
    /// handed over.
    ///
    /// # Errors
    ///
    /// As [`SimulatedRun::each_hour`].
    pub fn into_log(
        mut self,
        wall: impl Fn(RunTime) -> WallTime,
        mut take: impl FnMut(&[Fact]),
    ) -> Result<Log, DriverError> {
        let mut log = Log { sensors: sensor_names(&self.run), ..Log::default() };
        let mut known: HashMap<String, u32> = HashMap::new();
        self.each_hour(|facts, rows| {
            take(facts);
            for row in rows {
                let next = log.values.len() as u32;
                let value = *known.entry(row.value).or_insert_with_key(|value| {
                    log.values.push(value.clone());
                    next
                });
                log.events.push(Event { at: wall(row.at), sensor: row.sensor.0, value });
            }
        })?;
        Ok(log)
    }
}

fn sensor_names(run: &Run) -> Vec<String> {
    run.sensors().iter().map(|sensor| sensor.name.clone()).collect()
}
