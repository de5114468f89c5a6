//! What residents did when: from the notes of a log, or from a run's truth.

use super::instant::{Instant, Instants, since_1970};
use super::sqlite::{connect, text};
use crate::error::LogError;
use homebody_core::time::Micros;
use rusqlite::types::ValueRef;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What somebody did over a span, on the log's clock; the end is no part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Activity {
    pub name: String,
    pub begin: Micros,
    pub end: Micros,
}

/// What a run's truth tells of one resident.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Life {
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

/// Why each row of a log is there: what the truth tells of the firings behind it, those of ONs first.
pub(crate) fn told_causes(truth: &Path) -> Result<Vec<Cause>, LogError> {
    // Firings are numbered from 0 and rows of a table from 1.
    let sql = "SELECT row, resident, seen_at, sensor, why, thing FROM cause WHERE row IS NOT NULL
               UNION ALL
               SELECT off.row, cause.resident, cause.seen_at, cause.sensor, cause.why, cause.thing
               FROM off JOIN cause ON cause.rowid = off.firing + 1 AND cause.firing = off.firing";
    let database = |error| LogError::database(truth, error);
    let connection = connect(truth).map_err(database)?;
    let mut statement = connection.prepare(sql).map_err(database)?;
    let mut rows = statement.query([]).map_err(database)?;
    let mut instants = Instants::default();
    let mut causes = Vec::new();
    while let Some(row) = rows.next().map_err(database)? {
        let said = |column| {
            let said = text(row.get_ref(column).map_err(database)?).into_owned();
            Ok::<_, LogError>(Some(said).filter(|said| !said.is_empty()))
        };
        let seen_at = match row.get_ref(2).map_err(database)? {
            ValueRef::Integer(number) => since_1970(number as f64),
            ValueRef::Real(number) => since_1970(number),
            other => instants.read(&text(other)),
        };
        causes.push(Cause {
            row: row.get::<_, i64>(0).map_err(database)? as u64,
            resident: said(1)?,
            seen_at: seen_at.map(|(Instant::Local(at) | Instant::Utc(at))| at),
            sensor: said(3)?,
            why: said(4)?.unwrap_or_default(),
            thing: said(5)?,
        });
    }
    Ok(causes)
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
