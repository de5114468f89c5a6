//! A run's truth, opened to be read: a database of SQLite; or, of any other kind of place, a database without a name into which its
//! tables are put, and which is gone as soon as they have been read.

use crate::error::{LogError, TruthMessage};
use crate::files::database::{columns, connect, tables as tables_of};
use crate::log::Clock;
use crate::read::LogSource;
use crate::registry;
use crate::run::{RunPlaces, TRUTH};
use crate::source::table_files::read_files;
use crate::source::{LogInstant, TakeTruthRow, TruthValue, open};
use crate::table::Table;
use crate::table::truth::{self, Truth, TruthKept, tables};
use crate::url::{Url, table_file};
use homebody_core::scenario::scheme::{Scheme, SchemeRow, TablePlacement, without_password};
use homebody_core::time::TimeScale;
use jiff::Timestamp;
use rusqlite::types::{ToSqlOutput, ValueRef};
use rusqlite::{Connection, Statement, ToSql, params_from_iter};
use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};

/// The tables by which rows of a log are labelled.
pub(crate) const LABEL_TABLES: [Truth; 5] = [Truth::Cause, Truth::Off, Truth::Movement, Truth::Room, Truth::Activity];

/// A truth whose tables are known to be there.
pub(crate) struct RecordedTruth {
    place: PathBuf,
    pub connection: Connection,
    /// Whether it says how bodies moved: a brief one does not.
    pub has_movements: bool,
    /// By which clock a place tells instants that has a type for them; None where they are as the run's mapping wants them.
    told_by: Option<Clock>,
}

impl RecordedTruth {
    /// Opens those tables of a truth that are to be read. Movements are read besides where they are there: they tell which of the hours
    /// that clocks tell twice an instant is in.
    pub fn open(url: &Url, wanted: &[Truth]) -> Result<RecordedTruth, LogError> {
        let all = tables();
        let is_brief = is_brief(url);
        let mut wanted: Vec<&Table> = wanted.iter().map(|&table| &all[table as usize]).collect();
        if let Some(table) = wanted.iter().find(|table| is_brief && !TruthKept::Brief.has(table)) {
            return Err(LogError::LeftOut { place: url.to_string(), table: table.name.clone() });
        }
        let movement = &all[Truth::Movement as usize];
        if !is_brief && !wanted.contains(&movement) {
            wanted.push(movement);
        }
        let no_truth = |why: TruthMessage| LogError::no_truth(url.to_string(), why);
        match (url.scheme(), registry::built_in(url.scheme())) {
            (Scheme::Sqlite, _) => RecordedTruth::in_place(url, &wanted),
            (_, Some(row)) => {
                let read = row.table.ok_or_else(|| no_truth(TruthMessage::CasasForm))?;
                gathered(url, &wanted, |take| read_files(url, &wanted, read, take))
            }
            (_, None) => {
                let read = registry::plugin(url)?.tables.ok_or_else(|| no_truth(TruthMessage::Unstored))?;
                gathered(url, &wanted, |take| read(url, &wanted, take))
            }
        }
    }

    /// One in a database of SQLite stays where it is.
    fn in_place(url: &Url, wanted: &[&Table]) -> Result<RecordedTruth, LogError> {
        let path = url.path();
        let no_truth = |why: TruthMessage| LogError::no_truth(url.to_string(), why);
        open(path)?;
        let found = connect(path).and_then(|connection| Ok((missing(&connection, wanted)?, connection)));
        let (missing, connection) = found.map_err(|error| match error.sqlite_error_code() {
            Some(rusqlite::ErrorCode::NotADatabase) => no_truth(TruthMessage::NotDatabase),
            _ => LogError::database(path, error),
        })?;
        match missing.is_empty() {
            true => Ok(RecordedTruth {
                place: path.into(),
                connection,
                has_movements: has_movements(wanted),
                told_by: None,
            }),
            false => Err(no_truth(TruthMessage::Missing { missing })),
        }
    }

    /// The scale of its run for the instants of this place: `scale` is that of the run's files.
    pub fn scale(&self, scale: &TimeScale) -> TimeScale {
        if self.told_by == Some(Clock::Utc) { scale.with_wall_of_utc() } else { scale.clone() }
    }

    /// What an error of its database means.
    pub fn error(&self, error: rusqlite::Error) -> LogError {
        LogError::database(&self.place, error)
    }
}

fn has_movements(read: &[&Table]) -> bool {
    read.iter().any(|table| table.name == "movement")
}

/// Whether a truth leaves out what has a row for each firing or movement, as that of a large cohort does.
pub fn is_brief(url: &Url) -> bool {
    let path = url.path();
    let has = |of: &dyn Fn(&str) -> bool| has_all(of) && TruthKept::of(of) == TruthKept::Brief;
    match url.scheme() {
        Scheme::Sqlite => {
            let found = open(path).ok().and_then(|_| tables_of(&connect(path).ok()?).ok());
            found.is_some_and(|found| has(&|table| found.iter().any(|known| known == table)))
        }
        _ if url.is_data_set() => false,
        _ => url.file().is_some() && has(&|table| table_file(path, table).is_file()),
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
        let columns = columns(connection, &table.name)?;
        let gone = table.columns.iter().filter(|column| !columns.contains(&column.name));
        missing.extend(gone.map(|column| format!("no column {:?} of {:?}", column.name, table.name)));
    }
    Ok(missing)
}

/// A database of the rows that a place gives. SQLite puts it on disk where it becomes large.
fn gathered(
    url: &Url,
    wanted: &[&Table],
    read: impl FnOnce(&mut TakeTruthRow<'_>) -> Result<(), LogError>,
) -> Result<RecordedTruth, LogError> {
    let database = |error| LogError::database(url.path(), error);
    let connection = Connection::open("").map_err(database)?;
    let mut made = "BEGIN".to_owned();
    for table in wanted {
        let columns: Vec<String> = table.columns.iter().map(|column| format!("{:?}", column.name)).collect();
        made += &format!("; CREATE TABLE {:?} ({})", table.name, columns.join(", "));
    }
    connection.execute_batch(&made).map_err(database)?;
    let told_by = Cell::new(None);
    {
        let insert = |table: &&Table| {
            let places = vec!["?"; table.columns.len()].join(", ");
            connection.prepare(&format!("INSERT INTO {:?} VALUES ({places})", table.name))
        };
        let mut inserts: Vec<Statement> =
            wanted.iter().map(insert).collect::<rusqlite::Result<_>>().map_err(database)?;
        read(&mut |table, values| {
            for value in values {
                if let TruthValue::Instant(at) = value {
                    told_by.set(Some(at.clock()));
                }
            }
            inserts[table].execute(params_from_iter(values)).map_err(database).map(|_| ())
        })?;
    }
    connection.execute_batch("COMMIT").map_err(database)?;
    let (place, has_movements) = (url.path().into(), has_movements(wanted));
    Ok(RecordedTruth { place, connection, has_movements, told_by: told_by.get() })
}

impl ToSql for TruthValue<'_> {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        Ok(match *self {
            TruthValue::Null => ToSqlOutput::Borrowed(ValueRef::Null),
            TruthValue::Integer(number) => number.into(),
            TruthValue::Real(number) => number.into(),
            TruthValue::Text(text) => ToSqlOutput::Borrowed(ValueRef::Text(text.as_bytes())),
            // As the truth of a run has them: what is on the wall has a blank in it, and is compared as text.
            TruthValue::Instant(LogInstant::Utc(at)) => (civil(at.micros(), "%Y-%m-%dT%H:%M:%S.%6f")? + "Z").into(),
            TruthValue::Instant(LogInstant::Local(at)) => civil(at.micros(), "%Y-%m-%d %H:%M:%S.%6f")?.into(),
        })
    }
}

fn civil(at: i64, format: &str) -> rusqlite::Result<String> {
    let wrong = |error: jiff::Error| rusqlite::Error::ToSqlConversionFailure(error.into());
    Ok(Timestamp::from_microsecond(at).map_err(wrong)?.strftime(format).to_string())
}

/// The truth that somebody names: as `sqlite:FILE`, `csv:FILE`, `postgresql://...` and so on, by the folder of its run, or by its path
/// alone, be it that of a database, of one of the files of its tables, or what these have been named after.
pub fn truth_at(text: &str) -> Url {
    let path = Path::new(text);
    if path.is_dir() {
        if is_truth_set(path) {
            return Url::new(Scheme::Parquet, path);
        }
        let inside = path.join(TRUTH);
        return truth_beside(&inside).unwrap_or(Url::new(Scheme::Sqlite, inside));
    }
    if !path.exists() {
        let path = &*PathBuf::from(&*without_password(text));
        let named = text.parse().ok().or_else(|| in_tables(path));
        return named.unwrap_or(Url::new(Scheme::Sqlite, path));
    }
    let whole = whole_of(path).and_then(|whole| in_tables(&whole));
    whole.unwrap_or(Url::new(Scheme::Sqlite, path))
}

/// The truth of the run whose log this is: beside its file, or where its server has it.
pub fn truth_of(log: &LogSource) -> Option<Url> {
    if !log.is_server() {
        return truth_beside(log.path());
    }
    let url: Url = log.path().to_string_lossy().parse().ok()?;
    (registry::plugin(&url).ok()?.truth_of?)(&url)
}

/// The truth that a run has left beside its log: a database, files of its tables, or a folder of these; of a member of a cohort's set,
/// the one in the set of truths.
pub fn truth_beside(log: &Path) -> Option<Url> {
    let database = log.with_file_name(TRUTH);
    // One of a run that was killed as it began it has nothing in it.
    if fs::metadata(&database).is_ok_and(|found| found.is_file() && found.len() > 0) {
        return Some(Url::new(Scheme::Sqlite, database));
    }
    let mut endings = SchemeRow::with_files_of_tables().flat_map(|row| row.extensions);
    let files = endings.find_map(|ending| in_tables(&database.with_extension(ending)));
    let set = database.with_extension("");
    let files = files.or_else(|| is_truth_set(&set).then(|| Url::new(Scheme::Parquet, set)));
    files.or_else(|| RunPlaces::in_set_at(log)?.truth)
}

/// Whether each table of a truth is there, of which an earlier version may have known fewer, and which may be brief.
fn has_all(is_there: impl Fn(&str) -> bool) -> bool {
    truth::tables_of(&is_there).iter().all(|table| is_there(&table.name))
}

/// The truth of which each table has a file that is named after a path.
fn in_tables(path: &Path) -> Option<Url> {
    let are_there = path.file_name().is_some() && has_all(|table| table_file(path, table).is_file());
    let row = SchemeRow::by_path(&path.to_string_lossy()).filter(|row| row.tables == TablePlacement::FileEach);
    are_there.then(|| Url::new(row.map_or(Scheme::Csv, |row| row.scheme), path))
}

/// Whether a folder is a data set of a truth: one in it for each table.
pub fn is_truth_set(folder: &Path) -> bool {
    has_all(|table| folder.join(table).is_dir())
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
