//! What bodies did in a span of a run, from its truth.
//!
//! The truth has no index: a row is stored once the movement after it is known, so that rows come in the order of their ends,
//! and those of a span are found by halving. The one in which somebody is as the span ends may be long, such as a
//! visitor's absence of weeks; it is looked for further on, once.

use super::database::{self, instant, text};
use super::instant::Instants;
use super::recorded_truth::RecordedTruth;
use super::run_clock::RunClock;
use crate::error::LogError;
use crate::truth::Truth;
use crate::url::Url;
use homebody_core::geometry::Point;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND};
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension, Row};

/// Time after the end of a span beyond which a missing item is searched for by its name (our choice).
const FURTHER: Micros = 3600 * SECOND;

/// What a body did, from when to when in the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement {
    /// From when, in microseconds since the run's start.
    pub begin: Micros,
    /// Until when.
    pub end: Micros,
    /// What kind of movement it was.
    pub kind: MovementKind,
    /// Nothing for who is away.
    pub from: Option<Point>,
    /// Where it ended, in metres; `None` for who is away.
    pub to: Option<Point>,
    /// How the body held itself.
    pub posture: Posture,
}

/// What a body did, as the truth's column `kind` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    clock: RunClock,
    residents: Vec<String>,
    instants: Instants,
    /// By resident, those that lasted beyond a span by far.
    long: Vec<Vec<Movement>>,
}

const COLUMNS: &str = "resident, begin_at, end_at, kind, from_x, from_y, to_x, to_y, posture";

impl Movements {
    /// The movements of these residents; whoever else is in the truth is passed over.
    ///
    /// # Errors
    ///
    /// [`LogError::NoTruth`] if there is none in this place.
    pub fn open(truth: &Url, residents: &[String], clock: RunClock) -> Result<Movements, LogError> {
        let truth = RecordedTruth::open(truth, &[Truth::Movement])?;
        let clock = truth.clock(&clock);
        Ok(Movements {
            truth,
            clock,
            residents: residents.to_vec(),
            instants: Instants::default(),
            long: vec![Vec::new(); residents.len()],
        })
    }

    /// What each resident did between two instants of the run, in order; first and last may reach beyond.
    pub fn of(&mut self, begin: Micros, end: Micros) -> Result<Vec<Vec<Movement>>, LogError> {
        self.read(begin, end).map_err(|error| self.truth.error(error))
    }

    fn read(&mut self, begin: Micros, end: Micros) -> rusqlite::Result<Vec<Vec<Movement>>> {
        let Movements { truth: RecordedTruth { connection, .. }, clock, residents, instants, long } = self;
        let first = first_row(connection, instants, |end| clock.instant(end, Micros::MIN) <= begin - FURTHER)?;
        let mut of: Vec<Vec<Movement>> = vec![Vec::new(); residents.len()];
        let mut last_row = first;
        let sql = format!("SELECT {COLUMNS}, rowid FROM movement WHERE rowid >= ? ORDER BY rowid");
        let mut statement = connection.prepare_cached(&sql)?;
        let mut rows = statement.query([first])?;
        while let Some(row) = rows.next()? {
            last_row = row.get(9)?;
            let who = text(row.get_ref(0)?);
            let Some(resident) = residents.iter().position(|resident| *resident == who) else { continue };
            let last = of[resident].last().map_or(begin, |before| before.end);
            let Some(movement) = movement(row, instants, clock, last)? else { continue };
            if movement.begin < end && movement.end > begin {
                of[resident].push(movement);
            }
            let is_there = |movements: &Vec<Movement>| movements.last().is_some_and(|last| last.end >= end);
            if movement.end > end.saturating_add(FURTHER) || of.iter().all(is_there) {
                break;
            }
        }
        drop(rows);
        let sql = format!("SELECT {COLUMNS} FROM movement WHERE rowid > ? AND resident = ? ORDER BY rowid LIMIT 1");
        let mut statement = connection.prepare_cached(&sql)?;
        for (resident, found) in of.iter_mut().enumerate() {
            let until = found.last().map_or(begin, |last| last.end);
            if until >= end {
                continue;
            }
            let is_it = |long: &&Movement| long.begin <= until && long.end > until;
            if let Some(known) = long[resident].iter().find(is_it) {
                found.push(*known);
                continue;
            }
            let next = |row: &Row| movement(row, instants, clock, until);
            let next = statement.query_row((last_row, &residents[resident]), next).optional()?.flatten();
            if let Some(next) = next.filter(|next| next.begin < end && next.end > begin) {
                long[resident].push(next);
                found.push(next);
            }
        }
        Ok(of)
    }
}

/// The first row whose movement does not end before what is looked for; `is_before` is asked of ends as the rows tell them. On a clock
/// that goes back an hour is told twice: whoever asks looks from an hour before.
pub(super) fn first_row(
    connection: &Connection,
    instants: &mut Instants,
    is_before: impl Fn(Micros) -> bool,
) -> rusqlite::Result<i64> {
    let last = "SELECT coalesce(max(rowid), 0) FROM movement";
    let last = connection.prepare_cached(last)?.query_row([], |row| row.get(0))?;
    let sql = "SELECT end_at FROM movement WHERE rowid >= ? ORDER BY rowid LIMIT 1";
    let mut statement = connection.prepare_cached(sql)?;
    database::first_row(last, |row| {
        let end = statement.query_row([row], |row| instant(row, 0, instants)).optional()?.flatten();
        Ok(end.is_some_and(&is_before))
    })
}

/// A row of [`COLUMNS`]; nothing where it is none of ours.
fn movement(row: &Row, instants: &mut Instants, clock: &RunClock, last: Micros) -> rusqlite::Result<Option<Movement>> {
    let (Some(begin), Some(end)) = (instant(row, 1, instants)?, instant(row, 2, instants)?) else { return Ok(None) };
    let begin = clock.instant(begin, last);
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
    Ok(Some(Movement { begin, end: clock.instant_from(end, begin), kind, from, to, posture }))
}

/// A finite number.
fn number(row: &Row, column: usize) -> rusqlite::Result<Option<f64>> {
    Ok(match row.get_ref(column)? {
        ValueRef::Integer(number) => Some(number as f64),
        ValueRef::Real(number) => Some(number).filter(|number| number.is_finite()),
        _ => None,
    })
}
