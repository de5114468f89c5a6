//! Rows of comma-separated values, none of which is longer than it may be.

use super::reading::open;
use super::start::Start;
use crate::error::LogError;
use crate::limits::{LONGEST_ROW_BYTES, MOST_CELLS};
use ::csv::{ByteRecord, Reader, ReaderBuilder, Terminator};
use std::cell::Cell;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// How many bytes are asked for at once.
const BUFFER: usize = 1 << 16;

/// A file of rows.
pub(super) struct Records {
    path: PathBuf,
    reader: Reader<Limited>,
    record: ByteRecord,
    /// How many bytes have come since the last row was whole.
    come: Rc<Cell<usize>>,
}

/// A file that ends with an error where a row is too long: after a quote that is never closed, all the rest is one row.
struct Limited {
    file: File,
    come: Rc<Cell<usize>>,
}

impl Read for Limited {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.come.get() > LONGEST_ROW_BYTES + BUFFER {
            return Err(io::ErrorKind::InvalidData.into());
        }
        let read = self.file.read(buffer)?;
        self.come.set(self.come.get() + read);
        Ok(read)
    }
}

impl Records {
    pub fn open(path: &Path) -> Result<Records, LogError> {
        let come = Rc::new(Cell::new(0));
        let source = Limited { file: open(path)?, come: come.clone() };
        // Lines end as on Windows, too: what is before their end is blank. So they are counted as people count them.
        let mut builder = ReaderBuilder::new();
        builder.delimiter(Start::of(path)?.delimiter());
        builder.has_headers(false).flexible(true).terminator(Terminator::Any(b'\n')).buffer_capacity(BUFFER);
        Ok(Records { path: path.into(), reader: builder.from_reader(source), record: ByteRecord::new(), come })
    }

    /// The next row with the line that it begins in, counted from 1; None at the end.
    pub fn next(&mut self) -> Result<Option<(u64, &ByteRecord)>, LogError> {
        let line = self.reader.position().line();
        let read = self.reader.read_byte_record(&mut self.record);
        let too_long = |what: String| LogError::too_long(&self.path, line, what);
        if self.come.replace(0) > LONGEST_ROW_BYTES + BUFFER || self.record.as_slice().len() > LONGEST_ROW_BYTES {
            return Err(too_long(format!(
                "the row is longer than {LONGEST_ROW_BYTES} bytes, or a quote in it is never closed"
            )));
        }
        if self.record.len() > MOST_CELLS {
            return Err(too_long(format!("the row has more than {MOST_CELLS} cells")));
        }
        if !read.map_err(|error| LogError::file(&self.path, error.into()))? {
            return Ok(None);
        }
        let line = self.record.position().map_or(line, |position| position.line());
        Ok(Some((line, &self.record)))
    }
}
