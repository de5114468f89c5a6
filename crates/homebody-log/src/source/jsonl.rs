//! JSON Lines: an object a line, whose keys tell time, sensor and value by any of the usual names or ours.

use super::columns::Places;
use super::form::{Form, Shows};
use super::instant::{Instant, since_1970};
use super::lines::Lines;
use super::reading::Reading;
use super::start::Start;
use crate::error::LogError;
use homebody_core::scenario::logger::LoggerFile;
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::path::Path;

pub(super) const FORM: Form = Form {
    name: "jsonl",
    what: "JSON Lines: an object a line with time, sensor and value, under any of the usual names or ours",
    shows,
    read,
};

type Object = Map<String, Value>;

fn shows(start: &Start) -> Shows {
    let first = start.lines().next().and_then(|line| serde_json::from_str::<Object>(&line).ok());
    let is_row = |object: Object| places(&object, &LoggerFile::default()).is_some();
    Shows::rows_if(first.is_some_and(is_row))
}

/// Where an object has the parts of a row.
fn places(object: &Object, file: &LoggerFile) -> Option<Places> {
    let names: Vec<String> = object.keys().cloned().collect();
    Places::by_name(&names, file)
}

fn read(path: &Path, file: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut lines = Lines::open(path)?;
    // By the keys of the last object: nearly all have the same.
    let mut known: Option<(Vec<String>, Places)> = None;
    while let Some((line, text)) = lines.next()? {
        if text.trim_ascii().is_empty() {
            continue;
        }
        let object: Object = match serde_json::from_slice(text) {
            Ok(object) => object,
            Err(_) => {
                reading.skip(line, "it is no JSON object".into());
                continue;
            }
        };
        if !known.as_ref().is_some_and(|(keys, _)| keys.iter().eq(object.keys())) {
            known = places(&object, file).map(|places| (object.keys().cloned().collect(), places));
        }
        match &known {
            Some((_, places)) => take(line, &object, places, reading)?,
            None => reading.skip(line, "it has no time, sensor and value".into()),
        }
    }
    Ok(())
}

fn take(line: u64, object: &Object, places: &Places, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let cell = |place: usize| object.values().nth(place).map_or(Cow::Borrowed(""), text);
    let (sensor, value) = (cell(places.sensor), cell(places.value));
    let number = object.values().nth(places.time).and_then(Value::as_f64);
    let instant: Option<Option<Instant>> = number.map(since_1970);
    let is_row = match instant {
        None => reading.row(line, &cell(places.time), &sensor, &value)?,
        Some(Some(instant)) => reading.event(line, instant, &sensor, &value)?,
        Some(None) => {
            reading.skip(line, "the time is out of range".into());
            false
        }
    };
    if let (true, Some(place)) = (is_row, places.label) {
        let label = cell(place);
        reading.label(Some(&*label).filter(|label| !label.is_empty()));
    }
    Ok(())
}

/// A value as the text that a sensor said; null says nothing.
fn text(value: &Value) -> Cow<'_, str> {
    match value {
        Value::Null => Cow::Borrowed(""),
        Value::String(text) => Cow::Borrowed(text),
        other => Cow::Owned(other.to_string()),
    }
}
