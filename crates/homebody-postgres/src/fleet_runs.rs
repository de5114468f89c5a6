//! The rows of many runs in the table `homebody_run`, each statement for all of them at once.

use crate::connection::DatabaseConnection;
use crate::runs::{At, holds, start_of, zone};
use crate::schema::{InTable, Schema};
use crate::sensors;
use homebody_log::LogError;
use homebody_log::fleet::{Fleet, FleetHome};
use std::collections::HashMap;
use tokio_postgres::types::ToSql;

pub(crate) struct StoredFleetRun {
    pub holds: String,
    pub version: String,
    /// The number of the next row, and how many transactions have changed it.
    pub rows: i64,
    pub commits: i64,
}

/// Adds all runs of a fleet that are not there yet, without rows.
pub(crate) fn add(connection: &DatabaseConnection, schema: &Schema, fleet: &Fleet) -> Result<(), LogError> {
    let sql = format!(
        "INSERT INTO {} (run_id, holds, home, scenario, seed, version, zone, started_at, tables, rows, commits) \
         SELECT run, $3, home, $4, seed, $5, $6, $7, ARRAY[$8], ARRAY[0::bigint], 0 \
         FROM unnest($1::bigint[], $2::text[], $9::text[]) AS u(run, home, seed) ON CONFLICT DO NOTHING",
        schema.runs()
    );
    for (index, layout) in fleet.layouts.iter().enumerate() {
        let homes: Vec<&FleetHome> = fleet.homes.iter().filter(|home| home.layout == index).collect();
        let ids: Vec<i64> = homes.iter().map(|home| home.run).collect();
        let names: Vec<&str> = homes.iter().map(|home| home.name.as_str()).collect();
        let seeds: Vec<String> = homes.iter().map(|home| home.seed.to_string()).collect();
        let run = &layout.run;
        let (zone, start) = (zone(run), At(start_of(run)));
        let values: [&(dyn ToSql + Sync); 9] =
            [&ids, &names, &holds(false), &run.scenario, &run.version, &zone, &start, &layout.table.name, &seeds];
        connection.wait_long(connection.client.execute(&sql, &values))?;
    }
    Ok(())
}

/// Removes runs and their rows, where that is asked for: by table, which runs.
pub(crate) fn forget(
    connection: &DatabaseConnection,
    schema: &Schema,
    of: &[(InTable, Vec<i64>)],
) -> Result<(), LogError> {
    connection.wait(connection.client.batch_execute("BEGIN"))?;
    for (table, ids) in of {
        let sql = format!("DELETE FROM {} WHERE {} = ANY($1)", table.quoted, table.run_column);
        connection.wait_long(connection.client.execute(&sql, &[ids]))?;
        let sql = format!("DELETE FROM {} WHERE run_id = ANY($1)", schema.runs());
        connection.wait_long(connection.client.execute(&sql, &[ids]))?;
    }
    let ids: Vec<i64> = of.iter().flat_map(|(_, ids)| ids.iter().copied()).collect();
    sensors::forget(connection, schema, &ids)?;
    connection.wait(connection.client.batch_execute("COMMIT"))
}

pub(crate) fn find(
    connection: &DatabaseConnection,
    schema: &Schema,
    fleet: &Fleet,
) -> Result<HashMap<i64, StoredFleetRun>, LogError> {
    let ids: Vec<i64> = fleet.homes.iter().map(|home| home.run).collect();
    let sql = format!("SELECT run_id, holds, version, rows[1], commits FROM {} WHERE run_id = ANY($1)", schema.runs());
    let rows = connection.wait_long(connection.client.query(&sql, &[&ids]))?;
    let known = |row: &tokio_postgres::Row| StoredFleetRun {
        holds: row.get(1),
        version: row.get(2),
        rows: row.get(3),
        commits: row.get(4),
    };
    Ok(rows.iter().map(|row| (row.get(0), known(row))).collect())
}

/// Looks at some runs within a transaction; who else would change them waits until that ends. By id, the number of the next
/// row, and how many transactions have changed it.
pub(crate) fn look_at(
    connection: &DatabaseConnection,
    schema: &Schema,
    ids: &[i64],
) -> Result<HashMap<i64, (i64, i64)>, LogError> {
    // In one order, so that no two programs wait for each other.
    let sql = format!(
        "SELECT run_id, rows[1], commits FROM {} WHERE run_id = ANY($1) ORDER BY run_id FOR UPDATE",
        schema.runs()
    );
    let rows = connection.wait(connection.client.query(&sql, &[&ids]))?;
    Ok(rows.iter().map(|row| (row.get(0), (row.get(1), row.get(2)))).collect())
}

/// Says how far runs are, within the transaction that has brought their rows.
pub(crate) fn mark(
    connection: &DatabaseConnection,
    schema: &Schema,
    ids: &[i64],
    rows: &[i64],
) -> Result<(), LogError> {
    let sql = format!(
        "UPDATE {} AS r SET rows = ARRAY[u.rows], commits = r.commits + 1, ended_at = NULL \
         FROM unnest($1::bigint[], $2::bigint[]) AS u(run, rows) WHERE r.run_id = u.run",
        schema.runs()
    );
    connection.wait(connection.client.execute(&sql, &[&ids, &rows])).map(|_| ())
}
