//! The table `run`, which tells about the run in each database that holds one.
//!
//! Its times are simulated ones: a log does not depend on when it was made. `ended_at` stays empty until the run is
//! complete.

use super::database::Database;
use crate::clock::{Clock, Stamp};
use crate::error::LogError;
use crate::logger::RunInfo;
use homebody_core::scenario::logger::TimeFormat;
use rusqlite::types::{ToSqlOutput, ValueRef};
use rusqlite::{Connection, ToSql, params};

/// Creates the table and tells about the run.
pub(crate) fn begin<'a>(
    run: &'a RunInfo,
    time: TimeFormat,
    clock: &'a mut Clock,
) -> impl FnOnce(&Connection) -> rusqlite::Result<()> + 'a {
    move |connection| {
        let time = time_type(time);
        connection.execute_batch(&format!(
            "CREATE TABLE run (run_id INTEGER PRIMARY KEY, scenario TEXT, seed TEXT, started_at {time}, \
             ended_at {time}, version TEXT)"
        ))?;
        // A seed can be larger than a database's integers.
        let values = params![run.id, run.scenario, run.seed.to_string(), clock.stamp(0), run.version];
        let sql = "INSERT INTO run (run_id, scenario, seed, started_at, version) VALUES (?, ?, ?, ?, ?)";
        connection.execute(sql, values).map(|_| ())
    }
}

/// Marks the run as complete.
pub(crate) fn end(database: &mut Database, run: i64, end: Stamp) -> Result<(), LogError> {
    database.change(0, |connection| {
        connection.execute("UPDATE run SET ended_at = ? WHERE run_id = ?", params![end, run]).map(|_| ())
    })
}

/// The type of a column of instants.
pub(crate) fn time_type(time: TimeFormat) -> &'static str {
    match time {
        TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => "TEXT",
        TimeFormat::EpochS => "REAL",
        TimeFormat::EpochMs => "INTEGER",
    }
}

impl ToSql for Stamp<'_> {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        Ok(ToSqlOutput::Borrowed(match self {
            Stamp::Text(text) => ValueRef::Text(text.as_bytes()),
            Stamp::Seconds(seconds) => ValueRef::Real(*seconds),
            Stamp::Milliseconds(milliseconds) => ValueRef::Integer(*milliseconds),
        }))
    }
}
