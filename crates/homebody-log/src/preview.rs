//! The first rows of a log as its readers see them, and a check that a log can be written at a place.

use crate::error::LogError;
use crate::files::database::text;
use crate::files::{ExistingFile, FreshFile, unpacked};
use crate::table::ColumnNames;
use crate::url::Url;
use homebody_core::scenario::logger::LoggerFile;
use rusqlite::{Connection, OpenFlags};
use std::io::{BufRead, BufReader};
use std::path::Path;

/// The first rows of a log.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Preview {
    /// The name of the table in a database.
    pub table: Option<String>,
    /// Empty for a text without a header line.
    pub columns: Vec<String>,
    /// The cells of the rows as texts, in the order of the columns.
    pub rows: Vec<Vec<String>>,
}

/// Reads the first rows of a log; the mapping is the one that it was written by.
pub(crate) type ReadFirstRows = fn(&Path, &LoggerFile, usize) -> Result<Preview, LogError>;

/// Checks that a new log can be written at a place, and leaves nothing there.
pub fn try_place(url: &Url) -> Result<(), LogError> {
    let Some(path) = url.file() else { return Ok(()) };
    match ExistingFile::at(path, false)? {
        // Opening a pipe would wait for its reader.
        ExistingFile::Device => Ok(()),
        _ => FreshFile::create(path, false).map(drop),
    }
}

pub(crate) fn database(path: &Path, file: &LoggerFile, most: usize) -> Result<Preview, LogError> {
    let table = ColumnNames::new(file)?.table;
    first_of_table(path, &table, most).map_err(|error| LogError::database(path, error))
}

fn first_of_table(path: &Path, table: &str, most: usize) -> rusqlite::Result<Preview> {
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(path, flags)?;
    // The name of the table was checked before it reaches SQL.
    let mut select = connection.prepare(&format!("SELECT * FROM \"{table}\" LIMIT {most}"))?;
    let columns: Vec<String> = select.column_names().map(str::to_owned).collect();
    let mut rows = Vec::new();
    let mut found = select.query([])?;
    while let Some(row) = found.next()? {
        rows.push(
            (0..columns.len())
                .map(|column| row.get_ref(column).map(|value| text(value).into_owned()))
                .collect::<Result<_, _>>()?,
        );
    }
    Ok(Preview { table: Some(table.to_owned()), columns, rows })
}

pub(crate) fn values(path: &Path, _: &LoggerFile, most: usize) -> Result<Preview, LogError> {
    let file = unpacked(path).map_err(|error| LogError::file(path, error))?;
    let mut records = csv::ReaderBuilder::new().has_headers(false).from_reader(BufReader::new(file)).into_records();
    let fields = |record: csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let wrong = |error: csv::Error| LogError::file(path, error.into());
    let columns = records.next().transpose().map_err(wrong)?.map(fields).unwrap_or_default();
    let rows = records.take(most).map(|record| record.map(fields).map_err(wrong)).collect::<Result<_, _>>()?;
    Ok(Preview { table: None, columns, rows })
}

pub(crate) fn lines(path: &Path, _: &LoggerFile, most: usize) -> Result<Preview, LogError> {
    let file = unpacked(path).map_err(|error| LogError::file(path, error))?;
    let lines = BufReader::new(file).lines().take(most);
    let fields = |line: String| line.split('\t').map(str::to_owned).collect();
    let rows = lines.map(|line| line.map(fields).map_err(|error| LogError::file(path, error)));
    Ok(Preview { table: None, columns: Vec::new(), rows: rows.collect::<Result<_, _>>()? })
}

pub(crate) fn objects(path: &Path, _: &LoggerFile, most: usize) -> Result<Preview, LogError> {
    let file = unpacked(path).map_err(|error| LogError::file(path, error))?;
    let (mut columns, mut rows) = (Vec::new(), Vec::new());
    for line in BufReader::new(file).lines().take(most) {
        let line = line.map_err(|error| LogError::file(path, error))?;
        let Ok(object) = serde_json::from_str::<serde_json::Map<String, serde_json::Value>>(&line) else { continue };
        columns = object.keys().cloned().collect();
        let cell = |value: &serde_json::Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        rows.push(object.values().map(cell).collect());
    }
    Ok(Preview { table: None, columns, rows })
}
