//! The movements of bodies in an interval of a run, from its truth.
//!
//! The truth has no index: a row is stored once the movement after it is known, so that rows come in the order of their ends,
//! and those of an interval are found by halving. The movement at the end of the interval may be long, such as a
//! visitor's absence of weeks; it is looked for further on, once.

use super::RecordedTruth;
use crate::error::LogError;
use crate::files::database::{self, text};
use crate::source::{InstantReader, instant_of_cell};
use crate::table::truth::Truth;
use crate::url::Url;
use homebody_core::geometry::Point;
use homebody_core::posture::Posture;
use homebody_core::time::{HOUR, Interval, RunTime, Span, TimeScale, WallTime};
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension, Row};
use serde::Serialize;

/// Time after the end of a span beyond which a missing item is searched for by its name (our choice).
const FURTHER: Span = HOUR;

/// A movement of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement {
    /// From when to when.
    pub time: Interval<RunTime>,
    /// The kind of movement.
    pub kind: MovementKind,
    /// Where it began, in metres; `None` while away.
    pub from: Option<Point>,
    /// Where it ended, in metres; `None` while away.
    pub to: Option<Point>,
    /// The posture meanwhile.
    pub posture: Posture,
}

/// A kind of movement, by the truth's column `kind`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum MovementKind {
    /// A straight movement at constant speed.
    Stride,
    /// Movement on the spot.
    InPlace,
    /// Keeping still.
    Rest,
    /// Out of the home.
    Away,
}

/// Finds a run's movements.
pub struct Movements {
    truth: RecordedTruth,
    scale: TimeScale,
    residents: Vec<String>,
    instants: InstantReader,
    /// By resident, movements that lasted far beyond an interval.
    long: Vec<Vec<Movement>>,
}

const COLUMNS: &str = "resident, begin_at, end_at, kind, from_x, from_y, to_x, to_y, posture";

impl Movements {
    /// Finds the movements of these residents alone.
    ///
    /// # Errors
    ///
    /// [`LogError::NoTruth`] if there is none in this place.
    pub fn open(truth: &Url, residents: &[String], scale: TimeScale) -> Result<Movements, LogError> {
        let truth = RecordedTruth::open(truth, &[Truth::Movement])?;
        let scale = truth.scale(&scale);
        Ok(Movements {
            truth,
            scale,
            residents: residents.to_vec(),
            instants: InstantReader::default(),
            long: vec![Vec::new(); residents.len()],
        })
    }

    /// The movements of each resident that overlap an interval, in order.
    pub fn of(&mut self, interval: Interval<RunTime>) -> Result<Vec<Vec<Movement>>, LogError> {
        self.read(interval).map_err(|error| self.truth.error(error))
    }

    fn read(&mut self, time: Interval<RunTime>) -> rusqlite::Result<Vec<Vec<Movement>>> {
        let Interval { begin, end } = time;
        let Movements { truth: RecordedTruth { connection, .. }, scale, residents, instants, long } = self;
        let first = first_row(connection, instants, |end| scale.run_from_wall(end, RunTime::MIN) <= begin - FURTHER)?;
        let mut of: Vec<Vec<Movement>> = vec![Vec::new(); residents.len()];
        let mut last_row = first;
        let sql = format!("SELECT {COLUMNS}, rowid FROM movement WHERE rowid >= ? ORDER BY rowid");
        let mut statement = connection.prepare_cached(&sql)?;
        let mut rows = statement.query([first])?;
        while let Some(row) = rows.next()? {
            last_row = row.get(9)?;
            let who = text(row.get_ref(0)?);
            let Some(resident) = residents.iter().position(|resident| *resident == who) else { continue };
            let last = of[resident].last().map_or(begin, |before| before.time.end);
            let Some(movement) = movement(row, instants, scale, last)? else { continue };
            if movement.time.overlaps(time) {
                of[resident].push(movement);
            }
            let is_there = |movements: &Vec<Movement>| movements.last().is_some_and(|last| last.time.end >= end);
            if movement.time.end > end.saturating_add(FURTHER) || of.iter().all(is_there) {
                break;
            }
        }
        drop(rows);
        let sql = format!("SELECT {COLUMNS} FROM movement WHERE rowid > ? AND resident = ? ORDER BY rowid LIMIT 1");
        let mut statement = connection.prepare_cached(&sql)?;
        for (resident, found) in of.iter_mut().enumerate() {
            let until = found.last().map_or(begin, |last| last.time.end);
            if until >= end {
                continue;
            }
            let is_it = |long: &&Movement| long.time.contains(until);
            if let Some(known) = long[resident].iter().find(is_it) {
                found.push(*known);
                continue;
            }
            let next = |row: &Row| movement(row, instants, scale, until);
            let next = statement.query_row((last_row, &residents[resident]), next).optional()?.flatten();
            if let Some(next) = next.filter(|next| next.time.overlaps(time)) {
                long[resident].push(next);
                found.push(next);
            }
        }
        Ok(of)
    }
}

/// The first row whose movement does not end before an instant; `is_before` gets ends as the rows have them. On a clock that is set back an
/// hour comes twice: the caller looks from an hour before.
pub(crate) fn first_row(
    connection: &Connection,
    instants: &mut InstantReader,
    is_before: impl Fn(WallTime) -> bool,
) -> rusqlite::Result<i64> {
    let last = "SELECT coalesce(max(rowid), 0) FROM movement";
    let last = connection.prepare_cached(last)?.query_row([], |row| row.get(0))?;
    let sql = "SELECT end_at FROM movement WHERE rowid >= ? ORDER BY rowid LIMIT 1";
    let mut statement = connection.prepare_cached(sql)?;
    database::first_row(last, |row| {
        let end = statement.query_row([row], |row| instant_of_cell(row, 0, instants)).optional()?.flatten();
        Ok(end.is_some_and(&is_before))
    })
}

/// A row of [`COLUMNS`]; `None` for an unknown kind.
fn movement(
    row: &Row,
    instants: &mut InstantReader,
    scale: &TimeScale,
    last: RunTime,
) -> rusqlite::Result<Option<Movement>> {
    let (Some(begin), Some(end)) = (instant_of_cell(row, 1, instants)?, instant_of_cell(row, 2, instants)?) else {
        return Ok(None);
    };
    let begin = scale.run_from_wall(begin, last);
    let kind = match row.get_ref(3)? {
        ValueRef::Text(b"stride") => MovementKind::Stride,
        ValueRef::Text(b"in_place" | b"stir") => MovementKind::InPlace,
        ValueRef::Text(b"rest") => MovementKind::Rest,
        ValueRef::Text(b"away") => MovementKind::Away,
        _ => return Ok(None),
    };
    let posture = row.get_ref(8)?.as_str().ok().and_then(Posture::named).unwrap_or_default();
    let point = |x| Ok::<_, rusqlite::Error>(number(row, x)?.zip(number(row, x + 1)?).map(|(x, y)| Point::new(x, y)));
    let (from, to) = (point(4)?, point(6)?);
    let time = Interval::new(begin, scale.run_from_wall_after(end, begin));
    Ok(Some(Movement { time, kind, from, to, posture }))
}

/// A finite number.
fn number(row: &Row, column: usize) -> rusqlite::Result<Option<f64>> {
    Ok(match row.get_ref(column)? {
        ValueRef::Integer(number) => Some(number as f64),
        ValueRef::Real(number) => Some(number).filter(|number| number.is_finite()),
        _ => None,
    })
}
