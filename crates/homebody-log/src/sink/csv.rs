//! Comma-separated values with a header line, quoted as RFC 4180 says; lines end in a line feed alone. Of several tables,
//! each has a file of its own: `truth.csv` becomes `truth.room.csv` and so on.

use super::Begin;
use super::text::TextTarget;
use super::text_rows::{CellWriter, TextForm};
use crate::error::LogError;
use crate::table::{BatchRow, Table};
use crate::text;
use csv::{QuoteStyle, Terminator, WriterBuilder};
use homebody_core::scenario::scheme::Scheme;

pub(crate) struct Csv {
    cells: CellWriter,
    spreadsheet_safe: bool,
}

impl TextForm for Csv {
    const SCHEME: Scheme = Scheme::Csv;

    fn begin(_: &TextTarget, begin: &Begin) -> Result<Csv, LogError> {
        Ok(Csv { cells: CellWriter::new(begin.clock()), spreadsheet_safe: begin.spreadsheet_safe })
    }

    fn header(table: &Table) -> Option<String> {
        Some(csv_line(table.columns.iter().map(|column| &*column.name)))
    }

    fn learn(&mut self, _: &TextTarget, text: &str) -> Result<(), LogError> {
        self.cells.texts.push(quoted(&text::spreadsheet_cell(text, self.spreadsheet_safe)));
        Ok(())
    }

    fn line(&mut self, row: &BatchRow, line: &mut Vec<u8>) {
        for (column, cell) in row.cells.iter().enumerate() {
            if column > 0 {
                line.push(b',');
            }
            line.extend_from_slice(self.cells.text(*cell).unwrap_or_default().as_bytes());
        }
    }
}

/// A line of a table, without its end, with quotes around cells that need them.
pub fn csv_line<'c>(cells: impl IntoIterator<Item = &'c str>) -> String {
    cells.into_iter().map(quoted).collect::<Vec<_>>().join(",")
}

/// A field, with quotes if it needs them.
fn quoted(field: &str) -> String {
    let mut writer = WriterBuilder::new()
        .quote_style(QuoteStyle::Necessary)
        .terminator(Terminator::Any(b'\n'))
        .flexible(true)
        .from_writer(Vec::new());
    // The writer would quote a single empty field, since an empty line is not a record.
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
    fn quotes_only_where_needed() {
        assert_eq!(quoted("bedroom motion"), "bedroom motion");
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("the \"old\" one"), "\"the \"\"old\"\" one\"");
        assert_eq!(quoted("two\nlines"), "\"two\nlines\"");
        assert_eq!(quoted(""), "");
        assert_eq!(csv_line(["a b", "", "a,\"b\""]), "a b,,\"a,\"\"b\"\"\"");
    }
}
