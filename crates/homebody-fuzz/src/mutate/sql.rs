//! Databases made of hostile SQL: odd types, views, triggers, virtual tables, large values; and corrupt pages.

use super::{numbers, texts, word};
use crate::choices::Choices;
use rusqlite::Connection;
use std::fs;
use std::path::Path;

/// Changes a script, and makes a database of it, which may be partly corrupt. A statement ends with a semicolon at the
/// end of a line.
pub fn database(script: &str, choices: &mut Choices) -> Vec<u8> {
    let mut statements: Vec<String> = split(script);
    for _ in 0..choices.size(5) {
        once(&mut statements, choices);
    }
    if choices.is(0.15) {
        statements.insert(0, word(choices, "pragmas").to_owned());
    }
    let mut bytes = made(&statements);
    if choices.is(0.4) {
        corrupt(&mut bytes, choices);
    }
    bytes
}

/// The database of an unchanged script.
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
        // A mutant may be invalid SQL; the other statements are valid.
        let _ = connection.execute_batch(statement);
    }
    Ok(())
}

fn once(statements: &mut Vec<String>, choices: &mut Choices) {
    let at = choices.below(statements.len() + 1);
    let new = match choices.below(9) {
        0 => table(choices),
        1 | 2 => row(choices),
        3 => view(choices),
        4 => special(choices),
        5 | 6 => {
            if let Some(statement) = statements.get_mut(at) {
                *statement = reworded(statement, choices);
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
            let (from, to) = (word(choices, "tables"), word(choices, "tables"));
            format!("ALTER TABLE \"{from}\" RENAME TO \"{to}\"")
        }
    };
    // The last statements find the earlier tables.
    statements.insert(if choices.is(0.7) { statements.len() } else { at }, new);
}

fn columns(choices: &mut Choices) -> Vec<&'static str> {
    let mut columns: Vec<&str> = (0..choices.size(12)).map(|_| word(choices, "columns")).collect();
    if choices.is(0.5) {
        columns.splice(0..0, ["time", "sensor", "value"]);
    }
    columns.dedup();
    columns
}

fn table(choices: &mut Choices) -> String {
    let columns: Vec<String> =
        columns(choices).iter().map(|name| format!("{name} {}", word(choices, "types"))).collect();
    let end = choices.one(&["", "", "", " WITHOUT ROWID", " STRICT"]);
    let key = if end.contains("WITHOUT") { ", PRIMARY KEY (time, sensor)" } else { "" };
    format!("CREATE TABLE {}({}{key}){end}", word(choices, "tables"), columns.join(", "))
}

/// Rows of one shape, up to some hundreds.
fn row(choices: &mut Choices) -> String {
    let columns = columns(choices);
    let values: Vec<String> = columns.iter().map(|_| value(choices)).collect();
    let length = values.iter().map(String::len).sum();
    let times = if choices.is(0.2) { choices.size(super::times(length, 300)) } else { 1 };
    let rows = vec![format!("({})", values.join(", ")); times].join(", ");
    format!("INSERT OR IGNORE INTO {}({}) VALUES {rows}", word(choices, "tables"), columns.join(", "))
}

fn value(choices: &mut Choices) -> String {
    match choices.below(9) {
        0 => "NULL".to_owned(),
        1 | 2 => format!("'{}'", word(choices, "instants")),
        3 => format!("'{}'", texts::other("bed motion", choices).replace('\'', "''").replace('\0', "")),
        4 => numbers::other(1_235_977_923.0, choices),
        5 => format!("zeroblob({})", choices.size(20_000_000)),
        6 => "x'ff00c328eda080'".to_owned(),
        7 => {
            (*choices.one(&["9e999", "-9e999", "9223372036854775807", "-9223372036854775808", "0.1 + 0.2"])).to_owned()
        }
        _ => (*choices.one(&["'ON'", "'OFF'", "'movement'", "'stride'", "'kitchen'", "0", "1"])).to_owned(),
    }
}

fn view(choices: &mut Choices) -> String {
    let columns = columns(choices);
    let others: String = columns.iter().skip(1).map(|name| format!("{} AS {name}, ", value(choices))).collect();
    let first = columns.first().copied().unwrap_or("time");
    let body = word(choices, "views").replacen('%', &others, 1);
    let table = word(choices, "tables");
    let names = columns.iter().skip(1).copied().chain([first]).collect::<Vec<_>>().join(", ");
    let drop = if choices.is(0.7) { format!("DROP TABLE IF EXISTS {table};\n") } else { String::new() };
    format!("{drop}CREATE VIEW {table}({names}) AS {body}")
}

fn special(choices: &mut Choices) -> String {
    let (table, column) = (word(choices, "tables"), word(choices, "columns"));
    match choices.below(9) {
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
        7 => format!("UPDATE {table} SET {column} = {}", value(choices)),
        _ => "PRAGMA writable_schema = ON;\nUPDATE sqlite_schema SET sql = replace(sql, 'TEXT', 'NOTHING')".to_owned(),
    }
}

fn reworded(statement: &str, choices: &mut Choices) -> String {
    let mut words: Vec<String> = statement.split(' ').map(str::to_owned).collect();
    let at = choices.below(words.len());
    words[at] = match choices.below(5) {
        0 => word(choices, "tables").to_owned(),
        1 => word(choices, "columns").to_owned(),
        2 => word(choices, "types").to_owned(),
        3 => format!("{},", value(choices)),
        _ => String::new(),
    };
    words.join(" ")
}

/// Writes random bytes into pages, mostly into their headers.
fn corrupt(bytes: &mut Vec<u8>, choices: &mut Choices) {
    const PAGE: usize = 4096;
    for _ in 0..choices.size(8) {
        if bytes.is_empty() {
            return;
        }
        let page = choices.below(bytes.len().div_ceil(PAGE)) * PAGE;
        let head = page + if page == 0 { choices.below(120) } else { choices.below(40) };
        let at = if choices.is(0.6) { head } else { choices.below(bytes.len()) }.min(bytes.len() - 1);
        match choices.below(6) {
            0 => bytes[at] ^= 1 << choices.below(8),
            1 => bytes[at] = *choices.one(&[0, 1, 0x7f, 0x80, 0xff]),
            2 => {
                let end = (at + 4).min(bytes.len());
                bytes[at..end].fill(*choices.one(&[0, 0xff]));
            }
            3 if choices.is(0.3) => bytes.truncate(at),
            4 => {
                // One page in place of another.
                let other = choices.below(bytes.len().div_ceil(PAGE)) * PAGE;
                let copy: Vec<u8> = bytes[other..(other + PAGE).min(bytes.len())].to_vec();
                let end = (page + copy.len()).min(bytes.len());
                bytes[page..end].copy_from_slice(&copy[..end - page]);
            }
            _ => bytes[at] = choices.below(256) as u8,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices;

    const SCRIPT: &str = "CREATE TABLE firing(seq INTEGER, time TEXT, sensor TEXT, value TEXT);\n\
                          INSERT INTO firing VALUES (0, '2009-03-02 07:12:03', 'a', 'ON');\n";

    #[test]
    fn mutants_of_a_script_make_other_databases() {
        let whole = plain(SCRIPT);
        assert!(whole.starts_with(b"SQLite format 3\0"));
        let mutants: Vec<Vec<u8>> =
            (0..50).map(|number| database(SCRIPT, &mut Choices::new(&choices::bytes(number)))).collect();
        assert!(mutants.iter().filter(|mutant| **mutant != whole).count() > 25);
        assert_eq!(mutants[7], database(SCRIPT, &mut Choices::new(&choices::bytes(7))));
    }
}
