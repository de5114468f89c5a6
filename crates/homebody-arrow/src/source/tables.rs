//! The tables of a truth, read by their names: a file for each, or a folder of a data set.

use super::batches::OpenedTable;
use super::cells::{TextCells, TimeCell, Times};
use super::files::files;
use super::here::here;
use super::rows::each_batch;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, ArrayRef, Float64Array, Int64Array};
use arrow_schema::Schema;
use homebody_log::error::TruthMessage;
use homebody_log::source::{TakeTruthRow, TruthValue};
use homebody_log::table::{Column, ColumnKind, Table};
use homebody_log::url::table_file;
use homebody_log::{LogError, Url};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

pub(crate) fn read_tables(url: &Url, wanted: &[&Table], take: &mut TakeTruthRow<'_>) -> Result<(), LogError> {
    let (_kept, folder) = here(url.path())?;
    let named = url;
    let url = &Url::new(url.scheme(), folder);
    let places: Vec<PathBuf> = wanted.iter().map(|table| place(url, table)).collect();
    let gone = places.iter().filter(|place| !place.exists());
    let what = if url.is_data_set() { "folder" } else { "file" };
    let missing: Vec<String> = gone.map(|place| format!("no {what} {}", place.display())).collect();
    if !missing.is_empty() {
        return Err(LogError::no_truth(named.to_string(), TruthMessage::Missing { missing }));
    }
    for (index, (table, place)) in wanted.iter().zip(&places).enumerate() {
        let files = files(place).map_err(|error| match error {
            LogError::NoLog(reason) => LogError::no_truth(named.to_string(), *reason.why),
            error => error,
        })?;
        for file in files {
            read_file(&file, table, &mut |values| take(index, values))?;
        }
    }
    Ok(())
}

/// The place of a table. One run of several is named by its folder, such as `truth/run=5`, though each table has such a folder.
fn place(url: &Url, table: &Table) -> PathBuf {
    let path = url.path();
    let is_run = |name: &&OsStr| name.to_string_lossy().starts_with("run=");
    match (url.is_data_set(), path.file_name().filter(is_run)) {
        (false, _) => table_file(path, &table.name),
        (true, Some(run)) => path.with_file_name(&table.name).join(run),
        (true, None) => path.join(&table.name),
    }
}

fn read_file(
    path: &Path,
    table: &Table,
    take: &mut dyn FnMut(&[TruthValue<'_>]) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let opened = OpenedTable::open(path)?;
    let no_truth = |why: TruthMessage| LogError::no_truth(path.display().to_string(), why);
    let columns = places(&opened.schema, table).map_err(no_truth)?;
    each_batch(path, opened, &columns, &mut |rows, arrays| {
        let mut columns = Vec::with_capacity(arrays.len());
        for (array, column) in arrays.iter().zip(&table.columns) {
            let typed = || no_truth(TruthMessage::ColumnType { column: column.name.clone() });
            columns.push(TruthCells::from_array(array, column.kind).ok_or_else(typed)?);
        }
        // Buffers for cells that are built, such as a number that is read as text.
        let mut buffers = vec![String::new(); columns.len()];
        for row in 0..rows {
            let values: Option<Vec<TruthValue>> =
                columns.iter().zip(&mut buffers).map(|(cells, buffer)| cells.get(row, buffer)).collect();
            take(&values.ok_or_else(|| no_truth(TruthMessage::InstantOutOfRange))?)?;
        }
        Ok(())
    })
}

/// The places of the columns of a table in a file, or all missing columns.
fn places(schema: &Schema, table: &Table) -> Result<Vec<usize>, TruthMessage> {
    let place = |column: &Column| schema.fields().iter().position(|field| *field.name() == column.name);
    let missing = table.columns.iter().filter(|column| place(column).is_none());
    let missing: Vec<String> = missing.map(|column| format!("no column {:?}", column.name)).collect();
    match missing.is_empty() {
        true => Ok(table.columns.iter().filter_map(place).collect()),
        false => Err(TruthMessage::Missing { missing }),
    }
}

enum TruthCells<'a> {
    Instants(&'a ArrayRef, Times<'a>),
    Integers(&'a Int64Array),
    Reals(&'a Float64Array),
    Texts(&'a ArrayRef, TextCells<'a>),
}

impl<'a> TruthCells<'a> {
    fn from_array(array: &'a ArrayRef, kind: ColumnKind) -> Option<TruthCells<'a>> {
        Some(match kind {
            ColumnKind::Instant => TruthCells::Instants(array, Times::from_array(array)?),
            ColumnKind::Integer => TruthCells::Integers(array.as_primitive_opt::<Int64Type>()?),
            ColumnKind::Real => TruthCells::Reals(array.as_primitive_opt::<Float64Type>()?),
            ColumnKind::Text => TruthCells::Texts(array, TextCells::from_array(array)?),
        })
    }

    /// The cell of a row; None for an invalid instant.
    fn get<'b>(&'b self, row: usize, buffer: &'b mut String) -> Option<TruthValue<'b>> {
        let is_null = match self {
            TruthCells::Instants(array, _) | TruthCells::Texts(array, _) => array.is_null(row),
            TruthCells::Integers(array) => array.is_null(row),
            TruthCells::Reals(array) => array.is_null(row),
        };
        if is_null {
            return Some(TruthValue::Null);
        }
        Some(match self {
            TruthCells::Integers(array) => TruthValue::Integer(array.value(row)),
            TruthCells::Reals(array) => TruthValue::Real(array.value(row)),
            TruthCells::Texts(_, texts) => TruthValue::Text(texts.get(row, buffer)),
            TruthCells::Instants(_, times) => match times.get(row, buffer) {
                TimeCell::At(at) => TruthValue::Instant(at),
                TimeCell::Text(text) => TruthValue::Text(text),
                TimeCell::OutOfRange => return None,
            },
        })
    }
}
