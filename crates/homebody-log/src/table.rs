//! Tables: the content of every destination, a log and the truth alike, in one form for writing and for reading.
//!
//! A [`Batch`] is a number of rows in the order of the run, each of one of its tables. Cells are plain numbers; a text is a number, too,
//! which [`Batch::text`] turns back. So a batch is cheap to hand to several destinations.

pub(crate) mod instant_writer;
pub(crate) mod log_row;
pub(crate) mod mapping;
pub(crate) mod rows;
pub mod truth;

use foldhash::HashMap;
use homebody_core::time::RunTime;
pub use instant_writer::InstantWriter;
pub(crate) use instant_writer::Stamp;
pub(crate) use log_row::{LogRow, Messages};
pub(crate) use mapping::{ColumnNames, ShownTexts, apart};
pub use rows::{LogRows, RowText};
use std::sync::Arc;

/// The description of the rows of a log, by which a file of columns is known as one.
pub const LOG: &str = "what a sensor said, as the logger stored it";

/// A kind of rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Of a log, as its mapping calls it; of the truth, always the same.
    pub name: String,
    /// The meaning of a row.
    pub about: &'static str,
    /// Its columns, but for that of the run's id, which the destination adds in front.
    pub columns: Vec<Column>,
    /// Whether the first column numbers the rows of a run, without gaps and from 0: with the run it is the key.
    pub is_numbered: bool,
    /// Whether a day has thousands of rows, so that a few of them may wait for others.
    pub is_frequent: bool,
}

/// One column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// The name in destinations.
    pub name: String,
    /// The type of its cells.
    pub kind: ColumnKind,
    /// The unit of its numbers, such as `m`; empty without one.
    pub unit: &'static str,
    /// Its meaning.
    pub about: &'static str,
}

/// The type of the cells of a column, apart from NULL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// An instant; a destination writes it in the time format of the run's mapping.
    Instant,
    /// A whole number, such as that of a row.
    Integer,
    /// A number with a fraction, in the column's unit.
    Real,
    /// A text, or a number as a sensor said it.
    Text,
}

impl Table {
    /// The place of a column by its name.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }
}

/// One value of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// Nothing: unknown, or it does not apply.
    Null,
    /// An instant of the run.
    Instant(RunTime),
    /// A whole number.
    Integer(i64),
    /// A number with a fraction, in the column's unit.
    Real(f64),
    /// A text, by its number among the batch's texts.
    Text(TextId),
    /// A text that is a number in thousandths: 21500 is `21.5`.
    Thousandths(i32),
}

/// The number of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TextId(pub u32);

/// Texts and their numbers. A text keeps its number for a whole run.
#[derive(Clone, Debug, Default)]
pub struct TextPool {
    all: Arc<Vec<Arc<str>>>,
    known: HashMap<Arc<str>, TextId>,
}

impl TextPool {
    /// The number of a text, a new one if it is new.
    pub fn id(&mut self, text: &str) -> TextId {
        if let Some(&id) = self.known.get(text) {
            return id;
        }
        let id = TextId(self.all.len() as u32);
        let text: Arc<str> = text.into();
        Arc::make_mut(&mut self.all).push(text.clone());
        self.known.insert(text, id);
        id
    }

    /// The numbers of several texts.
    pub fn ids(&mut self, texts: &[String]) -> Vec<TextId> {
        texts.iter().map(|text| self.id(text)).collect()
    }

    /// The number of texts.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }
}

/// Rows in the order of the run.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// By row: its table, and where its cells begin.
    rows: Vec<(u32, u32)>,
    cells: Vec<Cell>,
    /// Of rows of a log: which firing each came from.
    firings: Vec<u64>,
    texts: Arc<Vec<Arc<str>>>,
}

/// One row of a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatchRow<'a> {
    /// Index into the run's tables.
    pub table: usize,
    /// In the order of the table's columns.
    pub cells: &'a [Cell],
    /// Of a row of a log, the firing that it came from; of an OFF that a hold ends with, the last firing that was held.
    pub firing: Option<u64>,
}

impl Batch {
    /// A batch with room for some rows.
    pub fn with_capacity(rows: usize, columns: usize) -> Batch {
        Batch { rows: Vec::with_capacity(rows), cells: Vec::with_capacity(rows * columns), ..Batch::default() }
    }

    /// Adds a row; its cells are in the order of its table's columns.
    pub fn push(&mut self, table: usize, cells: impl IntoIterator<Item = Cell>) {
        self.rows.push((table as u32, self.cells.len() as u32));
        self.cells.extend(cells);
    }

    /// Adds a row of a log that came from a firing. All rows of a batch have one, or none.
    pub fn push_of(&mut self, firing: u64, table: usize, cells: impl IntoIterator<Item = Cell>) {
        self.firings.push(firing);
        self.push(table, cells);
    }

    /// Makes the batch ready to be handed over: its texts are those that are known by now.
    pub fn with(mut self, texts: &TextPool) -> Batch {
        self.texts = texts.all.clone();
        self
    }

    /// The same with the texts of another batch of the same run, which came later.
    pub(crate) fn with_texts_of(mut self, later: &Batch) -> Batch {
        self.texts = later.texts.clone();
        self
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// One of its rows.
    #[inline]
    pub fn row(&self, index: usize) -> BatchRow<'_> {
        let (table, begin) = self.rows[index];
        let end = self.rows.get(index + 1).map_or(self.cells.len(), |&(_, next)| next as usize);
        let firing = self.firings.get(index).copied();
        BatchRow { table: table as usize, cells: &self.cells[begin as usize..end], firing }
    }

    /// Its rows, in the order of the run.
    pub fn rows(&self) -> impl Iterator<Item = BatchRow<'_>> {
        (0..self.len()).map(|index| self.row(index))
    }

    /// The text of a number.
    pub fn text(&self, id: TextId) -> &str {
        &self.texts[id.0 as usize]
    }

    /// The texts from a number on: those that a reader of the earlier ones lacks.
    pub fn texts_from(&self, first: usize) -> impl Iterator<Item = Arc<str>> {
        self.texts.get(first..).unwrap_or_default().iter().cloned()
    }

    /// The batch without rows that are there already: of each table so many are left out, and as many are counted down.
    pub fn beyond(&self, there: &mut [u64]) -> Batch {
        let mut rest = Batch { texts: self.texts.clone(), ..Batch::default() };
        for row in self.rows() {
            match there.get_mut(row.table).filter(|there| **there > 0) {
                Some(there) => *there -= 1,
                None => {
                    rest.firings.extend(row.firing);
                    rest.push(row.table, row.cells.iter().copied());
                }
            }
        }
        rest
    }
}

/// Writes thousandths as a number: `21.5`, `-0.25`, `150`.
pub fn thousandths(number: i32, text: &mut String) {
    use std::fmt::Write;
    text.clear();
    // A string takes whatever is written to it.
    let _ = write!(text, "{}", homebody_core::event::Value::Reading(number));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_their_order_and_their_texts() {
        let mut texts = TextPool::default();
        let (hall, bath) = (texts.id("hall"), texts.id("bath"));
        assert_eq!(texts.id("hall"), hall);
        let mut batch = Batch::default();
        batch.push(0, [Cell::Integer(1), Cell::Text(hall)]);
        batch.push(1, [Cell::Text(bath)]);
        batch.push(0, [Cell::Integer(2), Cell::Text(bath)]);
        let batch = batch.with(&texts);
        let rows: Vec<_> = batch.rows().collect();
        assert_eq!(rows[2].cells, [Cell::Integer(2), Cell::Text(bath)]);
        assert_eq!((rows[1].table, batch.text(bath)), (1, "bath"));
        let mut there = [1, 0];
        let rest = batch.beyond(&mut there);
        assert_eq!(rest.rows().map(|row| row.table).collect::<Vec<_>>(), [1, 0]);
        assert_eq!(there, [0, 0]);
    }
}
