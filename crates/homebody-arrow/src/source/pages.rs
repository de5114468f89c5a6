//! The sizes of a Parquet file's pages, read from the pages' own headers before any page is unpacked.
//!
//! A page of a few kilobytes may unpack to gigabytes. The reader allocates what the header of a page says, so the headers are
//! checked first. They are structs in Thrift's compact protocol (parquet-format, `PageHeader`); the sizes are its second and third
//! field, and all other fields are skipped.

use parquet::basic::Encoding;
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData};
use std::io::{self, BufReader, ErrorKind, Read, Seek, SeekFrom};

/// Largest size of an unpacked page. Writers make pages of 1 MiB by default.
const LARGEST_PAGE_BYTES: u64 = 64 << 20;

/// Largest size of an unpacked page with shared prefixes: each of its values may then be as long as the whole page.
const LARGEST_SHARED_BYTES: u64 = 2 << 20;

/// A header of a page has no more structs within structs.
const DEEPEST: u32 = 16;

/// Whether a column packs texts as differences from the previous text.
fn shares_beginnings(chunk: &ColumnChunkMetaData) -> bool {
    chunk.encodings().any(|encoding| encoding == Encoding::DELTA_BYTE_ARRAY)
}

/// Checks the pages of these columns, all for `None`. Returns whether texts share beginnings in one of them.
///
/// # Errors
///
/// A sentence where a page is too large, or a header is damaged.
pub(super) fn check(
    file: impl Read + Seek,
    metadata: &ParquetMetaData,
    columns: Option<&[usize]>,
) -> Result<bool, String> {
    let mut file = BufReader::new(file);
    let mut shares = false;
    for group in metadata.row_groups() {
        for (leaf, chunk) in group.columns().iter().enumerate() {
            let root = group.schema_descr().get_column_root_idx(leaf);
            if columns.is_some_and(|columns| !columns.contains(&root)) {
                continue;
            }
            shares |= shares_beginnings(chunk);
            let largest = if shares_beginnings(chunk) { LARGEST_SHARED_BYTES } else { LARGEST_PAGE_BYTES };
            let (begin, length) = chunk.byte_range();
            check_chunk(&mut file, begin, begin.saturating_add(length), largest)?;
        }
    }
    Ok(shares)
}

/// Checks the pages between two places of the file.
fn check_chunk(file: &mut BufReader<impl Read + Seek>, begin: u64, end: u64, largest: u64) -> Result<(), String> {
    let mut at = begin;
    while at < end {
        file.seek(SeekFrom::Start(at)).map_err(|error| error.to_string())?;
        let mut header = Header { file, read: 0 };
        let sizes = match header.sizes() {
            Ok(sizes) => sizes,
            // The reader reports a file that ends early better.
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => return Ok(()),
            Err(error) => return Err(error.to_string()),
        };
        if sizes.unpacked > largest {
            return Err(format!("a page of it unpacks to more than {} MB", largest >> 20));
        }
        at += header.read + sizes.packed;
    }
    Ok(())
}

#[derive(Default)]
struct Sizes {
    unpacked: u64,
    packed: u64,
}

struct Header<'f, F> {
    file: &'f mut BufReader<F>,
    read: u64,
}

fn damaged() -> io::Error {
    io::Error::new(ErrorKind::InvalidData, "the header of a page is damaged")
}

impl<F: Read + Seek> Header<'_, F> {
    fn sizes(&mut self) -> io::Result<Sizes> {
        let mut sizes = Sizes::default();
        let mut field = 0_i64;
        loop {
            let head = self.byte()?;
            let (delta, kind) = (i64::from(head >> 4), head & 0x0f);
            if kind == 0 {
                return Ok(sizes);
            }
            field = if delta == 0 { unzigzag(self.varint()?) } else { field + delta };
            let size = |number: u64| u64::try_from(unzigzag(number)).map_err(|_| damaged());
            match (field, kind) {
                (2, 5) => sizes.unpacked = size(self.varint()?)?,
                (3, 5) => sizes.packed = size(self.varint()?)?,
                _ => self.skip(kind, DEEPEST)?,
            }
        }
    }

    /// Skips a value of a kind; of truth values in a struct the kind is the value.
    fn skip(&mut self, kind: u8, deepest: u32) -> io::Result<()> {
        let deeper = deepest.checked_sub(1).ok_or_else(damaged)?;
        match kind {
            1 | 2 => Ok(()),
            3 => self.byte().map(drop),
            4..=6 => self.varint().map(drop),
            7 => self.pass(8),
            8 => {
                let length = self.varint()?;
                self.pass(length)
            }
            9 | 10 => {
                let head = self.byte()?;
                let count = if head >> 4 == 15 { self.varint()? } else { u64::from(head >> 4) };
                (0..count).try_for_each(|_| match head & 0x0f {
                    1 | 2 => self.byte().map(drop),
                    kind => self.skip(kind, deeper),
                })
            }
            12 => loop {
                let head = self.byte()?;
                if head & 0x0f == 0 {
                    return Ok(());
                }
                if head >> 4 == 0 {
                    self.varint()?;
                }
                self.skip(head & 0x0f, deeper)?;
            },
            _ => Err(damaged()),
        }
    }

    fn byte(&mut self) -> io::Result<u8> {
        let mut byte = [0];
        self.file.read_exact(&mut byte)?;
        self.read += 1;
        Ok(byte[0])
    }

    fn varint(&mut self) -> io::Result<u64> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Ok(number);
            }
        }
        Err(damaged())
    }

    fn pass(&mut self, bytes: u64) -> io::Result<()> {
        self.file.seek_relative(i64::try_from(bytes).map_err(|_| damaged())?)?;
        self.read = self.read.checked_add(bytes).ok_or_else(damaged)?;
        Ok(())
    }
}

/// The number that Thrift writes with its sign in the lowest bit.
fn unzigzag(number: u64) -> i64 {
    (number >> 1) as i64 ^ -((number & 1) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    /// A header: type 0, two sizes, a struct with a text and a list, and a truth value.
    fn header(unpacked: u32, packed: u32) -> Vec<u8> {
        let varint = |number: u32| {
            let (mut number, mut bytes) = (u64::from(number) << 1, Vec::new());
            while number > 0x7f {
                bytes.push(number as u8 | 0x80);
                number >>= 7;
            }
            bytes.push(number as u8);
            bytes
        };
        let within = [0x18, 3, b'a', b'b', b'c', 0x19, 0x25, 2, 4, 0x11, 0x00];
        [&[0x15, 0][..], &[0x15], &varint(unpacked), &[0x15], &varint(packed), &[0x2c], &within, &[0x00]].concat()
    }

    fn checked(bytes: Vec<u8>, largest: u64) -> Result<(), String> {
        let end = bytes.len() as u64;
        check_chunk(&mut BufReader::new(Cursor::new(bytes)), 0, end, largest)
    }

    #[test]
    fn every_page_of_a_column_is_checked() {
        let page = |unpacked: u32| [header(unpacked, 5), vec![0; 5]].concat();
        assert_eq!(checked([page(100), page(200)].concat(), 200), Ok(()));
        let refused = checked([page(100), page(3 << 20)].concat(), 2 << 20);
        assert_eq!(refused, Err("a page of it unpacks to more than 2 MB".into()));
        assert_eq!(checked(header(100, 1000), 200), Ok(()), "the reader reports a file that ends early");
        assert!(checked(vec![0x1f; 40], 200).is_err());
    }
}
