//! A JSON object a line, its keys the names of the columns. Of several tables, each has a file of its own, as in CSV.
//!
//! Standard output gets each row at once, so that a pipe is a live feed. A run's file that is not packed has
//! its name from its first row on, so that it can be followed; of a killed run it keeps what was written, perhaps with half a line
//! at its end.

use super::text::{TextSink, TextTarget};
use super::{Begin, Sink, Watermark};
use crate::error::LogError;
use crate::table::{Batch, Cell, InstantWriter, Stamp, TextId, thousandths};
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::RunTime;
use std::io::Write;

/// Text files of an object a line, one for each table.
pub(crate) struct Jsonl {
    at: TextTarget,
    open: Option<OpenJsonl>,
}

struct OpenJsonl {
    tables: Vec<JsonlTable>,
    clock: InstantWriter,
    /// Texts as JSON has them.
    texts: Vec<String>,
    line: Vec<u8>,
    number: String,
}

struct JsonlTable {
    text: TextSink,
    /// What stands before the value of each column: a brace or a comma, and its key.
    keys: Vec<String>,
    rows: u64,
}

impl Jsonl {
    pub fn new(at: TextTarget) -> Jsonl {
        Jsonl { at, open: None }
    }
}

impl Sink for Jsonl {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let places = self.at.of_tables(Scheme::Jsonl, begin.tables)?;
        let mut tables = Vec::new();
        for (table, at) in begin.tables.iter().zip(places) {
            let names = table.columns.iter().map(|column| in_json(&column.name));
            let keys = names.enumerate().map(|(index, name)| format!("{}{name}:", if index == 0 { '{' } else { ',' }));
            tables.push(JsonlTable {
                keys: keys.collect(),
                text: TextSink::begin(&at, begin.how, !begin.is_whole, begin.deadline)?,
                rows: 0,
            });
        }
        let (texts, line, number) = (Vec::new(), Vec::new(), String::new());
        self.open = Some(OpenJsonl { tables, clock: begin.clock(), texts, line, number });
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let stopped = || LogError::Stopped { place: self.at.place() };
        let open = self.open.as_mut().ok_or_else(stopped)?;
        open.texts.extend(batch.texts_from(open.texts.len()).map(|text| in_json(&text)));
        for row in batch.rows() {
            open.line(row.table, row.cells);
            let table = &mut open.tables[row.table];
            table.text.line(&open.line)?;
            table.rows += 1;
        }
        open.tables.iter_mut().try_for_each(|table| table.text.show())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let Some(open) = &mut self.open else { return Ok(Watermark::none()) };
        let mut durable = Vec::new();
        for table in &mut open.tables {
            durable.push(if table.text.make_durable()? { table.rows } else { 0 });
        }
        Ok(Watermark(durable))
    }

    fn finish(&mut self, _end: RunTime) -> Result<(), LogError> {
        let tables = self.open.take().into_iter().flat_map(|open| open.tables);
        tables.map(|table| table.text).try_for_each(TextSink::finish)
    }
}

impl OpenJsonl {
    /// Makes the line of a row.
    fn line(&mut self, table: usize, cells: &[Cell]) {
        let OpenJsonl { tables, clock, texts, line, number } = self;
        line.clear();
        for (key, cell) in tables[table].keys.iter().zip(cells) {
            line.extend_from_slice(key.as_bytes());
            // What is written into a vector arrives.
            let _ = match *cell {
                Cell::Null => write!(line, "null"),
                Cell::Instant(at) => match clock.stamp(at) {
                    Stamp::Text(text) => write!(line, "\"{text}\""),
                    Stamp::Seconds(_) => write!(line, "{}", clock.text(at)),
                    Stamp::Milliseconds(number) => write!(line, "{number}"),
                },
                Cell::Integer(number) => write!(line, "{number}"),
                Cell::Real(number) if number.is_finite() => write!(line, "{number}"),
                Cell::Real(_) => write!(line, "null"),
                Cell::Text(TextId(id)) => line.write_all(texts[id as usize].as_bytes()),
                Cell::Thousandths(value) => {
                    thousandths(value, number);
                    line.write_all(number.as_bytes())
                }
            };
        }
        line.extend_from_slice(b"}\n");
    }
}

/// A text in quotes, as JSON has it.
pub(crate) fn in_json(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
