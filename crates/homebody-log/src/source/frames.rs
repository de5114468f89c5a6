//! Tables of what begins and ends in one row: pyadlml's activities `start_time,end_time,activity` and its older devices, the
//! activities of Orange4Home, and ours beside a log in CSV.

use super::form::{Form, Shows};
use super::in_order::InOrder;
use super::reading::Reading;
use super::records::{Record, Records};
use super::start::Start;
use crate::error::{LogError, place_of};
use crate::limits::beginning;
use crate::spreadsheet::unescaped;
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(super) const FORM: Form = Form {
    name: "pyadlml",
    what: "comma-separated values with a start and an end in each row, of activities or devices, as pyadlml and Orange4Home have them",
    shows,
    read,
};

/// What columns are called, in lower case.
const BEGINS: [&str; 4] = ["start_time", "starttime", "start", "begin"];
const ENDS: [&str; 4] = ["end_time", "endtime", "end", "stop"];
const ACTIVITIES: [&str; 3] = ["activity", "label", "room|activity"];
const DEVICES: [&str; 3] = ["device", "sensor", "item"];

/// Where the parts of a row are.
struct Columns {
    begin: usize,
    end: usize,
    what: usize,
    is_of_activities: bool,
}

fn columns(names: &[String]) -> Option<Columns> {
    let place = |known: &[&str]| {
        known.iter().find_map(|known| names.iter().position(|name| name.trim().eq_ignore_ascii_case(known)))
    };
    let (begin, end) = (place(&BEGINS)?, place(&ENDS)?);
    let activity = place(&ACTIVITIES);
    let what = activity.or_else(|| place(&DEVICES))?;
    Some(Columns { begin, end, what, is_of_activities: activity.is_some() })
}

fn shows(start: &Start) -> Shows {
    match start.cells().next().and_then(|names| columns(&names)) {
        None => Shows::Nothing,
        Some(Columns { is_of_activities: true, .. }) => Shows::Activities,
        Some(_) => Shows::Rows,
    }
}

fn read(path: &Path, _: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut records = Records::open(path)?;
    let no_columns = || {
        let why = "no columns of start, end and activity or device are in its first line".to_owned();
        LogError::NoLog { place: place_of(path), why }
    };
    let Some((_, header)) = records.next(&mut |_| false)? else { return Ok(()) };
    let columns = columns(&header.texts()).ok_or_else(no_columns)?;
    let mut order = InOrder::new();
    let mut instants = super::instant::Instants::default();
    let text = |record: &Record, place: usize| {
        String::from_utf8_lossy(record.get(place).unwrap_or_default().trim_ascii()).into_owned()
    };
    loop {
        let mut is_row = |alone: &Record| instants.read(&text(alone, columns.begin)).is_some();
        let Some((line, record)) = records.next(&mut is_row)? else { break };
        if record.len() == 1 && text(record, 0).is_empty() {
            continue;
        }
        let (begin, end, what) = (text(record, columns.begin), text(record, columns.end), text(record, columns.what));
        let ends = (reading.instants.read(&begin), reading.instants.read(&end));
        match ends {
            _ if record.is_broken => reading.skip(line, "a quote in it is never closed".into()),
            (Some(begin), Some(end)) if columns.is_of_activities => reading.span(line, begin, end, unescaped(&what)),
            (Some(begin), Some(end)) => order.interval(line, (begin, end), unescaped(&what), reading)?,
            (None, _) => reading.skip(line, format!("{} is no date and time", beginning(&begin))),
            (_, None) => reading.skip(line, format!("{} is no date and time", beginning(&end))),
        }
    }
    order.end(reading)
}
