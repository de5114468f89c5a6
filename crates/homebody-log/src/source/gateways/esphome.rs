//! The output of `esphome logs`: each line reports a state that a sensor of a device has sent.
//!
//! Its lines tell the time of day alone. The day comes from the file's name or, where another program has put a date before each line, from
//! there. Lines without a state are about the device itself.

use crate::error::{LogError, place_of};
use crate::log::{ColumnRole, SensorInfo};
use crate::source::gathered::Gathered;
use crate::source::instant::InstantReader;
use crate::source::instant::dateless::{DayCounter, time_of_day};
use crate::source::lines::LineReader;
use crate::source::messages::FormMessage;
use crate::source::reading::LogReading;
use crate::source::start::FileStart;
use crate::source::{LogForm, Shows};
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "esphome",
    what: "the output of esphome logs: the states that sensors send; the file's name gives the day of its first line",
    shows,
    read,
};

/// A text is one with this many lines that look like it.
const ENOUGH: usize = 2;

/// The words between the name of a sensor and its state, in the versions of the program.
const SENDS: [&str; 4] = ["': Sending state ", "': Sending initial state ", "': New state is ", "' >> "];

fn shows(start: &FileStart) -> Shows {
    Shows::rows_if(start.lines().filter(|line| parts(&plain(line)).is_some()).take(ENOUGH).count() == ENOUGH)
}

/// A line without the colours of a terminal.
fn plain(line: &str) -> String {
    let mut parts = line.split("\u{1b}[");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |line, part| {
        line + part.trim_start_matches(|c: char| c.is_ascii_digit() || c == ';').trim_start_matches('m')
    })
}

/// The text before the time of day, the time of day, the component, and its message.
fn parts(line: &str) -> Option<(&str, &str, &str, &str)> {
    let begin = line
        .match_indices('[')
        .map(|(at, _)| at)
        .find(|at| line.as_bytes().get(at + 3) == Some(&b':') && line.as_bytes().get(at + 6) == Some(&b':'))?;
    let (time, rest) = line[begin + 1..].split_once(']')?;
    let (level, rest) = rest.strip_prefix('[')?.split_once(']')?;
    let (component, says) = rest.strip_prefix('[')?.split_once(']')?;
    let component = component.split(':').next()?;
    (level.len() <= 2).then(|| (line[..begin].trim(), time, component, says.trim_start_matches(':').trim()))
}

/// The name of a sensor, and the state that it sends.
fn sent(says: &str) -> Option<(&str, &str)> {
    let says = says.strip_prefix('\'')?;
    SENDS.iter().find_map(|sends| says.split_once(sends)).map(|(name, state)| (name, state.trim()))
}

/// A state and its unit, such as `21.50` and `°C`.
fn state(component: &str, state: &str) -> (String, Option<String>) {
    let (state, _) = state.split_once(" with ").filter(|_| component == "sensor").unwrap_or((state, ""));
    let (value, unit) = state.split_once(' ').filter(|_| component == "sensor").unwrap_or((state, ""));
    let value = value.trim_matches('\'');
    let value = if value.eq_ignore_ascii_case("nan") { "unknown" } else { value };
    (value.to_owned(), Some(unit.trim().to_owned()).filter(|unit| !unit.is_empty()))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut lines = LineReader::open(path)?;
    let (mut days, mut instants) = (DayCounter::from_path(path), InstantReader::default());
    let mut out = Gathered::as_they_come(path, reading);
    if days.is_known() {
        out.column("the file's name", ColumnRole::Time, "it has the day of the first line; each midnight adds one");
    }
    out.column("the time of day", ColumnRole::Time, "the form has it there");
    out.column("the name in quotes", ColumnRole::Sensor, "the form has it there");
    out.column("the state behind it", ColumnRole::Value, "the form has it there");
    let mut dateless = false;
    while let Some((line, text)) = lines.next_text()? {
        let text = plain(&text);
        if text.trim().is_empty() {
            continue;
        }
        let Some((head, time, component, says)) = parts(&text) else {
            out.count("lines about the device itself");
            continue;
        };
        let Some(time_of_day) = time_of_day(time, &mut instants) else {
            out.reading.skip(line, format!("{time:?} is no time of day"));
            continue;
        };
        let at = instants.read(head).or_else(|| days.at(time_of_day));
        let Some((name, said)) = sent(says) else {
            out.count("lines about the device itself");
            continue;
        };
        let Some(at) = at else {
            out.reading.skip(line, "it has a time without a date".into());
            dateless = true;
            continue;
        };
        let (value, unit) = state(component, said);
        if !out.knows(name) {
            out.know(SensorInfo { kind: component.to_owned(), unit, ..SensorInfo::named(name) });
        }
        out.row(line, at, [name, &value], None)?;
    }
    let is_refused = dateless && out.reading.log.rows == 0;
    out.end()?;
    match is_refused {
        true => Err(LogError::no_log(place_of(path), FormMessage::Dateless { program: "ESPHome" })),
        false => Ok(()),
    }
}
