//! What residents did when: from the notes of a log, or from a run's truth.

use super::database::{connect, text};
use super::instant::{Instant, Instants, since_1970};
use crate::error::LogError;
use homebody_core::time::Micros;
use rusqlite::Connection;
use rusqlite::types::ValueRef;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::Path;

/// What somebody did over a span, on the log's clock; the end is no part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Activity {
    /// Its label, such as `sleeping`; of a span in a room, the room's name.
    pub name: String,
    /// From when, in microseconds since 1970.
    pub begin: Micros,
    /// Until when.
    pub end: Micros,
}

/// What a run's truth tells of one resident.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Life {
    /// The resident's name.
    pub resident: String,
    /// In order of their beginnings.
    pub activities: Vec<Activity>,
    /// The rooms as spans, named by the room; none between rooms and away.
    pub rooms: Vec<Activity>,
}

/// The activities that a run's truth tells, in order of their beginnings.
pub fn activities(truth: &Path) -> Result<Vec<Activity>, LogError> {
    let sql = "SELECT begin_at, end_at, NULL, name FROM activity WHERE name IS NOT NULL ORDER BY begin_at";
    let told = told(truth, sql)?;
    let spans = told.into_iter().filter_map(|row| Some((row.at[0]?, row.at[1]?, row.what?)));
    Ok(spans.map(|(begin, end, name)| Activity { name, begin, end }).collect())
}

/// What a run's truth tells of each resident, by name.
pub fn lives(truth: &Path) -> Result<Vec<Life>, LogError> {
    let mut lives: BTreeMap<String, Life> = BTreeMap::new();
    let mut end = Micros::MIN;
    let sql = "SELECT begin_at, end_at, resident, name FROM activity WHERE name IS NOT NULL ORDER BY begin_at";
    for row in told(truth, sql)? {
        if let (Some(begin), Some(until), Some(name)) = (row.at[0], row.at[1], row.what) {
            end = end.max(until);
            lives.entry(row.who).or_default().activities.push(Activity { name, begin, end: until });
        }
    }
    // Where somebody goes ends where they are; the last room ends with the run, or when no more is known.
    let runs = told(truth, "SELECT max(ended_at), NULL, NULL, NULL FROM run")?;
    end = runs.into_iter().filter_map(|row| row.at[0]).fold(end, Micros::max);
    let mut open: BTreeMap<String, (Micros, Option<String>)> = BTreeMap::new();
    let mut rows = told(truth, "SELECT at, NULL, resident, room FROM room ORDER BY at, rowid")?;
    let residents: BTreeSet<String> = rows.iter().map(|row| row.who.clone()).collect();
    rows.extend(residents.into_iter().map(|who| Told { at: [Some(end), None], who, what: None }));
    for row in rows {
        let Some(at) = row.at[0] else { continue };
        if let Some((begin, Some(room))) = open.insert(row.who.clone(), (at, row.what))
            && begin < at
        {
            lives.entry(row.who).or_default().rooms.push(Activity { name: room, begin, end: at });
        }
    }
    Ok(lives.into_iter().map(|(resident, life)| Life { resident, ..life }).collect())
}

/// The truth of a run, to be asked why each row of its log is there.
pub(crate) struct Causes<'t> {
    truth: &'t Path,
    connection: Connection,
    instants: Instants,
    firings: Rows,
    offs: Rows,
}

/// Rows of one of the truth's tables that name rows of the log, in their order, a part of them in memory.
struct Rows {
    /// Asks for those after a rowid, and how many.
    sql: &'static str,
    /// The last that was read.
    rowid: i64,
    is_over: bool,
    read: VecDeque<Cause>,
}

/// How many of them are read at once.
const AT_ONCE: usize = 4096;

// A firing that only prolongs what an ON has begun names the same row as those before it. Firings are numbered from 0 and rows
// of a table from 1.
const FIRINGS: &str = "SELECT rowid, row, resident, seen_at, sensor, why, thing FROM cause
                       WHERE rowid > ?1 AND row IS NOT NULL ORDER BY rowid LIMIT ?2";
const OFFS: &str = "SELECT off.rowid, off.row, cause.resident, cause.seen_at, cause.sensor, cause.why, cause.thing
                    FROM off JOIN cause ON cause.rowid = off.firing + 1 AND cause.firing = off.firing
                    WHERE off.rowid > ?1 ORDER BY off.rowid LIMIT ?2";

impl Rows {
    fn of(sql: &'static str) -> Rows {
        Rows { sql, rowid: 0, is_over: false, read: VecDeque::new() }
    }

    /// What is told of a row, if anything is; rows are asked for in their order.
    fn take(&mut self, row: u64, from: &Connection, instants: &mut Instants) -> rusqlite::Result<Option<Cause>> {
        loop {
            match self.read.front() {
                Some(next) if next.row > row => return Ok(None),
                Some(next) if next.row == row => return Ok(self.read.pop_front()),
                Some(_) => drop(self.read.pop_front()),
                None if self.is_over => return Ok(None),
                None => self.read_on(from, instants)?,
            }
        }
    }

    fn read_on(&mut self, from: &Connection, instants: &mut Instants) -> rusqlite::Result<()> {
        let mut statement = from.prepare_cached(self.sql)?;
        let mut rows = statement.query((self.rowid, AT_ONCE as i64))?;
        self.is_over = true;
        while let Some(row) = rows.next()? {
            let said = |column| {
                let said = text(row.get_ref(column)?).into_owned();
                Ok::<_, rusqlite::Error>(Some(said).filter(|said| !said.is_empty()))
            };
            let seen_at = match row.get_ref(3)? {
                ValueRef::Integer(number) => since_1970(number as f64),
                ValueRef::Real(number) => since_1970(number),
                other => instants.read(&text(other)),
            };
            self.read.push_back(Cause {
                row: row.get::<_, i64>(1)? as u64,
                resident: said(2)?,
                seen_at: seen_at.map(|(Instant::Local(at) | Instant::Utc(at))| at),
                sensor: said(4)?,
                why: said(5)?.unwrap_or_default(),
                thing: said(6)?,
            });
            (self.rowid, self.is_over) = (row.get(0)?, false);
        }
        Ok(())
    }
}

impl Causes<'_> {
    pub fn open(truth: &Path) -> Result<Causes<'_>, LogError> {
        let connection = connect(truth).map_err(|error| LogError::database(truth, error))?;
        let (firings, offs) = (Rows::of(FIRINGS), Rows::of(OFFS));
        Ok(Causes { truth, connection, instants: Instants::default(), firings, offs })
    }

    /// The last row of the log that it tells of, if it tells of any.
    pub fn last_row(&self) -> Result<Option<u64>, LogError> {
        let sql = "SELECT max(row) FROM (SELECT max(row) AS row FROM cause UNION ALL SELECT max(row) FROM off)";
        let last = self.connection.query_row(sql, [], |row| row.get::<_, Option<i64>>(0));
        Ok(last.map_err(|error| LogError::database(self.truth, error))?.map(|row| row as u64))
    }

    /// Why a row is there, if the truth tells; rows are asked for in their order. An ON tells of the firing that it began
    /// with; those that prolong it come later.
    pub fn of(&mut self, row: u64) -> Result<Option<Cause>, LogError> {
        let Causes { truth, connection, instants, firings, offs } = self;
        let mut take = || match firings.take(row, connection, instants)? {
            Some(cause) => Ok(Some(cause)),
            None => offs.take(row, connection, instants),
        };
        take().map_err(|error| LogError::database(truth, error))
    }
}

/// Why a row of a log is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Cause {
    /// The row that tells of it.
    pub row: u64,
    pub resident: Option<String>,
    pub seen_at: Option<Micros>,
    /// The sensor's id in the log.
    pub sensor: Option<String>,
    pub why: String,
    pub thing: Option<String>,
}

/// A row of the truth.
struct Told {
    at: [Option<Micros>; 2],
    who: String,
    what: Option<String>,
}

/// Rows of two instants, who, and what.
fn told(truth: &Path, sql: &str) -> Result<Vec<Told>, LogError> {
    let database = |error| LogError::database(truth, error);
    let connection = connect(truth).map_err(database)?;
    let mut statement = connection.prepare(sql).map_err(database)?;
    let mut rows = statement.query([]).map_err(database)?;
    let mut instants = Instants::default();
    let mut told = Vec::new();
    while let Some(row) = rows.next().map_err(database)? {
        let mut instant = |column| {
            let instant = match row.get_ref(column).map_err(database)? {
                ValueRef::Integer(number) => since_1970(number as f64),
                ValueRef::Real(number) => since_1970(number),
                other => instants.read(&text(other)),
            };
            Ok::<_, LogError>(instant.map(|(Instant::Local(at) | Instant::Utc(at))| at))
        };
        let at = [instant(0)?, instant(1)?];
        let who = text(row.get_ref(2).map_err(database)?).into_owned();
        let what = Some(text(row.get_ref(3).map_err(database)?).into_owned()).filter(|what| !what.is_empty());
        told.push(Told { at, who, what });
    }
    Ok(told)
}

/// Puts together what a log notes apart: that an activity begins, and that it ends.
#[derive(Default)]
pub(crate) struct Notes {
    /// Those that have begun.
    open: Vec<(String, Micros)>,
}

impl Notes {
    /// A note; gives the activity that it ends. What ends without having begun is passed over, and what begins
    /// again before it has ended goes on.
    pub fn take(&mut self, name: &str, begins: bool, at: Micros) -> Option<Activity> {
        let known = self.open.iter().position(|(open, _)| open == name);
        match known {
            None if begins => self.open.push((name.into(), at)),
            Some(index) if !begins => {
                let (name, begin) = self.open.swap_remove(index);
                return Some(Activity { name, begin, end: at });
            }
            _ => {}
        }
        None
    }
}
