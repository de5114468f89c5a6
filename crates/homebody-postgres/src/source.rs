//! A table in a database of PostgreSQL: by the names of a mapping, or ours. It is read row by row, in the order of its numbers,
//! through a cursor.

use crate::connection::{DatabaseConnection, cell};
use crate::messages::ServerMessage;
use crate::runs::ServerInstant;
use crate::schema::{RUNS, ident, quoted, usual};
use crate::sensors;
use crate::server::Server;
use crate::trouble::wrong;
use homebody_core::nearest::nearest;
use homebody_core::scenario::logger::{ColumnsFile, LoggerFile};
use homebody_log::LogError;
use homebody_log::log::{SPAN_COLUMNS, SPANS};
use homebody_log::source::{LogForm, LogInstant, LogReading, Shows};
use std::path::Path;
use tokio_postgres::Row;
use tokio_postgres::types::ToSql;

pub const FORM: LogForm = LogForm {
    name: "postgresql",
    what: "a table of a database of PostgreSQL that has a time, a sensor and a value, by the names of logger.json or ours",
    shows: |_| Shows::Nothing,
    read,
};

/// The transaction of a reader: it sees one instant of the table for as long as it lasts.
pub(crate) const BEGIN: &str = "BEGIN READ ONLY; SET LOCAL idle_in_transaction_session_timeout = 0";

/// Largest number of runs, tables or columns in an error (our choice).
const MOST_NAMED: usize = 20;

fn read(path: &Path, file: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let server = Server::parse(&path.to_string_lossy())?;
    let connection = DatabaseConnection::to_read(&server)?;
    let table = StoredLogTable::find(&connection, &server, file)?;
    let run = table.run(&connection, &server)?;
    let number = run.as_deref().and_then(|run| run.parse().ok());
    if let Some(zone) = zone(&connection, &table.schema, number) {
        reading.in_zone(&zone);
    }
    sensors::known(&connection, &table.schema, number)?.into_iter().for_each(|sensor| reading.know(sensor));
    connection.wait(connection.client.batch_execute(BEGIN))?;
    reading.has_spans = spans(&connection, &server, &table, run.as_deref(), reading)?;
    let (sql, parameter) = table.rows(run.as_deref());
    let parameters: Vec<&(dyn ToSql + Sync)> = parameter.iter().map(|run| run as &(dyn ToSql + Sync)).collect();
    let mut line = 0;
    connection.each_row(&sql, &parameters, |row| {
        line += 1;
        table.take(&server, line, row, reading)
    })?;
    connection.wait(connection.client.batch_execute("COMMIT"))
}

/// Reads the activities of a log from the table next to it; whether that table exists.
fn spans(
    connection: &DatabaseConnection,
    server: &Server,
    log: &StoredLogTable,
    run: Option<&str>,
    reading: &mut LogReading<'_>,
) -> Result<bool, LogError> {
    let columns = columns_of(connection, &log.schema, SPANS)?;
    let [begin, end, activity] = SPAN_COLUMNS;
    let types: Vec<&str> = [begin, end, activity]
        .iter()
        .filter_map(|wanted| columns.iter().find(|(name, _)| name == wanted).map(|(_, is)| is.as_str()))
        .collect();
    let [begins, ends, _] = types[..] else { return Ok(false) };
    let clocks = [begins, ends].map(clock_of);
    let told = |name: &str, clock: TimeColumnKind| {
        if clock == TimeColumnKind::Text { format!("{name}::text") } else { name.to_owned() }
    };
    let mut sql = format!(
        "SELECT {}, {}, {activity}::text FROM {}",
        told(begin, clocks[0]),
        told(end, clocks[1]),
        quoted(&log.schema, SPANS)
    );
    // The first column is the run's id, as that of the log.
    if let Some(run) = run.filter(|_| log.run.as_ref().is_some_and(|column| columns[0].0 == *column)) {
        let known = if log.has_numbers { run.parse::<i64>().ok() } else { None };
        let Some(run) = known else { return Ok(false) };
        sql += &format!(" WHERE {} = {run}", ident(&columns[0].0));
    }
    sql += &format!(" ORDER BY {begin}, {end}");
    let mut line = 0;
    connection.each_row(&sql, &[], |row| {
        line += 1;
        let mut at = |place: usize| -> Result<Option<LogInstant>, LogError> {
            Ok(match clocks[place] {
                TimeColumnKind::Text => cell(server, row, place)?.and_then(|text| reading.instant(text)),
                TimeColumnKind::Stamp => cell(server, row, place)?.map(|ServerInstant(at)| at),
            })
        };
        match at(0)?.zip(at(1)?) {
            Some((begin, end)) => reading.span(line, begin, end, cell(server, row, 2)?.unwrap_or_default()),
            None => reading.skip(line, format!("in the table {SPANS}: an end is no date and time")),
        }
        Ok(())
    })?;
    Ok(true)
}

fn clock_of(is: &str) -> TimeColumnKind {
    match is {
        "timestamp with time zone" | "timestamp without time zone" => TimeColumnKind::Stamp,
        _ => TimeColumnKind::Text,
    }
}

struct StoredLogTable {
    schema: String,
    table: String,
    time: String,
    clock: TimeColumnKind,
    sensor: String,
    value: String,
    run: Option<String>,
    has_numbers: bool,
    seq: Option<String>,
    label: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TimeColumnKind {
    /// Instants, of the world's clock or of one on some wall.
    Stamp,
    /// A text or a number, as files have them.
    Text,
}

impl StoredLogTable {
    /// The table by the names of a mapping, or all that is missing.
    fn find(connection: &DatabaseConnection, server: &Server, file: &LoggerFile) -> Result<StoredLogTable, LogError> {
        let schema = match &server.schema {
            Some(schema) => schema.clone(),
            None => usual(connection, server)?,
        };
        let table = file.table.clone().unwrap_or_else(|| table_of_run(connection, server, &schema));
        let columns = columns_of(connection, &schema, &table)?;
        if columns.is_empty() {
            let no_run = if file.table.is_none() { no_run(connection, server, &schema) } else { None };
            return Err(match no_run {
                Some(no_run) => no_run,
                None => no_table(connection, server, &schema, &table)?,
            });
        }
        let has = |name: &String| columns.iter().any(|(column, _)| column == name).then(|| name.clone());
        let by_types = || Some(&columns).filter(|_| file.columns == ColumnsFile::default()).and_then(|it| by_types(it));
        let guessed =
            [&file.columns.time, &file.columns.sensor, &file.columns.value].iter().any(|name| has(name).is_none());
        let names = &if guessed { by_types().unwrap_or_else(|| file.columns.clone()) } else { file.columns.clone() };
        let missing: Vec<&String> =
            [&names.time, &names.sensor, &names.value].into_iter().filter(|name| has(name).is_none()).collect();
        if !missing.is_empty() {
            let known: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
            let missing: Vec<String> = missing.iter().map(|name| format!("{name:?}")).collect();
            return Err(wrong(server, ServerMessage::MissingColumns { table, missing, known: listed(&known) }));
        }
        let is = |wanted: &String| columns.iter().find(|(name, _)| name == wanted).map_or("", |(_, is)| is.as_str());
        let clock = clock_of(is(&names.time));
        Ok(StoredLogTable {
            time: names.time.clone(),
            clock,
            sensor: names.sensor.clone(),
            value: names.value.clone(),
            run: has(&names.run),
            has_numbers: ["bigint", "integer", "smallint"].contains(&is(&names.run)),
            seq: has(&names.seq),
            label: has(&SPANS.to_owned()),
            schema,
            table,
        })
    }

    /// The run to read if rows have one: the requested run, or the only one.
    fn run(&self, connection: &DatabaseConnection, server: &Server) -> Result<Option<String>, LogError> {
        let Some(run) = &self.run else { return Ok(None) };
        let (run, table) = (ident(run), quoted(&self.schema, &self.table));
        // If a key begins with the run, the server finds each run without a scan of all rows.
        let runs = format!(
            "WITH RECURSIVE runs AS ((SELECT {run} AS run FROM {table} WHERE {run} IS NOT NULL ORDER BY 1 LIMIT 1) UNION ALL \
             SELECT (SELECT {run} FROM {table} WHERE {run} > runs.run ORDER BY 1 LIMIT 1) FROM runs WHERE runs.run IS NOT NULL) \
             SELECT run::text FROM runs WHERE run IS NOT NULL LIMIT {}",
            MOST_NAMED + 1
        );
        if let Some(asked) = &server.run {
            let (is_it, parameter) = self.is_run(&run, asked);
            let sql = format!("SELECT EXISTS (SELECT FROM {table} WHERE {is_it})");
            let parameters: Vec<&(dyn ToSql + Sync)> = parameter.iter().map(|run| run as _).collect();
            if connection.wait(connection.client.query_one(&sql, &parameters))?.get(0) {
                return Ok(Some(asked.clone()));
            }
        }
        let found = connection.wait(connection.client.query(&runs, &[]))?;
        let found: Vec<&str> = found.iter().map(|row| row.get(0)).collect();
        match (&server.run, &found[..]) {
            (Some(asked), found) => {
                let (table, run, known) = (self.table.clone(), asked.clone(), listed(found));
                Err(wrong(server, ServerMessage::NoRunInTable { table, run, known }))
            }
            (None, []) => Ok(None),
            (None, [one]) => Ok(Some((*one).to_owned())),
            (None, several) => {
                let (table, runs, first) = (self.table.clone(), listed(several), several[0].to_owned());
                Err(wrong(server, ServerMessage::SeveralRuns { table, runs, first }))
            }
        }
    }

    /// The SQL condition for rows of a run, with its parameter; an index finds a number.
    fn is_run(&self, column: &str, run: &str) -> (String, Option<String>) {
        match run.parse::<i64>().ok().filter(|_| self.has_numbers) {
            Some(number) => (format!("{column} = {number}"), None),
            None => (format!("{column}::text = $1"), Some(run.to_owned())),
        }
    }

    fn rows(&self, run: Option<&str>) -> (String, Option<String>) {
        let time = ident(&self.time);
        let told = if self.clock == TimeColumnKind::Text { format!("{time}::text") } else { time.clone() };
        let [sensor, value] = [&self.sensor, &self.value].map(|name| format!("{}::text", ident(name)));
        let label = self.label.as_deref().map_or_else(|| "NULL::text".into(), |name| format!("{}::text", ident(name)));
        let mut sql = format!("SELECT {told}, {sensor}, {value}, {label} FROM {}", quoted(&self.schema, &self.table));
        let mut parameter = None;
        if let (Some(run), Some(column)) = (run, self.run.as_deref().map(ident)) {
            let (is_it, asked) = self.is_run(&column, run);
            sql += &format!(" WHERE {is_it}");
            parameter = asked;
        }
        sql += &match &self.seq {
            Some(seq) => format!(" ORDER BY {}", ident(seq)),
            None => format!(" ORDER BY {time}"),
        };
        (sql, parameter)
    }

    fn take(&self, server: &Server, line: u64, row: &Row, reading: &mut LogReading) -> Result<(), LogError> {
        let text = |place: usize| cell::<&str>(server, row, place);
        let (sensor, value) = (text(1)?.unwrap_or_default(), text(2)?.unwrap_or_default());
        let is_row = match self.clock {
            TimeColumnKind::Text => reading.row(line, text(0)?.unwrap_or_default(), sensor, value)?,
            TimeColumnKind::Stamp => match cell(server, row, 0)? {
                None => {
                    reading.skip(line, "there is no time".into());
                    false
                }
                Some(ServerInstant(instant)) => reading.event(line, instant, sensor, value)?,
            },
        };
        if is_row && self.label.is_some() {
            reading.label(text(3)?.filter(|label| !label.is_empty()));
        }
        Ok(())
    }
}

/// The table to read by default: that of the run, or of all logs, in the table of runs; else the usual one.
fn table_of_run(connection: &DatabaseConnection, server: &Server, schema: &str) -> String {
    let sql = format!(
        "SELECT DISTINCT tables[1] FROM {} WHERE holds = 'log' AND ($1::text IS NULL OR run_id::text = $1) LIMIT 2",
        quoted(schema, RUNS)
    );
    // The table of runs may be missing or unreadable.
    let told = connection.wait(connection.client.query(&sql, &[&server.run])).unwrap_or_default();
    let told: Option<Option<String>> = (told.len() == 1).then(|| told[0].get(0));
    told.flatten().unwrap_or_else(|| "firing".into())
}

/// The error where the table of runs does not have the run that is asked for, and has others.
fn no_run(connection: &DatabaseConnection, server: &Server, schema: &str) -> Option<LogError> {
    let asked = server.run.as_ref()?;
    let sql = format!(
        "SELECT run_id::text FROM {} WHERE holds = 'log' ORDER BY run_id LIMIT {}",
        quoted(schema, RUNS),
        MOST_NAMED + 1
    );
    let found = connection.wait(connection.client.query(&sql, &[])).ok()?;
    let runs: Vec<&str> = found.iter().map(|row| row.get(0)).collect();
    if runs.is_empty() {
        return None;
    }
    Some(wrong(server, ServerMessage::NoRun { run: asked.clone(), known: listed(&runs) }))
}

/// The zone of a run's home, if there is a table of runs that may be read and names it.
fn zone(connection: &DatabaseConnection, schema: &str, run: Option<i64>) -> Option<String> {
    let sql = format!("SELECT zone FROM {} WHERE run_id = $1", quoted(schema, RUNS));
    connection.wait(connection.client.query_opt(&sql, &[&run?])).ok()??.get(0)
}

/// The columns of a log under names that say nothing: two texts side by side are sensor and value, and what is right before them the time, if
/// it may be one; two whole numbers before that are the run and the row. So are the logs that we write.
fn by_types(columns: &[(String, String)]) -> Option<ColumnsFile> {
    let is = |place: usize, types: &[&str]| columns.get(place).is_some_and(|(_, is)| types.contains(&is.as_str()));
    const TIMES: [&str; 4] = ["timestamp with time zone", "timestamp without time zone", "double precision", "bigint"];
    const TEXTS: [&str; 2] = ["text", "character varying"];
    let time = (0..columns.len()).find(|&at| is(at, &TIMES) && is(at + 1, &TEXTS) && is(at + 2, &TEXTS))?;
    let name = |place: usize| columns[place].0.clone();
    let usual = ColumnsFile { time: name(time), sensor: name(time + 1), value: name(time + 2), ..Default::default() };
    let is_key = |place: usize| is(place, &["bigint"]);
    Some(match time {
        2 if is_key(0) && is_key(1) => ColumnsFile { run: name(0), seq: name(1), ..usual },
        _ => usual,
    })
}

/// The columns of a table and their types, in their order; empty without such a table.
pub(crate) fn columns_of(
    connection: &DatabaseConnection,
    schema: &str,
    table: &str,
) -> Result<Vec<(String, String)>, LogError> {
    const COLUMNS: &str = "SELECT a.attname::text, format_type(a.atttypid, NULL) FROM pg_attribute a \
         JOIN pg_class c ON c.oid = a.attrelid JOIN pg_namespace n ON n.oid = c.relnamespace \
         WHERE n.nspname = $1 AND c.relname = $2 AND c.relkind IN ('r', 'p', 'v', 'm', 'f') \
         AND a.attnum > 0 AND NOT a.attisdropped ORDER BY a.attnum";
    let columns = connection.wait(connection.client.query(COLUMNS, &[&schema, &table]))?;
    Ok(columns.iter().map(|row| (row.get(0), row.get(1))).collect())
}

fn no_table(connection: &DatabaseConnection, server: &Server, schema: &str, table: &str) -> Result<LogError, LogError> {
    const TABLES: &str = "SELECT c.relname::text FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace \
         WHERE n.nspname = $1 AND c.relkind IN ('r', 'p', 'v', 'm', 'f') ORDER BY 1";
    let found = connection.wait(connection.client.query(TABLES, &[&schema]))?;
    let names: Vec<&str> = found.iter().map(|row| row.get(0)).collect();
    let advice = match (nearest(table, names.iter().copied()), &names[..]) {
        (_, []) => "the schema has no tables: name another, ?schema=NAME".to_owned(),
        (Some(near), _) => format!("did you mean {near:?}? name the table with --mapping logger.json"),
        (None, names) => format!("its tables are {}; name one with --mapping logger.json", listed(names)),
    };
    let (table, schema) = (table.to_owned(), schema.to_owned());
    Ok(wrong(server, ServerMessage::NoTable { table, schema, advice }))
}

pub(crate) fn listed(names: &[&str]) -> String {
    let more = if names.len() > MOST_NAMED { " and more" } else { "" };
    names.iter().take(MOST_NAMED).copied().collect::<Vec<_>>().join(", ") + more
}
