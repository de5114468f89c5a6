//! Writes text, a row a line: into a new file, into the file of a resumed run, packed, or to standard output.

use crate::error::{ChangedMessage, HoldMessage, LogError, OutputMessage, place_of};
use crate::files::{FileLock, FreshFile, Packer, Packing, WriteMode, remove_parts, unpacked};
use crate::policy::Deadline;
use crate::table::Table;
use crate::url::Url;
use homebody_core::scenario::scheme::Scheme;
use std::io::{self, BufReader, BufWriter, Read, Stdout, Write};
use std::path::{Path, PathBuf};

#[derive(Clone, Debug)]
pub(crate) enum TextTarget {
    File(PathBuf),
    Output,
}

impl TextTarget {
    pub fn from_url(url: &Url) -> TextTarget {
        url.file().map_or(TextTarget::Output, |file| TextTarget::File(file.into()))
    }

    /// The name in errors.
    pub fn place(&self) -> String {
        match self {
            TextTarget::File(path) => place_of(path),
            TextTarget::Output => "standard output".into(),
        }
    }

    /// The target of each of these tables. Standard output holds one table.
    pub fn for_tables(&self, scheme: Scheme, tables: &[Table]) -> Result<Vec<TextTarget>, LogError> {
        match self {
            TextTarget::File(path) => {
                Ok(Url::new(scheme, path).files(tables).into_iter().map(TextTarget::File).collect())
            }
            TextTarget::Output if tables.len() == 1 => Ok(vec![TextTarget::Output]),
            TextTarget::Output => Err(LogError::cannot_hold(self.place(), HoldMessage::OutputTables)),
        }
    }
}

pub(crate) enum TextSink {
    File(Box<TextFile>),
    Packed(Box<PackedFile>),
    Output(BufWriter<Pieces<Stdout>>),
}

impl TextSink {
    /// Begins a text. One `is_followed` that has its name from its first line on, so that it can be read while it grows. The reader of
    /// standard output has the time of the deadline for each piece.
    pub fn begin(
        at: &TextTarget,
        how: WriteMode,
        is_followed: bool,
        deadline: &Deadline,
    ) -> Result<TextSink, LogError> {
        Ok(match at {
            TextTarget::Output => {
                let pieces = Pieces { out: io::stdout(), deadline: deadline.clone() };
                TextSink::Output(BufWriter::with_capacity(1 << 16, pieces))
            }
            TextTarget::File(path) => match Packing::for_path(path)? {
                Some(packing) => TextSink::Packed(Box::new(PackedFile::begin(path, packing, how)?)),
                None => TextSink::File(Box::new(TextFile::begin(path, how, is_followed)?)),
            },
        })
    }

    /// Takes a line with its end.
    pub fn line(&mut self, line: &[u8]) -> Result<(), LogError> {
        match self {
            TextSink::File(file) => file.line(line),
            TextSink::Packed(file) => file.line(line),
            TextSink::Output(output) => output.write_all(line).map_err(no_output),
        }
    }

    /// Flushes lines for a reader that follows the file.
    pub fn show(&mut self) -> Result<(), LogError> {
        match self {
            TextSink::File(file) if file.is_followed => file.file.flush(),
            TextSink::File(_) | TextSink::Packed(_) => Ok(()),
            TextSink::Output(output) => output.flush().map_err(no_output),
        }
    }

    /// Makes sure of the lines; whether that could be done before the end.
    pub fn make_durable(&mut self) -> Result<bool, LogError> {
        match self {
            TextSink::File(file) => file.file.flush().map(|()| true),
            // A packer sees more of a text the longer it waits, and the bytes must not depend on when it was flushed.
            TextSink::Packed(_) => Ok(false),
            TextSink::Output(output) => output.flush().map(|()| true).map_err(no_output),
        }
    }

    /// Gives a file its name.
    pub fn finish(self) -> Result<(), LogError> {
        match self {
            TextSink::File(file) => file.finish(),
            TextSink::Packed(file) => file.finish(),
            TextSink::Output(mut output) => output.flush().map_err(no_output),
        }
    }

    /// The same for a run that may have been stopped before it made all lines again: the others stay.
    pub fn stop(mut self) -> Result<(), LogError> {
        if let TextSink::File(text) = &mut self
            && let TextFile { left: Some(left), file, .. } = &mut **text
            && left.is_all(file.path()).is_err()
        {
            file.keep();
            return Ok(());
        }
        self.finish()
    }
}

/// A pipe takes no more than this at once where its reader is slow.
const PIECE_BYTES: usize = 4096;

/// Writes piece by piece, each with the whole time of the deadline: a reader that is slow is not one that stands still.
pub(crate) struct Pieces<W> {
    out: W,
    deadline: Deadline,
}

impl<W: Write> Write for Pieces<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(&bytes[..bytes.len().min(PIECE_BYTES)])?;
        // Bytes in a buffer of this program have not reached the reader.
        self.out.flush()?;
        self.deadline.asks();
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

fn no_output(source: io::Error) -> LogError {
    match source.kind() {
        io::ErrorKind::BrokenPipe => LogError::destination("standard output", OutputMessage::Closed),
        _ => LogError::File { place: "standard output".into(), source },
    }
}

/// Existing lines, for comparison with those of the resumed run.
struct EarlierLines<R> {
    text: BufReader<R>,
    lines: u64,
    bytes: u64,
    found: Vec<u8>,
}

impl<R: Read> EarlierLines<R> {
    fn new(text: R) -> EarlierLines<R> {
        EarlierLines { text: BufReader::with_capacity(1 << 16, text), lines: 0, bytes: 0, found: Vec::new() }
    }

    /// Whether the whole line is there: false if the text ends before its end. An error if there is another line.
    fn has(&mut self, line: &[u8], path: &Path) -> Result<bool, LogError> {
        self.found.clear();
        let read = self.text.by_ref().take(line.len() as u64).read_to_end(&mut self.found);
        read.map_err(|error| LogError::reading(path, error))?;
        if !line.starts_with(&self.found) {
            return Err(LogError::changed(place_of(path), ChangedMessage::OtherLine { line: self.lines + 1 }));
        }
        if self.found.len() < line.len() {
            return Ok(false);
        }
        self.bytes += line.len() as u64;
        self.lines += 1;
        Ok(true)
    }

    fn is_all(&mut self, path: &Path) -> Result<(), LogError> {
        let more = self.text.read(&mut [0]).map_err(|error| LogError::reading(path, error))?;
        match more > 0 {
            true => Err(LogError::changed(place_of(path), ChangedMessage::MoreRows { rows: self.lines })),
            false => Ok(()),
        }
    }
}

/// A file of plain lines.
///
/// A resumed run compares its lines with the existing ones until the file ends. If it ends in the middle of a line, that line is written
/// anew.
pub(crate) struct TextFile {
    file: FreshFile,
    /// The existing text that has not been compared yet.
    left: Option<EarlierLines<std::fs::File>>,
    /// Whether it has its name from its first line on.
    is_followed: bool,
    /// Given back last, once the file has its name or its part is gone.
    _lock: FileLock,
}

impl TextFile {
    fn begin(path: &Path, how: WriteMode, is_followed: bool) -> Result<TextFile, LogError> {
        let lock = FileLock::take(path)?;
        let left = if how == WriteMode::Resume { FreshFile::reopen(path)? } else { None };
        let (file, left) = match left {
            Some((file, left)) => (file, Some(EarlierLines::new(left))),
            None => (FreshFile::create(path, how == WriteMode::Overwrite)?, None),
        };
        Ok(TextFile { file, left, is_followed, _lock: lock })
    }

    fn line(&mut self, line: &[u8]) -> Result<(), LogError> {
        let Some(left) = &mut self.left else { return self.add(line) };
        match left.has(line, self.file.path()) {
            Ok(true) => return Ok(()),
            Ok(false) => {}
            Err(error) => {
                // The file is another's: it stays unchanged.
                self.file.keep();
                return Err(error);
            }
        }
        // The file ends here, or in the middle of the line.
        let compared = left.bytes;
        self.left = None;
        self.file.cut(compared)?;
        self.add(line)
    }

    fn add(&mut self, line: &[u8]) -> Result<(), LogError> {
        self.file.write(line)?;
        if self.is_followed && self.file.part().is_some() { self.file.name_early() } else { Ok(()) }
    }

    fn finish(mut self) -> Result<(), LogError> {
        if let Some(left) = &mut self.left
            && let Err(error) = left.is_all(self.file.path())
        {
            self.file.keep();
            return Err(error);
        }
        self.file.finish()
    }
}

/// A file that is packed while it is written.
///
/// A packed file without its end cannot be continued. So a resumed run writes all of it anew; a whole file is compared, and replaced at
/// the end.
pub(crate) struct PackedFile {
    path: PathBuf,
    packer: Packer,
    left: Option<EarlierLines<Box<dyn Read + Send>>>,
    _lock: FileLock,
}

impl PackedFile {
    fn begin(path: &Path, packing: Packing, how: WriteMode) -> Result<PackedFile, LogError> {
        let lock = FileLock::take(path)?;
        let mut left = None;
        if how == WriteMode::Resume {
            remove_parts(path)?;
            if path.is_file() {
                let text = unpacked(path).map_err(|error| LogError::reading(path, error))?;
                left = Some(EarlierLines::new(text));
            }
        }
        let packer = packing.pack(FreshFile::create(path, how != WriteMode::Create)?)?;
        Ok(PackedFile { path: path.into(), packer, left, _lock: lock })
    }

    fn line(&mut self, line: &[u8]) -> Result<(), LogError> {
        if let Some(left) = &mut self.left
            && !left.has(line, &self.path)?
        {
            self.left = None;
        }
        self.packer.write_all(line).map_err(|error| LogError::file(&self.path, error))
    }

    fn finish(mut self) -> Result<(), LogError> {
        if let Some(left) = &mut self.left {
            left.is_all(&self.path)?;
        }
        self.packer.finish().map_err(|error| LogError::file(&self.path, error))?.finish()
    }
}
