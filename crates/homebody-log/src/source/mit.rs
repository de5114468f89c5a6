//! The text of Tapia's homes at MIT: records of five lines, one for each activity.
//!
//! They are the activity with its day and its two ends, the ids of the sensors that changed meanwhile, their names, the times of their
//! opening or switching on, and the times of their ends. Next to the text is a table of the sensors' rooms and names.
//!
//! We assume that an end before its begin is on the next day. An activation during two activities is in both records, and comes twice.

use super::in_order::InOrder;
use super::instant::LogInstant;
use super::lines::LineReader;
use super::reading::LogReading;
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::LogError;
use crate::files::plain;
use crate::limits::beginning;
use crate::log::{ColumnRole, SensorInfo};
use crate::source::instant::date_parts::day_of;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{DAY, SECOND, Span, WallTime};
use jiff::civil::Date;
use std::borrow::Cow;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "mit",
    what: "records of five lines: an activity, then the ids, names and times of the sensors that changed (Tapia's homes at MIT)",
    shows,
    read,
};

/// The table next to the text, `id,room,name` in each row.
const SENSORS: &str = "sensors.csv";

/// Largest number of bytes of such a table (our choice): one of 77 sensors has two thousand.
const LARGEST_TABLE_BYTES: u64 = 1 << 20;

/// The lines that may hold the first whole record.
const LOOKED_AT_LINES: usize = 4 * LINES;

fn shows(start: &FileStart) -> Shows {
    let lines: Vec<_> = start.lines().take(LOOKED_AT_LINES).collect();
    let is_record = |pair: &[Cow<str>]| heading(&pair[0]).is_some() && pair[1].split(',').all(is_id);
    Shows::rows_if(lines.windows(2).any(is_record))
}

fn is_id(cell: &str) -> bool {
    !cell.trim().is_empty() && cell.trim().bytes().all(|byte| byte.is_ascii_digit())
}

/// The first line of a record: the activity, its day, its begin and its end.
struct Heading {
    activity: String,
    /// The day's midnight and the two ends since then, or the reason why they are unknown.
    when: Result<(WallTime, [Span; 2]), String>,
}

fn heading(line: &str) -> Option<Heading> {
    let cells: Vec<&str> = line.split(',').map(str::trim).collect();
    let [activity @ .., day, begin, end] = &cells[..] else { return None };
    let [numbers, begins, ends] = [day.split('/'), begin.split(':'), end.split(':')].map(three);
    let (day, _, _) = (numbers?, begins?, ends?);
    let activity = activity.join(",");
    (!activity.is_empty()).then_some(())?;
    let when = american(day).and_then(|day| {
        let no_time = |text: &str| format!("{text} is no time of day");
        let ends = following(time(begin).ok_or_else(|| no_time(begin))?, time(end).ok_or_else(|| no_time(end))?);
        Ok((WallTime::midnight(day), ends))
    });
    Some(Heading { activity, when })
}

fn three<'t>(parts: impl Iterator<Item = &'t str>) -> Option<[i16; 3]> {
    let numbers: Vec<i16> = parts.map(|part| part.trim().parse().ok()).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// `4/1/2003` is the first of April.
fn american([month, day, year]: [i16; 3]) -> Result<Date, String> {
    let of_days = |why| if (1..=12).contains(&month) { why } else { format!("{why}: days are written month/day/year") };
    day_of([year, month, day].map(Into::into)).map_err(of_days)
}

/// `9:5:3`, since midnight.
fn time(text: &str) -> Option<Span> {
    let numbers: Vec<i64> = text.trim().split(':').map(|part| part.parse().ok()).collect::<Option<_>>()?;
    let &[hours, minutes, seconds] = &numbers[..] else { return None };
    let fits = (0..24).contains(&hours) && (0..60).contains(&minutes) && (0..60).contains(&seconds);
    fits.then_some(((hours * 60 + minutes) * 60 + seconds) * SECOND)
}

/// Two ends, the second moved to the next day if it is before the first.
fn following(begin: Span, end: Span) -> [Span; 2] {
    [begin, if end < begin { end + DAY } else { end }]
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    if reading.log.known.is_empty() {
        reading.log.known = known_beside(path);
    }
    reading.columns_of_form(&[
        ("the day, in the first line of a record", ColumnRole::Time),
        ("the activity before it", ColumnRole::Label),
        ("the second line of a record", ColumnRole::Sensor),
        ("the fourth line of a record", ColumnRole::Time),
        ("the fifth line of a record", ColumnRole::End),
    ]);
    let mut lines = LineReader::open(path)?;
    let mut order = InOrder::new();
    // The lines of a record that have come.
    let mut record: Vec<(u64, String)> = Vec::new();
    while let Some((number, line)) = lines.next_text()? {
        if line.trim().is_empty() {
            continue;
        }
        if heading(&line).is_some() {
            take(&std::mem::take(&mut record), &mut order, reading)?;
        } else if record.is_empty() {
            reading.skip(number, format!("{} begins no activity", beginning(line.trim())));
            continue;
        }
        record.push((number, line.into_owned()));
        if record.len() == LINES {
            take(&std::mem::take(&mut record), &mut order, reading)?;
        }
    }
    take(&record, &mut order, reading)?;
    order.end(reading)
}

/// So many lines has a record.
const LINES: usize = 5;

/// Takes the lines of a record: its activity, and of its sensors those whose two times are known.
fn take(record: &[(u64, String)], order: &mut InOrder, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let Some((first, head)) = record.first() else { return Ok(()) };
    let Some(Heading { activity, when }) = heading(head) else { return Ok(()) };
    let (midnight, ends) = match when {
        Ok(when) => when,
        Err(why) => {
            reading.skip(*first, format!("{why}: its record is left out, which has {} lines", record.len()));
            return Ok(());
        }
    };
    let [begin, end] = ends.map(|at| LogInstant::Local(midnight + at));
    reading.span(*first, begin, end, &activity);
    let [(_, _), (line, ids), (_, _), (_, begins), (last, ends)] = record else {
        reading.skip(*first, format!("it has {} of {LINES} lines, so that its sensors are not known", record.len()));
        return Ok(());
    };
    let [ids, begins, ends] = [ids, begins, ends].map(|line| line.split(',').map(str::trim).collect::<Vec<_>>());
    if ids.len() != begins.len() || ids.len() != ends.len() {
        let counts = format!("{} sensors have {} times and {} ends", ids.len(), begins.len(), ends.len());
        reading.skip(*line, counts);
        return Ok(());
    }
    for ((id, begin), end) in ids.into_iter().zip(begins).zip(ends) {
        match (time(begin), time(end)) {
            _ if id.is_empty() => reading.skip(*line, "there is no sensor".into()),
            (Some(begin), Some(end)) => {
                let [begin, end] = following(begin, end).map(|at| LogInstant::Local(midnight + at));
                order.interval(*last, (begin, end), id, reading)?;
            }
            _ => reading.skip(*last, format!("the times of sensor {} are not known", beginning(id))),
        }
    }
    Ok(())
}

/// The sensors in the table next to the text; none without it.
fn known_beside(path: &Path) -> Vec<SensorInfo> {
    let table = plain::read_text(&path.with_file_name(SENSORS), LARGEST_TABLE_BYTES).unwrap_or_default();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let &[id, room, ref name @ ..] = &cells[..] else { return None };
        let known = SensorInfo { name: name.join(","), room: Some(room.to_owned()), ..SensorInfo::named(id) };
        (is_id(id) && !known.name.is_empty()).then_some(known)
    };
    table.lines().filter_map(row).collect()
}
