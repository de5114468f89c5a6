//! What residents did when: from the notes of a log, or from a run's truth.

use super::instant::{Instant, Instants, since_1970};
use super::sqlite::{connect, text};
use crate::error::LogError;
use homebody_core::time::Micros;
use rusqlite::types::ValueRef;
use std::path::Path;

/// What somebody did over a span, on the log's clock; the end is no part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Activity {
    pub name: String,
    pub begin: Micros,
    pub end: Micros,
}

/// The activities that a run's truth tells, in order of their beginnings.
pub fn activities(truth: &Path) -> Result<Vec<Activity>, LogError> {
    let database = |error| LogError::database(truth, error);
    let connection = connect(truth).map_err(database)?;
    let sql = "SELECT begin_at, end_at, name FROM activity WHERE name IS NOT NULL ORDER BY begin_at";
    let mut statement = connection.prepare(sql).map_err(database)?;
    let mut rows = statement.query([]).map_err(database)?;
    let mut instants = Instants::default();
    let mut activities = Vec::new();
    while let Some(row) = rows.next().map_err(database)? {
        let value = |column| row.get_ref(column).map_err(database);
        let mut instant = |column| {
            let instant = match value(column)? {
                ValueRef::Integer(number) => since_1970(number as f64),
                ValueRef::Real(number) => since_1970(number),
                other => instants.read(&text(other)),
            };
            Ok::<_, LogError>(instant.map(|(Instant::Local(at) | Instant::Utc(at))| at))
        };
        if let (Some(begin), Some(end)) = (instant(0)?, instant(1)?) {
            activities.push(Activity { name: text(value(2)?), begin, end });
        }
    }
    Ok(activities)
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
