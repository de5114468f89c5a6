//! Rows of forms whose records say more than a row: rows in the order of time if asked for, what is known of their sensors, and
//! remarks on what was passed over.

use super::in_order::InOrder;
use super::instant::LogInstant;
use super::messages::TableMessage;
use super::reading::LogReading;
use crate::error::{LogError, place_of};
use crate::log::{ColumnRole, SensorInfo};
use foldhash::{HashMap, HashMapExt};
use homebody_core::sensed::{Meaning, meaning};
use homebody_core::time::{Interval, WallTime};
use std::collections::BTreeMap;
use std::path::Path;

/// Largest number of columns in a list: each sensor of a wide table is one.
const MOST_COLUMNS: usize = 100;

/// Rows on their way into a log.
pub(crate) struct Gathered<'r, 't> {
    pub reading: &'r mut LogReading<'t>,
    place: String,
    order: Option<InOrder>,
    known: BTreeMap<String, SensorInfo>,
    /// The last instant of each sensor, where rows are put into order.
    last: HashMap<String, WallTime>,
    backward: u64,
    counts: BTreeMap<&'static str, u64>,
    /// Since when a recorder has been stopped.
    stopped: Option<LogInstant>,
}

impl<'r, 't> Gathered<'r, 't> {
    pub fn as_they_come(path: &Path, reading: &'r mut LogReading<'t>) -> Gathered<'r, 't> {
        Gathered {
            reading,
            place: place_of(path),
            order: None,
            known: BTreeMap::new(),
            last: HashMap::new(),
            backward: 0,
            counts: BTreeMap::new(),
            stopped: None,
        }
    }

    pub fn in_order(path: &Path, reading: &'r mut LogReading<'t>) -> Gathered<'r, 't> {
        Gathered { order: Some(InOrder::new()), ..Gathered::as_they_come(path, reading) }
    }

    pub fn row(
        &mut self,
        line: u64,
        instant: LogInstant,
        [sensor, value]: [&str; 2],
        label: Option<Option<&str>>,
    ) -> Result<(), LogError> {
        let Some(order) = &mut self.order else {
            let is_row = self.reading.event(line, instant, sensor, value)?;
            if let (true, Some(label)) = (is_row, label) {
                self.reading.label(label);
            }
            return Ok(());
        };
        if value.is_empty() || sensor.is_empty() {
            let what = if sensor.is_empty() { "sensor" } else { "value" };
            self.reading.skip(line, format!("there is no {what}"));
            return Ok(());
        }
        let at = instant.on_wall();
        match self.last.get_mut(sensor) {
            Some(last) => {
                self.backward += u64::from(at < *last);
                *last = at;
            }
            None => drop(self.last.insert(sensor.to_owned(), at)),
        }
        order.row(line, instant, [sensor, value], label.flatten(), self.reading)
    }

    /// Keeps what the source reports of a sensor. Later reports add to it.
    pub fn know(&mut self, sensor: SensorInfo) {
        let Some(known) = self.known.get_mut(&sensor.id) else {
            self.known.insert(sensor.id.clone(), sensor);
            return;
        };
        // A domain of Home Assistant, such as `binary_sensor`, says less than a class of devices.
        if known.id.strip_prefix(&known.kind).is_some_and(|rest| rest.starts_with('.')) {
            known.kind.clear();
        }
        known.fill(sensor);
    }

    pub fn knows(&self, sensor: &str) -> bool {
        self.known.contains_key(sensor)
    }

    /// Records what a key or a column was taken for, once.
    pub fn column(&mut self, column: &str, used_as: ColumnRole, because: &str) {
        let columns = &self.reading.log.columns;
        let is_new = columns.iter().all(|known| known.column != column || known.used_as != used_as);
        if is_new && columns.len() < MOST_COLUMNS {
            self.reading.column(column, used_as, because);
        }
    }

    /// Counts something that a remark at the end reports, such as `values that are null`.
    pub fn count(&mut self, what: &'static str) {
        *self.counts.entry(what).or_default() += 1;
    }

    /// Says once that something is passed over.
    pub fn remark(&mut self, what: String) {
        if !self.reading.log.remarks.contains(&what) {
            self.reading.log.remarks.push(what);
        }
    }

    /// The name that a file has for the sensor of its rows: without the date behind it, and only if it has a word for what sensors
    /// measure, as `history.zigbee.0.hall.temperature.json` and `heart_rate-2020-01-05.json` have.
    pub fn named_by_file(&self) -> Option<String> {
        let name = Path::new(&self.place).file_name()?.to_str()?;
        let name = name.split(".json").next()?.trim_start_matches("history.");
        let name = name.trim_end_matches(|c: char| c.is_ascii_digit() || "-_. ".contains(c));
        let is_of_sensor = meaning(name, "").is_some_and(|meaning| meaning != Meaning::ReadingOnly);
        is_of_sensor.then(|| name.to_owned())
    }

    pub fn stop(&mut self, at: LogInstant) {
        self.stopped = Some(at);
    }

    /// Takes note that the recorder started: between its stop and now nothing was recorded.
    pub fn start(&mut self, at: LogInstant) {
        if let Some(stopped) = self.stopped.take().filter(|stopped| stopped.clock() == at.clock()) {
            let gap = Interval::new(stopped.on_wall(), at.on_wall());
            if !gap.is_empty() {
                self.reading.gap(gap);
            }
        }
    }

    pub fn refused(&self, why: TableMessage) -> LogError {
        LogError::no_log(self.place.as_str(), why)
    }

    /// Hands over all that waits, and what is known.
    pub fn end(self) -> Result<(), LogError> {
        let reading = self.reading;
        if let Some(order) = self.order {
            order.end(reading)?;
        }
        for (what, count) in self.counts {
            reading.log.remarks.push(format!("{what}: {count}"));
        }
        if self.backward > 0 {
            let remark = format!(
                "rows that are earlier than the row of the same sensor before them, and are put into the order of time: {}",
                self.backward
            );
            reading.log.remarks.push(remark);
        }
        let is_known = |sensor: &SensorInfo| {
            !sensor.kind.is_empty() || sensor.unit.is_some() || sensor.room.is_some() || sensor.name != sensor.id
        };
        self.known.into_values().filter(is_known).for_each(|sensor| reading.know(sensor));
        Ok(())
    }
}
