//! Checks a PostgreSQL database as a destination of logs and truths: the connection, the rights to create tables and rows, the tables, and
//! that the rows of each run are there once. It only reads.

use crate::connection::DatabaseConnection;
use crate::examined_runs::runs;
use crate::schema::{RUNS, TRUTH_SCHEMA, look, quoted, usual};
use crate::server::{Host, Server};
use homebody_core::problem::Problem;
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::examine::{Check, CheckOptions, is_this_machine, log_table, truth_tables};
use homebody_log::table::Table;
use homebody_log::{LogError, Url};

/// The oldest server that the tests cover (our choice).
const OLDEST: i32 = 120_000;

pub(crate) fn examine(url: &Url, asked: &CheckOptions) -> Result<Vec<Check>, LogError> {
    let server = Server::parse(&url.to_string())?;
    let (log, run_column) = log_table(asked.mapping)?;
    let connection = match DatabaseConnection::to_read(&server) {
        Ok(connection) => connection,
        Err(error) => return Ok(vec![Check::of_error("server", &error)]),
    };
    let mut checks = Vec::new();
    if let Err(error) = look_at(&connection, &server, asked.mapping, (log, run_column), &mut checks) {
        checks.push(Check::of_error("server", &error));
    }
    Ok(checks)
}

fn look_at(
    connection: &DatabaseConnection,
    server: &Server,
    mapping: &LoggerFile,
    log: (Table, String),
    checks: &mut Vec<Check>,
) -> Result<(), LogError> {
    about_server(connection, server, checks)?;
    let (log, run_column) = log;
    let schema = match &server.schema {
        Some(schema) => schema.clone(),
        None => usual(connection, server)?,
    };
    let log = [log];
    let of = |tables: &[Table]| look(connection, &schema, tables, mapping.time, &run_column);
    let (there, problems) = of(&log)?;
    let has_truth = match holds(connection, &schema, &there) {
        Ok(holds) => holds.as_deref() == Some("truth"),
        // A user without the right to ask gets the list of missing rights.
        Err(_) if !problems.is_empty() => {
            checks.extend(problems.into_iter().map(check_of));
            return Ok(());
        }
        Err(error) => return Err(error),
    };
    let truth_of = |schema: &str, checks: &mut Vec<Check>| {
        let all = truth_tables(|_| true);
        let (there, _) = look(connection, schema, &all, mapping.time, &run_column)?;
        if there.is_empty() {
            return Ok(());
        }
        let truth = truth_tables(|name| there.iter().any(|there| there == name));
        let (there, problems) = look(connection, schema, &truth, mapping.time, &run_column)?;
        schema_of(connection, schema, &truth, there, problems, &run_column, checks)
    };
    if has_truth {
        return truth_of(&schema, checks);
    }
    schema_of(connection, &schema, &log, there, problems, &run_column, checks)?;
    // By default, truths are in a schema of their own.
    if server.schema.is_none() { truth_of(TRUTH_SCHEMA, checks) } else { Ok(()) }
}

/// Which server it is, who we are there, and whether what it confirms is on its disk.
fn about_server(connection: &DatabaseConnection, server: &Server, checks: &mut Vec<Check>) -> Result<(), LogError> {
    const ABOUT: &str = "SELECT current_setting('server_version'), current_setting('server_version_num')::int, \
         current_user::text, current_database()::text, pg_is_in_recovery(), current_setting('fsync'), \
         (SELECT version FROM pg_stat_ssl WHERE pid = pg_backend_pid() AND ssl), \
         current_setting('server_encoding'), abs(extract(epoch FROM clock_timestamp())::float8 - $1::float8)";
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default().as_secs_f64();
    let row = connection.wait(connection.client.query_one(ABOUT, &[&now]))?;
    let (version, number): (String, i32) = (row.get(0), row.get(1));
    let (user, database): (String, String) = (row.get(2), row.get(3));
    let tls: Option<String> = row.get(6);
    let how = match (&tls, &server.host) {
        (Some(version), _) => format!("over {version}"),
        (None, Host::Socket(_)) => "over a socket of this machine".into(),
        (None, Host::Name(_)) => "without encryption".into(),
    };
    let says = format!("PostgreSQL {version} lets {user:?} into {database:?}, {how}");
    checks.push(match number {
        OLDEST.. => Check::ok("server", says),
        _ => Check::warning("server", says, "Homebody is tested with PostgreSQL 12 and newer: use a newer one"),
    });
    if tls.is_none() && matches!(&server.host, Host::Name(name) if !is_this_machine(name)) {
        let says = "rows and the proof of the password cross the network unencrypted";
        checks.push(Check::warning(
            "encryption",
            says,
            "write ?sslmode=verify-full, with sslrootcert=FILE or sslrootcert=system",
        ));
    }
    if row.get::<_, bool>(4) {
        let hint = "name its primary server";
        checks.push(Check::wrong("rights", "it is a standby of another server, and takes no changes", hint));
    }
    if row.get::<_, String>(5) == "off" {
        let hint = "set fsync = on in postgresql.conf, and restart the server";
        let says = "it does not wait for its disk, so a power failure loses confirmed rows";
        checks.push(Check::warning("durability", says, hint));
    }
    let encoding: String = row.get(7);
    if encoding != "UTF8" {
        let says = format!("its encoding is {encoding}, which lacks characters that names may have");
        checks.push(Check::warning("encoding", says, "CREATE DATABASE ... ENCODING 'UTF8'"));
    }
    let apart: f64 = row.get(8);
    if apart > MOST_APART_S {
        let says = format!("its clock and this machine's are {apart:.0} s apart");
        checks.push(Check::warning("clock", says, "set both from the network with NTP"));
    }
    Ok(())
}

/// Largest difference of two clocks that agree (our choice).
const MOST_APART_S: f64 = 30.0;

/// The kinds of runs in a schema; None without runs.
fn holds(connection: &DatabaseConnection, schema: &str, there: &[String]) -> Result<Option<String>, LogError> {
    if !there.iter().any(|name| name == RUNS) {
        return Ok(None);
    }
    let sql = format!("SELECT holds FROM {} LIMIT 1", quoted(schema, RUNS));
    Ok(connection.wait(connection.client.query_opt(&sql, &[]))?.map(|row| row.get(0)))
}

fn schema_of(
    connection: &DatabaseConnection,
    schema: &str,
    tables: &[Table],
    there: Vec<String>,
    problems: Vec<Problem>,
    run_column: &str,
    checks: &mut Vec<Check>,
) -> Result<(), LogError> {
    let is_well = problems.is_empty();
    checks.extend(problems.into_iter().map(check_of));
    if is_well {
        checks.push(Check::ok(
            "tables",
            match there.len() {
                0 => format!("the schema {schema:?} has no tables yet, and this user may create them"),
                _ => format!("the tables in the schema {schema:?} have the expected columns, keys and rights"),
            },
        ));
    }
    if there.iter().any(|name| name == RUNS) {
        runs(connection, schema, tables, &there, run_column, checks)?;
    } else if let Some(log) = tables.iter().find(|table| table.is_numbered && there.contains(&table.name)) {
        let says = format!("there is no table {RUNS:?} for {:?}, so the progress of a run is unknown", log.name);
        checks.push(Check::warning("runs", says, "another program wrote it; Homebody reads it, too"));
    }
    Ok(())
}

fn check_of(problem: Problem) -> Check {
    Check::wrong("tables", problem.what, problem.hint.unwrap_or_default())
}
