//! The archive: the text of the one entry that is read, `Home.xml`.
//!
//! The entry `Home`, a dump of Java objects, is never read.

use crate::error::NotImported;
use std::io::{Cursor, Read};
use zip::ZipArchive;
use zip::result::ZipError;

const ENTRY: &str = "Home.xml";

/// The dump of Java objects, which old versions wrote alone.
const JAVA_ENTRY: &str = "Home";

/// Larger files are mostly models and textures, and hardly of one home (ours).
pub const MOST_BYTES: u64 = 64 << 20;

/// A large house takes about one (ours).
const MOST_XML_BYTES: u64 = 32 << 20;

/// Every model and texture is an entry, some of them several (ours).
const MOST_ENTRIES: u64 = 20_000;

/// Text of plans shrinks to a tenth, that of many equal walls to a fiftieth; what shrinks more was made to (ours).
const MOST_SHRUNK: u64 = 200;

/// Where shrinking begins to matter (ours).
const SMALL_BYTES: u64 = 1 << 20;

/// What the list of an archive's entries has before each of them.
const ENTRY_SIGN: &[u8] = b"PK\x01\x02";

/// The text of the plan in a file.
pub fn home_xml(bytes: &[u8]) -> Result<String, NotImported> {
    let hint = "delete furniture whose models are large, in a copy";
    within("bytes", bytes.len() as u64, MOST_BYTES, hint)?;
    // The list is read as a whole when the archive is opened.
    let entries = bytes.windows(ENTRY_SIGN.len()).filter(|window| *window == ENTRY_SIGN).count();
    within("entries", entries as u64, MOST_ENTRIES, hint)?;
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|_| NotImported::NoArchive)?;
    let is_old = archive.index_for_name(JAVA_ENTRY).is_some();
    let entry = archive.by_name(ENTRY).map_err(|error| match error {
        ZipError::FileNotFound if is_old => NotImported::OnlyJava,
        ZipError::FileNotFound => NotImported::NoHomeXml,
        error => NotImported::Damaged(error.to_string()),
    })?;
    let hint = "a plan of one home is smaller: open it in Sweet Home 3D and save it again";
    within("bytes of XML", entry.size(), MOST_XML_BYTES, hint)?;
    let packed = entry.compressed_size().max(1);
    let most = if packed > MOST_XML_BYTES { MOST_XML_BYTES } else { (packed * MOST_SHRUNK).max(SMALL_BYTES) };
    let most = most.min(MOST_XML_BYTES);
    // What the entry says of its size may be a lie.
    let mut xml = Vec::new();
    let read = entry.take(most + 1).read_to_end(&mut xml);
    read.map_err(|error| NotImported::Damaged(error.to_string()))?;
    within("bytes of XML", xml.len() as u64, most, hint)?;
    let text = String::from_utf8(xml).map_err(|_| NotImported::disorder("it is not text in UTF-8"))?;
    // A byte order mark says nothing.
    Ok(text.strip_prefix('\u{feff}').map_or_else(|| text.clone(), str::to_owned))
}

fn within(unit: &'static str, found: u64, most: u64, hint: &'static str) -> Result<(), NotImported> {
    if found > most { Err(NotImported::TooLarge { unit, found, most, hint }) } else { Ok(()) }
}
