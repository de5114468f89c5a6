//! Tables with an event in each row.

use super::layout::{RowColumns, TableLayout};
use super::pick::FIRING;
use super::row_parts::know;
use crate::error::LogError;
use crate::files::plain::text;
use crate::source::instant::date_parts::no_instant;
use crate::source::reading::LogReading;
use crate::source::records::Record;
use crate::text::{unescaped, unescaped_bytes};
use std::borrow::Cow;

pub(crate) struct EventRows<'l> {
    layout: &'l TableLayout,
    time: Vec<u8>,
    sensor: Vec<u8>,
}

impl<'l> EventRows<'l> {
    pub fn for_layout(layout: &'l TableLayout) -> EventRows<'l> {
        EventRows { layout, time: Vec::new(), sensor: Vec::new() }
    }

    pub fn take(&mut self, line: u64, record: &Record, reading: &mut LogReading<'_>) -> Result<(), LogError> {
        let RowColumns::Events { sensor, value: place, is_mapped } = &self.layout.rows else { return Ok(()) };
        let time = self.layout.time.text(record, &mut self.time);
        let mut sensor = sensor.name(record, &mut self.sensor);
        let mut value = place.map_or(FIRING.as_bytes(), |place| record.get(place).unwrap_or_default());
        if !is_mapped {
            (sensor, value) = (sensor.trim_ascii(), value.trim_ascii());
        }
        let value = unescaped_bytes(value);
        let value = place.map_or(Cow::Borrowed(value), |place| self.layout.numbers.plain(place, value));
        if let Some((name, begins)) = label_of(sensor, &value) {
            match reading.instants.read_bytes(time) {
                Some(at) => reading.note_of(at, &text(name), begins),
                None => reading.skip(line, no_instant(&text(time))),
            }
            return Ok(());
        }
        let sensors = reading.log.sensors.len();
        if !reading.row_of_bytes(line, time, unescaped_bytes(sensor), &value)? {
            return Ok(());
        }
        if reading.log.sensors.len() > sensors {
            know(self.layout, record, reading);
        }
        if let Some(column) = self.layout.label {
            let label = text(record.get(column).unwrap_or_default().trim_ascii());
            let label = Some(unescaped(&label)).filter(|label| !label.is_empty());
            // A number behind the value is a reading.
            reading.label(
                label.filter(|label| Some(column) != place.map(|place| place + 1) || label.parse::<f64>().is_err()),
            );
        }
        Ok(())
    }
}

/// The activity of a row of labels, as Orange4Home has them: `label,START:Kitchen|Cooking` begins an activity.
fn label_of<'v>(sensor: &[u8], value: &'v [u8]) -> Option<(&'v [u8], bool)> {
    if !sensor.eq_ignore_ascii_case(b"label") {
        return None;
    }
    let of = |word: &[u8]| value.strip_prefix(word).map(<[u8]>::trim_ascii).filter(|name| !name.is_empty());
    of(b"START:").map(|name| (name, true)).or_else(|| of(b"STOP:").map(|name| (name, false)))
}
