//! Databases made of SQL that a file of somebody else's may hold: odd types, views, triggers, virtual tables, large values; and
//! pages that are corrupt.

use super::{numbers, tables, texts};
use crate::dice::Dice;
use rusqlite::Connection;
use std::fs;
use std::path::Path;

/// Says of the database itself, before anything is in it.
const PRAGMAS: [&str; 9] = [
    "PRAGMA encoding = 'UTF-16le'",
    "PRAGMA encoding = 'UTF-16be'",
    "PRAGMA page_size = 512",
    "PRAGMA page_size = 65536",
    "PRAGMA auto_vacuum = FULL",
    "PRAGMA journal_mode = WAL",
    "PRAGMA application_id = -1",
    "PRAGMA user_version = 2147483647",
    "PRAGMA writable_schema = ON",
];

/// Names that readers look for.
const TABLES: [&str; 17] = [
    "firing",
    "run",
    "sensor",
    "cause",
    "off",
    "movement",
    "room",
    "activity",
    "act",
    "outside",
    "need",
    "condition",
    "lost",
    "resident",
    "events",
    "sqlite_stat1",
    "\"; --",
];

const COLUMNS: [&str; 26] = [
    "seq", "time", "sensor", "value", "run_id", "row", "firing", "resident", "seen_at", "why", "thing", "begin_at",
    "end_at", "name", "at", "room", "ended_at", "kind", "from_x", "to_y", "posture", "rowid", "_rowid_", "oid", "id",
    "\"\"",
];

const TYPES: [&str; 10] = [
    "TEXT",
    "INTEGER",
    "REAL",
    "BLOB",
    "",
    "NUMERIC",
    "TEXT COLLATE NOCASE",
    "INTEGER PRIMARY KEY",
    "TEXT UNIQUE",
    "ANY DEFAULT (hex(zeroblob(9)))",
];

/// What a view may be that has no end, or no small one. `%` is its list of columns.
const VIEWS: [&str; 9] = [
    "WITH RECURSIVE n(x) AS (SELECT 0 UNION ALL SELECT x + 1 FROM n) SELECT %x FROM n",
    "WITH RECURSIVE n(x) AS (SELECT 0 UNION ALL SELECT x + 1 FROM n LIMIT 100000) SELECT %x FROM n",
    "SELECT %hex(zeroblob(400000000))",
    "SELECT %zeroblob(900000000)",
    "SELECT %printf('%.*c', 300000000, 'x')",
    "SELECT %1 FROM pragma_table_list, pragma_table_list, pragma_function_list, pragma_function_list",
    "SELECT %randomblob(100)",
    "SELECT %load_extension('outside')",
    "SELECT %readfile('outside')",
];

/// Changes a script, and makes a database of it, part of which may be corrupt then. Each statement is on lines of its own, up to
/// a semicolon at a line's end.
pub fn database(script: &str, dice: &mut Dice) -> Vec<u8> {
    let mut statements: Vec<String> = split(script);
    for _ in 0..dice.size(5) {
        once(&mut statements, dice);
    }
    if dice.is(0.15) {
        statements.insert(0, (*dice.one(&PRAGMAS)).to_owned());
    }
    let mut bytes = made(&statements);
    if dice.is(0.4) {
        corrupt(&mut bytes, dice);
    }
    bytes
}

/// The database that a script makes as it stands.
pub fn plain(script: &str) -> Vec<u8> {
    made(&split(script))
}

fn split(script: &str) -> Vec<String> {
    script.split(";\n").map(str::trim).filter(|statement| !statement.is_empty()).map(str::to_owned).collect()
}

fn made(statements: &[String]) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("the program begins by making sure of it");
    let path = folder.path().join("made.db");
    fill(&path, statements).expect("a new database can be made there");
    fs::read(&path).unwrap_or_default()
}

fn fill(path: &Path, statements: &[String]) -> rusqlite::Result<()> {
    let connection = Connection::open(path)?;
    connection.execute_batch("PRAGMA synchronous = OFF")?;
    for statement in statements {
        // A mutant may be no SQL; the others stand.
        let _ = connection.execute_batch(statement);
    }
    Ok(())
}

fn once(statements: &mut Vec<String>, dice: &mut Dice) {
    let at = dice.below(statements.len() + 1);
    let new = match dice.below(9) {
        0 => table(dice),
        1 | 2 => row(dice),
        3 => view(dice),
        4 => special(dice),
        5 | 6 => {
            if let Some(statement) = statements.get_mut(at) {
                *statement = reworded(statement, dice);
            }
            return;
        }
        7 => {
            if at < statements.len() {
                statements.remove(at);
            }
            return;
        }
        _ => {
            let (from, to) = (dice.one(&TABLES), dice.one(&TABLES));
            format!("ALTER TABLE \"{from}\" RENAME TO \"{to}\"")
        }
    };
    // What is made last finds what was made before.
    statements.insert(if dice.is(0.7) { statements.len() } else { at }, new);
}

fn columns(dice: &mut Dice) -> Vec<&'static str> {
    let mut columns: Vec<&str> = (0..dice.size(12)).map(|_| *dice.one(&COLUMNS)).collect();
    if dice.is(0.5) {
        columns.splice(0..0, ["time", "sensor", "value"]);
    }
    columns.dedup();
    columns
}

fn table(dice: &mut Dice) -> String {
    let columns: Vec<String> = columns(dice).iter().map(|name| format!("{name} {}", dice.one(&TYPES))).collect();
    let end = dice.one(&["", "", "", " WITHOUT ROWID", " STRICT"]);
    let key = if end.contains("WITHOUT") { ", PRIMARY KEY (time, sensor)" } else { "" };
    format!("CREATE TABLE {}({}{key}){end}", dice.one(&TABLES), columns.join(", "))
}

/// Rows of one shape, of which there may be some hundreds.
fn row(dice: &mut Dice) -> String {
    let columns = columns(dice);
    let values: Vec<String> = columns.iter().map(|_| value(dice)).collect();
    let length = values.iter().map(String::len).sum();
    let times = if dice.is(0.2) { dice.size(super::times(length, 300)) } else { 1 };
    let rows = vec![format!("({})", values.join(", ")); times].join(", ");
    format!("INSERT OR IGNORE INTO {}({}) VALUES {rows}", dice.one(&TABLES), columns.join(", "))
}

fn value(dice: &mut Dice) -> String {
    match dice.below(9) {
        0 => "NULL".to_owned(),
        1 | 2 => format!("'{}'", tables::instant(dice)),
        3 => format!("'{}'", texts::other("bed motion", dice).replace('\'', "''").replace('\0', "")),
        4 => numbers::other(1_235_977_923.0, dice),
        5 => format!("zeroblob({})", dice.size(20_000_000)),
        6 => "x'ff00c328eda080'".to_owned(),
        7 => (*dice.one(&["9e999", "-9e999", "9223372036854775807", "-9223372036854775808", "0.1 + 0.2"])).to_owned(),
        _ => (*dice.one(&["'ON'", "'OFF'", "'movement'", "'stride'", "'kitchen'", "0", "1"])).to_owned(),
    }
}

fn view(dice: &mut Dice) -> String {
    let columns = columns(dice);
    let others: String = columns.iter().skip(1).map(|name| format!("{} AS {name}, ", value(dice))).collect();
    let first = columns.first().copied().unwrap_or("time");
    let body = dice.one(&VIEWS).replacen('%', &others, 1);
    let table = *dice.one(&TABLES);
    let names = columns.iter().skip(1).copied().chain([first]).collect::<Vec<_>>().join(", ");
    let drop = if dice.is(0.7) { format!("DROP TABLE IF EXISTS {table};\n") } else { String::new() };
    format!("{drop}CREATE VIEW {table}({names}) AS {body}")
}

fn special(dice: &mut Dice) -> String {
    let (table, column) = (*dice.one(&TABLES), *dice.one(&COLUMNS));
    match dice.below(9) {
        0 => format!("CREATE VIRTUAL TABLE v{table} USING fts5(time, sensor, value)"),
        1 => format!("DROP TABLE IF EXISTS {table};\nCREATE VIRTUAL TABLE {table} USING fts5(time, sensor, value)"),
        2 => format!(
            "DROP TABLE IF EXISTS {table};\nCREATE VIRTUAL TABLE {table} USING rtree(id, time, sensor, value, at)"
        ),
        3 => format!("DROP TABLE IF EXISTS {table};\nCREATE VIRTUAL TABLE {table} USING dbstat"),
        4 => format!(
            "CREATE TRIGGER t{table} AFTER INSERT ON {table} BEGIN INSERT INTO {table} SELECT * FROM {table}; END"
        ),
        5 => format!("CREATE INDEX i{column} ON {table}({column})"),
        6 => format!("ALTER TABLE {table} ADD COLUMN g AS (zeroblob(100000000)) VIRTUAL"),
        7 => format!("UPDATE {table} SET {column} = {}", value(dice)),
        _ => "PRAGMA writable_schema = ON;\nUPDATE sqlite_schema SET sql = replace(sql, 'TEXT', 'NOTHING')".to_owned(),
    }
}

fn reworded(statement: &str, dice: &mut Dice) -> String {
    let mut words: Vec<String> = statement.split(' ').map(str::to_owned).collect();
    let at = dice.below(words.len());
    words[at] = match dice.below(5) {
        0 => (*dice.one(&TABLES)).to_owned(),
        1 => (*dice.one(&COLUMNS)).to_owned(),
        2 => (*dice.one(&TYPES)).to_owned(),
        3 => format!("{},", value(dice)),
        _ => String::new(),
    };
    words.join(" ")
}

/// Writes nonsense into pages, their heads above all.
fn corrupt(bytes: &mut Vec<u8>, dice: &mut Dice) {
    const PAGE: usize = 4096;
    for _ in 0..dice.size(8) {
        if bytes.is_empty() {
            return;
        }
        let page = dice.below(bytes.len().div_ceil(PAGE)) * PAGE;
        let head = page + if page == 0 { dice.below(120) } else { dice.below(40) };
        let at = if dice.is(0.6) { head } else { dice.below(bytes.len()) }.min(bytes.len() - 1);
        match dice.below(6) {
            0 => bytes[at] ^= 1 << dice.below(8),
            1 => bytes[at] = *dice.one(&[0, 1, 0x7f, 0x80, 0xff]),
            2 => {
                let end = (at + 4).min(bytes.len());
                bytes[at..end].fill(*dice.one(&[0, 0xff]));
            }
            3 if dice.is(0.3) => bytes.truncate(at),
            4 => {
                // A page that stands for another.
                let other = dice.below(bytes.len().div_ceil(PAGE)) * PAGE;
                let copy: Vec<u8> = bytes[other..(other + PAGE).min(bytes.len())].to_vec();
                let end = (page + copy.len()).min(bytes.len());
                bytes[page..end].copy_from_slice(&copy[..end - page]);
            }
            _ => bytes[at] = dice.below(256) as u8,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCRIPT: &str = "CREATE TABLE firing(seq INTEGER, time TEXT, sensor TEXT, value TEXT);\n\
                          INSERT INTO firing VALUES (0, '2009-03-02 07:12:03', 'a', 'ON');\n";

    #[test]
    fn a_script_makes_a_database_and_mutants_are_others() {
        let whole = plain(SCRIPT);
        assert!(whole.starts_with(b"SQLite format 3\0"));
        let mutants: Vec<Vec<u8>> = (0..50).map(|number| database(SCRIPT, &mut Dice::of("sql", 1, number))).collect();
        assert!(mutants.iter().filter(|mutant| **mutant != whole).count() > 25);
        assert_eq!(mutants[7], database(SCRIPT, &mut Dice::of("sql", 1, 7)));
    }
}
