//! Tables with a row for each second and a column for each sensor: OpenSHS, whose rows have times and an activity, and ARAS, whose
//! rows have neither names nor times, and the activities of two residents by number.
//!
//! Of a sensor only changes become rows of the log, ON and OFF, and what is on in the first row. A pause of more than
//! a minute is a gap: sensors and activities end with the last row before it, and the next row stores their states anew. A column of
//! OpenSHS whose cells are not 0 and 1 is one of readings. We assume that the first row of a day of ARAS is its midnight. ARAS has
//! no dates: its day n becomes day n of 1970.

use super::columns::ColumnPlaces;
use super::in_order::{OFF, ON};
use super::instant::{InstantReader, LogInstant};
use super::lines::LineReader;
use super::messages::FormMessage;
use super::reading::LogReading;
use super::records::{Record, RecordReader};
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::{LogError, place_of};
use crate::limits::beginning;
use crate::log::{Clock, ColumnRole, ColumnUse};
use crate::source::instant::date_parts::no_instant;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{DAY, Interval, MINUTE, SECOND, Span, WallTime};
use std::collections::BTreeSet;
use std::path::Path;

pub(crate) const OPENSHS: LogForm = LogForm {
    name: "openshs",
    what: "comma-separated values with a row for each second and columns for each sensor, Activity and timestamp (OpenSHS)",
    shows: shows_openshs,
    read: read_openshs,
};

pub(crate) const ARAS: LogForm = LogForm {
    name: "aras",
    what: "a day with a row for each second: 20 sensors and the activities of two residents, as numbers (ARAS)",
    shows: shows_aras,
    read: read_aras,
};

/// The last value of each column, in local time and in UTC: the log's clock is known later, and rows on the other clock
/// do not count. A state begins as OFF, a reading as nothing.
struct Changes([Vec<String>; 2]);

impl Changes {
    /// The last values of the file before, if there was one.
    fn new(columns: &[SensorColumn], reading: &LogReading<'_>) -> Changes {
        let first = |column: &SensorColumn| {
            let begins = if column.is_state { OFF } else { "" };
            reading.carried.said.get(&column.name).map_or(begins, String::as_str).to_owned()
        };
        let said: Vec<String> = columns.iter().map(first).collect();
        Changes([said.clone(), said])
    }

    /// Takes the values of an instant; None is a damaged cell.
    fn take<'c>(
        &mut self,
        line: u64,
        at: LogInstant,
        says: impl Iterator<Item = Option<&'c str>>,
        columns: &[SensorColumn],
        reading: &mut LogReading<'_>,
    ) -> Result<(), LogError> {
        for ((last, says), column) in self.0[clock(at)].iter_mut().zip(says).zip(columns) {
            if let Some(says) = says.filter(|says| last != says)
                && reading.event(line, at, &column.name, says)?
            {
                last.clear();
                last.push_str(says);
            }
        }
        Ok(())
    }

    /// Ends a recorded stretch: what was on, and readings, are stored anew with the next row.
    fn end_stretch(&mut self, at: LogInstant, columns: &[SensorColumn]) {
        for (last, column) in self.0[clock(at)].iter_mut().zip(columns) {
            if !column.is_state || last != OFF {
                last.clear();
            }
        }
    }

    /// Keeps the last values for the next file of the log.
    fn carry(self, columns: &[SensorColumn], until: Option<LogInstant>, reading: &mut LogReading<'_>) {
        let Some(until) = until else { return };
        let [local, utc] = self.0;
        let said = if clock(until) == 0 { local } else { utc };
        reading.carried.said = columns.iter().map(|column| column.name.clone()).zip(said).collect();
        reading.carried.until = Some(until);
    }
}

fn clock(at: LogInstant) -> usize {
    usize::from(at.clock() == Clock::Utc)
}

struct SensorColumn {
    name: String,
    /// Whether its cells are 0 and 1, and not readings.
    is_state: bool,
}

/// Pause between two rows above which there is a gap: rows are a second apart.
const LONGEST_PAUSE: Span = MINUTE;

/// The gap between two rows, if there is one: its beginning as an instant, and on the wall.
fn pause(last: Option<LogInstant>, at: LogInstant) -> Option<(LogInstant, Interval<WallTime>)> {
    let begin = last.filter(|last| last.clock() == at.clock())?.after(SECOND);
    let gap = Interval::new(begin.on_wall(), at.on_wall());
    (gap.length() > LONGEST_PAUSE).then_some((begin, gap))
}

fn state(cell: &[u8]) -> Option<bool> {
    match cell.trim_ascii() {
        b"0" | b"0.0" => Some(false),
        b"1" | b"1.0" => Some(true),
        _ => None,
    }
}

/// The places of time, activity and sensors in a table of OpenSHS.
fn places(names: &[String]) -> Option<(usize, usize, Vec<usize>)> {
    let place = |wanted: &str| names.iter().position(|name| name.eq_ignore_ascii_case(wanted));
    let (time, activity) = (place("timestamp")?, place("activity")?);
    let others = (0..names.len()).filter(|&other| ![time, activity].contains(&other) && !names[other].is_empty());
    let sensors: Vec<usize> = others.collect();
    (sensors.len() >= 2).then_some((time, activity, sensors))
}

fn shows_openshs(start: &FileStart) -> Shows {
    let mut rows = start.cells();
    let is_log = |names: &Vec<String>| ColumnPlaces::by_name(names, &LoggerFile::default()).is_some();
    let Some(names) = rows.next().filter(|names| !is_log(names)) else { return Shows::Nothing };
    let Some((_, _, sensors)) = places(&names) else { return Shows::Nothing };
    let Some(row) = rows.next() else { return Shows::Nothing };
    let states = sensors.iter().filter(|&&place| row.get(place).is_some_and(|cell| state(cell.as_bytes()).is_some()));
    Shows::rows_if(states.count() >= 2)
}

/// The columns of the sensors, by most cells of the beginning.
fn columns_of(start: &FileStart, header: &[String], sensors: &[usize]) -> Vec<SensorColumn> {
    /// Damaged cells have fewer different texts.
    const FEWEST_READINGS: usize = 3;
    let mut others: Vec<(usize, BTreeSet<String>)> = vec![Default::default(); sensors.len()];
    let mut rows = 0;
    for cells in start.cells().skip(1) {
        rows += 1;
        for (&place, (count, different)) in sensors.iter().zip(&mut others) {
            if let Some(cell) = cells.get(place).filter(|cell| !cell.is_empty() && state(cell.as_bytes()).is_none()) {
                *count += 1;
                different.insert(cell.clone());
            }
        }
    }
    let column = |(&place, (count, different)): (&usize, &(usize, BTreeSet<String>))| {
        let is_reading =
            count * 2 > rows || different.len() >= FEWEST_READINGS || (different.len() > 1 && count * 10 >= rows);
        let is_state = !is_reading;
        SensorColumn { name: header[place].clone(), is_state }
    };
    sensors.iter().zip(&others).map(column).collect()
}

fn read_openshs(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut records = RecordReader::open(path)?;
    let no_columns = || LogError::no_log(place_of(path), FormMessage::OpenshsColumns);
    let Some((_, header)) = records.next(&mut |_| false)? else { return Ok(()) };
    let header = header.texts();
    let (time, activity, sensors) = places(&header).ok_or_else(no_columns)?;
    let columns = columns_of(&FileStart::read(path)?, &header, &sensors);
    reading.column(&header[time], ColumnRole::Time, ColumnUse::HEADING);
    reading.column(&header[activity], ColumnRole::Label, ColumnUse::HEADING);
    for column in &columns {
        let because = if column.is_state { "its cells are 0 and 1" } else { "its cells are readings" };
        reading.column(&column.name, ColumnRole::OneSensor, because);
    }
    let mut changes = Changes::new(&columns, reading);
    let mut alone = InstantReader::default();
    let mut last = reading.carried.until;
    loop {
        let mut is_row = |row: &Record| alone.read(&cell(row, time)).is_some();
        let Some((line, record)) = records.next(&mut is_row)? else { break };
        if record.len() == 1 && cell(record, 0).is_empty() {
            continue;
        }
        let told = cell(record, time);
        let Some(at) = reading.instants.read(&told) else {
            reading.skip(line, no_instant(&told));
            continue;
        };
        let says: Vec<Option<String>> =
            sensors.iter().zip(&columns).map(|(&place, column)| said(record, place, column)).collect();
        if let Some(column) = says.iter().position(Option::is_none) {
            let value = beginning(&cell(record, sensors[column]));
            reading.skip(line, format!("{} says {value}, neither 0 nor 1", columns[column].name));
            continue;
        }
        if let Some((end, gap)) = pause(last, at) {
            reading.label_of(end, None);
            changes.end_stretch(end, &columns);
            reading.gap(gap);
        }
        let label = cell(record, activity);
        reading.label_of(at, Some(label.as_str()).filter(|label| !label.is_empty()));
        changes.take(line, at, says.iter().map(Option::as_deref), &columns, reading)?;
        last = Some(at);
    }
    if let Some(last) = last {
        reading.label_of(last.after(SECOND), None);
    }
    changes.carry(&columns, last, reading);
    Ok(())
}

fn cell(record: &Record, place: usize) -> String {
    String::from_utf8_lossy(record.get(place).unwrap_or_default().trim_ascii()).into_owned()
}

/// The value in a cell of a sensor; None if it is damaged.
fn said(record: &Record, place: usize, column: &SensorColumn) -> Option<String> {
    match column.is_state {
        true => state(record.get(place)?).map(|is_on| if is_on { ON } else { OFF }.to_owned()),
        false => Some(cell(record, place)).filter(|cell| !cell.is_empty()),
    }
}

/// The number of sensors in a row of ARAS, and of residents.
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

fn shows_aras(start: &FileStart) -> Shows {
    // The last line may be cut.
    let rows: Vec<bool> = start.lines().take(3).map(|line| aras(&line).is_some()).collect();
    Shows::rows_if(rows.first() == Some(&true))
}

/// The number of a file's day, by its name.
pub(crate) fn day_of(path: &Path) -> Option<i64> {
    let name = path.file_stem()?.to_string_lossy().into_owned();
    let digits = name.rsplit(|c: char| !c.is_ascii_digit()).next()?;
    digits.parse().ok().filter(|day| (1..=366).contains(day))
}

fn read_aras(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let day = day_of(path).unwrap_or(1);
    let remark = "its dates are not known: its first day becomes day";
    if reading.log.remarks.iter().all(|told| !told.starts_with(remark)) {
        reading.log.remarks.push(format!("{remark} {day} of 1970"));
    }
    reading.columns_of_form(&[
        ("the number of the line", ColumnRole::Time),
        ("columns 1 to 20", ColumnRole::OneSensor),
        ("columns 21 and 22", ColumnRole::Label),
    ]);
    let columns: Vec<SensorColumn> =
        (1..=SENSORS).map(|number| SensorColumn { name: format!("sensor {number}"), is_state: true }).collect();
    let mut lines = LineReader::open(path)?;
    let mut changes = Changes::new(&columns, reading);
    // Since when each resident has done what.
    let mut doing: [Option<(u8, WallTime)>; RESIDENTS] = [None; RESIDENTS];
    let mut at = WallTime::EPOCH + (day - 1) * DAY;
    let mut close = |reading: &mut LogReading<'_>, line, resident: usize, now: Option<u8>, at: WallTime| {
        if doing[resident].map(|(what, _)| what) != now {
            if let Some((what, since)) = doing[resident].take() {
                let name = format!("R{} activity {what}", resident + 1);
                reading.span(line, LogInstant::Local(since), LogInstant::Local(at), &name);
            }
            doing[resident] = now.map(|what| (what, at));
        }
    };
    if let Some((end, gap)) = pause(reading.carried.until, LogInstant::Local(at)) {
        changes.end_stretch(end, &columns);
        reading.gap(gap);
    }
    let mut last = 0;
    while let Some((number, line)) = lines.next_text()? {
        last = number;
        if line.trim().is_empty() {
            continue;
        }
        match aras(&line) {
            Some((states, activities)) => {
                let says = states.into_iter().map(|is_on| Some(if is_on { ON } else { OFF }));
                changes.take(number, LogInstant::Local(at), says, &columns, reading)?;
                for (resident, what) in activities.into_iter().enumerate() {
                    close(reading, number, resident, Some(what), at);
                }
            }
            None => reading.skip(number, "it has not 20 sensors and two activities".into()),
        }
        at += SECOND;
    }
    (0..RESIDENTS).for_each(|resident| close(reading, last, resident, None, at));
    changes.carry(&columns, Some(LogInstant::Local(at - SECOND)), reading);
    Ok(())
}
