//! Writes a log anew elsewhere, part by part, whatever its size: instants stay the same to the microsecond, and names and
//! values what they were, as far as the other form can write them.

use crate::error::LogError;
use crate::fresh::all_can_be_written;
use crate::mapping::Columns;
use crate::places::not_of_a_run;
use crate::run_info::RunInfo;
use crate::sink::{self, Begin, How};
use crate::source::{Clock, Event, Log, stream};
use crate::table::{Batch, Cell, Column, TextId, Texts};
use crate::url::Url;
use crate::writer::BATCH;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};

/// A log that is to be written anew, under our own names of table and columns.
///
/// Local times stay local. A log in UTC stays in UTC, but for the CASAS form, which knows local time only: there it is
/// the local time of `zone`. Notes of activities stay behind.
#[derive(Clone, Copy, Debug)]
pub struct Transfer<'a> {
    /// The log that is read.
    pub from: &'a Url,
    /// What its table and columns are called, where that is neither ours nor to be guessed.
    pub mapping: &'a LoggerFile,
    /// Where it is written to.
    pub to: &'a Url,
    /// What the log is called.
    pub name: &'a str,
    /// The name of a time zone.
    pub zone: &'a str,
    /// What becomes of what is there already.
    pub how: How,
}

/// What a row gets besides its own cells: by its number, counted from 0, and itself.
pub(crate) type More<'m> = dyn FnMut(u64, &Event, &Log, &mut Texts, &mut Vec<Cell>) -> Result<(), LogError> + 'm;

/// Columns behind those of a log.
pub(crate) struct Besides {
    /// What the table is called.
    pub name: &'static str,
    /// What a row of it is.
    pub about: &'static str,
    pub columns: Vec<Column>,
}

impl Transfer<'_> {
    /// Writes all rows, with what each gets besides; returns how many there are. `about` is the survey of the log; `progress` is
    /// told how many rows have been written.
    pub(crate) fn write(
        &self,
        about: &Log,
        besides: Option<Besides>,
        more: &mut More,
        progress: &mut dyn FnMut(u64),
    ) -> Result<u64, LogError> {
        not_of_a_run(self.to)?;
        let (zone, time) = match about.clock {
            Clock::Local => ("UTC", TimeFormat::Local),
            Clock::Utc => (self.zone, TimeFormat::Utc),
        };
        let calendar = Calendar::new("1970-01-01T00:00:00", zone).map_err(LogError::Zone)?;
        let start = calendar.timestamp(0).as_microsecond();
        let columns = Columns::new(&LoggerFile::default())?;
        let mut table = columns.log_table();
        if let Some(besides) = besides {
            (table.name, table.about) = (besides.name.into(), besides.about);
            table.columns.extend(besides.columns);
        }
        let run = RunInfo::of_log(self.name, calendar, about);
        all_can_be_written(&self.to.file().into_iter().collect::<Vec<_>>(), self.how == How::Replace)?;
        let mut sink = sink::open(self.to);
        let (width, tables) = (table.columns.len(), [table]);
        sink.begin(&Begin { run: &run, tables: &tables, time, run_column: &columns.run, how: self.how })?;
        let mut texts = Texts::default();
        let (mut sensors, mut values): (Vec<TextId>, Vec<TextId>) = (Vec::new(), Vec::new());
        let (mut seq, mut last, mut cells) = (0, start, Vec::with_capacity(width));
        stream(self.from, self.mapping, &mut |part| {
            sensors.extend(part.sensors[sensors.len()..].iter().map(|text| texts.id(text)));
            values.extend(part.values[values.len()..].iter().map(|text| texts.id(text)));
            for events in part.events.chunks(BATCH) {
                let mut batch = Batch::with_capacity(events.len(), width);
                for event in events {
                    let sensor = Cell::Text(sensors[event.sensor as usize]);
                    let value = Cell::Text(values[event.value as usize]);
                    cells.extend([Cell::Integer(seq as i64), Cell::Instant(event.at - start), sensor, value]);
                    more(seq, event, part, &mut texts, &mut cells)?;
                    batch.push(0, cells.drain(..));
                    (seq, last) = (seq + 1, event.at);
                }
                sink.write(&batch.with(&texts))?;
                progress(seq);
            }
            Ok(())
        })?;
        sink.finish(last - start)?;
        Ok(seq)
    }
}
