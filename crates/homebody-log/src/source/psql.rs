//! A table as psql prints it: a line of names, a line of dashes, then rows whose cells are parted by `|`. So the X10 network of
//! MavPad was kept, with the columns mark, zone, number, state, level, source and info.

use super::columns::Places;
use super::form::{Form, Shows};
use super::lines::Lines;
use super::reading::Reading;
use super::start::Start;
use crate::error::{LogError, place_of};
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(super) const FORM: Form = Form {
    name: "psql",
    what: "a table as psql prints it, with cells parted by |: the X10 network of MavPad, or a log with the usual names",
    shows,
    read,
};

/// Where the parts of a row are.
enum Columns {
    /// A time, a zone and a number that are the sensor together, its state, and its level where it has no state.
    X10 {
        time: usize,
        zone: usize,
        number: usize,
        state: usize,
        level: Option<usize>,
    },
    Usual(Places),
}

fn columns(heading: &str, file: &LoggerFile) -> Option<Columns> {
    let names: Vec<String> = heading.split('|').map(|name| name.trim().to_owned()).collect();
    let place = |wanted: &str| names.iter().position(|name| name.eq_ignore_ascii_case(wanted));
    let x10 = || {
        let (time, zone, number) = (place("mark")?, place("zone")?, place("number")?);
        Some(Columns::X10 { time, zone, number, state: place("state")?, level: place("level") })
    };
    x10().or_else(|| Places::by_name(&names, file).map(Columns::Usual))
}

fn is_rule(line: &str) -> bool {
    let line = line.trim();
    line.contains('+') && line.bytes().all(|byte| b"-+".contains(&byte))
}

fn shows(start: &Start) -> Shows {
    let mut lines = start.lines();
    let is_heading = lines.next().is_some_and(|line| columns(&line, &LoggerFile::default()).is_some());
    Shows::rows_if(is_heading && lines.next().is_some_and(|line| is_rule(&line)))
}

fn read(path: &Path, file: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut lines = Lines::open(path)?;
    let mut known = None;
    while let Some((number, line)) = lines.next_text()? {
        let line = line.trim();
        if line.is_empty() || is_rule(line) || is_count(line) {
            continue;
        }
        let Some(known) = &known else {
            known = columns(line, file);
            if known.is_none() {
                let why = "no columns of time, sensor and value are in its first line".to_owned();
                return Err(LogError::NoLog { place: place_of(path), why });
            }
            continue;
        };
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let cell = |place: usize| cells.get(place).copied().unwrap_or_default();
        match known {
            Columns::X10 { time, zone, number: of, state, level } => {
                let sensor = format!("{}{}", cell(*zone), cell(*of));
                let value = Some(cell(*state)).filter(|state| !state.is_empty());
                let value = value.or_else(|| level.map(cell)).unwrap_or_default();
                // Either alone names no sensor.
                let sensor = if cell(*zone).is_empty() || cell(*of).is_empty() { "" } else { &sensor };
                reading.row(number, cell(*time), sensor, value)?;
            }
            Columns::Usual(places) => {
                let is_row = reading.row(number, cell(places.time), cell(places.sensor), cell(places.value))?;
                if let (true, Some(label)) = (is_row, places.label) {
                    reading.label(Some(cell(label)).filter(|label| !label.is_empty()));
                }
            }
        }
    }
    Ok(())
}

/// Whether a line is the last one, which says how many rows there are: `(123 rows)`.
fn is_count(line: &str) -> bool {
    let inner = line.strip_prefix('(').and_then(|line| line.strip_suffix(" rows)").or(line.strip_suffix(" row)")));
    inner.is_some_and(|count| count.bytes().all(|byte| byte.is_ascii_digit()))
}
