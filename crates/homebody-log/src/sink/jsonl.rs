//! A JSON object on each line, its keys the names of the columns. Of several tables, each has a file of its own, as in CSV.
//!
//! Standard output gets each row at once, so that a pipe is a live feed. A run's file that is not packed has its name from its first row
//! on, so that others can follow it; a killed run leaves the written rows, perhaps with half a line at its end.

use super::Begin;
use super::text::TextTarget;
use super::text_rows::{CellWriter, TextForm};
use crate::error::LogError;
use crate::table::{BatchRow, Cell, InstantWriter};
use homebody_core::scenario::scheme::Scheme;

pub(crate) struct Jsonl {
    /// By table, the text before the value of each column: a brace or a comma, and its key.
    keys: Vec<Vec<String>>,
    cells: CellWriter,
    quote: &'static str,
}

impl TextForm for Jsonl {
    const SCHEME: Scheme = Scheme::Jsonl;
    const IS_FOLLOWED: bool = true;

    fn begin(_: &TextTarget, begin: &Begin) -> Result<Jsonl, LogError> {
        let keys = begin.tables.iter().map(|table| {
            let names = table.columns.iter().map(|column| in_json(&column.name));
            names.enumerate().map(|(index, name)| format!("{}{name}:", if index == 0 { '{' } else { ',' })).collect()
        });
        let clock = begin.clock();
        Ok(Jsonl { keys: keys.collect(), quote: quote(&clock), cells: CellWriter::new(clock) })
    }

    fn learn(&mut self, _: &TextTarget, text: &str) -> Result<(), LogError> {
        self.cells.texts.push(in_json(text));
        Ok(())
    }

    fn line(&mut self, row: &BatchRow, line: &mut Vec<u8>) {
        for (key, &cell) in self.keys[row.table].iter().zip(row.cells) {
            line.extend_from_slice(key.as_bytes());
            let quote = if matches!(cell, Cell::Instant(_)) { self.quote } else { "" };
            // JSON has no other numbers.
            let cell = if matches!(cell, Cell::Real(number) if !number.is_finite()) { Cell::Null } else { cell };
            let text = self.cells.text(cell).unwrap_or("null");
            [quote, text, quote].iter().for_each(|part| line.extend_from_slice(part.as_bytes()));
        }
        line.push(b'}');
    }
}

/// The mark around an instant, which is a text or a number.
pub(crate) fn quote(clock: &InstantWriter) -> &'static str {
    if clock.writes_numbers() { "" } else { "\"" }
}

pub(crate) fn in_json(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
