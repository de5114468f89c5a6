//! Tables with a column for each sensor, and a row for each instant.
//!
//! Of a sensor with states each change becomes a row of the log; 0 and 1 are OFF and ON, and what is off in the first row has no
//! row. Of a sensor with numbers each cell is a reading. An empty cell says nothing.

use super::cells::{is_blank, is_off};
use super::layout::{RowColumns, TableLayout, WideSensor};
use super::row_parts::joined;
use crate::error::LogError;
use crate::files::plain::text;
use crate::limits::beginning;
use crate::log::{Clock, SensorInfo};
use crate::source::in_order::{OFF, ON};
use crate::source::instant::LogInstant;
use crate::source::instant::date_parts::no_instant;
use crate::source::reading::LogReading;
use crate::source::records::Record;
use crate::text::unescaped;
use homebody_core::problem::counted;
use std::collections::BTreeMap;

pub(crate) struct Wide<'l> {
    layout: &'l TableLayout,
    prefix: &'l [usize],
    sensors: &'l [WideSensor],
    time: Vec<u8>,
    /// The last words of the sensors, by the prefix and the clock of their rows: the log's clock is known later.
    last: BTreeMap<(Vec<u8>, Clock), Vec<LastReading>>,
    last_at: Option<LogInstant>,
    key: Vec<u8>,
}

struct LastReading {
    name: String,
    said: Vec<u8>,
}

impl<'l> Wide<'l> {
    pub fn for_layout(layout: &'l TableLayout) -> Wide<'l> {
        let (prefix, sensors): (&[usize], &[WideSensor]) = match &layout.rows {
            RowColumns::Wide { prefix, sensors } => (prefix, sensors),
            _ => (&[], &[]),
        };
        Wide { layout, prefix, sensors, time: Vec::new(), last: BTreeMap::new(), last_at: None, key: Vec::new() }
    }

    pub fn take(&mut self, line: u64, record: &Record, reading: &mut LogReading<'_>) -> Result<(), LogError> {
        let time = self.layout.time.text(record, &mut self.time);
        let Some(at) = reading.instants.read_bytes(time) else {
            reading.skip(line, no_instant(text(time).trim()));
            return Ok(());
        };
        if let Some(label) = self.layout.label {
            let label = text(record.get(label).unwrap_or_default().trim_ascii());
            reading.label_of(at, Some(unescaped(&label)).filter(|label| !label.is_empty()));
        }
        joined(self.prefix, record, &mut self.key);
        let key = (std::mem::take(&mut self.key), at.clock());
        if !self.last.contains_key(&key) {
            let before = text(&key.0);
            let name = |sensor: &WideSensor| match before.is_empty() {
                true => sensor.name.clone(),
                false => format!("{before} {}", sensor.name),
            };
            let said = self.sensors.iter().map(|sensor| LastReading { name: name(sensor), said: Vec::new() }).collect();
            self.last.insert(key.clone(), said);
        }
        if let Some(of) = self.last.get_mut(&key) {
            for (sensor, last) in self.sensors.iter().zip(of) {
                let cell = record.get(sensor.column).unwrap_or_default().trim_ascii();
                let cell = self.layout.numbers.plain(sensor.column, cell);
                take_cell(line, at, &cell, (sensor, last), reading)?;
            }
        }
        self.key = key.0;
        self.last_at = Some(at);
        Ok(())
    }

    /// Ends the label of the last row, and names the sensors that have no rows.
    pub fn end(self, reading: &mut LogReading<'_>) {
        if let (Some(at), Some(_)) = (self.last_at, self.layout.label) {
            reading.label_of(at, None);
        }
        for (sensor, of) in self.last.values().flat_map(|of| self.sensors.iter().zip(of)) {
            if let Some(unit) = &sensor.unit {
                reading.know(SensorInfo { unit: Some(unit.clone()), ..SensorInfo::named(&of.name) });
            }
        }
        let columns = counted(self.sensors.len(), "column is a sensor", "columns are sensors");
        let states = self.sensors.iter().filter(|sensor| sensor.has_states).count();
        reading
            .log
            .remarks
            .push(format!("{columns}: of {states} with states each change is a row, of the others each number"));
        let all = self.last.values().flatten().filter(|of| !reading.log.sensors.contains(&of.name));
        let mut silent: Vec<&str> = all.map(|of| of.name.as_str()).collect();
        silent.dedup();
        if !silent.is_empty() {
            /// So many are named.
            const NAMED: usize = 5;
            let names = silent.iter().take(NAMED).map(|name| beginning(name)).collect::<Vec<_>>().join(", ");
            let more = if silent.len() > NAMED { ", ..." } else { "" };
            let count =
                counted(silent.len(), "sensor never comes on and has no row", "sensors never come on and have no row");
            reading.log.remarks.push(format!("{count}: {names}{more}"));
        }
    }
}

fn take_cell(
    line: u64,
    at: LogInstant,
    cell: &[u8],
    (sensor, last): (&WideSensor, &mut LastReading),
    reading: &mut LogReading<'_>,
) -> Result<(), LogError> {
    if str::from_utf8(cell).is_ok_and(is_blank) {
        return Ok(());
    }
    if !sensor.has_states {
        reading.event_of_bytes(line, at, last.name.as_bytes(), cell)?;
        return Ok(());
    }
    let said = match cell {
        b"0" | b"0.0" => OFF.as_bytes(),
        b"1" | b"1.0" => ON.as_bytes(),
        other => other,
    };
    let is_first_off = last.said.is_empty() && is_off(&text(said));
    if last.said != said && (is_first_off || reading.event_of_bytes(line, at, last.name.as_bytes(), said)?) {
        last.said.clear();
        last.said.extend_from_slice(said);
    }
    Ok(())
}
