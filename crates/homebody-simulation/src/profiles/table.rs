//! A table as spreadsheets save it: values separated by commas, semicolons or tabs, each with its place in the text.

use super::messages::ProfileMessage;
use csv_core::{ReadFieldResult, ReaderBuilder, Terminator};
use homebody_core::problem::{Diagnostic, Excerpt, Problem};

pub(crate) struct ProfileTable<'t> {
    file: &'t str,
    lines: Vec<&'t str>,
    pub header: Vec<TableCell>,
    /// The rows that are not empty.
    pub rows: Vec<Vec<TableCell>>,
}

/// A cell of a table, without the blanks around its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TableCell {
    pub text: String,
    /// Both counted from 1, the column in characters.
    line: u32,
    column: u32,
}

impl<'t> ProfileTable<'t> {
    /// Reads a text whose first line that is not empty names the columns.
    pub fn read(file: &'t str, text: &'t str) -> Result<ProfileTable<'t>, Problem> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut table = ProfileTable { file, lines: text.lines().collect(), header: Vec::new(), rows: Vec::new() };
        let first = table.lines.iter().find(|line| !line.trim().is_empty()).copied().unwrap_or_default();
        // Spreadsheets with decimal commas separate cells by semicolons.
        let count = |mark: char| first.matches(mark).count();
        let mark = [',', ';', '\t'].into_iter().rev().max_by_key(|&mark| count(mark)).unwrap_or(',');
        let mut rows = match cells(text, mark) {
            Ok(rows) => rows.into_iter().filter(|row| row.iter().any(|cell| !cell.text.is_empty())),
            Err(cell) => return Err(table.problem(&cell, ProfileMessage::OpenQuote, None)),
        };
        table.header = rows.next().unwrap_or_default();
        table.rows = rows.collect();
        Ok(table)
    }

    /// A problem with a cell.
    pub fn problem(&self, cell: &TableCell, message: impl Into<Diagnostic>, hint: Option<String>) -> Problem {
        let line = self.lines.get(cell.line as usize - 1).copied().unwrap_or_default();
        let at = line.char_indices().nth(cell.column as usize - 1).map_or(line.len(), |(at, _)| at);
        let excerpt = Excerpt::around(line, at).underlining(cell.text.chars().count());
        let TableCell { line, column, .. } = *cell;
        Problem { line, column, excerpt: Some(excerpt), ..Problem::of_file(self.file, message, hint) }
    }

    /// A problem with the file as a whole.
    pub fn problem_of_file(&self, message: impl Into<Diagnostic>) -> Problem {
        Problem::of_file(self.file, message, None)
    }
}

impl TableCell {
    /// Its parts between plus signs, each at its place.
    pub fn parts(&self) -> Vec<TableCell> {
        let mut column = self.column;
        let part = |text: &str| {
            let blanks = text.chars().take_while(|c| c.is_whitespace()).count() as u32;
            let part = TableCell { text: text.trim().into(), line: self.line, column: column + blanks };
            column += text.chars().count() as u32 + 1;
            part
        };
        self.text.split('+').map(part).collect()
    }
}

/// The cells of all lines, and the cell without a closing quote, if there is one.
fn cells(text: &str, mark: char) -> Result<Vec<Vec<TableCell>>, TableCell> {
    // The first character of "\r\n" is a blank at the end of a cell.
    let mut reader = ReaderBuilder::new().delimiter(mark as u8).terminator(Terminator::Any(b'\n')).build();
    // No cell is longer than the text.
    let mut unquoted = vec![0; text.len()];
    let mut place = TextPlace { rest: text, line: 1, column: 1 };
    let (mut rows, mut row) = (Vec::new(), Vec::new());
    loop {
        let is_blank = |c: char| c.is_whitespace() && c != mark && c != '\n';
        while row.is_empty() && place.rest.trim_start_matches(is_blank).starts_with('\n') {
            place.pass(place.rest.find('\n').map_or(0, |end| end + 1));
        }
        let begin = place;
        place.pass(place.rest.len() - place.rest.trim_start_matches(is_blank).len());
        let first = place;
        let (mut result, read, mut length) = reader.read_field(place.rest.as_bytes(), &mut unquoted);
        place.pass(read);
        if result == ReadFieldResult::InputEmpty {
            let more;
            (result, _, more) = reader.read_field(&[], &mut unquoted[length..]);
            length += more;
        }
        let ReadFieldResult::Field { record_end } = result else { return Ok(rows) };
        let text = str::from_utf8(&unquoted[..length]).expect("a text cut at marks of one byte is a text");
        let blanks = text.len() - text.trim_start().len();
        let mut at = if text.trim().is_empty() { begin } else { first };
        let quoted = first.rest.strip_prefix('"').map(|quoted| &quoted[..read - 1]);
        if quoted.is_some() {
            at = first;
            at.pass(1);
        }
        // A doubled quote is part of the cell; a single one closes it.
        if quoted.is_some_and(|quoted| !quoted.replace("\"\"", "").contains('"')) {
            return Err(TableCell { text: text.into(), line: at.line, column: at.column });
        }
        if !text.trim().is_empty() {
            at.column += text[..blanks].chars().count() as u32;
        }
        row.push(TableCell { text: text.trim().into(), line: at.line, column: at.column });
        if record_end {
            rows.push(std::mem::take(&mut row));
        }
    }
}

/// A place in a text, both counted from 1.
#[derive(Clone, Copy)]
struct TextPlace<'t> {
    rest: &'t str,
    line: u32,
    column: u32,
}

impl TextPlace<'_> {
    /// Moves by so many bytes.
    fn pass(&mut self, bytes: usize) {
        let (passed, rest) = self.rest.split_at(bytes);
        match passed.rsplit_once('\n') {
            Some((before, last)) => {
                self.line += 1 + before.matches('\n').count() as u32;
                self.column = 1 + last.chars().count() as u32;
            }
            None => self.column += passed.chars().count() as u32,
        }
        self.rest = rest;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(row: &[TableCell]) -> Vec<&str> {
        row.iter().map(|cell| cell.text.as_str()).collect()
    }

    #[test]
    fn reads_each_separator_of_spreadsheets() {
        for mark in [",", ";", "\t"] {
            let text = "\u{feff}\r\nname,age\r\nanna , \"8\"\"2\"\r\n,\r\n\nbea,\n".replace(',', mark);
            let table = ProfileTable::read("a.csv", &text).unwrap();
            assert_eq!(texts(&table.header), ["name", "age"]);
            let rows: Vec<_> = table.rows.iter().map(|row| texts(row)).collect();
            assert_eq!(rows, [["anna", "8\"2"], ["bea", ""]]);
        }
        let table = ProfileTable::read("a.csv", "name\nanna\n\"b,\nc\"\n").unwrap();
        assert_eq!((texts(&table.rows[0]), texts(&table.rows[1])), (vec!["anna"], vec!["b,\nc"]));
        assert!(ProfileTable::read("a.csv", " \n\n").unwrap().header.is_empty());
    }

    #[test]
    fn every_cell_knows_its_place() {
        let table = ProfileTable::read("a.csv", "name,age\n  Öz, \"82\" , x + yy\n").unwrap();
        let places: Vec<_> = table.rows[0].iter().map(|cell| (cell.line, cell.column)).collect();
        assert_eq!(places, [(2, 3), (2, 8), (2, 14)]);
        let parts: Vec<_> = table.rows[0][2].parts().into_iter().map(|cell| (cell.text, cell.column)).collect();
        assert_eq!(parts, [("x".to_owned(), 14), ("yy".to_owned(), 18)]);
        let problem = table.problem(&table.rows[0][0], ProfileMessage::NoName, None);
        assert_eq!((problem.line, problem.column), (2, 3));
        assert_eq!(problem.excerpt.map(|excerpt| (excerpt.before, excerpt.width)), Some((2, 2)));
    }

    #[test]
    fn finds_the_start_of_an_unclosed_cell() {
        let problem = ProfileTable::read("a.csv", "name,age\nanna,\"82\nbea,80\n").err().unwrap();
        assert_eq!((problem.line, problem.column), (2, 7));
    }
}
