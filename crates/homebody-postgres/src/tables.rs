//! Reads the tables of a truth from a database of PostgreSQL by their names: the rows of one run, in the order of writing.

use crate::connection::{DatabaseConnection, cell};
use crate::messages::ServerMessage;
use crate::runs::ServerInstant;
use crate::schema::{RUNS, TRUTH_SCHEMA, ident, quoted};
use crate::server::Server;
use crate::source::{BEGIN, columns_of, listed};
use crate::trouble::wrong;
use homebody_log::error::TruthMessage;
use homebody_log::source::{TakeTruthRow, TruthValue};
use homebody_log::table::{Column, ColumnKind, Table};
use homebody_log::{LogError, Url};

pub(crate) fn read(url: &Url, wanted: &[&Table], take: &mut TakeTruthRow<'_>) -> Result<(), LogError> {
    let server = Server::parse(&url.to_string())?;
    let connection = DatabaseConnection::to_read(&server)?;
    let schema = server.schema.clone().unwrap_or_else(|| TRUTH_SCHEMA.into());
    let mut found = Vec::new();
    let mut missing = Vec::new();
    for table in wanted {
        found.push(StoredTruthTable::find(&connection, &schema, table, &mut missing)?);
    }
    if !missing.is_empty() {
        return Err(LogError::no_truth(server.place.as_str(), TruthMessage::Missing { missing }));
    }
    let run = run(&connection, &server, &schema)?;
    // One instant of all tables.
    connection.wait(connection.client.batch_execute(BEGIN))?;
    connection.wait(connection.client.batch_execute("SET TRANSACTION ISOLATION LEVEL REPEATABLE READ"))?;
    for (index, found) in found.iter().flatten().enumerate() {
        found.read(&connection, &server, run, &mut |values| take(index, values))?;
    }
    connection.wait(connection.client.batch_execute("COMMIT"))
}

/// The truth of the run with this log: in the default schema of truths, if that has one of the run.
pub(crate) fn truth_of(log: &Url) -> Option<Url> {
    let server = Server::parse(&log.to_string()).ok()?;
    let connection = DatabaseConnection::to_read(&server).ok()?;
    let truths = runs(&connection, TRUTH_SCHEMA).ok()?;
    let run = match (&server.run, &truths[..]) {
        (Some(run), truths) => truths.iter().find(|truth| truth.to_string() == *run).copied()?,
        (None, [one]) => *one,
        (None, _) => return None,
    };
    let at = log.path().to_string_lossy().into_owned();
    let (main, query) = at.split_once('?').unwrap_or((&at, ""));
    let kept = query.split('&').filter(|pair| !["", "schema", "run"].contains(&pair.split('=').next().unwrap_or("")));
    let query: Vec<&str> = kept.collect();
    let more = query.iter().map(|pair| format!("&{pair}")).collect::<String>();
    Some(Url::new(log.scheme(), format!("{main}?schema={TRUTH_SCHEMA}&run={run}{more}")))
}

fn runs(connection: &DatabaseConnection, schema: &str) -> Result<Vec<i64>, LogError> {
    let sql = format!("SELECT run_id FROM {} WHERE holds = 'truth' ORDER BY 1", quoted(schema, RUNS));
    Ok(connection.wait(connection.client.query(&sql, &[]))?.iter().map(|row| row.get(0)).collect())
}

fn run(connection: &DatabaseConnection, server: &Server, schema: &str) -> Result<i64, LogError> {
    let runs = runs(connection, schema)?;
    let names: Vec<String> = runs.iter().map(i64::to_string).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    match (&server.run, &runs[..]) {
        (Some(asked), runs) => match runs.iter().find(|run| run.to_string() == *asked) {
            Some(run) => Ok(*run),
            None => {
                let (schema, run, known) = (schema.to_owned(), asked.clone(), listed(&names));
                Err(wrong(server, ServerMessage::NoTruthOfRun { schema, run, known }))
            }
        },
        (None, [one]) => Ok(*one),
        (None, []) => Err(LogError::no_truth(server.place.as_str(), ServerMessage::NoTruth { schema: schema.into() })),
        (None, several) => {
            let (schema, runs) = (schema.to_owned(), listed(&names));
            Err(wrong(server, ServerMessage::SeveralTruths { schema, runs, first: several[0] }))
        }
    }
}

struct StoredTruthTable {
    sql: String,
    cells: Vec<TruthCellKind>,
}

#[derive(Clone, Copy, PartialEq)]
enum TruthCellKind {
    Stamp,
    Integer,
    Real,
    Text,
}

impl StoredTruthTable {
    fn find(
        connection: &DatabaseConnection,
        schema: &str,
        table: &Table,
        missing: &mut Vec<String>,
    ) -> Result<Option<StoredTruthTable>, LogError> {
        let there = columns_of(connection, schema, &table.name)?;
        // The first column is the run's id, whatever it is called.
        let Some((run, _)) = there.first() else {
            missing.push(format!("no table {:?} in the schema {schema:?}", table.name));
            return Ok(None);
        };
        let gone = table.columns.iter().filter(|column| !there.iter().any(|(name, _)| *name == column.name));
        let gone: Vec<String> = gone.map(|column| format!("no column {:?} of {:?}", column.name, table.name)).collect();
        if !gone.is_empty() {
            missing.extend(gone);
            return Ok(None);
        }
        let is =
            |column: &Column| there.iter().find(|(name, _)| *name == column.name).map_or("", |(_, is)| is.as_str());
        let cells: Vec<TruthCellKind> = table.columns.iter().map(|column| cell_kind(column.kind, is(column))).collect();
        let told = |(column, cell): (&Column, &TruthCellKind)| match cell {
            TruthCellKind::Stamp => ident(&column.name),
            TruthCellKind::Integer => format!("{}::bigint", ident(&column.name)),
            TruthCellKind::Real => format!("{}::double precision", ident(&column.name)),
            TruthCellKind::Text => format!("{}::text", ident(&column.name)),
        };
        let columns: Vec<String> = table.columns.iter().zip(&cells).map(told).collect();
        // By what rises from row to row: a number, or when something was over. Between rows that are alike in it, where they are
        // on the server's disk says which was written first.
        let by = |name: &&str| table.column(name).map(|_| ident(name));
        let order: Vec<String> = ["firing", "row", "end_at", "sent_at", "at"].iter().find_map(by).into_iter().collect();
        let order = order.into_iter().chain(["ctid".into()]).collect::<Vec<_>>().join(", ");
        let (columns, table) = (columns.join(", "), quoted(schema, &table.name));
        let sql = format!("SELECT {columns} FROM {table} WHERE {} = $1 ORDER BY {order}", ident(run));
        Ok(Some(StoredTruthTable { sql, cells }))
    }

    fn read(
        &self,
        connection: &DatabaseConnection,
        server: &Server,
        run: i64,
        take: &mut dyn FnMut(&[TruthValue<'_>]) -> Result<(), LogError>,
    ) -> Result<(), LogError> {
        connection.each_row(&self.sql, &[&run], |row| {
            let value = |(place, kind): (usize, &TruthCellKind)| {
                Ok(match kind {
                    TruthCellKind::Stamp => cell(server, row, place)?.map(|ServerInstant(at)| TruthValue::Instant(at)),
                    TruthCellKind::Integer => cell(server, row, place)?.map(TruthValue::Integer),
                    TruthCellKind::Real => cell(server, row, place)?.map(TruthValue::Real),
                    TruthCellKind::Text => cell(server, row, place)?.map(TruthValue::Text),
                }
                .unwrap_or(TruthValue::Null))
            };
            take(&self.cells.iter().enumerate().map(value).collect::<Result<Vec<_>, LogError>>()?)
        })
    }
}

fn cell_kind(kind: ColumnKind, is: &str) -> TruthCellKind {
    match (kind, is) {
        (ColumnKind::Instant, "timestamp with time zone" | "timestamp without time zone") => TruthCellKind::Stamp,
        (ColumnKind::Integer, _) => TruthCellKind::Integer,
        (ColumnKind::Real, _) => TruthCellKind::Real,
        // Of other kinds of instants the server says the numbers.
        (ColumnKind::Instant | ColumnKind::Text, _) => TruthCellKind::Text,
    }
}
