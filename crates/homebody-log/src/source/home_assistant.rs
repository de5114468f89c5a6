//! The database of Home Assistant's recorder: which state each entity had from when on.
//!
//! The table `states` names an entity by its row of `states_meta`, and tells seconds since 1970; older databases have the entity's
//! id in each row, and times as text in UTC. Rows in which no more than attributes changed are passed over: their state began
//! before. Attributes themselves are never read.

use super::database::{connect, tables, text};
use super::form::{Form, Shows};
use super::instant::{Instant, since_1970};
use super::reading::{Reading, open};
use super::start::Start;
use crate::error::{LogError, place_of};
use homebody_core::scenario::logger::LoggerFile;
use rusqlite::Connection;
use rusqlite::types::ValueRef;
use std::path::Path;

pub(super) const FORM: Form = Form {
    name: "home-assistant",
    what: "the database of Home Assistant's recorder, home-assistant_v2.db: the states of all entities",
    shows,
    read,
};

fn shows(start: &Start) -> Shows {
    let found = || {
        let connection = connect(&start.path)?;
        columns(&connection)
    };
    Shows::rows_if(start.is_sqlite() && found().is_ok_and(|columns| columns.is_some()))
}

/// What the table of states has.
struct Columns {
    /// What asks for the entity's id, for when it was last changed and for when it was last updated.
    entity: String,
    changed: String,
    updated: String,
    has_names: bool,
}

fn columns(connection: &Connection) -> rusqlite::Result<Option<Columns>> {
    let tables = tables(connection)?;
    let mut statement = connection.prepare("SELECT name FROM pragma_table_info('states')")?;
    let names: Vec<String> = statement.query_map([], |row| row.get(0))?.collect::<rusqlite::Result<_>>()?;
    let has = |name: &str| names.iter().any(|known| known == name);
    let all = |wanted: [&str; 2]| {
        let there: Vec<String> = wanted.into_iter().filter(|name| has(name)).map(|name| format!("s.{name}")).collect();
        match &there[..] {
            [] => None,
            [one] => Some(one.clone()),
            several => Some(format!("coalesce({})", several.join(", "))),
        }
    };
    let has_names = has("metadata_id") && tables.iter().any(|name| name == "states_meta");
    let entity = match (has_names, has("entity_id")) {
        (true, true) => "coalesce(m.entity_id, s.entity_id)",
        (true, false) => "m.entity_id",
        (false, true) => "s.entity_id",
        (false, false) => return Ok(None),
    };
    let (changed, updated) = (all(["last_changed_ts", "last_changed"]), all(["last_updated_ts", "last_updated"]));
    let is_there = tables.iter().any(|name| name == "states") && has("state") && has("state_id");
    Ok(updated.filter(|_| is_there).map(|updated| Columns {
        entity: entity.into(),
        changed: changed.unwrap_or("NULL".into()),
        updated,
        has_names,
    }))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    open(path)?;
    let database = |error| LogError::database(path, error);
    let connection = connect(path).map_err(database)?;
    let no_states = || LogError::NoLog {
        place: place_of(path),
        why: "it has no table of states as Home Assistant makes it".into(),
    };
    let Columns { entity, changed, updated, has_names } =
        columns(&connection).map_err(database)?.ok_or_else(no_states)?;
    let names = if has_names { "LEFT JOIN states_meta m ON m.metadata_id = s.metadata_id" } else { "" };
    // A state that has changed was updated at that very instant, and some versions leave out when it changed.
    let sql = format!(
        "SELECT s.state_id, {updated}, {entity}, s.state, {changed} IS NULL OR {changed} = {updated} \
         FROM states s {names} ORDER BY s.state_id"
    );
    let mut statement = connection.prepare(&sql).map_err(database)?;
    let mut rows = statement.query([]).map_err(database)?;
    let mut attributes = 0_u64;
    while let Some(row) = rows.next().map_err(database)? {
        let line: i64 = row.get(0).map_err(database)?;
        let line = line.unsigned_abs();
        if !row.get::<_, bool>(4).map_err(database)? {
            attributes += 1;
            continue;
        }
        let said = |column| row.get_ref(column).map(text).map_err(database);
        let (sensor, value) = (said(2)?, said(3)?);
        let instant = match row.get_ref(1).map_err(database)? {
            ValueRef::Integer(number) => since_1970(number as f64),
            ValueRef::Real(number) => since_1970(number),
            // Its texts are in UTC and do not say so.
            other => {
                reading.instants.read(&text(other)).map(|(Instant::Local(at) | Instant::Utc(at))| Instant::Utc(at))
            }
        };
        match instant {
            Some(instant) => drop(reading.event(line, instant, &sensor, &value)?),
            None => reading.skip(line, "the time is out of range".into()),
        }
    }
    if attributes > 0 {
        reading.log.remarks.push(format!("{attributes} rows in which only attributes changed are passed over"));
    }
    Ok(())
}
