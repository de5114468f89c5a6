//! A database file: a table by the mapping's names or ours, or whichever looks like a log.

use super::columns::ColumnPlaces;
use super::instant::{since_1970, since_1970_whole};
use super::messages::FormMessage;
use super::reading::{LogReading, open};
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::{LogError, place_of};
use crate::files::database::{columns, connect, has_column, list, tables, text};
use crate::log::{SENSOR, SENSOR_COLUMNS, SPAN_COLUMNS, SPANS, SensorInfo};
use homebody_core::scenario::logger::LoggerFile;
use rusqlite::Connection;
use rusqlite::types::ValueRef;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "sqlite",
    what: "a database file with a table of time, sensor and value, with the column names of logger.json or of Homebody, or common names such as timestamp, device and state",
    shows,
    read,
};

fn shows(start: &FileStart) -> Shows {
    Shows::rows_if(start.is_sqlite())
}

struct LogTable {
    name: String,
    columns: Vec<String>,
    places: ColumnPlaces,
}

fn read(path: &Path, file: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    open(path)?;
    let database = |error| LogError::database(path, error);
    let connection = connect(path).map_err(database)?;
    let table = find(&connection, file, reading).map_err(|error| match error.sqlite_error_code() {
        Some(rusqlite::ErrorCode::NotADatabase) => LogError::no_log(place_of(path), FormMessage::NotDatabase),
        _ => LogError::database(path, error),
    })?;
    let table = match table {
        Some(table) => table,
        None if tables(&connection).map_err(database)?.is_empty() => {
            return Err(LogError::NoTables { place: place_of(path) });
        }
        None => return Err(LogError::no_log(place_of(path), FormMessage::NoLogTable)),
    };
    reading.has_spans = spans(&connection, reading).map_err(database)?;
    if let Some(zone) = zone(&connection).map_err(database)? {
        reading.in_zone(&zone);
    }
    // The log's table in a file has places, too, so it comes first.
    sensors(&connection).map_err(database)?.into_iter().for_each(|sensor| reading.know(sensor));
    let sql = rows_of(&connection, file, &table, reading).map_err(database)?;
    let mut statement = connection.prepare(&sql).map_err(database)?;
    let mut rows = statement.query([]).map_err(database)?;
    let mut line = 0;
    while let Some(row) = rows.next().map_err(database)? {
        line += 1;
        let said = |column| row.get_ref(column).map(text).map_err(database);
        let (sensor, value) = (said(1)?, said(2)?);
        let time = row.get_ref(0).map_err(database)?;
        let number = match time {
            ValueRef::Integer(number) => Some(since_1970_whole(number)),
            ValueRef::Real(number) => Some(since_1970(number)),
            _ => None,
        };
        let is_row = match number {
            None => reading.row(line, &text(time), &sensor, &value)?,
            Some(Some(instant)) => reading.event(line, instant, &sensor, &value)?,
            Some(None) => {
                reading.skip(line, "the time is out of range".into());
                false
            }
        };
        if is_row && table.places.label.is_some() {
            let label = said(3)?;
            reading.label(Some(&*label).filter(|label| !label.is_empty()));
        }
    }
    Ok(())
}

/// Takes the activities of our table next to a log; whether there is one.
fn spans(connection: &Connection, reading: &mut LogReading<'_>) -> rusqlite::Result<bool> {
    let [begin, end, activity] = SPAN_COLUMNS;
    let columns = columns(connection, SPANS)?;
    let has_all = SPAN_COLUMNS.iter().all(|wanted| columns.iter().any(|name| name == wanted));
    if !has_all || !tables(connection)?.iter().any(|name| name == SPANS) {
        return Ok(false);
    }
    let mut statement =
        connection.prepare(&format!("SELECT {begin}, {end}, {activity} FROM {SPANS} ORDER BY rowid"))?;
    let mut rows = statement.query([])?;
    let mut line = 0;
    while let Some(row) = rows.next()? {
        line += 1;
        let [begin, end] = [0, 1].map(|column| row.get_ref(column).map(|cell| reading.instants.read(&text(cell))));
        match (begin?, end?) {
            (Some(begin), Some(end)) => reading.span(line, begin, end, &text(row.get_ref(2)?)),
            _ => reading.skip(line, format!("in the table {SPANS}: an end is no date and time")),
        }
    }
    Ok(true)
}

/// The zone of the homes, as the table of runs that our logs have names it; none where several zones are named.
fn zone(connection: &Connection) -> rusqlite::Result<Option<String>> {
    if !has_column(connection, "run", "zone")? || !tables(connection)?.iter().any(|name| name == "run") {
        return Ok(None);
    }
    let sql = "SELECT DISTINCT zone FROM run WHERE typeof(zone) = 'text' LIMIT 2";
    let zones: Vec<String> = list(connection, sql, [], |row| row.get(0))?;
    Ok(<[String; 1]>::try_from(zones).ok().map(|[zone]| zone))
}

/// The sensors in the table that our logs have; none without such a table.
fn sensors(connection: &Connection) -> rusqlite::Result<Vec<SensorInfo>> {
    if !has_sensors(connection)? {
        return Ok(Vec::new());
    }
    let columns = SENSOR_COLUMNS.join(", ");
    list(connection, &format!("SELECT {columns} FROM {SENSOR} ORDER BY rowid LIMIT {MOST_SENSORS}"), [], |row| {
        let mut cells = [const { String::new() }; SENSOR_COLUMNS.len()];
        for (column, cell) in cells.iter_mut().enumerate() {
            *cell = text(row.get_ref(column)?).into_owned();
        }
        Ok(SensorInfo::of_cells(cells))
    })
}

/// Largest number of sensors that are read from the table.
const MOST_SENSORS: usize = 10_000;

fn has_sensors(connection: &Connection) -> rusqlite::Result<bool> {
    let columns = columns(connection, SENSOR)?;
    let is_ours = columns.len() == SENSOR_COLUMNS.len() + 1 && columns.ends_with(&SENSOR_COLUMNS.map(str::to_owned));
    Ok(is_ours && tables(connection)?.iter().any(|name| name == SENSOR))
}

/// The table named by the mapping, ours, or the first that looks like a log.
fn find(
    connection: &Connection,
    file: &LoggerFile,
    reading: &mut LogReading<'_>,
) -> rusqlite::Result<Option<LogTable>> {
    let mut names = tables(connection)?;
    if has_sensors(connection)? {
        names.retain(|name| name != SENSOR);
    }
    let wanted = file.table.as_deref().unwrap_or("firing");
    names.sort_by_key(|name| name != wanted);
    for by_content in [false, true] {
        for name in &names {
            let columns = columns(connection, name)?;
            let places = match by_content {
                false => ColumnPlaces::by_name(&columns, file),
                true => by_first_row(connection, name, reading)?,
            };
            if let Some(places) = places {
                return Ok(Some(LogTable { name: name.clone(), columns, places }));
            }
        }
    }
    Ok(None)
}

/// The first instant, as text or as a number since 1970, is the time; the next two texts are sensor and value. Neither of these is an
/// instant: a table with two instants is not a log. Numbers of a key, and the ids of our own runs, are not instants either.
fn by_first_row(
    connection: &Connection,
    table: &str,
    reading: &mut LogReading<'_>,
) -> rusqlite::Result<Option<ColumnPlaces>> {
    let keys = "SELECT pk > 0 OR name = 'run_id' FROM pragma_table_info(?) ORDER BY cid";
    let key: Vec<bool> = list(connection, keys, [table], |row| row.get(0))?;
    let mut statement = connection.prepare(&format!("SELECT * FROM {} LIMIT 1", quoted(table)))?;
    let columns = statement.column_count();
    let mut rows = statement.query([])?;
    let Some(row) = rows.next()? else { return Ok(None) };
    let (mut time, mut texts) = (None, Vec::new());
    for column in 0..columns {
        let is_key = key.get(column).is_some_and(|&is_key| is_key);
        let (is_text, is_instant) = match row.get_ref(column)? {
            ValueRef::Integer(number) => (false, !is_key && since_1970_whole(number).is_some()),
            ValueRef::Real(number) => (false, !is_key && since_1970(number).is_some()),
            value => (true, reading.instants.read(&text(value)).is_some()),
        };
        match time {
            None if is_instant => time = Some(column),
            Some(_) if is_text => texts.push((column, is_instant)),
            _ => {}
        }
    }
    Ok(match (time, &texts[..]) {
        (Some(time), &[(sensor, false), (value, false), ..]) => {
            Some(ColumnPlaces { time, sensor, value, label: None, is_mapped: false })
        }
        _ => None,
    })
}

/// The query of time, sensor and value of a log's rows, in their order.
fn rows_of(
    connection: &Connection,
    file: &LoggerFile,
    table: &LogTable,
    reading: &mut LogReading<'_>,
) -> rusqlite::Result<String> {
    let column = |place: usize| quoted(&table.columns[place]);
    let has = |name: &str| table.columns.iter().any(|column| column == name).then(|| quoted(name));
    let name = quoted(&table.name);
    let mut sql = format!(
        "SELECT {}, {}, {}, {} FROM {name}",
        column(table.places.time),
        column(table.places.sensor),
        column(table.places.value),
        table.places.label.map_or("NULL".to_owned(), column),
    );
    let run = has(&file.columns.run);
    // Rows of several runs make no log; what comes first is read.
    if let Some(run) = &run {
        // If a key begins with the run, its ends are found without a scan of all rows.
        let ends = format!("SELECT (SELECT min({run}) FROM {name}) IS NOT (SELECT max({run}) FROM {name})");
        if connection.query_row(&ends, [], |row| row.get(0))? {
            let count = format!("SELECT count(DISTINCT {run}) FROM {name}");
            let runs: i64 = connection.query_row(&count, [], |row| row.get(0))?;
            reading.log.remarks.push(format!("of {runs} runs in it only the first is read"));
            sql += &format!(" WHERE {run} = (SELECT min({run}) FROM {name})");
        }
    }
    if let Some(seq) = has(&file.columns.seq) {
        // As the key has them: nothing is to be sorted.
        let order: Vec<String> = run.into_iter().chain([seq]).collect();
        sql += &format!(" ORDER BY {}", order.join(", "));
    }
    Ok(sql)
}

/// A name of someone else's table, as SQL wants it.
fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}
