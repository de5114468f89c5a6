//! The archive: the text of its entry `Home.xml`, or that file by itself, unpacked.
//!
//! The entry `Home`, a dump of Java objects, is never read.

use crate::error::ImportError;
use crate::file_form;
use std::io::{Cursor, Read};
use zip::ZipArchive;

const ENTRY: &str = "Home.xml";

/// The dump of Java objects, which old versions wrote alone.
const JAVA_ENTRY: &str = "Home";

/// Largest size of a plan's file (our choice): larger ones contain mostly models and textures.
pub const MOST_BYTES: u64 = 64 << 20;

/// Largest size of the unpacked XML (our choice): a large house takes about one MiB.
const MOST_XML_BYTES: u64 = 32 << 20;

/// Largest number of entries (our choice): each model and texture is one or more.
const MOST_ENTRIES: u64 = 20_000;

/// Largest compression ratio (our choice): text of plans shrinks to a tenth, that of many equal walls to a fiftieth. A
/// higher ratio is an attack.
const MOST_SHRUNK: u64 = 200;

/// Size above which the compression ratio is checked (our choice).
const SMALL_BYTES: u64 = 1 << 20;

const ENTRY_SIGN: &[u8] = b"PK\x01\x02";

pub fn home_xml(bytes: &[u8]) -> Result<String, ImportError> {
    let hint = "delete furniture whose models are large, in a copy";
    within("bytes", bytes.len() as u64, MOST_BYTES, hint)?;
    if is_unpacked(bytes) {
        within("bytes of XML", bytes.len() as u64, MOST_XML_BYTES, SAVE_AGAIN)?;
        return text(bytes.to_vec());
    }
    // The list is read as a whole when the archive is opened.
    let entries = bytes.windows(ENTRY_SIGN.len()).filter(|window| *window == ENTRY_SIGN).count();
    within("entries", entries as u64, MOST_ENTRIES, hint)?;
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|_| file_form::refused(bytes))?;
    if archive.index_for_name(ENTRY).is_none() {
        let is_old = archive.index_for_name(JAVA_ENTRY).is_some();
        let names = archive.file_names().filter_map(Result::ok).map(|name| name.into_owned());
        return Err(if is_old { ImportError::OnlyJava } else { file_form::archive_error(names) });
    }
    let entry = archive.by_name(ENTRY).map_err(|error| ImportError::Damaged(error.to_string()))?;
    let hint = SAVE_AGAIN;
    within("bytes of XML", entry.size(), MOST_XML_BYTES, hint)?;
    let packed = entry.compressed_size().max(1);
    let most = if packed > MOST_XML_BYTES { MOST_XML_BYTES } else { (packed * MOST_SHRUNK).max(SMALL_BYTES) };
    let most = most.min(MOST_XML_BYTES);
    // The size in the entry may be wrong.
    let mut xml = Vec::new();
    let read = entry.take(most + 1).read_to_end(&mut xml);
    read.map_err(|error| ImportError::Damaged(error.to_string()))?;
    within("bytes of XML", xml.len() as u64, most, hint)?;
    text(xml)
}

const SAVE_AGAIN: &str = "a plan of one home is smaller: open it in Sweet Home 3D and save it again";

/// Unpacked text: a plan without an archive around it.
fn is_unpacked(bytes: &[u8]) -> bool {
    /// Number of bytes within which the root element begins (our choice).
    const HEAD: usize = 4_096;
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]).into_owned();
    let head = head.trim_start_matches('\u{feff}').trim_start();
    // A plan has attributes in its root element.
    let has_root = || ["<home ", "<home\t", "<home\n", "<home\r"].iter().any(|root| head.contains(root));
    head.starts_with('<') && has_root()
}

fn text(xml: Vec<u8>) -> Result<String, ImportError> {
    let text = String::from_utf8(xml).map_err(|_| ImportError::NotUtf8)?;
    // A byte order mark says nothing.
    Ok(text.strip_prefix('\u{feff}').map_or_else(|| text.clone(), str::to_owned))
}

fn within(unit: &'static str, found: u64, most: u64, hint: &'static str) -> Result<(), ImportError> {
    if found > most { Err(ImportError::TooLarge { unit, found, most, hint }) } else { Ok(()) }
}
