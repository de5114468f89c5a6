//! Rows of comma-separated values, each at most as long as a row may be.
//!
//! A cell in quotes may continue over several lines. A quote that is never closed would make a row of all that follows: so a row ends with
//! its first line, and is reported as broken, if the next line looks like a row or no quote comes soon.

use super::lines::LineReader;
use super::start::FileStart;
use crate::error::{LengthMessage, LogError};
use crate::files::plain::text;
use crate::limits::{LONGEST_ROW_BYTES, MOST_CELLS, MOST_LINES_OF_ROW};
use std::borrow::Cow;
use std::collections::VecDeque;
use std::ops::Range;
use std::path::{Path, PathBuf};

pub(crate) struct RecordReader {
    path: PathBuf,
    lines: LineReader,
    delimiter: u8,
    /// Lines that have been read and belong to no row yet.
    ahead: VecDeque<(u64, Vec<u8>)>,
    record: Record,
    /// Whether a line was not valid UTF-8.
    pub has_other_letters: bool,
}

#[derive(Default)]
pub(crate) struct Record {
    text: Vec<u8>,
    cells: Vec<Range<usize>>,
    /// Whether a quote in it is never closed.
    pub is_broken: bool,
}

impl Record {
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// A cell with all its blanks, without quotes.
    pub fn get(&self, place: usize) -> Option<&[u8]> {
        self.cells.get(place).map(|cell| &self.text[cell.clone()])
    }

    /// All cells as texts, without blanks at their ends.
    pub fn texts(&self) -> Vec<String> {
        let text = |cell: &Range<usize>| text(self.text[cell.clone()].trim_ascii()).into_owned();
        self.cells.iter().map(text).collect()
    }

    fn part_unquoted(&mut self, line: &[u8], delimiter: u8) -> bool {
        self.text.clear();
        self.cells.clear();
        let mut begin = 0;
        for at in memchr::memchr2_iter(delimiter, b'"', line) {
            if line[at] == b'"' {
                return false;
            }
            self.cells.push(begin..at);
            begin = at + 1;
        }
        self.cells.push(begin..line.len());
        self.text.extend_from_slice(line);
        true
    }

    /// Parts a line whose quotes mean nothing.
    fn part_plainly(&mut self, line: &[u8], delimiter: u8) {
        self.text.clear();
        self.cells.clear();
        self.text.extend_from_slice(line);
        let mut begin = 0;
        for at in memchr::memchr_iter(delimiter, line) {
            self.cells.push(begin..at);
            begin = at + 1;
        }
        self.cells.push(begin..line.len());
    }

    /// Parts text with quotes; whether all of them are closed.
    fn part(&mut self, text: &[u8], delimiter: u8) -> bool {
        self.text.clear();
        self.cells.clear();
        let mut rest = text;
        loop {
            let begin = self.text.len();
            if rest.first() == Some(&b'"') {
                rest = &rest[1..];
                loop {
                    let Some(quote) = rest.iter().position(|&byte| byte == b'"') else { return false };
                    self.text.extend_from_slice(&rest[..quote]);
                    rest = &rest[quote + 1..];
                    if rest.first() != Some(&b'"') {
                        break;
                    }
                    self.text.push(b'"');
                    rest = &rest[1..];
                }
            }
            let end = rest.iter().position(|&byte| byte == delimiter);
            self.text.extend_from_slice(&rest[..end.unwrap_or(rest.len())]);
            self.cells.push(begin..self.text.len());
            match end {
                Some(end) => rest = &rest[end + 1..],
                None => return true,
            }
        }
    }
}

impl RecordReader {
    pub fn open(path: &Path) -> Result<RecordReader, LogError> {
        let delimiter = FileStart::read(path)?.delimiter();
        let (lines, ahead, record) = (LineReader::open(path)?, VecDeque::new(), Record::default());
        Ok(RecordReader { path: path.into(), lines, delimiter, ahead, record, has_other_letters: false })
    }

    /// The next row with the line that it begins in, counted from 1; None at the end. `is_row` says of a line by itself whether it is a
    /// row, so that it does not belong to the one before.
    pub fn next(&mut self, is_row: &mut dyn FnMut(&Record) -> bool) -> Result<Option<(u64, &Record)>, LogError> {
        self.record.is_broken = false;
        let number = if self.ahead.is_empty() {
            let Some((number, line)) = self.lines.next_whole()? else { return Ok(None) };
            let line = in_utf8(line, &mut self.has_other_letters);
            if !self.record.part_unquoted(trimmed(&line), self.delimiter) {
                let line = line.into_owned();
                self.quoted(line, is_row)?;
            }
            number
        } else {
            let Some((number, line)) = self.ahead.pop_front() else { return Ok(None) };
            self.quoted(line, is_row)?;
            number
        };
        if self.record.len() > MOST_CELLS {
            return Err(LogError::too_long(&self.path, number, LengthMessage::Cells));
        }
        Ok(Some((number, &self.record)))
    }

    /// Parts a row that begins with this line, and takes more lines for it while a quote is open.
    fn quoted(&mut self, first: Vec<u8>, is_row: &mut dyn FnMut(&Record) -> bool) -> Result<(), LogError> {
        if self.record.part(trimmed(&first), self.delimiter) {
            return Ok(());
        }
        let mut whole = first.clone();
        let mut alone = Record::default();
        let mut quoting = Quoting::CellBegins.after(&first, self.delimiter);
        for taken in 0..MOST_LINES_OF_ROW {
            if self.ahead.len() == taken {
                let Some((number, line)) = self.lines.next_whole()? else { break };
                let line = (number, in_utf8(line, &mut self.has_other_letters).into_owned());
                self.ahead.push_back(line);
            }
            let line = &self.ahead[taken].1;
            alone.part_plainly(trimmed(line), self.delimiter);
            if is_row(&alone) || whole.len() + line.len() > LONGEST_ROW_BYTES {
                break;
            }
            whole.extend_from_slice(line);
            quoting = quoting.after(line, self.delimiter);
            if quoting != Quoting::Quoted && self.record.part(trimmed(&whole), self.delimiter) {
                self.ahead.drain(..=taken);
                return Ok(());
            }
        }
        self.record.part_plainly(trimmed(&first), self.delimiter);
        self.record.is_broken = true;
        Ok(())
    }
}

/// The end of a text in a row with quotes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Quoting {
    CellBegins,
    Plain,
    Quoted,
    /// After a quote in a quoted cell: the cell ends, or another quote follows.
    QuoteEnds,
}

impl Quoting {
    fn after(self, text: &[u8], delimiter: u8) -> Quoting {
        text.iter().fold(self, |quoting, &byte| match quoting {
            Quoting::Quoted if byte == b'"' => Quoting::QuoteEnds,
            Quoting::Quoted => Quoting::Quoted,
            Quoting::QuoteEnds | Quoting::CellBegins if byte == b'"' => Quoting::Quoted,
            _ if byte == delimiter => Quoting::CellBegins,
            _ => Quoting::Plain,
        })
    }
}

/// A line in UTF-8: one that is not is taken for one of Windows, in its letters of Western Europe.
fn in_utf8<'l>(line: &'l [u8], is_other: &mut bool) -> Cow<'l, [u8]> {
    /// The letters of the bytes 0x80 to 0x9f; those of further bytes have their numbers.
    const LETTERS: &str = "€\u{81}‚ƒ„…†‡ˆ‰Š‹Œ\u{8d}Ž\u{8f}\u{90}‘’“”•–—˜™š›œ\u{9d}žŸ";
    if str::from_utf8(line).is_ok() {
        return Cow::Borrowed(line);
    }
    *is_other = true;
    let letter = |byte: &u8| match byte.checked_sub(0x80).filter(|place| *place < 0x20) {
        Some(place) => LETTERS.chars().nth(place.into()).unwrap_or(char::REPLACEMENT_CHARACTER),
        None => char::from(*byte),
    };
    Cow::Owned(line.iter().map(letter).collect::<String>().into_bytes())
}

fn trimmed(line: &[u8]) -> &[u8] {
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    line.strip_suffix(b"\r").unwrap_or(line)
}
