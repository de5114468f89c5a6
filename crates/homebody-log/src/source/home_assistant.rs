//! The database of Home Assistant's recorder: which state each entity had from when on.
//!
//! The table `states` names an entity by its row of `states_meta`, and tells seconds since 1970; older databases have the entity's
//! id in each row, and times as text in UTC. Rows in which no more than attributes changed are passed over: their state began
//! before. Of attributes those are read that say what an entity is: `device_class`, `friendly_name` and `unit_of_measurement`. They
//! stand in `state_attributes`, and in older databases in each row. The registries in the
//! folder `.storage` say more: see `registry.rs`.
//!
//! The table `recorder_runs` says when the recorder ran. Between two runs nothing was recorded. A run that was not closed, as where
//! power was lost, ended with its last row: the recorder writes the beginning of the next run as its end.

mod registry;

use super::instant::{InstantReader, LogInstant, instant_of_cell as on_wall, since_1970};
use super::messages::FormMessage;
use super::reading::{LogReading, open};
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::{LogError, place_of};
use crate::files::database::{self, connect, tables, text};
use crate::log::{Clock, ColumnRole, SensorInfo};
use crate::source::json::said::{Object, entity, member};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::sensed::domain_of;
use homebody_core::time::{Interval, WallTime};
use registry::EntityRegistry;
use rusqlite::types::{Value as Cell, ValueRef};
use rusqlite::{Connection, OptionalExtension};
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "home-assistant",
    what: "the database of Home Assistant's recorder, home-assistant_v2.db: the states of all entities",
    shows,
    read,
};

fn shows(start: &FileStart) -> Shows {
    let found = || {
        let connection = connect(&start.path)?;
        columns(&connection)
    };
    Shows::rows_if(start.is_sqlite() && found().is_ok_and(|columns| columns.is_some()))
}

struct StateColumns {
    /// The query of the entity's id, of its last change and of its last update.
    entity: String,
    changed: String,
    updated: String,
    has_names: bool,
    /// The expression for a state's attributes, and the join of their table; `None` without attributes.
    attributes: Option<(&'static str, &'static str)>,
}

impl StateColumns {
    /// The join of the names of entities.
    fn names(&self) -> &'static str {
        if self.has_names { "LEFT JOIN states_meta m ON m.metadata_id = s.metadata_id" } else { "" }
    }
}

fn columns(connection: &Connection) -> rusqlite::Result<Option<StateColumns>> {
    let tables = tables(connection)?;
    let names = database::columns(connection, "states")?;
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
    let apart = "LEFT JOIN state_attributes a ON a.attributes_id = s.attributes_id";
    let has_apart = has("attributes_id") && tables.iter().any(|name| name == "state_attributes");
    let attributes = match (has_apart, has("attributes")) {
        (true, true) => Some(("coalesce(a.shared_attrs, s.attributes)", apart)),
        (true, false) => Some(("a.shared_attrs", apart)),
        (false, true) => Some(("s.attributes", "")),
        (false, false) => None,
    };
    Ok(updated.filter(|_| is_there).map(|updated| StateColumns {
        entity: entity.into(),
        changed: changed.unwrap_or("NULL".into()),
        updated,
        has_names,
        attributes,
    }))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    open(path)?;
    let database = |error| LogError::database(path, error);
    let connection = connect(path).map_err(database)?;
    let no_states = || LogError::no_log(place_of(path), FormMessage::NoStates);
    let columns = columns(&connection).map_err(database)?.ok_or_else(no_states)?;
    know_entities(&connection, &columns, &EntityRegistry::beside(path, &mut reading.log.remarks), reading)
        .map_err(database)?;
    for gap in gaps(&connection, &columns).map_err(database)? {
        reading.gap(gap);
    }
    let StateColumns { entity, changed, updated, .. } = &columns;
    for (column, role) in
        [(updated, ColumnRole::Time), (entity, ColumnRole::Sensor), (&"state".into(), ColumnRole::Value)]
    {
        reading.column(column, role, "its name in the table of states");
    }
    // A state that has changed was updated at that very instant, and some versions leave out when it changed.
    let sql = format!(
        "SELECT s.state_id, {updated}, {entity}, s.state, {changed} IS NULL OR {changed} = {updated} \
         FROM states s {} ORDER BY s.state_id",
        columns.names()
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
        // An entity that is taken away has no state.
        let value = if value.is_empty() { "unknown".into() } else { value };
        let instant = match row.get_ref(1).map_err(database)? {
            ValueRef::Integer(number) => since_1970(number as f64),
            ValueRef::Real(number) => since_1970(number),
            // Its texts are in UTC and do not say so.
            other => reading.instants.read(&text(other)).map(|at| LogInstant::told_by(Clock::Utc, at.on_wall())),
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

/// Keeps what the database and the registries say of entities: of each by its last state that was known, or else by its last.
fn know_entities(
    connection: &Connection,
    columns: &StateColumns,
    registry: &EntityRegistry,
    reading: &mut LogReading<'_>,
) -> rusqlite::Result<()> {
    let (id, names) = (&columns.entity, columns.names());
    let (attributes, apart) = columns.attributes.unwrap_or(("NULL", ""));
    let sql = format!(
        "SELECT l.entity, {attributes} FROM
            (SELECT {id} AS entity, coalesce(max(CASE WHEN s.state NOT IN ('unavailable', 'unknown', '') THEN s.state_id END),
                max(s.state_id)) AS last FROM states s {names} GROUP BY 1) l
         JOIN states s ON s.state_id = l.last {apart} ORDER BY l.last"
    );
    let mut statement = connection.prepare(&sql)?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let id = text(row.get_ref(0)?).into_owned();
        let attributes: Object = serde_json::from_str(&text(row.get_ref(1)?)).unwrap_or_default();
        let told = entity(&id, Some(&attributes));
        let entry = registry.entity(&id);
        let class = entry.and_then(|entry| entry.class.clone()).or(member(&attributes, &["device_class"]));
        let category = entry.and_then(|entry| entry.category.clone());
        // People do not use the switch of a setting. A class says more than `diagnostic`.
        let kind = match category {
            Some(category) if class.is_none() || category == "config" => category,
            _ => class.unwrap_or_else(|| domain_of(&id).unwrap_or_default().to_owned()),
        };
        let room = entry.and_then(|entry| entry.area.clone()).or_else(|| told.room.clone());
        reading.know(SensorInfo { is_motion: kind == "motion", kind, room, ..told });
    }
    Ok(())
}

/// When the recorder did not run, in the order of time, on the wall of UTC.
fn gaps(connection: &Connection, columns: &StateColumns) -> rusqlite::Result<Vec<Interval<WallTime>>> {
    if !tables(connection)?.iter().any(|name| name == "recorder_runs") {
        return Ok(Vec::new());
    }
    let mut instants = InstantReader::default();
    let mut statement =
        connection.prepare("SELECT start, \"end\", closed_incorrect FROM recorder_runs ORDER BY start")?;
    let mut rows = statement.query([])?;
    let mut runs: Vec<(WallTime, Option<WallTime>)> = Vec::new();
    while let Some(row) = rows.next()? {
        let Some(start) = on_wall(row, 0, &mut instants)? else { continue };
        let is_closed = !row.get::<_, Option<bool>>(2)?.unwrap_or(false);
        runs.push((start, on_wall(row, 1, &mut instants)?.filter(|_| is_closed)));
    }
    // One column alone is found in its index.
    let updated = if columns.updated.contains("last_updated_ts") { "s.last_updated_ts" } else { "s.last_updated" };
    let sql = format!("SELECT max({updated}) FROM states s WHERE {updated} < ?");
    let mut last_row = connection.prepare(&sql)?;
    let mut gaps = Vec::new();
    for (run, next) in runs.iter().zip(runs.iter().skip(1)) {
        let end = match run.1 {
            Some(end) => end,
            None => {
                let before = match updated.ends_with("_ts") {
                    true => Some(Cell::Real(next.0.since_zero().seconds())),
                    false => utc_text(next.0),
                };
                let last = last_row.query_row([before], |row| on_wall(row, 0, &mut instants)).optional()?.flatten();
                last.unwrap_or(run.0).max(run.0)
            }
        };
        if end < next.0 {
            gaps.push(Interval::new(end, next.0));
        }
    }
    Ok(gaps)
}

/// An instant as older databases write it.
fn utc_text(at: WallTime) -> Option<Cell> {
    let at = jiff::Timestamp::from_microsecond(at.micros()).ok()?;
    Some(Cell::Text(at.strftime("%Y-%m-%d %H:%M:%S%.6f").to_string()))
}
