//! A database file: the run's tables, and the table `run`.
//!
//! The order of insertions depends on the rows alone, and not on batches, so that the same run gives the same bytes. A resumed run
//! compares the rows of the file with those that it makes again.

use super::database::{Binding, Database, Insert};
use super::text_rows::CellWriter;
use super::{Begin, Sink, Watermark};
use crate::error::{ChangedMessage, LogError, place_of};
use crate::files::WriteMode;
use crate::log::{SENSOR, SENSOR_COLUMNS, says_more_of, sensor_cells};
use crate::run::RunInfo;
use crate::table::{Batch, Cell, Column, ColumnKind, InstantWriter, Stamp, Table};
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::RunTime;
use rusqlite::types::{Null, ToSqlOutput, ValueRef};
use rusqlite::{Connection, ToSql, params};
use std::path::{Path, PathBuf};

/// A database file with a table for each table of the run.
pub(crate) struct Sqlite {
    path: PathBuf,
    /// Once it is begun.
    open: Option<OpenSqlite>,
}

struct OpenSqlite {
    database: Database,
    tables: Vec<SqliteTable>,
    cells: CellWriter,
    run: i64,
}

struct SqliteTable {
    name: String,
    columns: Vec<Column>,
    is_numbered: bool,
    run_column: String,
    insert: Insert,
    /// Rows that are not inserted yet. They are inserted `at_once` together, whatever the batches.
    waiting: Vec<Cell>,
    /// The number of rows of the file at the beginning. As many rows of the run are compared with them.
    there: u64,
    come: u64,
    /// The number of rows of one INSERT.
    at_once: usize,
}

/// Rows that are inserted together if there is only one table, as in a log (our choice).
const ALONE: usize = 64 * Insert::AT_ONCE;

/// The same for a table with many rows among other tables (our choice).
const FREQUENT: usize = 4 * Insert::AT_ONCE;

impl Sqlite {
    pub fn new(path: PathBuf) -> Sqlite {
        Sqlite { path, open: None }
    }

    fn begun(&mut self) -> Result<&mut OpenSqlite, LogError> {
        let stopped = || LogError::Stopped { place: place_of(&self.path) };
        self.open.as_mut().ok_or_else(stopped)
    }
}

impl Sink for Sqlite {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let mut tables: Vec<SqliteTable> = begin.tables.iter().map(|table| SqliteTable::new(table, begin)).collect();
        let mut clock = begin.clock();
        let left = if begin.how == WriteMode::Resume { Database::reopen(&self.path)? } else { None };
        let database = match left {
            Some(database) => {
                can_go_on(&database, &begin.run)?;
                for table in &mut tables {
                    table.there = database.ask(|connection| table.count(connection))?;
                }
                database
            }
            None => {
                let created: Vec<String> = begin.tables.iter().map(|table| create(table, begin)).collect();
                let created: Vec<&str> = created.iter().map(String::as_str).collect();
                let run = tell_run(&begin.run, begin.time, &mut clock);
                // A truth has its own tables, and the rows of a log may have taken the name.
                let is_log = begin.tables.iter().any(|table| table.is_numbered)
                    && begin.tables.iter().all(|table| table.name != SENSOR);
                let tell = |connection: &Connection| {
                    run(connection)?;
                    if is_log { tell_sensors(connection, &begin.run) } else { Ok(()) }
                };
                Database::create(&self.path, begin.how == WriteMode::Overwrite, &created, tell)?
            }
        };
        self.open = Some(OpenSqlite { database, tables, cells: CellWriter::new(clock), run: begin.run.id });
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.begun()?.write(batch)
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let open = self.begun()?;
        open.database.make_durable()?;
        Ok(Watermark(open.tables.iter().map(SqliteTable::durable).collect()))
    }

    fn finish(&mut self, end: RunTime) -> Result<(), LogError> {
        let Some(mut open) = self.open.take() else { return Ok(()) };
        if let Some(table) = open.tables.iter().find(|table| table.come < table.there) {
            let (name, rows, of_run) = (table.name.clone(), table.there, table.come);
            let more = ChangedMessage::MoreRowsInTable { table: name, rows, of_run };
            return Err(LogError::changed(place_of(&self.path), more));
        }
        for index in 0..open.tables.len() {
            open.insert_waiting(index)?;
        }
        let (run, end) = (open.run, open.cells.clock.stamp(end));
        open.database.change(0, |connection| {
            connection.execute("UPDATE run SET ended_at = ? WHERE run_id = ?", params![end, run]).map(|_| ())
        })?;
        open.database.close()
    }
}

impl OpenSqlite {
    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let texts = &mut self.cells.texts;
        texts.extend(batch.texts_from(texts.len()).map(|text| text.to_string()));
        let mut known: Vec<Vec<&[Cell]>> = vec![Vec::new(); self.tables.len()];
        let mut new = 0;
        for row in batch.rows() {
            let table = &mut self.tables[row.table];
            table.come += 1;
            if table.come <= table.there {
                known[row.table].push(row.cells);
                continue;
            }
            new += 1;
            table.waiting.extend_from_slice(row.cells);
            if table.waiting.len() == table.at_once * table.columns.len() {
                self.insert_waiting(row.table)?;
            }
        }
        if self.tables.len() == 1 && new > 0 {
            // With one table only, it changes no byte how many rows are inserted together.
            self.insert_waiting(0)?;
        }
        for (table, rows) in known.iter().enumerate().filter(|(_, rows)| !rows.is_empty()) {
            self.compare(table, rows)?;
        }
        Ok(())
    }

    fn insert_waiting(&mut self, index: usize) -> Result<(), LogError> {
        let OpenSqlite { database, tables, cells, .. } = self;
        let table = &mut tables[index];
        let width = table.columns.len();
        let rows = std::mem::take(&mut table.waiting);
        let put = |&cell: &Cell, binding: &mut Binding| match cell {
            Cell::Null => binding.put(Null),
            Cell::Instant(at) => binding.put(cells.clock.stamp(at)),
            Cell::Integer(number) => binding.put(number),
            Cell::Real(number) => binding.put(number),
            Cell::Text(_) | Cell::Thousandths(_) => binding.put(cells.text(cell)),
        };
        database.change(rows.len() / width, |connection| table.insert.insert(connection, &rows, width, put))?;
        table.waiting = rows;
        table.waiting.clear();
        Ok(())
    }

    /// Checks that the next rows of a table in the file are these.
    fn compare(&mut self, index: usize, rows: &[&[Cell]]) -> Result<(), LogError> {
        let OpenSqlite { database, tables, cells: writer, run } = self;
        let table = &tables[index];
        let last = table.come.min(table.there);
        let first = last - rows.len() as u64;
        let sql = table.select();
        let differs = database.ask(|connection| {
            let mut select = connection.prepare_cached(&sql)?;
            let mut found = match table.is_numbered {
                true => select.query(params![first as i64, last as i64, *run])?,
                false => select.query(params![first as i64 + 1, last as i64 + 1])?,
            };
            for (number, cells) in (first..).zip(rows) {
                let Some(row) = found.next()? else { return Ok(Some(number)) };
                for (column, &cell) in cells.iter().enumerate() {
                    if !is_same(row.get_ref(column)?, cell, writer) {
                        return Ok(Some(number));
                    }
                }
            }
            Ok(None)
        })?;
        match differs {
            None => Ok(()),
            Some(number) => {
                let other = ChangedMessage::OtherRow { row: number, table: table.name.clone() };
                Err(LogError::changed(place_of(database.path()), other))
            }
        }
    }
}

impl SqliteTable {
    fn new(table: &Table, begin: &Begin) -> SqliteTable {
        let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
        SqliteTable {
            name: table.name.clone(),
            columns: table.columns.clone(),
            is_numbered: table.is_numbered,
            run_column: begin.run_column.clone(),
            insert: Insert::new(&table.name, (&begin.run_column, begin.run.id), &names),
            waiting: Vec::new(),
            there: 0,
            come: 0,
            // The order of insertions decides which page of the file belongs to which table. So it must depend on the rows
            // alone, not on batches. Tables with few rows insert each at once.
            at_once: match (begin.tables.len(), table.is_frequent) {
                (1, _) => ALONE,
                (_, true) => FREQUENT,
                (_, false) => 1,
            },
        }
    }

    /// The number of its rows in the database.
    fn durable(&self) -> u64 {
        self.there.max(self.come - (self.waiting.len() / self.columns.len()) as u64)
    }

    fn count(&self, connection: &Connection) -> rusqlite::Result<u64> {
        let sql = match self.is_numbered {
            true => format!("SELECT coalesce(max(\"{}\") + 1, 0) FROM \"{}\"", self.columns[0].name, self.name),
            false => format!("SELECT coalesce(max(rowid), 0) FROM \"{}\"", self.name),
        };
        connection.query_row(&sql, [], |row| row.get::<_, i64>(0)).map(|rows| rows as u64)
    }

    /// Rows from one number on and before another.
    fn select(&self) -> String {
        let names: Vec<String> = self.columns.iter().map(|column| format!("\"{}\"", column.name)).collect();
        let names = names.join(", ");
        match self.is_numbered {
            true => format!(
                "SELECT {names} FROM \"{}\" WHERE \"{key}\" >= ?1 AND \"{key}\" < ?2 AND \"{run}\" = ?3 ORDER BY \"{key}\"",
                self.name,
                key = self.columns[0].name,
                run = self.run_column,
            ),
            false => format!("SELECT {names} FROM \"{}\" WHERE rowid >= ?1 AND rowid < ?2 ORDER BY rowid", self.name),
        }
    }
}

fn create(table: &Table, begin: &Begin) -> String {
    let run = &begin.run_column;
    let mut columns = format!("\"{run}\" INTEGER");
    for column in &table.columns {
        columns += &format!(", \"{}\" {}", column.name, column_type(column.kind, begin.time));
    }
    match table.is_numbered {
        // Without a rowid the key is the table itself and not an index: smaller and faster.
        true => format!(
            "CREATE TABLE \"{}\" ({columns}, PRIMARY KEY (\"{run}\", \"{}\")) WITHOUT ROWID",
            table.name, table.columns[0].name
        ),
        false => format!("CREATE TABLE \"{}\" ({columns})", table.name),
    }
}

fn column_type(kind: ColumnKind, time: TimeFormat) -> &'static str {
    match kind {
        ColumnKind::Instant => time_type(time),
        ColumnKind::Integer => "INTEGER",
        ColumnKind::Real => "REAL",
        ColumnKind::Text => "TEXT",
    }
}

fn time_type(time: TimeFormat) -> &'static str {
    match time {
        TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => "TEXT",
        TimeFormat::EpochS => "REAL",
        TimeFormat::EpochMs => "INTEGER",
    }
}

/// Creates the table `run`, which tells about the run in each database that holds one.
///
/// Its times are simulated ones: a log does not depend on when it was made. `ended_at` stays empty until the run is
/// complete.
pub(crate) fn tell_run<'a>(
    run: &'a RunInfo,
    time: TimeFormat,
    clock: &'a mut InstantWriter,
) -> impl FnOnce(&Connection) -> rusqlite::Result<()> + 'a {
    move |connection| {
        let time = time_type(time);
        connection.execute_batch(&format!(
            "CREATE TABLE run (run_id INTEGER PRIMARY KEY, home TEXT, scenario TEXT, seed TEXT, started_at {time}, \
             ended_at {time}, version TEXT, zone TEXT)"
        ))?;
        // A seed can be larger than a database's integers.
        let (seed, started_at, zone) = (run.seed.to_string(), clock.stamp(RunTime::START), run.zone());
        let values = params![run.id, run.home, run.scenario, seed, started_at, run.version, zone];
        let sql =
            "INSERT INTO run (run_id, home, scenario, seed, started_at, version, zone) VALUES (?, ?, ?, ?, ?, ?, ?)";
        connection.execute(sql, values).map(|_| ())
    }
}

/// Creates the table of sensors, where more is known of them than what the log calls them.
fn tell_sensors(connection: &Connection, run: &RunInfo) -> rusqlite::Result<()> {
    if !says_more_of(&run.sensors) {
        return Ok(());
    }
    let columns = SENSOR_COLUMNS.map(|name| format!("{name} TEXT")).join(", ");
    connection.execute_batch(&format!("CREATE TABLE {SENSOR} (run_id INTEGER, {columns})"))?;
    let sql = format!("INSERT INTO {SENSOR} (run_id, {}) VALUES (?, ?, ?, ?, ?, ?)", SENSOR_COLUMNS.join(", "));
    let mut insert = connection.prepare(&sql)?;
    for sensor in &run.sensors {
        let [id, name, kind, room, unit] = sensor_cells(sensor);
        insert.execute(params![run.id, id, name, kind, room, unit])?;
    }
    Ok(())
}

/// Refuses a database that another run has left, or another program.
pub(crate) fn can_go_on(database: &Database, run: &RunInfo) -> Result<(), LogError> {
    let other = |why| LogError::changed(place_of(database.path()), why);
    let columns = "SELECT count(*) FROM pragma_table_info('run') WHERE name = 'run_id'";
    if database.ask(|connection| connection.query_row(columns, [], |row| row.get::<_, i64>(0)))? == 0 {
        return Err(other(ChangedMessage::ForeignDatabase));
    }
    let found: Option<i64> = database.ask(|connection| {
        use rusqlite::OptionalExtension;
        connection.query_row("SELECT run_id FROM run WHERE typeof(run_id) = 'integer'", [], |row| row.get(0)).optional()
    })?;
    if found == Some(run.id) { Ok(()) } else { Err(other(ChangedMessage::OtherRun)) }
}

/// Refuses to replace a file other than a database of this run. A missing or empty file is replaced.
pub(crate) fn can_be_replaced(path: &Path, run: &RunInfo) -> Result<(), LogError> {
    Database::reopen(path)?.map_or(Ok(()), |database| can_go_on(&database, run))
}

fn is_same(found: ValueRef, cell: Cell, writer: &mut CellWriter) -> bool {
    match (found, cell) {
        (ValueRef::Null, Cell::Null) => true,
        (ValueRef::Integer(found), Cell::Integer(number)) => found == number,
        (ValueRef::Real(found), Cell::Real(number)) => found == number,
        (ValueRef::Text(found), Cell::Text(_) | Cell::Thousandths(_)) => {
            writer.text(cell).is_some_and(|text| found == text.as_bytes())
        }
        (found, Cell::Instant(at)) => match (found, writer.clock.stamp(at)) {
            (ValueRef::Text(found), Stamp::Text(text)) => found == text.as_bytes(),
            (ValueRef::Real(found), Stamp::Seconds(seconds)) => found == seconds,
            (ValueRef::Integer(found), Stamp::Milliseconds(milliseconds)) => found == milliseconds,
            _ => false,
        },
        _ => false,
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
