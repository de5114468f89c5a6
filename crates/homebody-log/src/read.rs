//! Reads logs: ours, and those of real homes, in any form of the registry.
//!
//! A log is read into memory, or streamed if it may be of any size. Next to a run's log is a table of its sensors, which is read with the
//! log.
//!
//! No line makes reading fail: lines that are not understood are skipped and reported. Only a line that is longer than those of any log is
//! an error, before it fills the memory.

mod located;
mod sets;

use crate::error::{LogError, MappingMessage, place_of};
use crate::files::plain;
use crate::limits::LARGEST_OF_SCENARIO_BYTES;
use crate::log::{Clock, Log};
use crate::registry::FORMS;
use crate::run::sensor_table;
pub use crate::run::sensor_table::SensorMap;
use crate::source::messages::FormMessage;
use crate::source::{FileStart, LogReading, foreign};
use crate::text::one_word;
use homebody_core::problem::{Problem, Problems, readable};
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::{Span, TimeScale};
pub use located::LogSource;
pub(crate) use located::{activities_of, activities_of_set};
use std::io::ErrorKind;
use std::path::Path;

/// Reads a log into memory; `file` tells the names of a database's table and columns, or of a CSV file's columns, where they
/// are neither ours nor to be guessed.
pub fn read(from: impl Into<LogSource>, file: &LoggerFile) -> Result<Log, LogError> {
    let mut events = Vec::new();
    let log = stream(from, file, &mut |part| {
        events.extend_from_slice(&part.events);
        Ok(())
    })?;
    Ok(Log { events, ..log })
}

/// Reads a log through and keeps none of its rows: its sensors, values and clock, how many rows it has, and what was left out.
pub fn survey(from: impl Into<LogSource>, file: &LoggerFile) -> Result<Log, LogError> {
    stream(from, file, &mut |_| Ok(()))
}

/// Reads a log of any size in little memory. `take` gets its rows in parts, in their order: each is a log with the rows of that part, and
/// with all sensors and values so far. The result has all but the rows.
pub fn stream(
    from: impl Into<LogSource>,
    file: &LoggerFile,
    take: &mut dyn FnMut(&Log) -> Result<(), LogError>,
) -> Result<Log, LogError> {
    let source = from.into();
    let path = source.path();
    let mut reading = LogReading::new(take);
    reading.place = place_of(path);
    reading.options = source.options().clone();
    let table = sensor_table::known_beside(path)?;
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

fn read_parts(source: &LogSource, file: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let parts = source.parts();
    for part in &parts {
        if parts.len() > 1 {
            reading.continue_with(&part.path, part.begin);
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
fn read_labels(source: &LogSource, file: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let found = source.labels_beside();
    let name = |of: &LogSource| of.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
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

/// The error of a file that is not a log; lines of a file that is not text explain nothing.
fn no_log(source: &LogSource, error: LogError) -> LogError {
    match error {
        // Forms of crates of their own say it themselves.
        error if !FORMS.contains(source.form()) => error,
        LogError::NoLog(reason) => {
            let no_text = FileStart::read(source.path()).ok().and_then(|start| foreign::no_text(&start));
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

/// The time scale of a run of this length; local time is that of the run's files: the home's, or UTC.
pub fn scale_of(scenario: &Scenario, length: Span) -> TimeScale {
    let clock = if scenario.logger.time == TimeFormat::Local { Clock::Local } else { Clock::Utc };
    clock.scale(&scenario.calendar, length)
}

/// The ids, in a run's log at this place, of the sensors with these names.
pub fn ids(from: impl Into<LogSource>, file: &LoggerFile, sensors: &[String]) -> Vec<String> {
    let ids = sensors.iter().map(|name| file.ids.get(name).unwrap_or(name));
    match from.into().has_words() {
        true => ids.map(|id| one_word(id)).collect(),
        false => ids.cloned().collect(),
    }
}

/// Reads a `logger.json` outside a scenario, which has the names of a table and its columns.
///
/// # Errors
///
/// [`LogError::Missing`] if it is missing, [`LogError::NoMapping`] if it is invalid.
pub fn read_mapping(path: &Path) -> Result<LoggerFile, LogError> {
    let text = plain::read_text(path, LARGEST_OF_SCENARIO_BYTES).map_err(|error| match error.kind() {
        ErrorKind::NotFound => LogError::Missing { place: place_of(path) },
        _ => LogError::reading(path, error),
    })?;
    serde_json::from_str(&text).map_err(|why| {
        let invalid = MappingMessage::Invalid { reason: why.to_string() };
        LogError::NoMapping(Problems(vec![Problem::of_file(&place_of(path), invalid, None)]))
    })
}
