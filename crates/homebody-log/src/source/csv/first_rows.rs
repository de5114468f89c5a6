//! The first rows of a table: where its heading is, and the cells of each column.

use super::cells::{CellCounts, Reads};
use super::heading::{NumberedRow, TableBeginning};
use crate::error::LogError;
use crate::source::columns::ColumnPlaces;
use crate::source::instant::date_parts::no_such_day;
use crate::source::records::{Record, RecordReader};
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

/// Largest number of rows that are examined.
const MOST_ROWS: usize = 1000;

/// Largest number of bytes of these rows: rows of a thousand columns are long.
const MOST_BYTES: usize = 4 << 20;

pub(crate) struct FirstRows {
    /// The headings of the columns; without a heading their places, such as `column 2`.
    pub names: Vec<String>,
    pub has_heading: bool,
    /// The line of the first row behind the heading.
    pub first_line: u64,
    pub rows: Vec<Vec<String>>,
    /// By column.
    pub cells: Vec<CellCounts>,
    /// The number of rows with more cells than the heading has names, and a text in one of them.
    pub longer: usize,
    /// Remarks on the lines above them.
    pub remarks: Vec<String>,
}

impl FirstRows {
    /// Those of a file; `None` of an empty one.
    pub fn read(path: &Path, file: &LoggerFile) -> Result<Option<FirstRows>, LogError> {
        let mut records = RecordReader::open(path)?;
        let mut reads = Reads::new();
        let (mut rows, mut bytes) = (Vec::new(), 0);
        let mut has_instant = |alone: &Record| alone.texts().iter().any(|cell| reads.moment(cell, None).is_some());
        while rows.len() <= MOST_ROWS && bytes < MOST_BYTES {
            let Some((line, record)) = records.next(&mut has_instant)? else { break };
            let cells = record.texts();
            if cells.iter().any(|cell| !cell.is_empty()) {
                bytes += cells.iter().map(|cell| cell.len() + size_of::<String>()).sum::<usize>();
                rows.push((line, cells));
            }
        }
        let mut judged = Reads::new();
        let mut is_heading = |row: &[String]| ColumnPlaces::by_name(row, file).is_some() || !is_row(row, &mut judged);
        let Some(beginning) = TableBeginning::find(&rows, &mut is_heading, &mut reads) else { return Ok(None) };
        Ok(Some(FirstRows::parted(rows, beginning, &mut reads)))
    }

    fn parted(mut all: Vec<NumberedRow>, beginning: TableBeginning, reads: &mut Reads) -> FirstRows {
        let TableBeginning { names, first, remarks } = beginning;
        let behind = all.split_off(first);
        let line = all.last().map_or(1, |(line, _)| line + 1);
        let first_line = behind.first().map_or(line, |(line, _)| *line);
        let (has_heading, named) = (names.is_some(), names.unwrap_or_default());
        let rows: Vec<Vec<String>> = behind.into_iter().map(|(_, row)| row).collect();
        let is_longer = |row: &&Vec<String>| row.iter().skip(named.len()).any(|cell| !cell.is_empty());
        let longer = if has_heading { rows.iter().filter(is_longer).count() } else { 0 };
        let width = rows.iter().map(Vec::len).max().unwrap_or(0).max(named.len());
        let name = |place: usize| match named.get(place) {
            Some(name) if !name.is_empty() => name.clone(),
            _ => format!("column {}", place + 1),
        };
        let column = |place: usize| rows.iter().map(move |row| row.get(place).map_or("", String::as_str));
        let cells = (0..width).map(|place| CellCounts::count(column(place), reads)).collect();
        FirstRows { names: (0..width).map(name).collect(), has_heading, first_line, cells, rows, longer, remarks }
    }

    pub fn column(&self, place: usize) -> impl Iterator<Item = &str> {
        self.rows.iter().map(move |row| row.get(place).map_or("", String::as_str))
    }
}

/// Whether a first line is a row: an instant is in it, a day that no month has, a date and a time of day, or numbers are without a name.
fn is_row(cells: &[String], reads: &mut Reads) -> bool {
    let of: Vec<CellCounts> =
        cells.iter().map(|cell| CellCounts::count(std::iter::once(cell.as_str()), reads)).collect();
    let any = |is: fn(&CellCounts) -> usize| of.iter().any(|cell| is(cell) > 0);
    let names = of.iter().filter(|cell| cell.filled > 0 && cell.numbers == 0).count();
    let is_no_day = |cell: &String| no_such_day(cell).is_some();
    any(CellCounts::moments)
        || cells.iter().any(is_no_day)
        || any(|cell| cell.dates) && any(|cell| cell.times)
        || names == 0
}
