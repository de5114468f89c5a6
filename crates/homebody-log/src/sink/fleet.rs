//! Many homes that tell one place, over one connection or into one file: what a fleet is, and what takes what it says.

use crate::error::LogError;
use crate::files::WriteMode;
use crate::policy::Deadline;
use crate::run::RunInfo;
use crate::table::{ColumnNames, Messages, ShownTexts, Table};
use homebody_core::event::{Firing, Value};
use homebody_core::ids::SensorId;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::{RunTime, UtcTime};
use std::sync::Arc;

/// The homes that tell one place.
#[derive(Debug)]
pub struct Fleet {
    /// The number of the first home among all that there may be: 1, unless several fleets share a place.
    pub first: u32,
    /// The kinds of homes.
    pub layouts: Vec<FleetLayout>,
    /// The homes; rows count them from 0.
    pub homes: Vec<FleetHome>,
}

/// One home of a fleet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FleetHome {
    /// Its name, such as `home00001`.
    pub name: String,
    /// Which of the layouts it has.
    pub layout: usize,
    /// The id of its run, as a run of its own would have it.
    pub run: i64,
    /// The number that all of its randomness comes from.
    pub seed: u64,
}

/// The properties that homes of one scenario share.
#[derive(Debug)]
pub struct FleetLayout {
    /// The description of their runs, without the id, name and seed of each home.
    pub run: RunInfo,
    /// The table that rows are of, under the names that the scenario's logger says.
    pub table: Table,
    /// The name of the column of the run's id.
    pub run_column: String,
    /// The format of instants.
    pub time: TimeFormat,
    shown: ShownTexts,
    file: LoggerFile,
}

impl FleetLayout {
    /// The layout of runs like this one.
    ///
    /// # Errors
    ///
    /// What is wrong with the names of the scenario's logger.
    pub fn new(run: RunInfo, file: &LoggerFile) -> Result<FleetLayout, LogError> {
        let columns = ColumnNames::new(file)?;
        let shown = ShownTexts::new(file, &run.sensor_names())?;
        let run = RunInfo { id: 0, home: None, seed: 0, ..run };
        Ok(FleetLayout {
            run,
            table: columns.log_table(),
            run_column: columns.run,
            time: shown.time,
            shown,
            file: file.clone(),
        })
    }

    /// The network's own id of a sensor.
    pub fn sensor(&self, sensor: SensorId) -> &str {
        &self.shown.sensors[sensor.index()]
    }

    /// The text of a value in the log, built in `buffer` where necessary.
    pub fn value<'a>(&'a self, value: Value, buffer: &'a mut String) -> &'a str {
        self.shown.value(value, buffer)
    }

    /// Turns the firings of a home with this seed into rows.
    pub fn rows(&self, seed: u64) -> HomeRows {
        HomeRows(Messages::new(&self.file.messages, seed, &self.run.sensor_names()))
    }
}

impl Fleet {
    /// The layout of a home.
    pub fn layout_of(&self, home: u32) -> &FleetLayout {
        &self.layouts[self.homes[home as usize].layout]
    }

    /// The description of a home's run.
    pub fn run_of(&self, home: u32) -> RunInfo {
        let FleetHome { name, run, seed, .. } = &self.homes[home as usize];
        RunInfo { id: *run, home: Some(name.clone()), seed: *seed, ..self.layout_of(home).run.clone() }
    }
}

/// Turns the firings of one home into the rows that its log has of them.
#[derive(Clone)]
pub struct HomeRows(Messages);

impl HomeRows {
    /// All rows from the last `until` to this one: the number of each, its time, the sensor and what it said.
    pub fn of(&mut self, firings: &[Firing], until: RunTime, mut each: impl FnMut(u64, RunTime, SensorId, Value)) {
        let mut rows = Vec::new();
        for firing in firings {
            self.0.firing(firing, &mut rows);
        }
        self.0.quiet(until, &mut rows);
        rows.iter().for_each(|row| each(row.seq, row.at, row.sensor, row.value));
    }
}

/// A row of a home's log on its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FleetRow {
    /// The rows of a home are numbered from 0.
    pub seq: u64,
    /// Its time by the home's clock.
    pub at: RunTime,
    /// The time at which it is due, in UTC.
    pub due: UtcTime,
    /// Its home.
    pub home: u32,
    /// Which of the home's sensors said it.
    pub sensor: SensorId,
    /// Its value.
    pub value: Value,
}

/// An event of a fleet for a destination.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FleetEvent {
    /// A row.
    Row(FleetRow),
    /// A home has come.
    Comes(u32),
    /// A home has gone.
    Goes(u32),
}

/// A destination of the rows of a fleet.
///
/// The order of calls: [`begin`](FleetSink::begin) once, then any number of [`tell`](FleetSink::tell), then [`finish`](FleetSink::finish),
/// or drop if the fleet is given up. After an error that [`passes`](LogError::passes) the same call is made again with the same rows, if
/// there is time: the destination must not store rows twice.
pub trait FleetSink: Send {
    /// Checks that such a fleet can write here, as far as the URL says; `is_fast` if it is faster than real time.
    ///
    /// # Errors
    ///
    /// All problems of the URL.
    fn check(&self, _is_fast: bool) -> Result<(), LogError> {
        Ok(())
    }

    /// Begins. Returns for each home the number of its rows that the place holds already; it does not get these again. Each request, now and
    /// later, has the time of the deadline.
    fn begin(&mut self, fleet: &Arc<Fleet>, how: WriteMode, deadline: &Deadline) -> Result<Vec<u64>, LogError>;

    /// Takes events in order, and returns once they have arrived, as far as a place of this kind can tell.
    fn tell(&mut self, told: &[FleetEvent]) -> Result<(), LogError>;

    /// Makes sure of everything; the fleet has ended at this instant.
    fn finish(&mut self, end: UtcTime) -> Result<(), LogError>;

    /// Whether it is a file of this machine, which has more time than a server.
    fn is_file(&self) -> bool {
        false
    }

    /// The largest number of events of one call.
    fn most_at_once(&self) -> usize {
        MOST_AT_ONCE
    }
}

/// Largest batch for a destination that gives no other (our choice).
const MOST_AT_ONCE: usize = 1000;
