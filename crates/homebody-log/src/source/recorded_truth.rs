//! A run's truth, opened to be read: a database; or, of comma-separated values, a file for each table, which are put into a
//! database that is gone as soon as they have been read.

use super::database::{connect, tables as tables_of};
use super::reading::open;
use super::records::Records;
use crate::error::{LogError, place_of};
use crate::places::TRUTH;
use crate::spreadsheet::unescaped;
use crate::table::{Column, ColumnKind, Table};
use crate::truth::{Truth, tables};
use crate::url::{Url, table_file};
use homebody_core::scenario::scheme::{Scheme, without_password};
use rusqlite::types::Value;
use rusqlite::{Connection, params_from_iter};
use std::fs;
use std::path::{Path, PathBuf};

/// The tables by which rows of a log are labelled.
pub(crate) const LABEL_TABLES: [Truth; 5] = [Truth::Cause, Truth::Off, Truth::Movement, Truth::Room, Truth::Activity];

/// A truth whose tables are known to be there.
pub(crate) struct RecordedTruth {
    place: PathBuf,
    pub connection: Connection,
}

impl RecordedTruth {
    /// Opens those tables of a truth that are to be read.
    pub fn open(url: &Url, wanted: &[Truth]) -> Result<RecordedTruth, LogError> {
        let path = url.file().unwrap_or(Path::new(""));
        let all = tables();
        let wanted: Vec<&Table> = wanted.iter().map(|&table| &all[table as usize]).collect();
        let no_truth = |why| LogError::NoTruth { place: url.to_string(), why };
        let (connection, missing) = match url.scheme() {
            Scheme::Sqlite => {
                open(path)?;
                let found = connect(path).and_then(|connection| Ok((missing(&connection, &wanted)?, connection)));
                let (missing, connection) = found.map_err(|error| match error.sqlite_error_code() {
                    Some(rusqlite::ErrorCode::NotADatabase) => no_truth("it is no database".into()),
                    _ => LogError::database(path, error),
                })?;
                (connection, missing)
            }
            Scheme::Csv => {
                let files: Vec<(&Table, PathBuf)> =
                    wanted.iter().map(|&table| (table, table_file(path, &table.name))).collect();
                let missing = files.iter().filter(|(_, file)| !file.is_file());
                let missing: Vec<String> = missing.map(|(_, file)| format!("no file {}", place_of(file))).collect();
                (if missing.is_empty() { gathered(&files)? } else { temporary(path)? }, missing)
            }
            Scheme::Casas => return Err(no_truth("the form of CASAS cannot hold one".into())),
            _ => return Err(no_truth("a truth is read from sqlite: and csv: only".into())),
        };
        if missing.is_empty() {
            Ok(RecordedTruth { place: path.into(), connection })
        } else {
            Err(no_truth(missing.join(", ")))
        }
    }

    /// What an error of its database means.
    pub fn error(&self, error: rusqlite::Error) -> LogError {
        LogError::database(&self.place, error)
    }
}

/// What of the wanted tables and their columns is not there, in words.
fn missing(connection: &Connection, wanted: &[&Table]) -> rusqlite::Result<Vec<String>> {
    let found = tables_of(connection)?;
    let mut missing = Vec::new();
    for table in wanted {
        if !found.contains(&table.name) {
            missing.push(format!("no table {:?}", table.name));
            continue;
        }
        let mut statement = connection.prepare("SELECT name FROM pragma_table_info(?)")?;
        let columns: Vec<String> =
            statement.query_map([&table.name], |row| row.get(0))?.collect::<rusqlite::Result<_>>()?;
        let gone = table.columns.iter().filter(|column| !columns.contains(&column.name));
        missing.extend(gone.map(|column| format!("no column {:?} of {:?}", column.name, table.name)));
    }
    Ok(missing)
}

/// A temporary database without a name. SQLite puts it on disk where it becomes large.
fn temporary(path: &Path) -> Result<Connection, LogError> {
    Connection::open("").map_err(|error| LogError::database(path, error))
}

/// A database of the rows of files.
fn gathered(files: &[(&Table, PathBuf)]) -> Result<Connection, LogError> {
    let connection = temporary(Path::new(""))?;
    for (table, path) in files {
        gather(&connection, table, path)?;
    }
    Ok(connection)
}

fn gather(connection: &Connection, table: &Table, path: &Path) -> Result<(), LogError> {
    let database = |error| LogError::database(path, error);
    let no_truth = |why: String| LogError::NoTruth { place: place_of(path), why };
    let columns: Vec<String> = table.columns.iter().map(|column| format!("{:?}", column.name)).collect();
    let columns = columns.join(", ");
    connection.execute_batch(&format!("CREATE TABLE {:?} ({columns}); BEGIN", table.name)).map_err(database)?;
    let places = vec!["?"; table.columns.len()].join(", ");
    let sql = format!("INSERT INTO {:?} VALUES ({places})", table.name);
    let mut insert = connection.prepare(&sql).map_err(database)?;
    let mut records = Records::open(path)?;
    let header: Vec<String> = records.next(&mut |_| false)?.map(|(_, names)| names.texts()).unwrap_or_default();
    let mut cells = Vec::new();
    for column in &table.columns {
        let place = header.iter().position(|name| *name == column.name);
        cells.push((column, place.ok_or_else(|| no_truth(format!("no column {:?}", column.name)))?));
    }
    while let Some((line, row)) = records.next(&mut |_| false)? {
        let read = |&(column, place): &(&Column, usize)| cell(column.kind, row.get(place)?);
        let values: Option<Vec<Value>> = cells.iter().map(read).collect();
        let values = values.filter(|_| !row.is_broken);
        let values = values.ok_or_else(|| no_truth(format!("line {line} is none of the table {:?}", table.name)))?;
        insert.execute(params_from_iter(values)).map_err(database)?;
    }
    connection.execute_batch("COMMIT").map_err(database)
}

/// A cell as a database has it; None where it is no cell of such a column.
fn cell(kind: ColumnKind, said: &[u8]) -> Option<Value> {
    let text = String::from_utf8_lossy(said);
    Some(match kind {
        _ if text.is_empty() => Value::Null,
        ColumnKind::Integer => Value::Integer(text.parse().ok()?),
        ColumnKind::Real => Value::Real(text.parse().ok()?),
        ColumnKind::Instant => Value::Text(text.into_owned()),
        ColumnKind::Text => Value::Text(unescaped(&text).to_owned()),
    })
}

/// The truth that somebody names: as `sqlite:FILE` or `csv:FILE`, by the folder of its run, or by its path alone, be it that of a
/// database, of one of the files of its tables, or what these have been named after.
pub fn truth_at(text: &str) -> Url {
    let path = Path::new(text);
    if path.is_dir() {
        let inside = path.join(TRUTH);
        return truth_beside(&inside).unwrap_or(Url::new(Scheme::Sqlite, inside));
    }
    if !path.exists() {
        let path = &*PathBuf::from(&*without_password(text));
        let named = text.parse().ok().or_else(|| has_tables(path).then(|| Url::new(Scheme::Csv, path)));
        return named.unwrap_or(Url::new(Scheme::Sqlite, path));
    }
    let whole = whole_of(path).filter(|whole| has_tables(whole));
    whole.map_or(Url::new(Scheme::Sqlite, path), |whole| Url::new(Scheme::Csv, whole))
}

/// The truth that a run has left beside its log: a database, or files of its tables.
pub fn truth_beside(log: &Path) -> Option<Url> {
    let database = log.with_file_name(TRUTH);
    // One of a run that was killed as it began it has nothing in it.
    if fs::metadata(&database).is_ok_and(|found| found.is_file() && found.len() > 0) {
        return Some(Url::new(Scheme::Sqlite, database));
    }
    let texts = database.with_extension("csv");
    has_tables(&texts).then(|| Url::new(Scheme::Csv, texts))
}

/// Whether files of the truth's tables are named after a path.
fn has_tables(path: &Path) -> bool {
    // Truths from before there was one of them have no table of what was done from outside.
    let all = tables();
    let mut known = all.iter().enumerate().filter(|(index, _)| *index != Truth::Outside as usize);
    path.file_name().is_some() && known.all(|(_, table)| table_file(path, &table.name).is_file())
}

/// What the file of a table is named after: `truth.csv` of `truth.room.csv`, `truth.csv.gz` of `truth.room.csv.gz`.
fn whole_of(file: &Path) -> Option<PathBuf> {
    let name = file.file_name()?.to_str()?;
    let is_packed = |ending: &str| ["gz", "zst"].contains(&ending);
    let (plain, packing) = name.rsplit_once('.').filter(|(_, ending)| is_packed(ending)).unwrap_or((name, ""));
    let (stem, ending) = plain.rsplit_once('.')?;
    let (name, table) = stem.rsplit_once('.')?;
    let is_known = tables().iter().any(|known| known.name == table);
    let dot = if packing.is_empty() { "" } else { "." };
    is_known.then(|| file.with_file_name(format!("{name}.{ending}{dot}{packing}")))
}
