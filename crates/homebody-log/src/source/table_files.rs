//! Tables in files of text, one for each: comma-separated values, and JSON Lines.

use super::{LineReader, RecordReader, TakeTruthRow, TruthValue};
use crate::error::{LogError, TruthMessage, place_of};
use crate::table::{Column, ColumnKind, Table};
use crate::text::unescaped;
use crate::url::{Url, table_file};
use serde_json::{Map, Value as Json};
use std::borrow::Cow;
use std::path::{Path, PathBuf};

type TakeValues<'t> = dyn FnMut(&[TruthValue<'_>]) -> Result<(), LogError> + 't;

/// Reads the columns of a table from a file of text.
pub(crate) type ReadTable = fn(&Path, &Table, &mut TakeValues<'_>) -> Result<(), LogError>;

/// Reads tables that have a file each.
pub(crate) fn read_files(
    url: &Url,
    wanted: &[&Table],
    read: ReadTable,
    take: &mut TakeTruthRow<'_>,
) -> Result<(), LogError> {
    let files = files(url, wanted)?;
    files.iter().enumerate().try_for_each(|(index, (table, path))| read(path, table, &mut |row| take(index, row)))
}

pub(crate) fn read_csv(path: &Path, table: &Table, take: &mut TakeValues<'_>) -> Result<(), LogError> {
    let mut records = RecordReader::open(path)?;
    let header: Vec<String> = records.next(&mut |_| false)?.map(|(_, names)| names.texts()).unwrap_or_default();
    let mut places = Vec::new();
    for column in &table.columns {
        let place = header.iter().position(|name| *name == column.name);
        places.push((column, place.ok_or_else(|| no_column(path, column))?));
    }
    while let Some((line, row)) = records.next(&mut |_| false)? {
        let texts: Option<Vec<Cow<str>>> =
            places.iter().map(|(_, place)| row.get(*place).map(String::from_utf8_lossy)).collect();
        let texts = texts.filter(|_| !row.is_broken).ok_or_else(|| no_row(path, line, table))?;
        let cells = places.iter().zip(&texts).map(|((column, _), text)| cell(column.kind, text));
        let values: Option<Vec<TruthValue>> = cells.collect();
        take(&values.ok_or_else(|| no_row(path, line, table))?)?;
    }
    Ok(())
}

pub(crate) fn read_jsonl(path: &Path, table: &Table, take: &mut TakeValues<'_>) -> Result<(), LogError> {
    let mut lines = LineReader::open(path)?;
    while let Some((line, text)) = lines.next()? {
        if text.trim_ascii().is_empty() {
            continue;
        }
        let object: Map<String, Json> = serde_json::from_slice(text).map_err(|_| no_row(path, line, table))?;
        let mut values = Vec::with_capacity(table.columns.len());
        for column in &table.columns {
            let said = object.get(&column.name).ok_or_else(|| no_column(path, column))?;
            values.push(value(column.kind, said).ok_or_else(|| no_row(path, line, table))?);
        }
        take(&values)?;
    }
    Ok(())
}

/// The file of each table, or all that are missing.
fn files<'t>(url: &Url, wanted: &[&'t Table]) -> Result<Vec<(&'t Table, PathBuf)>, LogError> {
    let files: Vec<(&Table, PathBuf)> =
        wanted.iter().map(|&table| (table, table_file(url.path(), &table.name))).collect();
    let missing = files.iter().filter(|(_, file)| !file.is_file());
    let missing: Vec<String> = missing.map(|(_, file)| format!("no file {}", place_of(file))).collect();
    match missing.is_empty() {
        true => Ok(files),
        false => Err(LogError::no_truth(url.to_string(), TruthMessage::Missing { missing })),
    }
}

/// What a cell says; None where it is no cell of such a column.
fn cell<'c>(kind: ColumnKind, text: &'c str) -> Option<TruthValue<'c>> {
    Some(match kind {
        _ if text.is_empty() => TruthValue::Null,
        ColumnKind::Integer => TruthValue::Integer(text.parse().ok()?),
        ColumnKind::Real => TruthValue::Real(text.parse().ok()?),
        ColumnKind::Instant => TruthValue::Text(text),
        ColumnKind::Text => TruthValue::Text(unescaped(text)),
    })
}

/// The same of what an object says.
fn value(kind: ColumnKind, said: &Json) -> Option<TruthValue<'_>> {
    Some(match (kind, said) {
        (_, Json::Null) => TruthValue::Null,
        (ColumnKind::Instant | ColumnKind::Text, Json::String(text)) => TruthValue::Text(text),
        (ColumnKind::Integer, Json::Number(number)) => TruthValue::Integer(number.as_i64()?),
        // Milliseconds are whole, seconds are not.
        (ColumnKind::Instant, Json::Number(number)) if number.is_i64() => TruthValue::Integer(number.as_i64()?),
        (ColumnKind::Real | ColumnKind::Instant, Json::Number(number)) => TruthValue::Real(number.as_f64()?),
        _ => return None,
    })
}

fn no_column(path: &Path, column: &Column) -> LogError {
    LogError::no_truth(place_of(path), TruthMessage::NoColumn { column: column.name.clone() })
}

fn no_row(path: &Path, line: u64, table: &Table) -> LogError {
    LogError::no_truth(place_of(path), TruthMessage::BadRow { line, table: table.name.clone() })
}
