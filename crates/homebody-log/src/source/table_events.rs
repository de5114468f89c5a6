//! Tables with an event in each row.

use super::decimals::with_point;
use super::layout::{Layout, Rows};
use super::pick::FIRING;
use super::reading::Reading;
use super::records::Record;
use super::row_parts::know;
use crate::error::LogError;
use crate::plain::text;
use crate::spreadsheet::{unescaped, unescaped_bytes};

/// Reads events.
pub(super) struct Events<'l> {
    layout: &'l Layout,
    time: Vec<u8>,
    sensor: Vec<u8>,
}

impl<'l> Events<'l> {
    pub fn of(layout: &'l Layout) -> Events<'l> {
        Events { layout, time: Vec::new(), sensor: Vec::new() }
    }

    pub fn take(&mut self, line: u64, record: &Record, reading: &mut Reading<'_>) -> Result<(), LogError> {
        let Rows::Events { sensor, value: place, is_mapped } = &self.layout.rows else { return Ok(()) };
        let time = self.layout.time.text(record, &mut self.time);
        let mut sensor = sensor.name(record, &mut self.sensor);
        let mut value = place.map_or(FIRING.as_bytes(), |place| record.get(place).unwrap_or_default());
        if !is_mapped {
            (sensor, value) = (sensor.trim_ascii(), value.trim_ascii());
        }
        let with_point = if self.layout.has_decimal_comma { with_point(value) } else { None };
        let value = with_point.as_deref().unwrap_or_else(|| unescaped_bytes(value));
        let sensors = reading.log.sensors.len();
        if !reading.row_of_bytes(line, time, unescaped_bytes(sensor), value)? {
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
