//! A text file of rows, a line each: new, or one that a program which died has left, to be gone on with.

use super::{Begin, How};
use crate::error::{LogError, place_of};
use crate::fresh::FreshFile;
use crate::lock::FileLock;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

/// Lines on their way into a file.
///
/// Going on, lines that are there already are compared with those that are lived again, until the file ends, perhaps
/// in the middle of a line: that one is written anew.
pub(super) struct TextFile {
    file: FreshFile,
    /// What is there and has not been compared yet.
    left: Option<BufReader<File>>,
    /// How many bytes have been compared, and where that many lines end.
    compared: u64,
    lines: u64,
    found: Vec<u8>,
    /// Given back last, once the file has its name or its part is gone.
    _lock: FileLock,
}

impl TextFile {
    pub fn begin(path: &Path, begin: &Begin) -> Result<TextFile, LogError> {
        let lock = FileLock::take(path)?;
        let left = if begin.how == How::GoOn { FreshFile::reopen(path)? } else { None };
        let (file, left) = match left {
            Some((file, left)) => (file, Some(BufReader::with_capacity(1 << 16, left))),
            None => (FreshFile::create(path, begin.how == How::Replace)?, None),
        };
        Ok(TextFile { file, left, compared: 0, lines: 0, found: Vec::new(), _lock: lock })
    }

    /// Takes a line with its end.
    pub fn line(&mut self, line: &[u8]) -> Result<(), LogError> {
        let Some(left) = &mut self.left else { return self.file.write(line) };
        self.found.clear();
        let read = left.by_ref().take(line.len() as u64).read_to_end(&mut self.found);
        read.map_err(|error| LogError::reading(self.file.path(), error))?;
        if !line.starts_with(&self.found) {
            return Err(self.changed(format!("line {} is another", self.lines + 1)));
        }
        if self.found.len() < line.len() {
            // The file ends here, or in the middle of the line.
            self.left = None;
            self.file.cut(self.compared)?;
            return self.file.write(line);
        }
        self.compared += line.len() as u64;
        self.lines += 1;
        Ok(())
    }

    pub fn settle(&mut self) -> Result<(), LogError> {
        self.file.flush()
    }

    /// Gives the file its name.
    pub fn finish(mut self) -> Result<(), LogError> {
        if let Some(left) = &mut self.left {
            let mut next = [0];
            let more = left.read(&mut next).map_err(|error| LogError::reading(self.file.path(), error))?;
            if more > 0 {
                return Err(self.changed(format!("it has more than the {} lines of the run", self.lines)));
            }
        }
        self.file.finish()
    }

    fn changed(&mut self, what: String) -> LogError {
        // What is there is somebody's: it is left as it is.
        self.file.keep();
        LogError::Changed { place: place_of(self.file.path()), what }
    }
}
