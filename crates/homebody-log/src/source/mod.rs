//! Reads logs back: ours, and what real homes recorded. One file for each form, all in one shape, which `form.rs` says;
//! `forms.rs` lists them.
//!
//! A log is read into memory, or streamed where it may be of any size. Beside a run's log lies a table of its sensors; what it
//! tells comes with the log.
//!
//! Whatever is in a file, reading does not fail because of a line: what cannot be understood is skipped and told. Only what is
//! longer than anything that a log has ends it, before it fills the memory.

mod above;
mod activities;
mod casas;
mod casas_layout;
mod casas_words;
mod causes;
mod cells;
mod columns;
mod csv;
mod database;
mod date_parts;
mod dateless;
mod dates_of_table;
mod decimals;
mod devices;
mod domoticz;
mod each_second;
mod entity;
mod esphome;
mod first_rows;
mod foreign;
mod form;
mod form_messages;
mod forms;
mod gathered;
mod heading;
mod home_assistant;
mod homes;
mod in_order;
mod influx_csv;
mod influx_lines;
mod instant;
mod intervals;
mod json;
mod json_hint;
mod json_text;
mod jsonl;
mod labels;
mod layout;
mod lines;
mod lives;
mod located;
mod log;
mod measured;
mod mit;
mod mosquitto;
mod movements;
mod object_rows;
mod one_home;
mod openhab;
mod options;
mod pairs;
mod parallel;
mod payload;
mod pick;
mod psql;
mod reading;
mod recorded_truth;
mod records;
mod refusals;
mod registry;
mod row_parts;
mod run_clock;
mod said;
mod sensor_column;
mod sensors;
mod series;
mod sets;
mod sqlite;
mod start;
mod table_events;
mod table_intervals;
mod table_messages;
mod table_wide;
mod tables;
mod tables_of_text;
mod tasmota;
mod truth_of_log;
mod truth_rows;
mod turns;
mod xes;
mod zigbee2mqtt;

use crate::error::{LogError, place_of};
pub use crate::skipped::Skipped;
pub use crate::spans::{SPAN_COLUMNS, SPANS};
use crate::word::one_word;
pub use activities::Activity;
pub(crate) use causes::{Cause, Causes};
pub use columns::Places;
pub(crate) use database::{connect, connect_only, first_row, text};
pub use form::{Form, Shows};
use form_messages::FormMessage;
pub use forms::{FORMS, forms};
use homebody_core::problem::readable;
use homebody_core::scenario::logger::LoggerFile;
pub use instant::{Instant, since_1970};
pub(crate) use lives::lives_of;
pub use lives::{Life, LifeSpan, SpanKind, activities, life_spans, lives};
pub use located::Source;
pub(crate) use located::{activities_of, activities_of_set};
pub use log::{Clock, ColumnRole, ColumnUse, Event, Log, OffsetSpan, Pair};
pub use movements::{Movement, MovementKind, Movements};
pub use options::{DateOrder, DecimalMark, HomeColumn, TableOptions};
pub use reading::Reading;
pub(crate) use recorded_truth::{LABEL_TABLES, RecordedTruth};
pub use recorded_truth::{is_brief, is_truth_set, truth_at, truth_beside, truth_of};
pub use run_clock::RunClock;
pub use sensors::SensorMap;
pub use start::Start;
use std::path::Path;
pub use tables::{ReadTables, TakeRow, Value};
pub(crate) use tables_of_text::read_numbers;
pub use truth_of_log::is_truth_of;
pub use truth_rows::truth_rows;

/// The messages about files that are not logs.
pub(crate) const MESSAGES: [&[homebody_core::messages::Entry]; 2] = {
    use homebody_core::messages::Catalogue;
    [FormMessage::ENTRIES, table_messages::TableMessage::ENTRIES]
};

/// Reads a log into memory; `file` tells the names of a database's table and columns, or of a CSV file's columns, where they
/// are neither ours nor to be guessed.
pub fn read(from: impl Into<Source>, file: &LoggerFile) -> Result<Log, LogError> {
    let mut events = Vec::new();
    let log = stream(from, file, &mut |part| {
        events.extend_from_slice(&part.events);
        Ok(())
    })?;
    Ok(Log { events, ..log })
}

/// Reads a log through and keeps none of its rows: its sensors, values and clock, how many rows it has, and what was left out.
pub fn survey(from: impl Into<Source>, file: &LoggerFile) -> Result<Log, LogError> {
    stream(from, file, &mut |_| Ok(()))
}

/// Reads a log of any size in little memory. `take` gets its rows in parts, in their order: each time a log with the rows of
/// that part, and with the sensors and values that have come so far. What is returned has all but the rows.
pub fn stream(
    from: impl Into<Source>,
    file: &LoggerFile,
    take: &mut dyn FnMut(&Log) -> Result<(), LogError>,
) -> Result<Log, LogError> {
    let source = from.into();
    let path = source.path();
    let mut reading = Reading::new(take);
    reading.place = place_of(path);
    reading.options = source.options().clone();
    let table = sensors::known_beside(path)?;
    reading.log.known = table.known;
    reading.log.remarks.extend(table.remark);
    let beside = source.activities_beside();
    reading.has_spans = beside.is_some();
    read_parts(&source, file, &mut reading)?;
    match beside {
        Some(beside) => {
            reading.go_beside(beside.path());
            (beside.form().read)(beside.path(), file, &mut reading)?;
        }
        None if !reading.has_activities() => read_labels(&source, file, &mut reading)?,
        None => {}
    }
    let mut log = reading.end()?;
    match log.problems.first() {
        Some(first) if log.rows == 0 && log.activities.is_empty() => {
            let why = FormMessage::NoRow { line: first.line, reason: first.why.clone() };
            Err(no_log(&source, LogError::no_log(place_of(path), why)))
        }
        _ => {
            log.skipped += table.problems.len() as u64;
            log.problems.extend(table.problems);
            Ok(log)
        }
    }
}

/// Reads the files of a log, one after the other.
fn read_parts(source: &Source, file: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let parts = source.parts();
    for part in &parts {
        if parts.len() > 1 {
            reading.go_on(&part.path, part.begin);
        }
        (source.form().read)(&part.path, file, reading).map_err(|error| no_log(source, error))?;
    }
    if let [first, .., last] = &parts[..] {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let files = format!("{} files, {} to {}", parts.len(), name(&first.path), name(&last.path));
        reading.log.remarks.push(readable(format!("it is one log in {files}")));
    }
    Ok(())
}

/// Reads the labels for a log without its own, if one file in its folder has them.
fn read_labels(source: &Source, file: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let found = source.labels_beside();
    let name = |of: &Source| of.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
    let remark = match &found[..] {
        [] => return Ok(()),
        [labels] => {
            reading.go_beside(labels.path());
            (labels.form().read)(labels.path(), file, reading)?;
            format!("its activities are those of {} beside it", name(labels))
        }
        several => {
            let names: Vec<String> = several.iter().map(name).collect();
            format!(
                "its activities are not known: {} beside it have some, so leave one of them there",
                names.join(" and ")
            )
        }
    };
    reading.log.remarks.push(readable(remark));
    Ok(())
}

/// Why a file is no log: where it is no text, what stands in its lines says nothing.
fn no_log(source: &Source, error: LogError) -> LogError {
    match error {
        // Forms of crates of their own say it themselves.
        error if !FORMS.contains(source.form()) => error,
        LogError::NoLog(reason) => {
            let no_text = Start::of(source.path()).ok().and_then(|start| foreign::no_text(&start));
            match no_text {
                Some(why) => LogError::no_log(reason.place, why),
                None => LogError::NoLog(reason),
            }
        }
        LogError::Broken { place, source } => {
            LogError::no_log(place, FormMessage::DamagedDatabase { reason: source.to_string() })
        }
        other => other,
    }
}

/// What a run's log in this place calls sensors of these names.
pub fn ids(from: impl Into<Source>, file: &LoggerFile, sensors: &[String]) -> Vec<String> {
    let ids = sensors.iter().map(|name| file.ids.get(name).unwrap_or(name));
    match from.into().has_words() {
        true => ids.map(|id| one_word(id)).collect(),
        false => ids.cloned().collect(),
    }
}
