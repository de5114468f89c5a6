//! JSON Lines: an object a line, whose keys tell time, sensor and value by any of the usual names or ours.

use super::above::Above;
use super::object_rows::{ObjectRows, ObjectUse};
use super::said::{Object, text};
use crate::error::LogError;
use crate::log::{Log, SPAN_COLUMNS};
use crate::source::gathered::Gathered;
use crate::source::lines::LineReader;
use crate::source::reading::LogReading;
use crate::source::start::FileStart;
use crate::source::{LogForm, Shows};
use homebody_core::scenario::logger::LoggerFile;
use std::borrow::Cow;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "jsonl",
    what: "JSON Lines: one object per line with time, sensor and value, under common names or those of Homebody, or with a topic and \
           a payload of MQTT",
    shows,
    read,
};

fn shows(start: &FileStart) -> Shows {
    let first = start.lines().next().and_then(|line| serde_json::from_str::<Object>(&line).ok());
    let is_row = |object: &Object| {
        let mut take = |_: &Log| Ok(());
        let mut reading = LogReading::new(&mut take);
        let mut out = Gathered::as_they_come(&start.path, &mut reading);
        let taken = ObjectRows::of_lines().take(1, object, &mut Above::default(), &LoggerFile::default(), &mut out);
        taken.is_ok_and(|taken| taken != ObjectUse::Nothing)
    };
    match first {
        Some(first) if is_row(&first) => Shows::Rows,
        Some(first) if is_span(&first) => Shows::Activities,
        _ => Shows::Nothing,
    }
}

/// Whether an object is an activity, as in our files next to a log.
fn is_span(object: &Object) -> bool {
    SPAN_COLUMNS.iter().all(|name| object.contains_key(*name))
}

fn read(path: &Path, file: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut lines = LineReader::open(path)?;
    let (mut objects, mut above) = (ObjectRows::of_lines(), Above::default());
    let mut out = Gathered::as_they_come(path, reading);
    while let Some((line, text)) = lines.next()? {
        if text.trim_ascii().is_empty() {
            continue;
        }
        let object: Object = match serde_json::from_slice(text) {
            Ok(object) => object,
            Err(_) => {
                out.reading.skip(line, "it is no JSON object".into());
                continue;
            }
        };
        match objects.take(line, &object, &mut above, file, &mut out)? {
            ObjectUse::Nothing if is_span(&object) => take_span(line, &object, out.reading),
            ObjectUse::Nothing => out.reading.skip(line, "it has no time, sensor and value".into()),
            ObjectUse::Row | ObjectUse::Broken => {}
        }
    }
    objects.end(&out)?;
    out.end()
}

fn take_span(line: u64, object: &Object, reading: &mut LogReading<'_>) {
    let [begin, end, activity] = SPAN_COLUMNS.map(|name| object.get(name).map_or(Cow::Borrowed(""), text));
    match [begin, end].map(|at| reading.instants.read(&at)) {
        [Some(begin), Some(end)] => reading.span(line, begin, end, &activity),
        _ => reading.skip(line, "an end is no date and time".into()),
    }
}
