//! A table of the sensors of a home with their rooms and places.

use crate::error::ScaffoldError;
use crate::messages::NewMessage;
use homebody_analysis::signs::kind_in_home;
use homebody_core::nearest::nearest;
use homebody_core::problem::{Problem, Problems};
use homebody_core::sensed::meaning;
use homebody_log::files::plain;
use homebody_simulation::SimulationError;
use std::collections::BTreeMap;
use std::path::Path;

/// Largest number of bytes of a table (our choice): one of a thousand sensors has a tenth of it.
const LARGEST_BYTES: u64 = 1 << 20;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct SensorRow {
    pub line: u64,
    pub room: Option<String>,
    pub place: Option<String>,
    /// Its kind, if the table has it: `motion`, `contact`, `used`, `reading` or `other`.
    pub kind: Option<String>,
    /// Its position: in pixels of a picture, or in metres.
    pub at: Option<[f64; 2]>,
}

const COLUMNS: [(&str, &[&str]); 6] = [
    ("id", &["id", "sensor"]),
    ("room", &["room"]),
    ("place", &["place", "name"]),
    ("kind", &["kind", "type"]),
    ("x", &["x", "x_m", "x_px"]),
    ("y", &["y", "y_m", "y_px"]),
];

/// The kinds of sensors for a home.
const KINDS: [&str; 2] = ["motion", "contact"];

/// Reads a table, by the ids of sensors.
pub fn read_table(path: &Path) -> Result<BTreeMap<String, SensorRow>, ScaffoldError> {
    let bytes = plain::read(path, LARGEST_BYTES).map_err(|error| SimulationError::io(path, error))?;
    let mut reader = csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).from_reader(&bytes[..]);
    let header: Vec<String> = match reader.byte_headers() {
        Ok(header) => header.iter().map(|cell| String::from_utf8_lossy(cell).to_lowercase()).collect(),
        Err(error) => return Err(SimulationError::file(path, error.to_string()).into()),
    };
    let place = |names: &[&str]| names.iter().find_map(|name| header.iter().position(|cell| cell == name));
    let [id, room, place, kind, x, y] = COLUMNS.map(|(_, names)| place(names));
    let Some(id) = id else {
        let near = header.iter().find(|cell| nearest(cell, ["id"]).is_some()).cloned();
        return Err(ScaffoldError::Source(Problems(vec![at_line(path, 1, NewMessage::NoIdColumn { near })])));
    };
    let (mut rows, mut problems) = (BTreeMap::<String, SensorRow>::new(), Vec::new());
    for record in reader.byte_records() {
        let record = record.map_err(|error| SimulationError::file(path, error.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let text = |column: Option<usize>| {
            let text = String::from_utf8_lossy(record.get(column?)?).into_owned();
            (!text.is_empty()).then_some(text)
        };
        let mut wrong = |message: NewMessage| problems.push(at_line(path, line, message));
        let Some(id) = text(Some(id)) else {
            wrong(NewMessage::NoId);
            continue;
        };
        let kind = text(kind).map(|kind| kind.to_lowercase());
        if let Some(kind) = kind.as_deref().filter(|kind| !is_known(kind)) {
            wrong(NewMessage::Kind { kind: kind.into(), known: KINDS.map(String::from).into() });
        }
        let number = |text: Option<String>, wrong: &mut dyn FnMut(NewMessage)| {
            let text = text?;
            let number = text.parse().ok().filter(|number: &f64| number.is_finite());
            if number.is_none() {
                wrong(NewMessage::Coordinate { text });
            }
            number
        };
        let (has_x, has_y) = (text(x).is_some(), text(y).is_some());
        if has_x != has_y {
            wrong(NewMessage::HalfPlace { sensor: id.clone() });
        }
        let at = [number(text(x), &mut wrong), number(text(y), &mut wrong)];
        let at = if let [Some(x), Some(y)] = at { Some([x, y]) } else { None };
        let row = SensorRow {
            line,
            room: text(room),
            place: text(place),
            kind: kind.map(|kind| kind_in_home(&kind, false).word().to_owned()),
            at,
        };
        if let Some(first) = rows.insert(id.clone(), row) {
            let message = NewMessage::SameSensor { sensor: id, first_line: first.line };
            problems.push(at_line(path, line, message));
        }
    }
    match problems.is_empty() {
        true => Ok(rows),
        false => Err(ScaffoldError::Source(Problems(problems))),
    }
}

fn at_line(path: &Path, line: u64, message: NewMessage) -> Problem {
    let line = u32::try_from(line).unwrap_or(u32::MAX);
    Problem { line, column: 1, ..Problem::of_file(&path.display().to_string(), message, None) }
}

fn is_known(kind: &str) -> bool {
    meaning(kind, "").is_some()
}
