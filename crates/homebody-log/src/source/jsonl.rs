//! JSON Lines: an object a line, whose keys tell time, sensor and value by any of the usual names or ours.

use super::columns::Places;
use super::form::{Form, Shows};
use super::instant::{Instant, Instants, since_1970};
use super::lines::Lines;
use super::reading::Reading;
use super::start::Start;
use crate::error::LogError;
use crate::spans::SPAN_COLUMNS;
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
    match start.lines().next().and_then(|line| serde_json::from_str::<Object>(&line).ok()) {
        Some(first) if places(&first, &LoggerFile::default()).is_some() => Shows::Rows,
        Some(first) if is_span(&first) => Shows::Activities,
        Some(first) if by_content(&first, &mut Instants::default()).is_some() => Shows::Rows,
        _ => Shows::Nothing,
    }
}

/// Whether an object tells what somebody did, as ours beside a log do.
fn is_span(object: &Object) -> bool {
    SPAN_COLUMNS.iter().all(|name| object.contains_key(*name))
}

/// Where an object has the parts of a row.
fn places(object: &Object, file: &LoggerFile) -> Option<Places> {
    let names: Vec<String> = object.keys().cloned().collect();
    Places::by_name(&names, file)
}

/// Under names that say nothing: the first value that is an instant is the time, and the two right behind it, which are none, are sensor
/// and value.
fn by_content(object: &Object, instants: &mut Instants) -> Option<Places> {
    let mut is_instant = |value: &Value| match value {
        Value::String(text) => instants.read(text).is_some(),
        other => other.as_f64().and_then(since_1970).is_some(),
    };
    let time = object.values().position(&mut is_instant)?;
    let mut behind = object.values().skip(time + 1).take(2);
    let (sensor, value) = (behind.next()?, behind.next()?);
    let is_log = sensor.is_string() && !is_instant(sensor) && !value.is_object() && !is_instant(value);
    is_log.then_some(Places { time, sensor: time + 1, value: time + 2, label: None, is_mapped: false })
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
            let by_content =
                || Some(&object).filter(|object| !is_span(object)).and_then(|it| by_content(it, &mut reading.instants));
            known = places(&object, file).or_else(by_content).map(|places| (object.keys().cloned().collect(), places));
        }
        match &known {
            Some((_, places)) => take(line, &object, places, reading)?,
            None if is_span(&object) => take_span(line, &object, reading),
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

fn take_span(line: u64, object: &Object, reading: &mut Reading<'_>) {
    let [begin, end, activity] = SPAN_COLUMNS.map(|name| object.get(name).map_or(Cow::Borrowed(""), text));
    match [begin, end].map(|at| reading.instants.read(&at)) {
        [Some(begin), Some(end)] => reading.span(line, begin, end, &activity),
        _ => reading.skip(line, "an end is no date and time".into()),
    }
}

/// A value as the text that a sensor said; null says nothing.
fn text(value: &Value) -> Cow<'_, str> {
    match value {
        Value::Null => Cow::Borrowed(""),
        Value::String(text) => Cow::Borrowed(text),
        other => Cow::Owned(other.to_string()),
    }
}
