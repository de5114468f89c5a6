//! The parts of a table's row: its instant, the name of its sensor, and what its columns say of that sensor.

use super::layout::{RowColumns, SensorColumns, TableLayout};
use super::pick::TimeColumns;
use crate::files::plain::text;
use crate::log::SensorInfo;
use crate::source::reading::LogReading;
use crate::source::records::Record;
use crate::text::unescaped;

impl TimeColumns {
    /// The text of a row's instant; `buffer` is where date and time of day are put together.
    #[inline]
    pub fn text<'r>(&self, record: &'r Record, buffer: &'r mut Vec<u8>) -> &'r [u8] {
        let cell = |column: usize| record.get(column).unwrap_or_default();
        let Some(of_day) = self.of_day else { return cell(self.column) };
        buffer.clear();
        buffer.extend_from_slice(cell(self.column).trim_ascii());
        buffer.push(b' ');
        buffer.extend_from_slice(cell(of_day).trim_ascii());
        buffer
    }
}

impl SensorColumns {
    /// The name of a row's sensor; `buffer` is where the cells of several columns are put together.
    #[inline]
    pub fn name<'r>(&'r self, record: &'r Record, buffer: &'r mut Vec<u8>) -> &'r [u8] {
        match self {
            SensorColumns::Alone(name) => name.as_bytes(),
            SensorColumns::Columns(columns) => match columns[..] {
                [column] => record.get(column).unwrap_or_default(),
                _ => joined(columns, record, buffer),
            },
        }
    }
}

/// The cells of columns, parted by blanks.
pub(crate) fn joined<'b>(columns: &[usize], record: &Record, buffer: &'b mut Vec<u8>) -> &'b [u8] {
    buffer.clear();
    for &column in columns {
        let cell = record.get(column).unwrap_or_default().trim_ascii();
        if !buffer.is_empty() && !cell.is_empty() {
            buffer.push(b' ');
        }
        buffer.extend_from_slice(cell);
    }
    buffer
}

/// Keeps what a row says of a sensor that has come for the first time: its kind, room and unit.
pub(crate) fn know(layout: &TableLayout, record: &Record, reading: &mut LogReading<'_>) {
    if let Some(id) = reading.log.sensors.last().cloned() {
        know_named(layout, record, &id, reading);
    }
}

pub(crate) fn know_named(layout: &TableLayout, record: &Record, id: &str, reading: &mut LogReading<'_>) {
    let TableLayout { kind, room, unit, .. } = *layout;
    let behind = match layout.rows {
        RowColumns::Events { value: Some(value), .. } => {
            layout.numbers.unit(value, record.get(value).unwrap_or_default())
        }
        _ => None,
    };
    if kind.or(room).or(unit).is_none() && behind.is_none()
        || id.is_empty()
        || reading.log.known.iter().any(|known| known.id == id)
    {
        return;
    }
    let cell = |column: Option<usize>| {
        let cell = text(record.get(column?).unwrap_or_default().trim_ascii());
        Some(unescaped(&cell).to_owned()).filter(|cell| !cell.is_empty())
    };
    let kind = cell(kind).unwrap_or_default();
    let is_motion = kind.to_lowercase().contains("motion") || kind.eq_ignore_ascii_case("pir");
    let known = SensorInfo { kind, is_motion, room: cell(room), unit: cell(unit).or(behind), ..SensorInfo::named(id) };
    reading.know(known);
}
