//! The lines of a text, each at most as long as a row may be.

use super::reading::open;
use crate::error::{LengthMessage, LogError};
use crate::files::plain::text;
use crate::limits::LONGEST_ROW_BYTES;
use std::borrow::Cow;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// The size of a read, in bytes.
const BUFFER: usize = 1 << 16;

/// The byte order mark, with which some programs begin a text.
const MARK: &[u8] = b"\xef\xbb\xbf";

pub(crate) struct LineReader {
    path: PathBuf,
    file: BufReader<Box<dyn Read + Send>>,
    number: u64,
    /// The length of the last line in the buffer.
    used: usize,
    /// A line that does not end in the buffer.
    line: Vec<u8>,
}

impl LineReader {
    pub fn open(path: &Path) -> Result<LineReader, LogError> {
        let file = BufReader::with_capacity(BUFFER, open(path)?);
        Ok(LineReader { path: path.into(), file, number: 0, used: 0, line: Vec::new() })
    }

    /// The next line without its end, and its number, counted from 1; None at the end.
    pub fn next(&mut self) -> Result<Option<(u64, &[u8])>, LogError> {
        let Some((number, line)) = self.next_whole()? else { return Ok(None) };
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        Ok(Some((number, line.strip_suffix(b"\r").unwrap_or(line))))
    }

    /// The same with the line's end.
    pub fn next_whole(&mut self) -> Result<Option<(u64, &[u8])>, LogError> {
        self.file.consume(std::mem::take(&mut self.used));
        let path = &self.path;
        let failed = |error| LogError::file(path, error);
        self.number += 1;
        let end = memchr::memchr(b'\n', self.file.fill_buf().map_err(failed)?);
        let line = match end {
            Some(end) => {
                self.used = end + 1;
                &self.file.buffer()[..self.used]
            }
            // It continues behind the buffer; one more byte shows that it is too long.
            None => {
                self.line.clear();
                let mut rest = self.file.by_ref().take(LONGEST_ROW_BYTES as u64 + 1);
                rest.read_until(b'\n', &mut self.line).map_err(failed)?;
                &self.line
            }
        };
        if line.is_empty() {
            return Ok(None);
        }
        if line.len() > LONGEST_ROW_BYTES {
            return Err(LogError::too_long(path, self.number, LengthMessage::Line));
        }
        let line = if self.number == 1 { line.strip_prefix(MARK).unwrap_or(line) } else { line };
        Ok(Some((self.number, line)))
    }

    /// The next line as text; invalid UTF-8 is replaced.
    pub fn next_text(&mut self) -> Result<Option<(u64, Cow<'_, str>)>, LogError> {
        Ok(self.next()?.map(|(number, line)| (number, text(line))))
    }
}
