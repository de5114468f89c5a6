//! The SQLite files of a run: of the log and, apart from it, of the truth.
//!
//! They are written in place, so that a run can be watched. Transactions are on the disk before their rows count as stored; killed at any
//! moment, the file holds a gap-free beginning of the run.
//!
//! Rows of a fast run go through a rollback journal: it writes a new page once, a write-ahead log twice. Rows of a run in real time go
//! through a write-ahead log, which lets others read for as long as they like. A fast run waits for readers. A new database begins with a
//! write-ahead log, and so does a resumed one with a reader, so that a reader from before the first rows does not block the run. After the
//! run the database is one file, unless a reader stays longer than the run waits for it: then the write-ahead log remains until the reader
//! ends.

use crate::error::{LogError, place_of};
use crate::files::{ExistingFile, FileLock, OpenMode, are_own, companions, open};
use rusqlite::{CachedStatement, Connection, OpenFlags, ToSql};
use std::fs;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::slice::ChunksExact;
use std::time::{Duration, Instant};

/// Time to wait for another program that is about to write the database, and at the end for one that reads it (our
/// choice).
const BUSY: Duration = Duration::from_secs(2);

/// Longest delay of many rows by a reader (our choice). Readers do not delay few rows.
const READERS: Duration = Duration::from_secs(100);

/// The interval of checks for readers.
const LOOK: Duration = Duration::from_millis(20);

/// FULL: a committed transaction survives a loss of power, too. The cache is in KiB.
const SAFE: &str = "PRAGMA synchronous = FULL; PRAGMA cache_size = -1024";

const ONE_FILE: &str = "PRAGMA journal_mode = DELETE";

/// Wait for a reader after which rows are written in small transactions, so that no reader blocks them again (our
/// choice).
const WATCHED: Duration = Duration::from_secs(1);

/// Rows above which a transaction is large (our choice). In real time, a transaction has the rows of a second.
const TRICKLE: usize = 10_000;

/// Rows of one statement (our choice): half again as fast as one by one, measured.
const ROWS_AT_ONCE: usize = 16;

/// The count of transactions in a closed database: not a real one, so that no reader has cached pages for it.
const TRANSACTIONS: [u8; 4] = *b"home";

pub(crate) struct Database {
    /// Fields are dropped in order: the connection closes before `file` decides whether to delete the file.
    connection: OpenDatabase,
    file: DatabaseFile,
    /// Rows of the open transaction.
    not_durable: usize,
    flow: RowFlow,
    /// Whether a reader has been in the way.
    is_watched: bool,
}

/// Dropped in the middle of work, it undoes the open transaction, and leaves one file if no program is reading it.
struct OpenDatabase {
    connection: Connection,
    is_complete: bool,
}

/// Dropped before any row is stored, it leaves behind what was there before.
struct DatabaseFile {
    path: PathBuf,
    has_rows: bool,
    /// The file that this one replaces, put aside until the first rows are safe.
    replaced: Option<PathBuf>,
    _lock: FileLock,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RowFlow {
    Pouring,
    Trickling,
}

impl RowFlow {
    fn for_rows(rows: usize) -> RowFlow {
        if rows < TRICKLE { RowFlow::Trickling } else { RowFlow::Pouring }
    }

    /// TRUNCATE, unlike DELETE, makes sure of a transaction's end without asking the folder.
    fn journal(self) -> &'static str {
        match self {
            RowFlow::Pouring => "PRAGMA journal_mode = TRUNCATE",
            RowFlow::Trickling => "PRAGMA journal_mode = WAL",
        }
    }
}

impl Database {
    /// Creates the file and its tables, and does what else comes before all rows.
    pub fn create(
        path: &Path,
        force: bool,
        tables: &[&str],
        begin: impl FnOnce(&Connection) -> rusqlite::Result<()>,
    ) -> Result<Database, LogError> {
        let lock = FileLock::take(path)?;
        let replaced = match ExistingFile::at(path, force)? {
            ExistingFile::Free => None,
            ExistingFile::Replaced => Some(put_aside(path)?),
            ExistingFile::Device => return Err(LogError::NoFile { place: place_of(path) }),
        };
        let file = DatabaseFile { path: path.into(), has_rows: false, replaced, _lock: lock };
        // A new database has no companions: SQLite would write into those that are there.
        remove_companions(path);
        // The database's own way to create a file does not tell why it could not.
        open(path, OpenMode::New).map_err(|error| LogError::file(path, error))?;
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let opened = Connection::open_with_flags(path, flags).and_then(|connection| {
            connection.busy_timeout(BUSY)?;
            let journal: String = connection.query_row(RowFlow::Trickling.journal(), [], |row| row.get(0))?;
            // On some network drives there can be no write-ahead log.
            if journal != "wal" {
                connection.execute_batch(RowFlow::Pouring.journal())?;
            }
            connection.execute_batch(SAFE)?;
            connection.execute_batch("BEGIN IMMEDIATE")?;
            for table in tables {
                connection.execute_batch(table)?;
            }
            begin(&connection)?;
            connection.execute_batch("COMMIT")?;
            Ok(connection)
        });
        let connection = opened.map_err(|error| LogError::database(path, error))?;
        Ok(Database::new(connection, file, RowFlow::Trickling))
    }

    fn new(connection: Connection, file: DatabaseFile, flow: RowFlow) -> Database {
        Database {
            connection: OpenDatabase { connection, is_complete: false },
            file,
            not_durable: 0,
            flow,
            is_watched: false,
        }
    }

    /// Opens the database of an unfinished run, to resume it; None for an empty database, which is removed. The caller checks which run it
    /// is of.
    pub fn reopen(path: &Path) -> Result<Option<Database>, LogError> {
        let lock = FileLock::take(path)?;
        // The database's own way to open a file follows a link.
        match open(path, OpenMode::Left).and_then(|file| file.metadata()) {
            Ok(found) if found.len() > 0 => {}
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(LogError::reading(path, error)),
            _ => {
                remove_database(path);
                return Ok(None);
            }
        }
        are_own(path).map_err(|(companion, error)| LogError::reading(&companion, error))?;
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let opened = Connection::open_with_flags(path, flags).and_then(|connection| {
            connection.busy_timeout(BUSY)?;
            // SQLite first undoes or completes the work of a program that died.
            let begun = "SELECT count(*) FROM sqlite_schema";
            let is_begun: bool = connection.query_row(begun, [], |row| row.get(0))?;
            let flow = match connection.execute_batch(RowFlow::Pouring.journal()) {
                Ok(()) => RowFlow::Pouring,
                Err(error) if !LogError::is_in_use(&error) => return Err(error),
                Err(error) => {
                    // A reader keeps a write-ahead log in use: further rows go through it.
                    let journal: String = connection.query_row("PRAGMA journal_mode", [], |row| row.get(0))?;
                    if journal == "wal" { RowFlow::Trickling } else { return Err(error) }
                }
            };
            connection.execute_batch(SAFE)?;
            Ok((connection, is_begun, flow))
        });
        let (connection, is_begun, flow) = opened.map_err(|error| LogError::database(path, error))?;
        if !is_begun {
            drop(connection);
            fs::remove_file(path).map_err(|error| LogError::file(path, error))?;
            remove_companions(path);
            return Ok(None);
        }
        let file = DatabaseFile { path: path.into(), has_rows: true, replaced: None, _lock: lock };
        Ok(Some(Database::new(connection, file, flow)))
    }

    pub fn path(&self) -> &Path {
        &self.file.path
    }

    /// Asks for what is there.
    pub fn ask<T>(&self, ask: impl FnOnce(&Connection) -> rusqlite::Result<T>) -> Result<T, LogError> {
        ask(&self.connection.connection).map_err(|error| LogError::database(&self.file.path, error))
    }

    /// Changes rows within the transaction that the next [`Database::make_durable`] ends.
    pub fn change(
        &mut self,
        rows: usize,
        change: impl FnOnce(&Connection) -> rusqlite::Result<()>,
    ) -> Result<(), LogError> {
        let connection = &self.connection.connection;
        let begun = match (connection.is_autocommit(), self.flow) {
            // From then on only those who read can be in the way.
            (true, RowFlow::Pouring) => {
                connection.execute_batch("BEGIN IMMEDIATE").and_then(|()| connection.busy_timeout(READERS))
            }
            (true, RowFlow::Trickling) => connection.execute_batch("BEGIN IMMEDIATE"),
            (false, _) => Ok(()),
        };
        begun.and_then(|()| change(connection)).map_err(|error| LogError::database(&self.file.path, error))?;
        self.not_durable += rows;
        Ok(())
    }

    /// Ends the transaction: what was changed is safe now.
    pub fn make_durable(&mut self) -> Result<(), LogError> {
        let flow = if self.is_watched { RowFlow::Trickling } else { RowFlow::for_rows(self.not_durable) };
        if self.commit()? && flow != self.flow && self.without_waiting(flow.journal()) {
            self.flow = flow;
        }
        Ok(())
    }

    /// Ends the transaction and leaves one complete file, unless a reader continues.
    pub fn close(mut self) -> Result<(), LogError> {
        self.commit()?;
        self.file.keep();
        let begun = Instant::now();
        // Nothing that SQLite waits for: it asks once.
        let mut is_one_file = self.without_waiting(ONE_FILE);
        while !is_one_file && begun.elapsed() < BUSY {
            std::thread::sleep(LOOK);
            is_one_file = self.without_waiting(ONE_FILE);
        }
        self.connection.is_complete = true;
        drop(self.connection);
        if is_one_file { self.file.forget_transactions() } else { Ok(()) }
    }

    /// Ends the transaction if there is one.
    fn commit(&mut self) -> Result<bool, LogError> {
        let connection = &self.connection.connection;
        if connection.is_autocommit() {
            return Ok(false);
        }
        let begun = Instant::now();
        let committed = connection.execute_batch("COMMIT").and_then(|()| connection.busy_timeout(BUSY));
        committed.map_err(|error| LogError::database(&self.file.path, error))?;
        self.is_watched |= begun.elapsed() > WATCHED && self.flow == RowFlow::Pouring;
        self.not_durable = 0;
        self.file.keep();
        Ok(true)
    }

    /// Changes the journal, unless a program reads at this moment; whether it did.
    fn without_waiting(&self, pragma: &str) -> bool {
        let connection = &self.connection.connection;
        let _ = connection.busy_timeout(Duration::ZERO);
        let changed = connection.execute_batch(pragma).is_ok();
        let _ = connection.busy_timeout(BUSY);
        changed
    }
}

impl Drop for OpenDatabase {
    fn drop(&mut self) {
        if !self.is_complete {
            let _ = self.connection.execute_batch("ROLLBACK");
            let _ = self.connection.busy_timeout(Duration::ZERO);
            let _ = self.connection.execute_batch(ONE_FILE);
        }
    }
}

impl DatabaseFile {
    /// Sets the count of transactions to a fixed number, so that the same rows of a table are the same bytes, for any number of
    /// transactions; with several tables, the order of pages depends on them all the same. Readers would miss a change of the file between
    /// its closing and this. The file's format keeps the count twice, in the first page's header
    /// (<https://www.sqlite.org/fileformat2.html>, file change counter and version-valid-for number).
    fn forget_transactions(&self) -> Result<(), LogError> {
        let stamp = |offset: u64| {
            let mut file = open(&self.path, OpenMode::Kept)?;
            file.seek(SeekFrom::Start(offset))?;
            file.write_all(&TRANSACTIONS)?;
            file.sync_data()
        };
        [24, 92].into_iter().try_for_each(stamp).map_err(|error| LogError::file(&self.path, error))
    }

    /// From now on this is the file, and what it replaces is gone.
    fn keep(&mut self) {
        self.has_rows = true;
        if let Some(replaced) = self.replaced.take() {
            let _ = fs::remove_file(replaced);
        }
    }
}

impl Drop for DatabaseFile {
    fn drop(&mut self) {
        if !self.has_rows {
            let _ = fs::remove_file(&self.path);
            remove_companions(&self.path);
            if let Some(replaced) = &self.replaced {
                let _ = fs::rename(replaced, &self.path);
            }
        }
    }
}

/// The statements that insert rows into a table, one or several at a time.
pub(crate) struct Insert {
    one: String,
    many: String,
}

impl Insert {
    /// The number of rows of a multi-row INSERT.
    pub const AT_ONCE: usize = ROWS_AT_ONCE;

    /// Rows of `columns` and, before them, the column `run` with the run's id.
    pub fn new(table: &str, (run, id): (&str, i64), columns: &[&str]) -> Insert {
        let names: String = columns.iter().map(|name| format!(", \"{name}\"")).collect();
        let row = format!("({id}{})", ", ?".repeat(columns.len()));
        let rows = |count: usize| {
            format!("INSERT INTO \"{table}\" (\"{run}\"{names}) VALUES {}", vec![&row[..]; count].join(", "))
        };
        Insert { one: rows(1), many: rows(ROWS_AT_ONCE) }
    }

    /// Inserts rows, each of so many values; `put` binds values in their order.
    pub fn insert<T>(
        &self,
        connection: &Connection,
        values: &[T],
        width: usize,
        mut put: impl FnMut(&T, &mut Binding) -> rusqlite::Result<()>,
    ) -> rusqlite::Result<()> {
        let many = values.chunks_exact(ROWS_AT_ONCE * width);
        let rest = many.remainder().chunks_exact(width);
        let mut all = |sql: &str, chunks: ChunksExact<T>| {
            if chunks.len() == 0 {
                return Ok(());
            }
            // Asked for once: whenever it is given back, it forgets all that was bound, which takes as long as to bind it.
            let mut statement = connection.prepare_cached(sql)?;
            for values in chunks {
                let mut binding = Binding { statement: &mut statement, next: 1 };
                values.iter().try_for_each(|value| put(value, &mut binding))?;
                statement.raw_execute()?;
            }
            Ok(())
        };
        all(&self.many, many)?;
        all(&self.one, rest)
    }
}

/// Rows being bound, value by value in the order of the columns.
pub(crate) struct Binding<'a, 'c> {
    statement: &'a mut CachedStatement<'c>,
    next: usize,
}

impl Binding<'_, '_> {
    /// Binds the next value.
    pub fn put(&mut self, value: impl ToSql) -> rusqlite::Result<()> {
        self.statement.raw_bind_parameter(self.next, value)?;
        self.next += 1;
        Ok(())
    }
}

/// Renames a database that is to be replaced, unless another program is writing it; where it is then.
pub(crate) fn put_aside(path: &Path) -> Result<PathBuf, LogError> {
    are_own(path).map_err(|(companion, error)| LogError::reading(&companion, error))?;
    let probed = Connection::open_with_flags(path, OpenFlags::SQLITE_OPEN_READ_WRITE).and_then(|connection| {
        connection.busy_timeout(BUSY)?;
        connection.execute_batch("BEGIN EXCLUSIVE; ROLLBACK")
    });
    // Any other problem of it does not matter any more.
    if let Err(error) = probed.map_err(|error| LogError::database(path, error))
        && matches!(error, LogError::Locked { .. })
    {
        return Err(error);
    }
    let mut aside = path.as_os_str().to_owned();
    aside.push(format!(".{}.old", std::process::id()));
    fs::rename(path, &aside).map_err(|error| LogError::file(path, error))?;
    // The probe has brought whatever they held into the file.
    remove_companions(path);
    Ok(aside.into())
}

pub(crate) fn remove_database(path: &Path) {
    let _ = fs::remove_file(path);
    remove_companions(path);
}

fn remove_companions(path: &Path) {
    for companion in companions(path) {
        let _ = fs::remove_file(companion);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn another_file_under_the_name_of_a_companion_is_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let (path, mine) = (folder.path().join("log.db"), folder.path().join("mine"));
        let mut database = Database::create(&path, true, &["CREATE TABLE line (run INTEGER)"], |_| Ok(())).unwrap();
        database.change(1, |connection| connection.execute_batch("INSERT INTO line VALUES (1)")).unwrap();
        database.make_durable().unwrap();
        drop(database);
        for companion in companions(&path) {
            let _ = fs::remove_file(&companion);
            fs::write(&mine, "letter").unwrap();
            fs::hard_link(&mine, &companion).unwrap();
            assert!(Database::reopen(&path).is_err() && put_aside(&path).is_err(), "{}", companion.display());
            assert_eq!(fs::read_to_string(&mine).unwrap(), "letter");
            fs::remove_file(&companion).unwrap();
        }
        assert!(Database::reopen(&path).unwrap().is_some());
    }

    #[test]
    fn a_full_disk_keeps_what_was_stored() {
        let path = std::env::temp_dir().join(format!("homebody-full-{}.db", std::process::id()));
        let mut database =
            Database::create(&path, true, &["CREATE TABLE line (run INTEGER, text TEXT)"], |_| Ok(())).unwrap();
        database.change(0, |connection| connection.pragma_update(None, "max_page_count", 50)).unwrap();
        let insert = Insert::new("line", ("run", 1), &["text"]);
        let mut store = || {
            database.change(100, |connection| {
                insert.insert(connection, &["some words to fill pages with"; 100], 1, |text, row| row.put(text))
            })?;
            database.make_durable()
        };
        let mut stored = 0;
        let error = loop {
            match store() {
                Ok(()) => stored += 100,
                Err(error) => break error,
            }
        };
        assert!(matches!(error, LogError::Full { .. }), "{error}");
        drop(database);
        let connection = Connection::open(&path).unwrap();
        let kept: i64 = connection.query_row("SELECT count(*) FROM line", [], |row| row.get(0)).unwrap();
        drop(connection);
        assert!(stored > 0 && kept == stored, "{kept} of {stored}");
        fs::remove_file(&path).unwrap();
        remove_companions(&path);
    }
}
