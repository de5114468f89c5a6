//! Carries a log from one form into another: instants stay the same to the microsecond, and names and values what they
//! were, as far as the form can write them.

use crate::error::LogError;
use crate::logger::RunInfo;
use crate::mapping::{Columns, Shown};
use crate::messages::{Row, RowValue};
use crate::sink::Opening;
use crate::source::{Clock, Log};
use crate::url::Url;
use crate::writer::BATCH;
use homebody_core::ids::SensorId;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};

/// Writes a log to a place, under our own names of table and columns.
///
/// Local times stay local. A log in UTC stays in UTC, but for the CASAS form, which knows local time only: there it is
/// the local time of `zone`. Notes of activities stay behind.
pub fn convert(log: &Log, to: &Url, run: &RunInfo, zone: &str, force: bool) -> Result<u64, LogError> {
    let (zone, time) = match log.clock {
        Clock::Local => ("UTC", TimeFormat::Local),
        Clock::Utc => (zone, TimeFormat::Utc),
    };
    let calendar = Calendar::new("1970-01-01T00:00:00", zone).map_err(LogError::Zone)?;
    let start = calendar.timestamp(0).as_microsecond();
    let columns = Columns::new(&LoggerFile::default())?;
    let shown =
        Shown { sensors: log.sensors.clone(), values: [String::new(), String::new()], texts: log.values.clone(), time };
    let mut sink = Opening { columns: &columns, shown: &shown, calendar: &calendar, run, force }.open(to)?;
    let mut seq = 0;
    for events in log.events.chunks(BATCH) {
        let rows = events.iter().zip(seq..);
        let rows: Vec<Row> = rows
            .map(|(event, seq)| Row {
                seq,
                at: event.at - start,
                sensor: SensorId(event.sensor),
                value: RowValue::Text(event.value),
            })
            .collect();
        sink.write(&rows)?;
        seq += rows.len() as u64;
    }
    let end = log.events.last().map_or(0, |event| event.at - start);
    sink.finish(end)?;
    Ok(seq)
}
