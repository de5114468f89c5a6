//! A JSON object on each line, its keys the names of the columns. Of several tables, each has a file of its own, as in CSV.
//!
//! Standard output gets each row at once, so that a pipe is a live feed. A run's file that is not packed has its name from its first row
//! on, so that others can follow it; a killed run leaves the written rows, perhaps with half a line at its end.

use super::Begin;
use super::text::TextTarget;
use super::text_rows::TextForm;
use crate::error::LogError;
use crate::table::{BatchRow, Cell, InstantWriter, Stamp, TextId, thousandths};
use homebody_core::scenario::scheme::Scheme;
use std::io::Write;

pub(crate) struct Jsonl {
    /// By table, the text before the value of each column: a brace or a comma, and its key.
    keys: Vec<Vec<String>>,
    clock: InstantWriter,
    /// Texts as JSON has them.
    texts: Vec<String>,
    number: String,
}

impl TextForm for Jsonl {
    const SCHEME: Scheme = Scheme::Jsonl;
    const IS_FOLLOWED: bool = true;

    fn begin(_: &TextTarget, begin: &Begin) -> Result<Jsonl, LogError> {
        let keys = begin.tables.iter().map(|table| {
            let names = table.columns.iter().map(|column| in_json(&column.name));
            names.enumerate().map(|(index, name)| format!("{}{name}:", if index == 0 { '{' } else { ',' })).collect()
        });
        Ok(Jsonl { keys: keys.collect(), clock: begin.clock(), texts: Vec::new(), number: String::new() })
    }

    fn learn(&mut self, _: &TextTarget, text: &str) -> Result<(), LogError> {
        self.texts.push(in_json(text));
        Ok(())
    }

    fn line(&mut self, row: &BatchRow, line: &mut Vec<u8>) {
        for (key, cell) in self.keys[row.table].iter().zip(row.cells) {
            line.extend_from_slice(key.as_bytes());
            // A vector takes all that is written to it.
            let _ = match *cell {
                Cell::Null => write!(line, "null"),
                Cell::Instant(at) => match self.clock.stamp(at) {
                    Stamp::Text(text) => write!(line, "\"{text}\""),
                    Stamp::Seconds(_) => write!(line, "{}", self.clock.text(at)),
                    Stamp::Milliseconds(number) => write!(line, "{number}"),
                },
                Cell::Integer(number) => write!(line, "{number}"),
                Cell::Real(number) if number.is_finite() => write!(line, "{number}"),
                Cell::Real(_) => write!(line, "null"),
                Cell::Text(TextId(id)) => line.write_all(self.texts[id as usize].as_bytes()),
                Cell::Thousandths(value) => {
                    thousandths(value, &mut self.number);
                    line.write_all(self.number.as_bytes())
                }
            };
        }
        line.push(b'}');
    }
}

pub(crate) fn in_json(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
