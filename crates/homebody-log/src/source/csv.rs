//! Comma-separated values: ours, pyadlml's `time,device,value`, Home Assistant's `entity_id,state,last_changed`,
//! and files whose header line is unknown or missing, in which sensor and value come right after the time, and then perhaps what
//! somebody did.

use super::columns::Places;
use super::form::{Form, Shows};
use super::instant::Instants;
use super::reading::Reading;
use super::records::{Record, Records};
use super::start::Start;
use crate::error::{LogError, place_of};
use crate::plain::text;
use crate::spreadsheet::{unescaped, unescaped_bytes};
use homebody_core::problem::readable;
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(super) const FORM: Form = Form {
    name: "csv",
    what: "comma-separated values: time, sensor, value and perhaps an activity, in columns with any of the usual names or ours; \
           Home Assistant's history and pyadlml's devices, too",
    shows,
    read,
};

/// How many characters of an unknown header are told (ours).
const LONGEST_TOLD: usize = 200;

fn shows(start: &Start) -> Shows {
    let mut instants = Instants::default();
    let is_row = |cells: Vec<String>| cells.len() >= 3 && cells.iter().any(|cell| instants.read(cell).is_some());
    let is_named = |names: Vec<String>| Places::by_name(&names, &LoggerFile::default()).is_some();
    Shows::rows_if(start.cells().next().is_some_and(is_named) || start.cells().take(2).any(is_row))
}

/// What is known of the columns as rows come.
enum Header {
    /// Nothing has come yet.
    Awaited,
    /// Names have come that say nothing; what the rows hold is going to.
    Unknown(String),
    Known(Places),
}

fn read(path: &Path, file: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut records = Records::open(path)?;
    let mut header = Header::Awaited;
    let mut instants = Instants::default();
    let mut time = None;
    loop {
        let mut is_row = |alone: &Record| {
            time.and_then(|time| alone.get(time)).is_some_and(|time| instants.read_bytes(time).is_some())
        };
        let Some((line, record)) = records.next(&mut is_row)? else { break };
        if record.len() == 1 && record.get(0).is_none_or(|cell| cell.trim_ascii().is_empty()) {
            continue;
        }
        if !matches!(header, Header::Known(_)) {
            let Some((known, is_a_row)) = learn(&header, record, file, reading) else { break };
            header = known;
            time = if let Header::Known(places) = &header { Some(places.time) } else { None };
            if !is_a_row {
                continue;
            }
        }
        if let Header::Known(places) = &header {
            match record.is_broken {
                true => reading.skip(line, "a quote in it is never closed".into()),
                false => take(line, record, places, reading)?,
            }
        }
    }
    match header {
        Header::Unknown(names) => {
            let names: String = names.chars().take(LONGEST_TOLD).collect();
            let why = readable(format!("no columns of time, sensor and value are among {names}"));
            Err(LogError::NoLog { place: place_of(path), why })
        }
        _ => Ok(()),
    }
}

/// What a line tells of the columns, and whether it is a row itself; None where they are told neither by names nor by rows.
fn learn(known: &Header, record: &Record, file: &LoggerFile, reading: &mut Reading<'_>) -> Option<(Header, bool)> {
    let cells = record.texts();
    if let Header::Unknown(_) = known {
        return by_content(&cells, reading).map(|places| (Header::Known(places), true));
    }
    if cells.first().is_some_and(|first| reading.instants.read(first).is_some()) {
        return Some((Header::Known(after(0)), true));
    }
    let named = Places::by_name(&cells, file).map(Header::Known);
    Some((named.unwrap_or_else(|| Header::Unknown(cells.join(", "))), false))
}

fn take(line: u64, record: &Record, places: &Places, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let cell = |place: usize| record.get(place).unwrap_or_default();
    let (mut sensor, mut value) = (cell(places.sensor), cell(places.value));
    if !places.is_mapped {
        (sensor, value) = (sensor.trim_ascii(), value.trim_ascii());
    }
    if reading.row_of_bytes(line, cell(places.time), unescaped_bytes(sensor), unescaped_bytes(value))?
        && let Some(place) = places.label
    {
        let label = text(cell(place).trim_ascii());
        let label = Some(unescaped(&label)).filter(|label| !label.is_empty());
        // By its place alone a number is no label.
        reading.label(label.filter(|label| place != places.value + 1 || label.parse::<f64>().is_err()));
    }
    Ok(())
}

/// The first text that is an instant, or a number since 1970, is the time.
fn by_content(fields: &[String], reading: &mut Reading<'_>) -> Option<Places> {
    let time = fields.iter().position(|text| reading.instants.read(text).is_some())?;
    (time + 2 < fields.len()).then(|| after(time))
}

fn after(time: usize) -> Places {
    Places { time, sensor: time + 1, value: time + 2, label: Some(time + 3), is_mapped: false }
}
