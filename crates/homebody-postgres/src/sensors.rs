//! The table `homebody_sensor`: the sensors of each run. Rows know them by their ids alone.

use crate::connection::DatabaseConnection;
use crate::schema::{SENSORS, Schema, quoted};
use homebody_log::log::{says_more_of, sensor_cells};
use homebody_log::{LogError, SensorInfo};
use tokio_postgres::Row;
use tokio_postgres::types::ToSql;

/// The most rows in one statement.
const AT_ONCE: usize = 10_000;

/// Adds the sensors of runs, each run by its id. A user who may neither make nor write the table gets none: rows do not need it.
pub(crate) fn tell(
    connection: &DatabaseConnection,
    schema: &Schema,
    runs: &[(i64, &[SensorInfo])],
) -> Result<(), LogError> {
    if schema.is_truth || !runs.iter().any(|(_, sensors)| says_more_of(sensors)) || !may_write(connection, schema)? {
        return Ok(());
    }
    let table = quoted(&schema.name, SENSORS);
    connection.wait(connection.client.batch_execute(&format!(
        "CREATE TABLE IF NOT EXISTS {table} (run_id bigint, id text, name text, kind text, room text, unit text, \
         PRIMARY KEY (run_id, id))"
    )))?;
    let sql = format!(
        "INSERT INTO {table} (run_id, id, name, kind, room, unit) SELECT * FROM \
         unnest($1::bigint[], $2::text[], $3::text[], $4::text[], $5::text[], $6::text[]) ON CONFLICT DO NOTHING"
    );
    let rows: Vec<(i64, [Option<&str>; 5])> =
        runs.iter().flat_map(|(run, sensors)| sensors.iter().map(|sensor| (*run, sensor_cells(sensor)))).collect();
    for rows in rows.chunks(AT_ONCE) {
        let ids: Vec<i64> = rows.iter().map(|(run, _)| *run).collect();
        let columns = [0, 1, 2, 3, 4].map(|column| rows.iter().map(|(_, cells)| cells[column]).collect::<Vec<_>>());
        let [id, name, kind, room, unit] = &columns;
        let values: [&(dyn ToSql + Sync); 6] = [&ids, id, name, kind, room, unit];
        connection.wait(connection.client.execute(&sql, &values))?;
    }
    Ok(())
}

pub(crate) fn forget(connection: &DatabaseConnection, schema: &Schema, runs: &[i64]) -> Result<(), LogError> {
    let table = quoted(&schema.name, SENSORS);
    let may =
        "SELECT CASE WHEN to_regclass($1::text) IS NULL THEN false ELSE has_table_privilege($1::text, 'DELETE') END";
    if connection.wait(connection.client.query_one(may, &[&table]))?.get(0) {
        let sql = format!("DELETE FROM {table} WHERE run_id = ANY($1)");
        connection.wait(connection.client.execute(&sql, &[&runs]))?;
    }
    Ok(())
}

fn may_write(connection: &DatabaseConnection, schema: &Schema) -> Result<bool, LogError> {
    let sql = "SELECT CASE WHEN to_regclass($1::text) IS NULL THEN has_schema_privilege($2::text, 'CREATE') \
               ELSE has_table_privilege($1::text, 'INSERT') AND has_table_privilege($1::text, 'SELECT') END";
    let table = quoted(&schema.name, SENSORS);
    Ok(connection.wait(connection.client.query_one(sql, &[&table, &schema.name]))?.get(0))
}

/// Largest number of sensors that are read.
const MOST_SENSORS: i64 = 10_000;

/// The sensors of a run, or of all runs; none without such a table, or without the right to read it.
pub(crate) fn known(
    connection: &DatabaseConnection,
    schema: &str,
    run: Option<i64>,
) -> Result<Vec<SensorInfo>, LogError> {
    let table = quoted(schema, SENSORS);
    let may =
        "SELECT CASE WHEN to_regclass($1::text) IS NULL THEN false ELSE has_table_privilege($1::text, 'SELECT') END";
    if !connection.wait(connection.client.query_one(may, &[&table]))?.get::<_, bool>(0) {
        return Ok(Vec::new());
    }
    let sql = format!(
        "SELECT id, name, kind, room, unit FROM {table} WHERE $1::bigint IS NULL OR run_id = $1 ORDER BY run_id, id LIMIT {MOST_SENSORS}"
    );
    let rows = connection.wait(connection.client.query(&sql, &[&run]))?;
    let cell = |row: &Row, column: usize| row.try_get::<_, Option<String>>(column).ok().flatten().unwrap_or_default();
    Ok(rows.iter().map(|row| SensorInfo::of_cells([0, 1, 2, 3, 4].map(|column| cell(row, column)))).collect())
}
