//! The beginning of a file, which shows its content.

use super::instant::InstantReader;
use super::options::DateOrder;
use super::reading::open;
use crate::error::LogError;
use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};

/// So many bytes are looked at: a thousand rows and more of most logs.
const LOOKED_AT_BYTES: u64 = 1 << 18;

/// The mark between cells is found in so many lines.
const LINES_FOR_DELIMITER: usize = 20;

/// Most of so many lines decide where the first ones differ.
const LINES_FOR_USUAL: usize = 200;

/// The first bytes of a file.
pub struct FileStart {
    /// Which file it is.
    pub path: PathBuf,
    bytes: Vec<u8>,
    /// The kind of table that it is, found once: several forms ask.
    pub(crate) table: OnceCell<Option<TableKind>>,
}

/// The meaning of a table's rows.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum TableKind {
    Events,
    Intervals,
    Activities,
    Wide,
    /// A table of instants that is refused.
    Refused,
}

impl FileStart {
    /// Of a file; of one that is packed, of what is in it.
    ///
    /// # Errors
    ///
    /// [`LogError::Missing`] and what else the system says.
    pub fn read(path: &Path) -> Result<FileStart, LogError> {
        let mut bytes = Vec::new();
        let read = open(path)?.take(LOOKED_AT_BYTES).read_to_end(&mut bytes);
        read.map_err(|error| LogError::file(path, error))?;
        Ok(FileStart { path: path.into(), bytes, table: OnceCell::new() })
    }

    /// Whether it begins with these bytes.
    pub fn begins_with(&self, bytes: &[u8]) -> bool {
        self.bytes.starts_with(bytes)
    }

    pub(crate) fn is_sqlite(&self) -> bool {
        self.begins_with(b"SQLite format 3\0")
    }

    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The lines that are not blank, without a byte order mark and blanks at their ends; the last may be cut.
    pub(crate) fn lines(&self) -> impl Iterator<Item = Cow<'_, str>> {
        let bytes = self.bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&self.bytes);
        let lines = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty());
        lines.map(String::from_utf8_lossy)
    }

    /// The cells of the first lines, without quotes.
    pub(crate) fn cells(&self) -> impl Iterator<Item = Vec<String>> {
        let delimiter = char::from(self.delimiter());
        let cell = |cell: &str| cell.trim().trim_matches('"').trim().to_owned();
        self.lines().map(move |line| line.split(delimiter).map(cell).collect())
    }

    /// The mark between cells. A semicolon or a tab that each line has as often is one, whatever commas there are: spreadsheets
    /// write decimals with them. If the first lines differ, most lines decide.
    pub(crate) fn delimiter(&self) -> u8 {
        let lines: Vec<Cow<'_, str>> = self.lines().take(LINES_FOR_DELIMITER).collect();
        if let Some(mark) = lines.first().and_then(|line| told_delimiter(line)) {
            return mark;
        }
        if !lines.is_empty() && lines[..lines.len().max(2) - 1].iter().all(|line| is_pair(line)) {
            return b' ';
        }
        let counts = |mark: u8| lines.iter().map(move |line| line.bytes().filter(|byte| *byte == mark).count());
        let is_steady =
            |mark: u8| counts(mark).next().is_some_and(|first| first > 0 && counts(mark).all(|it| it == first));
        let first = |mark: u8| counts(mark).next().unwrap_or(0);
        // The table that psql prints has a line of dashes, and a table of Markdown begins with a bar.
        let has_bars = lines.len() > 1 && !lines[1].contains("-+-") && !lines[0].starts_with(['|', '+']);
        let by_first = match () {
            () if first(b';') > first(b',') || is_steady(b';') && !is_steady(b',') => b';',
            () if lines.len() > 1 && is_steady(b'\t') && first(b',') == 0 && first(b';') == 0 => b'\t',
            () if has_bars && is_steady(b'|') && first(b',') == 0 && first(b';') == 0 => b'|',
            () => b',',
        };
        if is_steady(by_first) {
            return by_first;
        }
        let usual = [b';', b'\t', b'|', b','].map(|mark| (mark, self.usual(mark).unwrap_or(0)));
        // A number has one comma in each cell at most.
        let mut usual_ones = usual.iter().filter(|(mark, _)| has_bars || *mark != b'|');
        let best = usual_ones.find(|(mark, count)| *count > 0 && (*mark == b',' || usual[3].1 <= count + 1));
        best.map_or(by_first, |(mark, _)| *mark)
    }

    /// The number of marks in nearly each line.
    fn usual(&self, mark: u8) -> Option<usize> {
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        let mut lines = 0;
        for line in self.lines().filter(|line| !line.starts_with('#')).take(LINES_FOR_USUAL) {
            *counts.entry(line.bytes().filter(|byte| *byte == mark).count()).or_default() += 1;
            lines += 1;
        }
        let (count, of) = counts.into_iter().max_by_key(|(_, of)| *of)?;
        (count > 0 && 10 * of >= 7 * lines).then_some(count)
    }

    /// Whether a cell of its first lines is an instant.
    pub(crate) fn has_instants(&self) -> bool {
        let mut instants = InstantReader::with_order(Some(DateOrder::DayFirst));
        let lines = self.cells().take(LINES_FOR_USUAL);
        lines.flatten().any(|cell| instants.read(&cell).is_some())
    }

    /// The number of delimiters in the first line, or in nearly each line.
    pub(crate) fn delimiters(&self) -> usize {
        let delimiter = self.delimiter();
        let first = self.lines().next().map_or(0, |line| line.bytes().filter(|&byte| byte == delimiter).count());
        first.max(self.usual(delimiter).unwrap_or(0))
    }

    /// Whether nearly each line has as many delimiters.
    pub(crate) fn is_steady(&self) -> bool {
        self.lines().nth(3).is_some() && self.usual(self.delimiter()).is_some()
    }
}

/// Whether a line is a number since 1970, a blank, and a number, as UK-DALE has them.
fn is_pair(line: &str) -> bool {
    let Some((at, value)) = line.split_once(' ') else { return false };
    let is_time = at.starts_with(|first: char| first.is_ascii_digit()) && InstantReader::default().read(at).is_some();
    is_time && value.parse::<f64>().is_ok()
}

/// The mark between cells that a first line tells, as `sep=;` does.
fn told_delimiter(line: &str) -> Option<u8> {
    let mark = line.trim_matches(['"', '\u{feff}']).to_lowercase();
    match *mark.strip_prefix("sep=")?.as_bytes() {
        [mark @ (b';' | b',' | b'\t' | b'|'), ..] => Some(mark),
        // The blanks at a line's end are left out.
        [] => Some(b'\t'),
        _ => None,
    }
}
