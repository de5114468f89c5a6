//! A text in JSON on its way. Values up to the length of a row are held as a whole; longer lists and objects are read part by part.

use crate::error::{LengthMessage, LogError};
use crate::limits::LONGEST_ROW_BYTES;
use crate::source::reading::open;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The size of a read, in bytes.
const AT_ONCE: usize = 1 << 16;

/// Some programs begin a text with this mark.
const MARK: &[u8] = b"\xef\xbb\xbf";

pub(crate) struct JsonText {
    path: PathBuf,
    file: Box<dyn Read + Send>,
    buffer: Vec<u8>,
    /// The number of bytes of the buffer that are read.
    at: usize,
    is_read: bool,
    /// The line of what comes next, counted from 1.
    pub line: u64,
}

impl JsonText {
    pub fn open(path: &Path) -> Result<JsonText, LogError> {
        let file = open(path)?;
        let mut text = JsonText { path: path.into(), file, buffer: Vec::new(), at: 0, is_read: false, line: 1 };
        while text.buffer.len() < MARK.len() && text.more()? {}
        if text.buffer.starts_with(MARK) {
            text.at = MARK.len();
        }
        Ok(text)
    }

    /// Reads on; whether more has come.
    fn more(&mut self) -> Result<bool, LogError> {
        if self.is_read {
            return Ok(false);
        }
        if self.at > AT_ONCE {
            self.buffer.drain(..self.at);
            self.at = 0;
        }
        let path = &self.path;
        let before = self.buffer.len();
        self.file
            .by_ref()
            .take(AT_ONCE as u64)
            .read_to_end(&mut self.buffer)
            .map_err(|error| LogError::file(path, error))?;
        self.is_read = self.buffer.len() == before;
        Ok(!self.is_read)
    }

    /// The next byte past blanks; None at the end.
    pub fn peek(&mut self) -> Result<Option<u8>, LogError> {
        loop {
            while let Some(&byte) = self.buffer.get(self.at) {
                if !byte.is_ascii_whitespace() {
                    return Ok(Some(byte));
                }
                self.pass(1);
            }
            if !self.more()? {
                return Ok(None);
            }
        }
    }

    /// Leaves so many bytes behind.
    pub fn pass(&mut self, bytes: usize) {
        let end = (self.at + bytes).min(self.buffer.len());
        self.line += memchr::memchr_iter(b'\n', &self.buffer[self.at..end]).count() as u64;
        self.at = end;
    }

    /// Leaves what is left of the line behind.
    pub fn pass_line(&mut self) -> Result<(), LogError> {
        loop {
            match memchr::memchr(b'\n', &self.buffer[self.at..]) {
                Some(end) => {
                    self.pass(end + 1);
                    return Ok(());
                }
                None => self.pass(self.buffer.len() - self.at),
            }
            if !self.more()? {
                return Ok(());
            }
        }
    }

    pub fn bytes(&self, length: usize) -> &[u8] {
        &self.buffer[self.at..self.at + length]
    }

    /// The length of the value that begins here: None where it has no end, or is longer than a row may be.
    pub fn length(&mut self) -> Result<Option<usize>, LogError> {
        let mut scan = Scan::default();
        let mut looked = 0;
        loop {
            while let Some(&byte) = self.buffer.get(self.at + looked) {
                match scan.take(byte) {
                    ValueEnd::More => looked += 1,
                    ValueEnd::EndsHere => return Ok(Some(looked + 1)),
                    ValueEnd::EndedBefore => return Ok(Some(looked)),
                }
                if looked > LONGEST_ROW_BYTES {
                    return Ok(None);
                }
            }
            if !self.more()? {
                return Ok((scan.is_plain() && looked > 0).then_some(looked));
            }
        }
    }

    /// Whether all that is left has no end because the text has been cut, and not because it is long.
    pub fn is_cut(&self) -> bool {
        self.is_read && self.buffer.len() - self.at <= LONGEST_ROW_BYTES
    }

    /// An error that says what is too long here.
    pub fn too_long(&self, what: LengthMessage) -> LogError {
        LogError::too_long(&self.path, self.line, what)
    }
}

/// The end of a value, as far as a byte shows it.
enum ValueEnd {
    More,
    EndsHere,
    EndedBefore,
}

/// Looks for the end of a value, whatever is in it.
#[derive(Default)]
struct Scan {
    depth: u32,
    is_begun: bool,
    is_quoted: bool,
    is_escaped: bool,
}

impl Scan {
    /// Whether a number or a word may end here.
    fn is_plain(&self) -> bool {
        self.depth == 0 && !self.is_quoted
    }

    fn take(&mut self, byte: u8) -> ValueEnd {
        if self.is_quoted {
            match byte {
                _ if self.is_escaped => self.is_escaped = false,
                b'\\' => self.is_escaped = true,
                // No text of JSON has a line's end in it: a quote that is never closed costs its own line alone.
                b'"' | b'\n' => self.is_quoted = false,
                _ => {}
            }
            return if self.is_plain() { ValueEnd::EndsHere } else { ValueEnd::More };
        }
        let is_first = !std::mem::replace(&mut self.is_begun, true);
        match byte {
            b'"' if self.depth > 0 || is_first => self.is_quoted = true,
            b'{' | b'[' if self.depth > 0 || is_first => self.depth += 1,
            b'}' | b']' if self.depth > 0 => {
                self.depth -= 1;
                if self.depth == 0 {
                    return ValueEnd::EndsHere;
                }
            }
            b',' | b':' | b'}' | b']' | b'{' | b'[' | b'"' if self.depth == 0 => return ValueEnd::EndedBefore,
            _ if self.depth == 0 && byte.is_ascii_whitespace() => return ValueEnd::EndedBefore,
            _ => {}
        }
        ValueEnd::More
    }
}
