//! Files that `--force` may replace. A database is one only if it holds nothing but a run of this program.

use super::database::{columns, connect, list};
use super::plain;
use crate::error::{LogError, place_of};
use crate::log::SENSOR;
use crate::table::truth::TruthKept;
use std::io::Read;
use std::path::Path;

/// The first bytes of a database of SQLite (<https://www.sqlite.org/fileformat2.html>).
const SQLITE: &[u8] = b"SQLite format 3\0";

/// Tables that a run's databases have besides that of its rows and those of a truth.
const BESIDES: [&str; 5] = ["run", SENSOR, "labelled", "camera", "silhouette"];

/// The first columns of this program's table `run`.
const RUN: [&str; 4] = ["run_id", "home", "scenario", "seed"];

/// Refuses a database with foreign tables: they could not be restored. The user has allowed to replace other files.
pub(crate) fn may_be_replaced(path: &Path) -> Result<(), LogError> {
    let mut begins = [0; SQLITE.len()];
    let is_database = plain::open(path).is_ok_and(|mut file| file.read_exact(&mut begins).is_ok()) && begins == SQLITE;
    if !is_database {
        return Ok(());
    }
    match others(path) {
        Ok(None) => Ok(()),
        Ok(Some(what)) => Err(LogError::OthersDatabase { place: place_of(path), what }),
        Err(error) => Err(LogError::database(path, error)),
    }
}

/// The first part of a database that no run leaves, if there is one.
fn others(path: &Path) -> rusqlite::Result<Option<String>> {
    // It adds no files to the database.
    let connection = connect(path)?;
    let all = "SELECT type, name, coalesce(sql, '') FROM sqlite_schema ORDER BY rowid";
    let found: Vec<(String, String, String)> =
        list(&connection, all, [], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))?;
    if !found.is_empty() && !columns(&connection, "run")?.iter().take(RUN.len()).eq(&RUN) {
        return Ok(Some("no run of this program".into()));
    }
    let truth = TruthKept::All.tables();
    let mut logs = 0;
    let is_other = |(kind, name, sql): &&(String, String, String)| {
        let is_known = BESIDES.contains(&name.as_str()) || truth.iter().any(|table| table.name == *name);
        // The rows of a log may have any name: their table is the one whose key is its order.
        let is_log = kind == "table" && sql.trim_end().ends_with("WITHOUT ROWID");
        logs += u32::from(kind == "table" && !is_known && is_log);
        let is_ours = kind == "table" && (is_known || is_log && logs == 1) || name.starts_with("sqlite_");
        !is_ours
    };
    let other = found.iter().find(is_other);
    Ok(other.map(|(kind, name, _)| format!("the {kind} {name:?}, which no run writes")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rusqlite::Connection;

    #[test]
    fn keeps_databases_that_hold_more_than_a_run() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("log.db");
        let run = "CREATE TABLE run (run_id INTEGER PRIMARY KEY, home TEXT, scenario TEXT, seed TEXT)";
        let rows = "CREATE TABLE event (run_id INTEGER, seq INTEGER, PRIMARY KEY (run_id, seq)) WITHOUT ROWID";
        for (holds, is_ours) in [
            (&[run, rows][..], true),
            (&[run, rows, "CREATE TABLE sensor (id TEXT)", "CREATE TABLE room (run_id INTEGER)"], true),
            (&[run, rows, "CREATE TABLE letters (text TEXT)"], false),
            (&[run, rows, "CREATE VIEW night AS SELECT * FROM event"], false),
            (&[run, rows, "CREATE TABLE mine (id INTEGER PRIMARY KEY) WITHOUT ROWID"], false),
            (&["CREATE TABLE states (state TEXT)"], false),
            (&["CREATE TABLE run (distance REAL)"], false),
        ] {
            let _ = std::fs::remove_file(&path);
            let connection = Connection::open(&path).unwrap();
            holds.iter().for_each(|sql| connection.execute_batch(sql).unwrap());
            drop(connection);
            assert_eq!(may_be_replaced(&path).is_ok(), is_ours, "{holds:?}");
        }
        // The control: any other file may be replaced.
        std::fs::write(&path, "notes").unwrap();
        may_be_replaced(&path).unwrap();
    }
}
