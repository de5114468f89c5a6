//! Texts that are packed by gzip or Zstandard: known by their endings where they are written, by how they begin where they are read.

use super::fresh::FreshFile;
use super::plain;
use crate::error::{LogError, PackedMessage};
use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Packing {
    /// Gzip (RFC 1952): `.gz`.
    Gzip,
    /// Zstandard (RFC 8878): `.zst`.
    #[cfg(feature = "zstd")]
    Zstd,
}

/// The first bytes of packed files.
const GZIP: &[u8] = b"\x1f\x8b";
const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";

/// Level of compression (our choice): 6 of gzip and 3 of Zstandard are the defaults of their own programs.
const GZIP_LEVEL: u32 = 6;
#[cfg(feature = "zstd")]
const ZSTD_LEVEL: i32 = 3;

/// Lines are packed so many bytes at a time, whatever the batches: so the same lines give the same bytes.
const AT_ONCE_BYTES: usize = 1 << 16;

/// Largest window of a packed text, as a power of two (our choice): 8 MB, the most that the format's specification asks
/// a reader for.
#[cfg(feature = "zstd")]
const LARGEST_WINDOW_LOG: u32 = 23;

impl Packing {
    /// The packing of a file with this name; an error if this build lacks it.
    pub fn for_path(path: &Path) -> Result<Option<Packing>, LogError> {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("gz") => Ok(Some(Packing::Gzip)),
            #[cfg(feature = "zstd")]
            Some("zst") => Ok(Some(Packing::Zstd)),
            #[cfg(not(feature = "zstd"))]
            Some("zst") => {
                Err(LogError::NotBuiltIn { place: crate::error::place_of(path), name: ".zst", feature: "parquet" })
            }
            _ => Ok(None),
        }
    }

    /// Packs what is written into a file.
    pub fn pack(self, file: FreshFile) -> Result<Packer, LogError> {
        let inner = match self {
            // No name and no time of its own: the same text gives the same bytes.
            Packing::Gzip => PackedWriter::Gzip(GzEncoder::new(file, Compression::new(GZIP_LEVEL))),
            #[cfg(feature = "zstd")]
            Packing::Zstd => {
                let path = file.path().to_owned();
                let begun = zstd::Encoder::new(file, ZSTD_LEVEL).map_err(|error| LogError::file(&path, error))?;
                PackedWriter::Zstd(begun)
            }
        };
        Ok(Packer(BufWriter::with_capacity(AT_ONCE_BYTES, inner)))
    }
}

pub(crate) struct Packer(BufWriter<PackedWriter>);

enum PackedWriter {
    Gzip(GzEncoder<FreshFile>),
    #[cfg(feature = "zstd")]
    Zstd(zstd::Encoder<'static, FreshFile>),
}

impl Write for PackedWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            PackedWriter::Gzip(inner) => inner.write(bytes),
            #[cfg(feature = "zstd")]
            PackedWriter::Zstd(inner) => inner.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        // The packed bytes end with the text.
        Ok(())
    }
}

impl Write for Packer {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl Packer {
    /// Packs the rest; the file has no name yet.
    pub fn finish(self) -> io::Result<FreshFile> {
        match self.0.into_inner().map_err(io::IntoInnerError::into_error)? {
            PackedWriter::Gzip(inner) => inner.finish(),
            #[cfg(feature = "zstd")]
            PackedWriter::Zstd(inner) => inner.finish(),
        }
    }
}

/// Whether a file is packed, so that its end needs a read of the whole file.
pub(crate) fn is_packed(path: &Path) -> bool {
    let mut begins = Vec::new();
    let read = plain::open(path).and_then(|file| file.take(ZSTD.len() as u64).read_to_end(&mut begins));
    read.is_ok() && (begins.starts_with(GZIP) || begins == ZSTD)
}

/// The text of a plain file, unpacked if necessary. It is unpacked while it is read, so that it may have any size.
///
/// # Errors
///
/// Those of [`plain::open`]; [`io::ErrorKind::Unsupported`] for a packing that this build lacks.
pub(crate) fn unpacked(path: &Path) -> io::Result<Box<dyn Read + Send>> {
    let mut file = plain::open(path)?;
    let mut begins = Vec::new();
    Read::by_ref(&mut file).take(ZSTD.len() as u64).read_to_end(&mut begins)?;
    file.rewind()?;
    match &begins[..] {
        begins if begins.starts_with(GZIP) => Ok(Box::new(Unpacked(MultiGzDecoder::new(BufReader::new(file))))),
        ZSTD => unpacked_zstd(file),
        _ => Ok(Box::new(file)),
    }
}

#[cfg(feature = "zstd")]
fn unpacked_zstd(file: File) -> io::Result<Box<dyn Read + Send>> {
    let mut decoder = zstd::Decoder::new(file)?;
    decoder.window_log_max(LARGEST_WINDOW_LOG)?;
    Ok(Box::new(Unpacked(decoder)))
}

/// An unpacked text; its errors have a message.
struct Unpacked<R>(R);

impl<R: Read> Read for Unpacked<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.0.read(bytes).map_err(|error| match error.raw_os_error() {
            // The disk's own.
            Some(_) => error,
            None => io::Error::new(io::ErrorKind::InvalidData, PackedMessage::Damaged),
        })
    }
}

#[cfg(not(feature = "zstd"))]
fn unpacked_zstd(_: File) -> io::Result<Box<dyn Read + Send>> {
    Err(io::Error::new(io::ErrorKind::Unsupported, PackedMessage::NoZstandard))
}
