//! The table `homebody_run`: what each run is, and how far the database holds it. That is its watermark, which changes in the
//! same transaction as the rows that it counts.

use crate::connection::DatabaseConnection;
use crate::rows::EPOCH_2000;
use crate::schema::Schema;
use bytes::BytesMut;
use homebody_core::time::{RunTime, Span, UtcTime, WallTime};
use homebody_log::source::LogInstant;
use homebody_log::{LogError, RunInfo};
use std::error::Error;
use tokio_postgres::types::{FromSql, IsNull, ToSql, Type, to_sql_checked};

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct StoredRun {
    pub holds: String,
    pub tables: Vec<String>,
    pub rows: Vec<i64>,
    /// The number of transactions that have changed it, which tells one from the next.
    pub commits: i64,
    pub is_ended: bool,
}

pub(crate) fn holds(is_truth: bool) -> &'static str {
    if is_truth { "truth" } else { "log" }
}

/// The entry of a run; with `locks`, other writers wait until this transaction ends.
pub(crate) fn find(
    connection: &DatabaseConnection,
    schema: &Schema,
    run: i64,
    locks: bool,
) -> Result<Option<StoredRun>, LogError> {
    let lock = if locks { " FOR UPDATE" } else { "" };
    let sql = format!(
        "SELECT holds, tables, rows, commits, ended_at IS NOT NULL FROM {} WHERE run_id = $1{lock}",
        schema.runs()
    );
    let row = connection.wait(connection.client.query_opt(&sql, &[&run]))?;
    Ok(row.map(|row| StoredRun {
        holds: row.get(0),
        tables: row.get(1),
        rows: row.get(2),
        commits: row.get(3),
        is_ended: row.get(4),
    }))
}

/// Whether the schema has runs of the other kind: truths among logs, or logs among truths.
pub(crate) fn has_others(connection: &DatabaseConnection, schema: &Schema) -> Result<bool, LogError> {
    let sql = format!("SELECT EXISTS (SELECT FROM {} WHERE holds <> $1)", schema.runs());
    Ok(connection.wait(connection.client.query_one(&sql, &[&holds(schema.is_truth)]))?.get(0))
}

pub(crate) fn has_rows(connection: &DatabaseConnection, schema: &Schema, run: i64) -> Result<bool, LogError> {
    for table in schema.tables.iter().filter(|table| table.is_numbered) {
        let sql = format!("SELECT EXISTS (SELECT FROM {} WHERE {} = $1)", table.quoted, table.run_column);
        if connection.wait(connection.client.query_one(&sql, &[&run]))?.get(0) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Adds a run without rows. False where it is there already.
pub(crate) fn add(connection: &DatabaseConnection, schema: &Schema, run: &RunInfo) -> Result<bool, LogError> {
    let sql = format!(
        "INSERT INTO {} (run_id, holds, home, scenario, seed, version, zone, started_at, tables, rows, commits) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, 0) ON CONFLICT DO NOTHING",
        schema.runs()
    );
    let tables: Vec<&str> = schema.tables.iter().map(|table| table.name.as_str()).collect();
    let rows = vec![0_i64; tables.len()];
    let (seed, zone, start) = (run.seed.to_string(), zone(run), At(start_of(run)));
    let values: [&(dyn ToSql + Sync); 10] = [
        &run.id,
        &holds(schema.is_truth),
        &run.home,
        &run.scenario,
        &seed,
        &run.version,
        &zone,
        &start,
        &tables,
        &rows,
    ];
    Ok(connection.wait(connection.client.execute(&sql, &values))? == 1)
}

/// Says that so many rows are there, within the transaction that has brought them. One that replaces says anew what the run is.
pub(crate) fn mark(
    connection: &DatabaseConnection,
    schema: &Schema,
    run: &RunInfo,
    rows: &[i64],
    end: Option<RunTime>,
) -> Result<(), LogError> {
    let sql = format!(
        "UPDATE {} SET rows = $2, commits = commits + 1, ended_at = $3, home = $4, scenario = $5, seed = $6, version = $7, \
         zone = $8, started_at = $9, tables = $10 WHERE run_id = $1",
        schema.runs()
    );
    let tables: Vec<&str> = schema.tables.iter().map(|table| table.name.as_str()).collect();
    let (seed, zone, start) = (run.seed.to_string(), zone(run), At(start_of(run)));
    let end = end.map(|end| At(start.0 + end.since_zero()));
    let values: [&(dyn ToSql + Sync); 10] =
        [&run.id, &rows, &end, &run.home, &run.scenario, &seed, &run.version, &zone, &start, &tables];
    connection.wait(connection.client.execute(&sql, &values)).map(|_| ())
}

pub(crate) fn forget(connection: &DatabaseConnection, schema: &Schema, run: i64) -> Result<(), LogError> {
    /// Longest wait for a clean-up (our choice).
    const LONGEST: std::time::Duration = std::time::Duration::from_secs(2);
    let sql = format!("DELETE FROM {} WHERE run_id = $1 AND commits = 0", schema.runs());
    connection.wait_for(LONGEST, connection.client.execute(&sql, &[&run])).map(|_| ())
}

pub(crate) fn start_of(run: &RunInfo) -> UtcTime {
    run.calendar.timestamp(RunTime::START).into()
}

pub(crate) fn zone(run: &RunInfo) -> String {
    run.calendar.local(RunTime::START).time_zone().iana_name().unwrap_or("UTC").to_owned()
}

/// An instant as the server keeps it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct At(pub UtcTime);

impl ToSql for At {
    fn to_sql(&self, kind: &Type, out: &mut BytesMut) -> Result<IsNull, Box<dyn Error + Sync + Send>> {
        (self.0 - EPOCH_2000).micros().to_sql(kind, out)
    }

    fn accepts(kind: &Type) -> bool {
        *kind == Type::TIMESTAMPTZ
    }

    to_sql_checked!();
}

/// An instant as a column of the server tells it: by the world's clock, or by one on some wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ServerInstant(pub LogInstant);

impl<'a> FromSql<'a> for ServerInstant {
    fn from_sql(kind: &Type, raw: &'a [u8]) -> Result<ServerInstant, Box<dyn Error + Sync + Send>> {
        // Infinite instants stay infinite.
        let since_1970 = Span::from_micros(i64::from_sql(kind, raw)?).saturating_add(EPOCH_2000);
        Ok(ServerInstant(match *kind {
            Type::TIMESTAMPTZ => LogInstant::Utc(UtcTime::EPOCH + since_1970),
            _ => LogInstant::Local(WallTime::EPOCH + since_1970),
        }))
    }

    fn accepts(kind: &Type) -> bool {
        matches!(*kind, Type::TIMESTAMPTZ | Type::TIMESTAMP)
    }
}
