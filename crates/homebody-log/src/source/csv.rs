//! Comma-separated values: tables of events, of intervals, and of a column for each sensor. `layout.rs` decides which it is.

mod cells;
mod dates;
mod decimals;
mod events;
mod first_rows;
mod heading;
mod homes;
mod intervals;
mod layout;
mod measured;
mod pick;
mod refusals;
mod row_parts;
mod sensor_column;
mod wide;

use super::foreign::no_text;
use super::instant::InstantReader;
use super::messages::TableMessage;
use super::options::TableOptions;
use super::reading::LogReading;
use super::records::{Record, RecordReader};
use super::start::{FileStart, TableKind};
use super::{LogForm, Shows, casas};
use crate::error::LogError;
use events::EventRows;
use homebody_core::scenario::logger::LoggerFile;
use homes::HomeFilter;
use intervals::Intervals;
use layout::{RowColumns, TableLayout, refused};
use std::path::Path;
use wide::Wide;

pub(crate) const FORM: LogForm = LogForm {
    name: "csv",
    what: "comma-separated values with a timestamp, a sensor and optionally a value and an activity in each row; also Home \
           Assistant's history and the devices of pyadlml",
    shows: |start| Shows::rows_if(matches!(table(start), Some(TableKind::Events | TableKind::Refused))),
    read,
};

pub(crate) const INTERVALS: LogForm = LogForm {
    name: "pyadlml",
    what: "comma-separated values with a start and an end or a duration in each row, for activities or sensors (pyadlml, \
           Orange4Home)",
    shows: |start| match table(start) {
        Some(TableKind::Activities) => Shows::Activities,
        Some(TableKind::Intervals) => Shows::Rows,
        _ => Shows::Nothing,
    },
    read,
};

pub(crate) const WIDE: LogForm = LogForm {
    name: "wide",
    what: "comma-separated values with a column for each sensor: each change of a state and each numeric cell becomes a row",
    shows: |start| Shows::rows_if(table(start) == Some(TableKind::Wide)),
    read: |path, file, reading| {
        // A table that is wide by itself may have a column of devices, too.
        let found = TableLayout::find(path, file, &reading.options);
        let is_wide = matches!(found, Ok(Some(TableLayout { rows: RowColumns::Wide { .. }, .. })));
        reading.options.is_wide |= !is_wide;
        read(path, file, reading)
    },
};

fn table(start: &FileStart) -> Option<TableKind> {
    *start.table.get_or_init(|| {
        if no_text(start).is_some() || start.delimiters() == 0 {
            return None;
        }
        let found = TableLayout::find(&start.path, &LoggerFile::default(), &TableOptions::default());
        let has_tabs = start.delimiter() == b'\t';
        match found {
            // The text of CASAS has tabs and no heading, or its own.
            Ok(Some(layout)) if has_tabs && (layout.first_line == 1 || casas::has_own_heading(start)) => None,
            Ok(Some(layout)) => Some(match layout.rows {
                RowColumns::Events { .. } => TableKind::Events,
                RowColumns::Intervals { is_of_activities: true, .. } => TableKind::Activities,
                RowColumns::Intervals { .. } => TableKind::Intervals,
                RowColumns::Wide { .. } => TableKind::Wide,
            }),
            Err(_) if !has_tabs && (start.delimiters() >= 2 || start.is_steady()) && start.has_instants() => {
                Some(TableKind::Refused)
            }
            _ => None,
        }
    })
}

fn read(path: &Path, file: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let Some(layout) = TableLayout::find(path, file, &reading.options)? else { return Ok(()) };
    (reading.instants.order, reading.instants.is_utc) = (layout.order, layout.is_utc);
    reading.instants.has_day_numbers = layout.has_day_numbers;
    let (rows, skipped) = (reading.log.rows, reading.log.skipped);
    layout.uses.iter().for_each(|of| reading.column_use(of.clone()));
    reading.log.remarks.extend(layout.remarks.iter().cloned());
    let mut homes = HomeFilter::new(&layout, &reading.options);
    match &layout.rows {
        RowColumns::Events { .. } => {
            let mut events = EventRows::for_layout(&layout);
            each_row(path, &layout, &mut homes, reading, &mut |line, record, reading| {
                events.take(line, record, reading)
            })?;
        }
        RowColumns::Intervals { .. } => {
            let mut intervals = Intervals::for_layout(&layout);
            let mut take = |line, record: &Record, reading: &mut LogReading<'_>| intervals.take(line, record, reading);
            each_row(path, &layout, &mut homes, reading, &mut take)?;
            intervals.end(reading)?;
        }
        RowColumns::Wide { .. } => {
            let mut wide = Wide::for_layout(&layout);
            each_row(path, &layout, &mut homes, reading, &mut |line, record, reading| {
                wide.take(line, record, reading)
            })?;
            wide.end(reading);
        }
    }
    match homes {
        HomeFilter::Asked { column, home } if reading.log.rows == 0 && reading.log.activities.is_empty() => {
            Err(homes::without(path, &layout, column, &home))
        }
        _ => has_rows(path, reading.log.rows - rows, reading.log.skipped - skipped, !reading.log.activities.is_empty()),
    }
}

/// Refuses a table that loses most of its rows.
fn has_rows(path: &Path, rows: u64, skipped: u64, has_activities: bool) -> Result<(), LogError> {
    /// Fewer lost rows may be an accident.
    const MOST_LOST: u64 = 20;
    match has_activities || skipped < MOST_LOST || 9 * rows >= skipped {
        true => Ok(()),
        false => {
            let all = rows + skipped;
            Err(refused(path, TableMessage::ManyLost { skipped, rows: all }))
        }
    }
}

type TakeRecord<'t> = dyn FnMut(u64, &Record, &mut LogReading<'_>) -> Result<(), LogError> + 't;

fn each_row(
    path: &Path,
    layout: &TableLayout,
    homes: &mut HomeFilter,
    reading: &mut LogReading<'_>,
    take: &mut TakeRecord<'_>,
) -> Result<(), LogError> {
    let mut records = RecordReader::open(path)?;
    let mut alone = InstantReader::with_order(layout.order);
    alone.has_day_numbers = layout.has_day_numbers;
    let mut buffer = Vec::new();
    let mut is_row = |record: &Record| alone.read_bytes(layout.time.text(record, &mut buffer)).is_some();
    while let Some((line, record)) = records.next(&mut is_row)? {
        if line < layout.first_line
            || record.len() == 1 && record.get(0).is_none_or(|cell| cell.trim_ascii().is_empty())
        {
            continue;
        }
        match homes.admit(record) {
            _ if record.is_broken => reading.skip(line, "a quote in it is never closed".into()),
            Some(true) => take(line, record, reading)?,
            Some(false) => {}
            None => return Err(homes::several(path, layout)),
        }
    }
    if records.has_other_letters {
        reading
            .log
            .remarks
            .push("it is no text in UTF-8: its letters are read as those of Windows (windows-1252)".into());
    }
    Ok(())
}
