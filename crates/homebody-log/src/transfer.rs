//! Writes a log anew elsewhere, part by part, whatever its size: instants stay the same to the microsecond, and names and
//! values what they were, as far as the other form can write them.

pub(crate) mod anonymise;
pub(crate) mod convert;
pub(crate) mod label;

use crate::destination::writer::BATCH;
use crate::error::LogError;
use crate::files::{WriteMode, all_can_be_written};
use crate::log::{Clock, Event, Log, SPAN_COLUMNS, says_more_of, spans};
use crate::policy::Deadline;
use crate::read::{LogSource, activities_of, activities_of_set, stream};
use crate::registry;
use crate::run::{RunInfo, SensorTable, not_of_a_run, sensor_table};
use crate::sink::{Begin, Whole};
use crate::table::{Batch, Cell, Column, ColumnNames, TextId, TextPool};
use crate::url::Url;
use homebody_core::calendar::Calendar;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::scenario::scheme::TablePlacement;
use homebody_core::time::{RunTime, Span, UtcTime, WallTime};
use homebody_timeline::Episode;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A log that is to be written anew, under our own names of table and columns.
///
/// Local times stay local. A log in UTC stays in UTC, but for the CASAS form, which knows local time only: there it is
/// the local time of `zone`.
#[derive(Clone, Copy, Debug)]
pub struct Transfer<'a> {
    /// The log that is read.
    pub from: &'a LogSource,
    /// The names of its table and columns, if they are neither ours nor easy to guess.
    pub mapping: &'a LoggerFile,
    /// The place of the new log.
    pub to: &'a Url,
    /// The name of the log.
    pub name: &'a str,
    /// The name of a time zone.
    pub zone: &'a str,
    /// The treatment of existing files.
    pub how: WriteMode,
}

/// Adds cells to a row, by its number, from 0.
pub(crate) type More<'m> = dyn FnMut(u64, &Event, &Log, &mut TextPool, &mut Vec<Cell>) -> Result<(), LogError> + 'm;

/// Columns behind those of a log.
pub(crate) struct Besides<'b> {
    /// The name of the table and the meaning of its rows, if they are not those of a log.
    pub table: Option<(&'static str, &'static str)>,
    pub columns: Vec<Column>,
    /// Activities that go into a table of their own.
    pub spans: &'b [Episode<WallTime>],
    /// Changes to rows.
    pub rewrite: Option<&'b Rewrite<'b>>,
}

/// Changes to rows; lists are in the order of the log's sensors and values.
pub(crate) struct Rewrite<'r> {
    /// The delay.
    pub shift: Span,
    /// The names of sensors.
    pub sensors: &'r [String],
    /// Which values stay: rows of others are left out.
    pub keeps: &'r [bool],
}

impl Besides<'_> {
    /// Columns of a log, without further ones.
    pub fn of_log() -> Self {
        Besides { table: None, columns: Vec::new(), spans: &[], rewrite: None }
    }
}

impl Transfer<'_> {
    /// Writes all rows, with their further cells; returns the number of rows. `about` is the survey of the log; `progress` gets the number
    /// of written rows.
    pub(crate) fn write(
        &self,
        about: &Log,
        besides: Besides<'_>,
        more: &mut More,
        progress: &mut dyn FnMut(u64),
    ) -> Result<u64, LogError> {
        not_of_a_run(self.to)?;
        let (zone, time) = match about.clock {
            Clock::Local => ("UTC", TimeFormat::Local),
            Clock::Utc => (self.zone, TimeFormat::Utc),
        };
        let calendar =
            Calendar::new("1970-01-01T00:00:00", zone).map_err(|why| LogError::Zone { why: why.to_string() })?;
        // Of this calendar, the log's own clock is that of UTC.
        let start = UtcTime::from(calendar.timestamp(RunTime::START)).on_wall_of_utc();
        let columns = ColumnNames::new(&LoggerFile::default())?;
        let mut table = columns.log_table();
        let Besides { table: named, columns: more_columns, spans, rewrite } = besides;
        if let Some((name, told)) = named {
            (table.name, table.about) = (name.into(), told);
        }
        table.columns.extend(more_columns);
        let run = RunInfo::of_log(self.name, calendar, about);
        let (width, mut tables) = (table.columns.len(), vec![table]);
        let beside = self.beside(spans);
        let names = self.names(&run).map(|path| SensorTable::new(path, &run)).transpose()?;
        let new_names = names.as_ref().filter(|names| !names.is_there()).map(|names| &*names.path);
        let besides = beside.as_ref().and_then(Url::file).into_iter().chain(new_names);
        let files: Vec<&Path> = self.to.file().into_iter().chain(besides).collect();
        all_can_be_written(&files, self.how == WriteMode::Overwrite)?;
        if beside.is_none() && !spans.is_empty() {
            tables.push(spans::table());
        }
        let has_own_spans = tables.len() > 1;
        let (how, spreadsheet_safe) = (self.how, self.mapping.spreadsheet_safe);
        let deadline = Deadline::new(registry::policy(self.to).answers_within);
        let begin = Begin::new(Arc::new(run), tables, time, how);
        let begin = Begin { run_column: columns.run, spreadsheet_safe, is_whole: true, deadline, ..begin };
        let whole = Whole::begin(self.to, how)?;
        let mut sink = registry::sink(whole.part());
        sink.begin(&begin)?;
        if let Some(beside) = &beside {
            let mut sink = registry::sink(beside);
            sink.begin(&Begin { tables: Arc::new(vec![spans::table()]), ..begin })?;
            sink.write(&spans_as_rows(spans, 0, start, &mut TextPool::default()))?;
            sink.finish(RunTime::START)?;
        }
        let mut texts = TextPool::default();
        let (mut sensors, mut values): (Vec<TextId>, Vec<TextId>) = (Vec::new(), Vec::new());
        let (mut seq, mut last, mut cells) = (0, start, Vec::with_capacity(width));
        stream(self.from, self.mapping, &mut |part| {
            let names = rewrite.map_or(&part.sensors[..], |rewrite| rewrite.sensors);
            sensors.extend(names[sensors.len()..part.sensors.len()].iter().map(|text| texts.id(text)));
            values.extend(part.values[values.len()..].iter().map(|text| texts.id(text)));
            for events in part.events.chunks(BATCH) {
                let mut batch = Batch::with_capacity(events.len(), width);
                let stays = |event: &&Event| rewrite.is_none_or(|rewrite| rewrite.keeps[event.value as usize]);
                for event in events.iter().filter(stays) {
                    let event = &Event { at: event.at + rewrite.map_or(Span::ZERO, |rewrite| rewrite.shift), ..*event };
                    let sensor = Cell::Text(sensors[event.sensor as usize]);
                    let value = Cell::Text(values[event.value as usize]);
                    let at = Cell::Instant(RunTime::START + (event.at - start));
                    cells.extend([Cell::Integer(seq as i64), at, sensor, value]);
                    more(seq, event, part, &mut texts, &mut cells)?;
                    batch.push(0, cells.drain(..));
                    (seq, last) = (seq + 1, event.at);
                }
                sink.write(&batch.with(&texts))?;
                progress(seq);
            }
            Ok(())
        })?;
        if has_own_spans {
            sink.write(&spans_as_rows(spans, 1, start, &mut texts))?;
        }
        // First, so that a finished log has its sensors. The same command accepts the table that it left.
        if let Some(names) = &names {
            names.write(how != WriteMode::Create)?;
        }
        sink.finish(RunTime::START + (last - start))?;
        drop(sink);
        whole.name()?;
        Ok(seq)
    }

    /// The path of the table of its sensors, if more is known of them than their ids. A table that is there would be taken for this log's, so
    /// it is written anew in any case. The table of the log that is read stays.
    fn names(&self, run: &RunInfo) -> Option<PathBuf> {
        let names = sensor_table::beside_url(self.to)?;
        let is_read = sensor_table::beside(self.from.path()) == names;
        (!is_read && (says_more_of(&run.sensors) || names.exists())).then_some(names)
    }

    /// The file of activities, if the log's own file has no room for them. An existing one would be taken for this log's, so it is written
    /// anew even without activities.
    fn beside(&self, spans: &[Episode<WallTime>]) -> Option<Url> {
        if self.to.scheme().row().tables != TablePlacement::FileEach {
            return None;
        }
        let path = match self.to.is_data_set() {
            true => activities_of_set(self.to.path()),
            false => activities_of(self.to.file()?),
        };
        (!spans.is_empty() || path.exists()).then(|| self.to.at(path))
    }
}

fn spans_as_rows(spans: &[Episode<WallTime>], table: usize, start: WallTime, texts: &mut TextPool) -> Batch {
    let mut batch = Batch::with_capacity(spans.len(), SPAN_COLUMNS.len());
    for span in spans {
        let cells = spans::cells(span, start, texts);
        batch.push(table, cells);
    }
    batch.with(texts)
}
