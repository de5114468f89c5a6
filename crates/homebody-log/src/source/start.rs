//! How a file begins, which says what it holds.

use super::reading::open;
use crate::error::LogError;
use std::io::Read;
use std::path::Path;

/// So many bytes are looked at (ours).
const LOOKED_AT_BYTES: u64 = 4096;

/// The first bytes of a file.
pub(super) struct Start(Vec<u8>);

impl Start {
    pub fn of(path: &Path) -> Result<Start, LogError> {
        let mut start = Vec::new();
        let read = open(path)?.take(LOOKED_AT_BYTES).read_to_end(&mut start);
        read.map_err(|error| LogError::file(path, error))?;
        Ok(Start(start))
    }

    pub fn is_sqlite(&self) -> bool {
        self.0.starts_with(b"SQLite format 3\0")
    }

    /// What parts the cells, if there are several: a semicolon where spreadsheets write decimals with a comma.
    pub fn delimiter(&self) -> u8 {
        if self.count(b';') > self.count(b',') { b';' } else { b',' }
    }

    /// How many delimiters the first line has.
    pub fn delimiters(&self) -> usize {
        self.count(self.delimiter())
    }

    /// How often a byte is in the first line that is not blank.
    fn count(&self, wanted: u8) -> usize {
        let mut lines = self.0.split(|&byte| byte == b'\n');
        let line = lines.find(|line| !line.trim_ascii().is_empty()).unwrap_or_default();
        line.iter().filter(|&&byte| byte == wanted).count()
    }
}
