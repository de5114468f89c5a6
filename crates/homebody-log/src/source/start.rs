//! How a file begins, which says what it holds.

use super::reading::open;
use crate::error::LogError;
use std::borrow::Cow;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The bytes that recognition may use: about a thousand rows.
const LOOKED_AT_BYTES: u64 = 1 << 16;

/// The first bytes of a file.
pub struct Start {
    /// Which file it is.
    pub path: PathBuf,
    bytes: Vec<u8>,
}

impl Start {
    /// Of a file; of one that is packed, of what is in it.
    ///
    /// # Errors
    ///
    /// [`LogError::Missing`] and what else the system says.
    pub fn of(path: &Path) -> Result<Start, LogError> {
        let mut bytes = Vec::new();
        let read = open(path)?.take(LOOKED_AT_BYTES).read_to_end(&mut bytes);
        read.map_err(|error| LogError::file(path, error))?;
        Ok(Start { path: path.into(), bytes })
    }

    /// Whether it begins with these bytes.
    pub fn begins_with(&self, bytes: &[u8]) -> bool {
        self.bytes.starts_with(bytes)
    }

    pub(super) fn is_sqlite(&self) -> bool {
        self.begins_with(b"SQLite format 3\0")
    }

    /// All these bytes.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The lines that are not blank, without a byte order mark and blanks at their ends; the last may be cut.
    pub(super) fn lines(&self) -> impl Iterator<Item = Cow<'_, str>> {
        let bytes = self.bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&self.bytes);
        let lines = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty());
        lines.map(String::from_utf8_lossy)
    }

    /// The cells of the first lines, without quotes.
    pub(super) fn cells(&self) -> impl Iterator<Item = Vec<String>> {
        let delimiter = char::from(self.delimiter());
        let cell = |cell: &str| cell.trim().trim_matches('"').trim().to_owned();
        self.lines().map(move |line| line.split(delimiter).map(cell).collect())
    }

    /// What parts the cells, if there are several: a semicolon where spreadsheets write decimals with a comma.
    pub(super) fn delimiter(&self) -> u8 {
        if self.count(b';') > self.count(b',') { b';' } else { b',' }
    }

    /// How many delimiters the first line has.
    pub(super) fn delimiters(&self) -> usize {
        self.count(self.delimiter())
    }

    /// How often a byte is in the first line that is not blank.
    fn count(&self, wanted: u8) -> usize {
        let mut lines = self.bytes.split(|&byte| byte == b'\n');
        let line = lines.find(|line| !line.trim_ascii().is_empty()).unwrap_or_default();
        line.iter().filter(|&&byte| byte == wanted).count()
    }
}
