//! Opens databases of other programs, or of our runs, for reading.
//!
//! Only tables are read: a view can compute without an end, or produce gigabytes.

use super::open::{self, OpenMode, are_own, log_beside};
use super::plain;
use crate::limits::LONGEST_ROW_BYTES;
use rusqlite::limits::Limit;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags, Params, Row};
use std::borrow::Cow;
use std::io::Read;
use std::path::Path;
use std::time::Duration;

/// The database in a file.
pub(crate) fn connect(path: &Path) -> rusqlite::Result<Connection> {
    match connect_only(path) {
        // A run that was killed has left a transaction half written: it has to be undone before anything is read. That changes the
        // file and those next to it, so none of them may be another file of the user.
        Err(error) if error.sqlite_error_code() == Some(rusqlite::ErrorCode::ReadOnly) => {
            match open::open(path, OpenMode::Left).is_ok() && are_own(path).is_ok() {
                true => open(path, OpenFlags::SQLITE_OPEN_READ_WRITE),
                false => Err(error),
            }
        }
        Err(_) => open(path, OpenFlags::SQLITE_OPEN_READ_ONLY),
        connected => connected,
    }
}

/// The same where nothing may be changed: what a killed run has half written is an error.
pub(crate) fn connect_only(path: &Path) -> rusqlite::Result<Connection> {
    let connection = open(path, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
    connection.query_row("SELECT count(*) FROM sqlite_schema", [], |_| Ok(()))?;
    Ok(connection)
}

fn open(path: &Path, flags: OpenFlags) -> rusqlite::Result<Connection> {
    // One thread at a time has a connection.
    let flags = flags | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = match is_closed_with_wal(path) {
        // Opened as usual, it would get two more files next to it.
        true => Connection::open_with_flags(unchanging(path), flags | OpenFlags::SQLITE_OPEN_URI)?,
        false => Connection::open_with_flags(path, flags)?,
    };
    connection.busy_timeout(Duration::from_secs(2))?;
    connection.set_limit(Limit::SQLITE_LIMIT_LENGTH, LONGEST_ROW_BYTES as i32)?;
    connection.execute_batch("PRAGMA trusted_schema = OFF")?;
    Ok(connection)
}

/// Whether a closed database uses a write-ahead log, by its header.
fn is_closed_with_wal(path: &Path) -> bool {
    let mut header = [0; 20];
    let read = plain::open(path).and_then(|mut file| file.read_exact(&mut header));
    read.is_ok() && header[18..] == [2, 2] && log_beside(path).is_none()
}

/// The name of a file for SQLite that does not change while it is read.
fn unchanging(path: &Path) -> String {
    let letter = |&byte: &u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' => char::from(byte).to_string(),
        _ => format!("%{byte:02X}"),
    };
    let path: String = path.as_os_str().as_encoded_bytes().iter().map(letter).collect();
    format!("file:{path}?immutable=1")
}

/// The tables of a database in the order of their creation, without views and virtual tables.
pub(crate) fn tables(connection: &Connection) -> rusqlite::Result<Vec<String>> {
    let sql = "SELECT name FROM sqlite_schema JOIN pragma_table_list USING (name)
               WHERE pragma_table_list.schema = 'main' AND pragma_table_list.type = 'table'
                 AND sqlite_schema.type = 'table' ORDER BY sqlite_schema.rowid";
    list(connection, sql, [], |row| row.get(0))
}

/// The columns of a table in their order; none without the table.
pub(crate) fn columns(connection: &Connection, table: &str) -> rusqlite::Result<Vec<String>> {
    list(connection, "SELECT name FROM pragma_table_info(?) ORDER BY cid", [table], |row| row.get(0))
}

pub(crate) fn has_column(connection: &Connection, table: &str, column: &str) -> rusqlite::Result<bool> {
    Ok(columns(connection, table)?.iter().any(|name| name == column))
}

/// All rows of a query.
pub(crate) fn list<T>(
    connection: &Connection,
    sql: &str,
    values: impl Params,
    row: impl FnMut(&Row) -> rusqlite::Result<T>,
) -> rusqlite::Result<Vec<T>> {
    connection.prepare(sql)?.query_map(values, row)?.collect()
}

/// The first of a table's row numbers from 1 to `last` that is not before what is looked for, found by halving; `last` + 1 if all are.
/// Rows lie in order, so that `is_before` holds for those up to one of them.
pub(crate) fn first_row<E>(last: i64, mut is_before: impl FnMut(i64) -> Result<bool, E>) -> Result<i64, E> {
    let (mut low, mut high) = (1, last + 1);
    while low < high {
        let middle = low + (high - low) / 2;
        match is_before(middle)? {
            true => low = middle + 1,
            false => high = middle,
        }
    }
    Ok(low)
}

pub(crate) fn text(value: ValueRef<'_>) -> Cow<'_, str> {
    match value {
        ValueRef::Null => "".into(),
        ValueRef::Integer(number) => number.to_string().into(),
        ValueRef::Real(number) => number.to_string().into(),
        ValueRef::Text(bytes) | ValueRef::Blob(bytes) => String::from_utf8_lossy(bytes),
    }
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn rolls_back_no_other_file_of_the_user() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let writing = Connection::open(path("writing.db")).unwrap();
        let begun = "PRAGMA cache_size = 2; CREATE TABLE line (text TEXT); BEGIN";
        writing.execute_batch(begun).unwrap();
        for _ in 0..200 {
            writing.execute("INSERT INTO line VALUES (?)", ["some words".repeat(100)]).unwrap();
        }
        // A copy of what a killed program leaves: half a transaction, and the journal that undoes it.
        let leave = || {
            fs::copy(path("writing.db"), path("log.db")).unwrap();
            fs::copy(path("writing.db-journal"), path("log.db-journal")).unwrap();
            fs::read(path("log.db")).unwrap()
        };
        let half = leave();
        fs::hard_link(path("log.db"), path("mine")).unwrap();
        assert!(connect(&path("log.db")).and_then(|found| rows(&found)).is_err());
        assert!(fs::read(path("mine")).unwrap() == half);
        // The control: under one name it is undone, and read.
        fs::remove_file(path("mine")).unwrap();
        assert_eq!(connect(&path("log.db")).and_then(|found| rows(&found)), Ok(0));
        assert!(fs::read(path("log.db")).unwrap() != half);
        // Nor is it undone where SQLite would write next to it into another file.
        leave();
        fs::write(path("letter"), "").unwrap();
        fs::hard_link(path("letter"), path("log.db-wal")).unwrap();
        assert!(connect(&path("log.db")).and_then(|found| rows(&found)).is_err());
    }

    fn rows(connection: &Connection) -> rusqlite::Result<i64> {
        connection.query_row("SELECT count(*) FROM line", [], |row| row.get(0))
    }
}
