//! A database file of SQLite: whether it is whole, who writes it, whether its tables are those of a log or of a truth, and whether the
//! rows of each run are there once.

use crate::check::{Check, CheckOptions, RowNumbers, log_table, truth_tables};
use crate::error::{LogError, place_of};
use crate::files::database::{connect_only, list};
use crate::files::{companions, is_held};
use crate::table::Table;
use crate::table::truth::Truth;
use crate::url::Url;
use homebody_core::problem::counted;
use rusqlite::Connection;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Largest number of damaged pages in a report (our choice).
const MOST_TOLD: usize = 5;

/// The version of SQLite in this program, once it has kept a row and given it back.
///
/// # Errors
///
/// It has not.
pub fn sqlite_version() -> Result<String, LogError> {
    let tried = Connection::open_in_memory().and_then(|connection| {
        connection.execute_batch(
            "CREATE TABLE firing (seq INTEGER PRIMARY KEY, value TEXT); INSERT INTO firing VALUES (0, 'ON')",
        )?;
        connection.query_row("SELECT sqlite_version() FROM firing WHERE value = 'ON'", [], |row| row.get(0))
    });
    tried.map_err(|error| LogError::database(Path::new(""), error))
}

pub(crate) fn examine(url: &Url, asked: &CheckOptions) -> Result<Vec<Check>, LogError> {
    let (log, run_column) = log_table(asked.mapping)?;
    let path = url.path();
    let mut checks = Vec::new();
    if let Err(error) = crate::files::plain::open(path) {
        return Ok(vec![Check::of_error("file", &LogError::reading(path, error))]);
    }
    checks.push(written_by(path));
    checks.extend(left_beside(path));
    let connection = match connect_only(path) {
        Ok(connection) => connection,
        Err(error) => {
            let is_half_written = error.sqlite_error_code() == Some(rusqlite::ErrorCode::ReadOnly);
            checks.push(match is_half_written {
                true => Check::warning(
                    "file",
                    "a transaction was half written as a program was killed, so nothing more is looked at: to open it would change it",
                    "homebody inspect reads it and undoes what was half written; homebody run --resume FOLDER resumes the run",
                ),
                false => Check::of_error("file", &LogError::database(path, error)),
            });
            return Ok(checks);
        }
    };
    let looked = look(&connection, path, &log, &run_column, &mut checks);
    if let Err(error) = looked {
        checks.push(Check::of_error("file", &LogError::database(path, error)));
    }
    Ok(checks)
}

/// Whether a program writes the file now.
fn written_by(path: &Path) -> Check {
    match is_held(path) {
        None => Check::ok("lock", "no program is writing it"),
        Some(true) => Check::warning(
            "lock",
            "a program is writing it now, so that what follows may be different in a moment",
            "wait until that program ends, and check again",
        ),
        Some(false) => Check::ok("lock", "a program that was killed has left a lock file, which holds nobody up"),
    }
}

/// The companion files of a killed program, or of a reader.
fn left_beside(path: &Path) -> Option<Check> {
    let size = |path: &PathBuf| std::fs::metadata(path).map(|found| found.len()).ok().filter(|bytes| *bytes > 0);
    let [log, _, journal] = &companions(path);
    match (size(log), size(journal)) {
        (Some(bytes), _) => Some(Check::warning(
            "journal",
            format!("a write-ahead log of {bytes} bytes next to it has rows of the database"),
            "copy both files together; homebody run --resume FOLDER adds the rows and continues",
        )),
        (None, Some(bytes)) => Some(Check::warning(
            "journal",
            format!("a journal of {bytes} bytes next to it undoes an incomplete change"),
            "copy both files together; the next program that writes to the database undoes the change",
        )),
        (None, None) => None,
    }
}

fn look(
    connection: &Connection,
    path: &Path,
    log: &Table,
    run_column: &str,
    checks: &mut Vec<Check>,
) -> rusqlite::Result<()> {
    let is_whole = integrity(connection, checks)?;
    if !is_whole {
        return Ok(());
    }
    let tables: Vec<String> =
        list(connection, "SELECT name FROM sqlite_schema WHERE type = 'table'", [], |row| row.get(0))?;
    let has = |name: &str| tables.iter().any(|table| table == name);
    let truth = truth_tables(has);
    let is_truth = !has(&log.name) && truth.iter().any(|table| has(&table.name));
    if !has(&log.name) && !is_truth {
        let says = format!(
            "there is no table {:?}: it has {}",
            log.name,
            if tables.is_empty() { "none".into() } else { tables.join(", ") }
        );
        checks.push(Check::wrong(
            "tables",
            says,
            "name the table with --mapping logger.json, or resume a run that was killed at its start: homebody run --resume FOLDER",
        ));
        return Ok(());
    }
    let wanted: Vec<&Table> = if is_truth { truth.iter().collect() } else { vec![log] };
    let mut is_as_wanted = true;
    for table in &wanted {
        is_as_wanted &= schema(connection, table, run_column, checks)?;
    }
    if is_as_wanted {
        let is_brief = is_truth && !has("cause");
        let what = match is_truth {
            true if is_brief => "a brief truth",
            true => "a truth",
            false => "a log",
        };
        checks.push(Check::ok("tables", format!("they are the tables of {what}, with the expected columns and keys")));
        match is_truth {
            true if is_brief => {}
            true => checks.extend(rows(connection, &truth[Truth::Cause as usize], run_column, ", its firings")?),
            false => {
                let rows = rows(connection, log, run_column, "")?;
                if rows.is_empty() {
                    let hint = "a run that has just begun has no rows yet";
                    checks.push(Check::warning("rows", "the table has no rows", hint));
                }
                checks.extend(rows);
                checks.extend(empty_cells(connection, log)?);
            }
        }
    }
    runs(connection, path, has("run"), checks)
}

fn integrity(connection: &Connection, checks: &mut Vec<Check>) -> rusqlite::Result<bool> {
    let sql = format!("PRAGMA quick_check({MOST_TOLD})");
    let told: Vec<String> = match list(connection, &sql, [], |row| row.get(0)) {
        Ok(told) => told,
        Err(error) if error.sqlite_error_code() == Some(rusqlite::ErrorCode::DatabaseCorrupt) => {
            vec![error.to_string()]
        }
        Err(error) => return Err(error),
    };
    let is_whole = told == ["ok"];
    checks.push(match is_whole {
        true => Check::ok("integrity", "every page is in order"),
        false => Check::wrong(
            "integrity",
            format!("it is damaged: {}", told.join("; ").replace('\n', " ")),
            "restore a copy, or run it again: homebody replay RECORDING --out sqlite:NEW.db",
        ),
    });
    Ok(is_whole)
}

/// Checks that a table has the wanted columns and key, and reports all problems.
fn schema(connection: &Connection, table: &Table, run_column: &str, checks: &mut Vec<Check>) -> rusqlite::Result<bool> {
    let sql = "SELECT name, pk FROM pragma_table_info(?)";
    let found: Vec<(String, i64)> = list(connection, sql, [&table.name], |row| Ok((row.get(0)?, row.get(1)?)))?;
    let hint = "name the columns with --mapping logger.json; Homebody reads logs of other programs, too";
    let mut wrong = Vec::new();
    if found.is_empty() {
        wrong.push(format!("there is no table {:?}", table.name));
    } else {
        let names = std::iter::once(run_column).chain(table.columns.iter().map(|column| column.name.as_str()));
        let gone = names.filter(|name| !found.iter().any(|(found, _)| found == name));
        wrong.extend(gone.map(|name| format!("the table {:?} has no column {name:?}", table.name)));
        let key: Vec<&str> = found.iter().filter(|(_, key)| *key > 0).map(|(name, _)| name.as_str()).collect();
        let has_key = [run_column, &table.columns[0].name].iter().all(|name| key.contains(name)) && key.len() == 2;
        if table.is_numbered && wrong.is_empty() && !has_key {
            wrong.push(format!(
                "the table {:?} has no key ({run_column}, {}), so that a row could be in it twice",
                table.name, table.columns[0].name
            ));
        }
    }
    let is_well = wrong.is_empty();
    checks.extend(wrong.into_iter().map(|says| Check::wrong("tables", says, hint)));
    Ok(is_well)
}

const FOREIGN_ROWS: &str = "Homebody never writes such a row: check which other program writes to this file";

/// The rows of each run by their numbers, which the first column of a table has.
fn rows(connection: &Connection, table: &Table, run_column: &str, of: &str) -> rusqlite::Result<Vec<Check>> {
    let sql = format!("SELECT \"{run_column}\", \"{}\" FROM \"{}\" ORDER BY 1, 2", table.columns[0].name, table.name);
    let mut statement = connection.prepare(&sql)?;
    let mut rows = statement.query([])?;
    let mut runs: BTreeMap<i64, RowNumbers> = BTreeMap::new();
    let mut without_number = 0;
    while let Some(row) = rows.next()? {
        match (row.get_ref(0)?.as_i64(), row.get_ref(1)?.as_i64()) {
            (Ok(run), Ok(number)) => runs.entry(run).or_default().push(number),
            _ => without_number += 1,
        }
    }
    let says = format!(
        "{} no integer as the number of the run or of the row",
        counted(without_number, "row has", "rows have")
    );
    let odd = (without_number > 0).then(|| Check::wrong("rows", says, FOREIGN_ROWS));
    Ok(runs.into_iter().map(|(run, numbers)| numbers.check(&format!("run {run}{of}"))).chain(odd).collect())
}

/// Cells of a log that say nothing where they should.
fn empty_cells(connection: &Connection, table: &Table) -> rusqlite::Result<Option<Check>> {
    let [time, sensor] = [1, 2].map(|column| &table.columns[column].name);
    let sql = format!("SELECT count(*) FROM \"{}\" WHERE \"{time}\" IS NULL OR \"{sensor}\" IS NULL", table.name);
    let empty: i64 = connection.query_row(&sql, [], |row| row.get(0))?;
    let says = format!("{} no time or no sensor", counted(empty as usize, "row has", "rows have"));
    Ok((empty > 0).then(|| Check::wrong("rows", says, FOREIGN_ROWS)))
}

fn runs(connection: &Connection, path: &Path, is_there: bool, checks: &mut Vec<Check>) -> rusqlite::Result<()> {
    if !is_there {
        checks.push(Check::warning(
            "runs",
            "there is no table \"run\", so the run is unknown",
            "another program wrote it; Homebody reads it, too",
        ));
        return Ok(());
    }
    let sql = "SELECT run_id, ended_at IS NOT NULL FROM run ORDER BY 1";
    let runs: Vec<(i64, bool)> = list(connection, sql, [], |row| Ok((row.get(0)?, row.get(1)?)))?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    for (run, is_ended) in &runs {
        checks.push(match is_ended {
            true => Check::ok("runs", format!("run {run} is complete")),
            false => Check::warning(
                "runs",
                format!("run {run} is not complete"),
                format!("homebody run --resume {} resumes it, unless it is running now", place_of(folder)),
            ),
        });
    }
    if runs.is_empty() {
        checks.push(Check::warning(
            "runs",
            "the table \"run\" has no row",
            "--resume continues a run that was killed at its start",
        ));
    }
    Ok(())
}
