//! Comma-separated values with a header line, quoted as RFC 4180 says; lines end in a line feed alone. Of several tables,
//! each has a file of its own: `truth.csv` becomes `truth.room.csv` and so on.

use super::text::{TextSink, TextTarget};
use super::{Begin, Sink, Watermark};
use crate::error::LogError;
use crate::table::{Batch, Cell, InstantWriter, TextId, thousandths};
use crate::text;
use csv::{QuoteStyle, Terminator, WriterBuilder};
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::RunTime;

/// Text files of a row a line, one for each table.
pub(crate) struct Csv {
    at: TextTarget,
    is_followed: bool,
    open: Option<OpenCsv>,
}

struct OpenCsv {
    files: Vec<TextSink>,
    clock: InstantWriter,
    /// Texts with quotes where they need them.
    texts: Vec<String>,
    spreadsheet_safe: bool,
    line: Vec<u8>,
    number: String,
    rows: Vec<u64>,
}

impl Csv {
    /// One that `is_followed` has its name from its first line on.
    pub fn new(at: TextTarget, is_followed: bool) -> Csv {
        Csv { at, is_followed, open: None }
    }
}

impl Sink for Csv {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let mut files = Vec::new();
        for (table, at) in begin.tables.iter().zip(self.at.of_tables(Scheme::Csv, begin.tables)?) {
            let mut file = TextSink::begin(&at, begin.how, self.is_followed, begin.deadline)?;
            let header: Vec<String> = table.columns.iter().map(|column| quoted(&column.name)).collect();
            file.line(format!("{}\n", header.join(",")).as_bytes())?;
            files.push(file);
        }
        let rows = vec![0; files.len()];
        let (line, number, texts) = (Vec::new(), String::new(), Vec::new());
        let (clock, spreadsheet_safe) = (begin.clock(), begin.spreadsheet_safe);
        self.open = Some(OpenCsv { files, clock, texts, spreadsheet_safe, line, number, rows });
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let stopped = || LogError::Stopped { place: self.at.place() };
        let OpenCsv { files, clock, texts, spreadsheet_safe, line, number, rows } =
            self.open.as_mut().ok_or_else(stopped)?;
        let cell = |text: &str| quoted(&text::spreadsheet_cell(text, *spreadsheet_safe));
        texts.extend(batch.texts_from(texts.len()).map(|text| cell(&text)));
        for row in batch.rows() {
            line.clear();
            for (column, cell) in row.cells.iter().enumerate() {
                if column > 0 {
                    line.push(b',');
                }
                match *cell {
                    Cell::Null => {}
                    Cell::Instant(at) => line.extend_from_slice(clock.text(at).as_bytes()),
                    Cell::Integer(number) => line.extend_from_slice(number.to_string().as_bytes()),
                    Cell::Real(number) => line.extend_from_slice(number.to_string().as_bytes()),
                    Cell::Text(TextId(id)) => line.extend_from_slice(texts[id as usize].as_bytes()),
                    Cell::Thousandths(value) => {
                        thousandths(value, number);
                        line.extend_from_slice(number.as_bytes());
                    }
                }
            }
            line.push(b'\n');
            files[row.table].line(line)?;
            rows[row.table] += 1;
        }
        files.iter_mut().try_for_each(TextSink::show)
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let Some(open) = &mut self.open else { return Ok(Watermark::none()) };
        let mut durable = Vec::new();
        for (file, &rows) in open.files.iter_mut().zip(&open.rows) {
            durable.push(if file.make_durable()? { rows } else { 0 });
        }
        Ok(Watermark(durable))
    }

    fn finish(&mut self, _end: RunTime) -> Result<(), LogError> {
        self.open.take().into_iter().flat_map(|open| open.files).try_for_each(TextSink::finish)
    }
}

/// A line of a table, without its end: cells in quotes where they need them.
pub fn csv_line<'c>(cells: impl IntoIterator<Item = &'c str>) -> String {
    cells.into_iter().map(quoted).collect::<Vec<_>>().join(",")
}

/// A field, in quotes where it needs them.
fn quoted(field: &str) -> String {
    let mut writer = WriterBuilder::new()
        .quote_style(QuoteStyle::Necessary)
        .terminator(Terminator::Any(b'\n'))
        .flexible(true)
        .from_writer(Vec::new());
    // A field of its own that is empty would be quoted, as a line with nothing in it is no record.
    if field.is_empty() || writer.write_record([field]).is_err() {
        return String::new();
    }
    let written = writer.into_inner().unwrap_or_default();
    String::from_utf8_lossy(&written).trim_end_matches('\n').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_needs_quotes_has_them() {
        assert_eq!(quoted("bedroom motion"), "bedroom motion");
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("the \"old\" one"), "\"the \"\"old\"\" one\"");
        assert_eq!(quoted("two\nlines"), "\"two\nlines\"");
        assert_eq!(quoted(""), "");
        assert_eq!(csv_line(["a b", "", "a,\"b\""]), "a b,,\"a,\"\"b\"\"\"");
    }
}
