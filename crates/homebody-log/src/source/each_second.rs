//! Tables with a row for each second and a column for each sensor: OpenSHS, whose rows have times and an activity, and ARAS, whose
//! rows have neither names nor times, and the activities of two residents by number.
//!
//! Of a sensor only changes become rows of the log, ON and OFF, and what is on in the first row. We assume that the first row of a
//! day of ARAS is its midnight; its dates are not known, so its day n is told as that of January 1970.

use super::form::{Form, Shows};
use super::in_order::{OFF, ON};
use super::instant::{Instant, Instants};
use super::lines::Lines;
use super::reading::Reading;
use super::records::{Record, Records};
use super::start::Start;
use crate::error::{LogError, place_of};
use crate::limits::beginning;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{DAY, Micros, SECOND};
use std::path::Path;

pub(super) const OPENSHS: Form = Form {
    name: "openshs",
    what: "comma-separated values with a row for each second and a column for each sensor, an Activity and a timestamp: OpenSHS",
    shows: shows_openshs,
    read: read_openshs,
};

pub(super) const ARAS: Form = Form {
    name: "aras",
    what: "a day as a row for each second: 20 sensors and the activities of two residents, by number; ARAS",
    shows: shows_aras,
    read: read_aras,
};

/// What each sensor said last, in local time and in UTC: which of both the log is told by is known later, and rows on the other
/// clock say nothing.
struct Changes([Vec<bool>; 2]);

impl Changes {
    /// All are off.
    fn new(sensors: usize) -> Changes {
        Changes([vec![false; sensors], vec![false; sensors]])
    }

    /// Takes what the sensors say at an instant.
    fn take(
        &mut self,
        line: u64,
        at: Instant,
        says: impl Iterator<Item = bool>,
        names: &[String],
        reading: &mut Reading<'_>,
    ) -> Result<(), LogError> {
        let clock = usize::from(matches!(at, Instant::Utc(_)));
        for ((last, is_on), name) in self.0[clock].iter_mut().zip(says).zip(names) {
            if *last != is_on && reading.event(line, at, name, if is_on { ON } else { OFF })? {
                *last = is_on;
            }
        }
        Ok(())
    }
}

/// What a cell says of a sensor, if it is one's.
fn state(cell: &[u8]) -> Option<bool> {
    match cell.trim_ascii() {
        b"0" | b"0.0" => Some(false),
        b"1" | b"1.0" => Some(true),
        _ => None,
    }
}

/// Where time, activity and sensors are in a table of OpenSHS.
fn places(names: &[String]) -> Option<(usize, usize, Vec<usize>)> {
    let place = |wanted: &str| names.iter().position(|name| name.eq_ignore_ascii_case(wanted));
    let (time, activity) = (place("timestamp")?, place("activity")?);
    let others = (0..names.len()).filter(|&other| ![time, activity].contains(&other) && !names[other].is_empty());
    let sensors: Vec<usize> = others.collect();
    (sensors.len() >= 2).then_some((time, activity, sensors))
}

fn shows_openshs(start: &Start) -> Shows {
    let mut rows = start.cells();
    let Some((_, _, sensors)) = rows.next().and_then(|names| places(&names)) else { return Shows::Nothing };
    let is_state =
        |row: &Vec<String>, place: usize| row.get(place).is_some_and(|cell| state(cell.as_bytes()).is_some());
    Shows::rows_if(rows.next().is_some_and(|row| sensors.iter().all(|&place| is_state(&row, place))))
}

fn read_openshs(path: &Path, _: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut records = Records::open(path)?;
    let no_columns = || {
        let why = "no columns timestamp, Activity and two sensors are in its first line".to_owned();
        LogError::NoLog { place: place_of(path), why }
    };
    let Some((_, header)) = records.next(&mut |_| false)? else { return Ok(()) };
    let header = header.texts();
    let (time, activity, sensors) = places(&header).ok_or_else(no_columns)?;
    let names: Vec<String> = sensors.iter().map(|&place| header[place].clone()).collect();
    let mut changes = Changes::new(names.len());
    let mut alone = Instants::default();
    let text = |record: &Record, place: usize| {
        String::from_utf8_lossy(record.get(place).unwrap_or_default().trim_ascii()).into_owned()
    };
    let mut last = None;
    loop {
        let mut is_row = |row: &Record| alone.read(&text(row, time)).is_some();
        let Some((line, record)) = records.next(&mut is_row)? else { break };
        if record.len() == 1 && text(record, 0).is_empty() {
            continue;
        }
        let told = text(record, time);
        let states: Option<Vec<bool>> = sensors.iter().map(|&place| state(record.get(place)?)).collect();
        match (reading.instants.read(&told), states) {
            (None, _) => reading.skip(line, format!("{} is no date and time", beginning(&told))),
            (_, None) => reading.skip(line, "a sensor says neither 0 nor 1".into()),
            (Some(at), Some(states)) => {
                let label = text(record, activity);
                reading.label_of(at, Some(label.as_str()).filter(|label| !label.is_empty()));
                changes.take(line, at, states.into_iter(), &names, reading)?;
                last = Some(at);
            }
        }
    }
    if let Some(last) = last {
        reading.label_of(later(last), None);
    }
    Ok(())
}

/// The next second.
fn later(at: Instant) -> Instant {
    match at {
        Instant::Local(at) => Instant::Local(at + SECOND),
        Instant::Utc(at) => Instant::Utc(at + SECOND),
    }
}

/// How many sensors a row of ARAS has, and residents.
const SENSORS: usize = 20;
const RESIDENTS: usize = 2;

/// The states and activities of a row of ARAS.
fn aras(line: &str) -> Option<([bool; SENSORS], [u8; RESIDENTS])> {
    let (mut states, mut activities) = ([false; SENSORS], [0; RESIDENTS]);
    let mut cells = line.split_ascii_whitespace();
    for is_on in &mut states {
        *is_on = state(cells.next()?.as_bytes())?;
    }
    for activity in &mut activities {
        *activity = cells.next()?.parse().ok().filter(|number| (1..=27).contains(number))?;
    }
    cells.next().is_none().then_some((states, activities))
}

fn shows_aras(start: &Start) -> Shows {
    // The last line may be cut.
    let rows: Vec<bool> = start.lines().take(3).map(|line| aras(&line).is_some()).collect();
    Shows::rows_if(rows.first() == Some(&true))
}

fn read_aras(path: &Path, _: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let day: Micros =
        name.rsplit('_').next().and_then(|number| number.parse().ok()).filter(|day| *day <= 366).unwrap_or(1);
    reading.log.remarks.push(format!("its dates are not known: its day is told as number {day} of 1970"));
    let names: Vec<String> = (1..=SENSORS).map(|number| format!("sensor {number}")).collect();
    let mut lines = Lines::open(path)?;
    let mut changes = Changes::new(SENSORS);
    // Since when each resident has done what.
    let mut doing: [Option<(u8, Micros)>; RESIDENTS] = [None; RESIDENTS];
    let mut at = (day - 1) * DAY;
    let mut close = |reading: &mut Reading<'_>, line, resident: usize, now: Option<u8>, at: Micros| {
        if doing[resident].map(|(what, _)| what) != now {
            if let Some((what, since)) = doing[resident].take() {
                let name = format!("R{} activity {what}", resident + 1);
                reading.span(line, Instant::Local(since), Instant::Local(at), &name);
            }
            doing[resident] = now.map(|what| (what, at));
        }
    };
    let mut last = 0;
    while let Some((number, line)) = lines.next_text()? {
        last = number;
        if line.trim().is_empty() {
            continue;
        }
        match aras(&line) {
            Some((states, activities)) => {
                changes.take(number, Instant::Local(at), states.into_iter(), &names, reading)?;
                for (resident, what) in activities.into_iter().enumerate() {
                    close(reading, number, resident, Some(what), at);
                }
            }
            None => reading.skip(number, "it has not 20 sensors and two activities".into()),
        }
        at += SECOND;
    }
    (0..RESIDENTS).for_each(|resident| close(reading, last, resident, None, at));
    Ok(())
}
