//! Comma-separated values: ours, pyadlml's `time,device,value`, Home Assistant's `entity_id,state,last_changed`,
//! and files whose header line is unknown or missing, in which sensor and value come right after the time.

use super::columns::Places;
use super::reading::Reading;
use super::records::Records;
use crate::error::{LogError, place_of};
use crate::spreadsheet::unescaped;
use homebody_core::problem::readable;
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

/// What some programs begin a text with.
const MARK: char = '\u{feff}';

/// How many characters of an unknown header are told (ours).
const LONGEST_TOLD: usize = 200;

pub(crate) fn read(path: &Path, file: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut records = Records::open(path)?;
    let mut places = None;
    let mut unknown_header: Option<String> = None;
    let mut ends_as_on_windows = false;
    while let Some((line, record)) = records.next()? {
        let field = |place: usize| {
            record.get(place).map(|field| String::from_utf8_lossy(field.trim_ascii())).unwrap_or_default()
        };
        if record.len() == 1 && field(0).is_empty() {
            continue;
        }
        if places.is_none() {
            ends_as_on_windows = record.iter().next_back().is_some_and(|last| last.ends_with(b"\r"));
            let fields: Vec<String> =
                (0..record.len()).map(|place| field(place).trim_start_matches(MARK).into()).collect();
            if unknown_header.is_some() {
                places = by_content(&fields, reading);
                if places.is_none() {
                    break;
                }
            } else if fields.first().is_some_and(|first| reading.instants.read(first).is_some()) {
                places = Some(after(0));
            } else {
                places = Places::by_name(&fields, file);
                unknown_header = places.is_none().then(|| fields.join(", "));
                continue;
            }
        }
        if let Some(places) = places {
            let time = field(places.time);
            let cell = |place: usize| match record.get(place) {
                Some(whole) if places.is_mapped => {
                    // Where lines end as on Windows, a part of the end is in the last cell.
                    let is_cut = ends_as_on_windows && place + 1 == record.len();
                    String::from_utf8_lossy(whole.strip_suffix(b"\r").filter(|_| is_cut).unwrap_or(whole))
                }
                _ => field(place),
            };
            let (sensor, value) = (cell(places.sensor), cell(places.value));
            reading.row(line, time.trim_start_matches(MARK), unescaped(&sensor), unescaped(&value))?;
        }
    }
    match unknown_header {
        Some(names) if places.is_none() => {
            let names: String = names.chars().take(LONGEST_TOLD).collect();
            let why = readable(format!("no columns of time, sensor and value are among {names}"));
            Err(LogError::NoLog { place: place_of(path), why })
        }
        _ => Ok(()),
    }
}

/// The first text that is an instant, or a number since 1970, is the time.
fn by_content(fields: &[String], reading: &mut Reading<'_>) -> Option<Places> {
    let time = fields.iter().position(|text| reading.instants.read(text).is_some())?;
    (time + 2 < fields.len()).then(|| after(time))
}

fn after(time: usize) -> Places {
    Places { time, sensor: time + 1, value: time + 2, is_mapped: false }
}
