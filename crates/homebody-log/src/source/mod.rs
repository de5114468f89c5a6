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
mod causes;
mod columns;
mod csv;
mod database;
mod dateless;
mod each_second;
mod entity;
mod esphome;
mod form;
mod forms;
mod frames;
mod gathered;
mod home_assistant;
mod in_order;
mod influx_csv;
mod influx_lines;
mod instant;
mod intervals;
mod json;
mod json_text;
mod jsonl;
mod lines;
mod lives;
mod log;
mod mit;
mod mosquitto;
mod movements;
mod object_rows;
mod payload;
mod psql;
mod reading;
mod recorded_truth;
mod records;
mod run_clock;
mod said;
mod sensors;
mod series;
mod sqlite;
mod start;
mod tables;
mod tables_of_text;
mod tasmota;
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
pub use forms::{FORMS, Source, forms};
pub(crate) use forms::{activities_of, activities_of_set};
use homebody_core::scenario::logger::LoggerFile;
pub use instant::{Instant, since_1970};
pub(crate) use lives::lives_of;
pub use lives::{Life, LifeSpan, SpanKind, activities, life_spans, lives};
pub use log::{Clock, ColumnRole, ColumnUse, Event, Log};
pub use movements::{Movement, MovementKind, Movements};
pub use reading::Reading;
pub(crate) use recorded_truth::{LABEL_TABLES, RecordedTruth};
pub use recorded_truth::{is_brief, is_truth_set, truth_at, truth_beside, truth_of};
pub use run_clock::RunClock;
pub use sensors::SensorMap;
pub use start::Start;
pub use tables::{ReadTables, TakeRow, Value};
pub(crate) use tables_of_text::read_numbers;
pub use truth_rows::truth_rows;

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
    reading.log.known = sensors::known_beside(path, &mut reading.log.remarks)?;
    let beside = source.activities_beside();
    reading.has_spans = beside.is_some();
    (source.form().read)(path, file, &mut reading).map_err(|error| no_log(&source, error))?;
    if let Some(beside) = beside {
        reading.go_beside(beside.path());
        (beside.form().read)(beside.path(), file, &mut reading)?;
    }
    let log = reading.end()?;
    match log.problems.first() {
        Some(first) if log.rows == 0 && log.activities.is_empty() => {
            let why = format!("line {}: {}", first.line, first.why);
            Err(no_log(&source, LogError::NoLog { place: place_of(path), why }))
        }
        _ => Ok(log),
    }
}

/// Why a file is no log: where it is no text, what stands in its lines says nothing.
fn no_log(source: &Source, error: LogError) -> LogError {
    match error {
        // Forms of crates of their own say it themselves.
        error if !FORMS.contains(source.form()) => error,
        LogError::NoLog { place, why } => {
            let start = Start::of(source.path()).ok();
            let no_text = start.filter(|start| !start.is_sqlite()).and_then(|start| start.no_text());
            LogError::NoLog { place, why: no_text.map_or(why, str::to_owned) }
        }
        LogError::Broken { place, source } => {
            LogError::NoLog { place, why: format!("as a database it is damaged or cut short: {source}") }
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
