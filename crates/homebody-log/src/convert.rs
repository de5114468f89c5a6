//! Carries a log from one form into another: instants stay the same to the microsecond, and names and values what they
//! were, as far as the form can write them.

use crate::error::LogError;
use crate::fresh::all_can_be_written;
use crate::mapping::Columns;
use crate::run_info::RunInfo;
use crate::sink::{self, Begin, How};
use crate::source::{Clock, Log};
use crate::table::{Batch, Cell, Texts};
use crate::url::Url;
use crate::writer::BATCH;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};

/// Writes a log to a place, under our own names of table and columns; returns the number of rows. `name` is what the
/// log is called.
///
/// Local times stay local. A log in UTC stays in UTC, but for the CASAS form, which knows local time only: there it is
/// the local time of `zone`. Notes of activities stay behind.
pub fn convert(log: &Log, to: &Url, name: &str, zone: &str, how: How) -> Result<u64, LogError> {
    let (zone, time) = match log.clock {
        Clock::Local => ("UTC", TimeFormat::Local),
        Clock::Utc => (zone, TimeFormat::Utc),
    };
    let calendar = Calendar::new("1970-01-01T00:00:00", zone).map_err(LogError::Zone)?;
    let start = calendar.timestamp(0).as_microsecond();
    let columns = Columns::new(&LoggerFile::default())?;
    let run = RunInfo::plain(name, calendar, &log.sensors);
    let files: Vec<_> = to.file().into_iter().collect();
    all_can_be_written(&files, how == How::Replace)?;
    let mut sink = sink::open(to);
    let tables = [columns.log_table()];
    sink.begin(&Begin { run: &run, tables: &tables, time, run_column: &columns.run, how })?;
    let mut texts = Texts::default();
    let (sensors, values) = (texts.ids(&log.sensors), texts.ids(&log.values));
    let mut seq = 0;
    for events in log.events.chunks(BATCH) {
        let mut batch = Batch::with_capacity(events.len(), tables[0].columns.len());
        for event in events {
            let sensor = Cell::Text(sensors[event.sensor as usize]);
            let value = Cell::Text(values[event.value as usize]);
            batch.push(0, [Cell::Integer(seq), Cell::Instant(event.at - start), sensor, value]);
            seq += 1;
        }
        sink.write(&batch.with(&texts))?;
    }
    sink.finish(log.events.last().map_or(0, |event| event.at - start))?;
    Ok(seq as u64)
}
