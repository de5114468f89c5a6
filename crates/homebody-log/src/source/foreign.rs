//! Recognises files of other kinds by their first bytes, and says what the user can do instead.

use super::messages::FormMessage;
use super::start::FileStart;

struct Foreign {
    begins: &'static [u8],
    is: ForeignKind,
}

#[derive(Clone, Copy)]
enum ForeignKind {
    /// A kind, and the advice about it.
    Other(&'static str, &'static str),
    /// A pointer of a program, and the command that fetches the data.
    Pointer(&'static str, &'static str),
    Utf16,
    Archive(&'static str),
    Packed,
    /// A dump of a kind of database, and the advice about it.
    Dump(&'static str, &'static str),
}

impl ForeignKind {
    fn message(self) -> FormMessage {
        match self {
            ForeignKind::Other(kind, advice) => FormMessage::OtherKind { kind, advice },
            ForeignKind::Pointer(program, command) => FormMessage::Pointer { program, command },
            ForeignKind::Utf16 => FormMessage::Utf16,
            ForeignKind::Archive(kind) => FormMessage::Archive { kind },
            ForeignKind::Packed => FormMessage::Packed,
            ForeignKind::Dump(kind, advice) => FormMessage::Dump { kind, advice },
        }
    }
}

const fn foreign(begins: &'static [u8], is: ForeignKind) -> Foreign {
    Foreign { begins, is }
}

const ARCHIVE: ForeignKind = ForeignKind::Archive("an archive or a spreadsheet");
const PICTURE: ForeignKind = ForeignKind::Other("a picture", "give the log whose rows it shows");
const MATRIX: ForeignKind = ForeignKind::Other(
    "a file of MATLAB",
    "write its table as CSV with writetable, or in Python with scipy.io.loadmat",
);
const HDF: ForeignKind = ForeignKind::Other(
    "a file in HDF5, as MATLAB and pandas write",
    "write its table as CSV with writetable or to_csv",
);
const R: ForeignKind = ForeignKind::Other("a file of R", "write its table as CSV with write.csv");
const MYSQL: ForeignKind = ForeignKind::Dump(
    "a MySQL database",
    "load it into MySQL, and write the table as CSV with a time, a sensor and a value in each row",
);
const POSTGRES: ForeignKind = ForeignKind::Dump(
    "a PostgreSQL database",
    "load it into PostgreSQL and read it as postgresql:, or write the table as CSV with \\copy",
);
const SQL: ForeignKind = ForeignKind::Dump(
    "a database in SQL",
    "load it into its database, and write the table as CSV with a time, a sensor and a value in each row",
);
const PAGE: ForeignKind =
    ForeignKind::Other("a web page, perhaps the error page of a download", "download the file itself again");
const EVENTS: ForeignKind = ForeignKind::Other(
    "a stream of events as a server sends them",
    "extract the JSON with sed -n 's/^data: //p' FILE > FILE.json, and read that",
);
const PROGRAM: ForeignKind = ForeignKind::Other("a program", "give the log that it writes");
const PICKLE: ForeignKind = ForeignKind::Other(
    "a pickle of Python, which runs the code in it when it is opened",
    "open it where it was written, and write the table as CSV with to_csv",
);
const CSV: &str = "save its table as CSV";

const FOREIGN: [Foreign; 42] = [
    foreign(b"version https://git-lfs.github.com/spec/", ForeignKind::Pointer("Git LFS", "git lfs pull")),
    foreign(b"/annex/objects/", ForeignKind::Pointer("git-annex", "git annex get")),
    foreign(b"\xff\xfe", ForeignKind::Utf16),
    foreign(b"\xfe\xff", ForeignKind::Utf16),
    foreign(b"PK\x03\x04", ARCHIVE),
    foreign(b"PK\x05\x06", ARCHIVE),
    foreign(b"7z\xbc\xaf\x27\x1c", ForeignKind::Archive("a 7z archive")),
    foreign(b"Rar!\x1a\x07", ForeignKind::Archive("a RAR archive")),
    foreign(b"\xfd7zXZ\0", ForeignKind::Packed),
    foreign(b"BZh", ForeignKind::Packed),
    foreign(b"\x04\x22\x4d\x18", ForeignKind::Packed),
    foreign(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", ForeignKind::Other("an old file of Microsoft Office", CSV)),
    foreign(b"%PDF-", ForeignKind::Other("a PDF", "export the table that it shows as CSV")),
    foreign(b"{\\rtf", ForeignKind::Other("a text of a word processor", "save it as plain text")),
    foreign(b"\x89PNG\r\n", PICTURE),
    foreign(b"\xff\xd8\xff", PICTURE),
    foreign(b"GIF8", PICTURE),
    foreign(b"II*\0", PICTURE),
    foreign(b"MM\0*", PICTURE),
    foreign(b"<svg", PICTURE),
    foreign(b"\x89HDF\r\n\x1a\n", HDF),
    foreign(b"CDF\x01", ForeignKind::Other("a file of NetCDF", "write its table as CSV")),
    foreign(b"MATLAB 5.0 MAT-file", MATRIX),
    foreign(b"MATLAB 7.3 MAT-file", MATRIX),
    foreign(
        b"\x93NUMPY",
        ForeignKind::Other(
            "an array of NumPy",
            "write it as CSV with times and names of sensors, as numpy.savetxt does",
        ),
    ),
    foreign(b"RDX2\n", R),
    foreign(b"RDX3\n", R),
    foreign(b"$FL2", ForeignKind::Other("a file of SPSS", CSV)),
    foreign(b"<stata_dta>", ForeignKind::Other("a file of Stata", CSV)),
    foreign(b"FEA1", ForeignKind::Other("an old Feather file", "write it as Parquet or CSV")),
    foreign(b"-- MySQL dump", MYSQL),
    foreign(b"-- MariaDB dump", MYSQL),
    foreign(b"/*M!999999", MYSQL),
    foreign(b"-- phpMyAdmin SQL Dump", MYSQL),
    foreign(b"-- PostgreSQL database", POSTGRES),
    foreign(b"--\n-- PostgreSQL database", POSTGRES),
    foreign(b"PGDMP", POSTGRES),
    foreign(
        b"PRAGMA foreign_keys",
        ForeignKind::Dump("an SQLite database", "make it a database again with sqlite3 log.db < FILE, and read log.db"),
    ),
    foreign(
        b"\0\xb5\0mosquitto db",
        ForeignKind::Other(
            "the store of mosquitto, which has the last message of each topic alone",
            "record a log with mosquitto_sub -v -F '%U %t %p'",
        ),
    ),
    foreign(b"\x7fELF", PROGRAM),
    foreign(b"MZ\x90\0", PROGRAM),
    foreign(
        b"BEGIN:VCALENDAR",
        ForeignKind::Other("a calendar", "write its entries as CSV with the columns start_time, end_time and activity"),
    ),
];

/// The message about a file of another kind; None for any other file.
pub(crate) fn foreign_kind(start: &FileStart) -> Option<FormMessage> {
    let bytes = start.bytes();
    if start.is_sqlite() {
        return None;
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if text.is_empty() {
        return Some(FormMessage::Empty);
    }
    let begins = |known: &Foreign| bytes.starts_with(known.begins) || text.starts_with(known.begins);
    if let Some(known) = FOREIGN.iter().find(|known| begins(known)) {
        return Some(known.is.message());
    }
    let contains = |part: &[u8]| memchr::memmem::find(bytes, part).is_some();
    let lower: Vec<u8> = text.iter().take(200).map(u8::to_ascii_lowercase).collect();
    let is = match () {
        () if lower.starts_with(b"<!doctype html") || lower.starts_with(b"<html") => PAGE,
        () if start.lines().filter(|line| line.starts_with("data: {") || line.starts_with("data: [")).count() > 1 => {
            EVENTS
        }
        () if is_pickle(bytes) => PICKLE,
        () if bytes.get(257..262) == Some(b"ustar") => ARCHIVE,
        () if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") => PICTURE,
        () if contains(b"\nINSERT INTO ")
            || text.starts_with(b"INSERT INTO ")
            || text.starts_with(b"CREATE TABLE ") =>
        {
            SQL
        }
        () => return None,
    };
    Some(is.message())
}

/// The message about a file without a form that has no text of rows.
pub(crate) fn no_text(start: &FileStart) -> Option<FormMessage> {
    // No text has this byte; in programs and packed files it comes soon.
    let is_other = !start.is_sqlite() && start.bytes().contains(&0);
    let is_xml = start.lines().next().is_some_and(|line| line.starts_with("<?xml") || line.starts_with('<'));
    let xml = || is_xml.then_some(FormMessage::Xml);
    foreign_kind(start).or_else(|| is_other.then_some(FormMessage::Binary)).or_else(xml)
}

/// Whether bytes begin as Python writes its objects, in the protocols 2 to 5; in the first, as pandas and lists do.
fn is_pickle(bytes: &[u8]) -> bool {
    let is_later = matches!(bytes, [0x80, 2..=5, b'}' | b']' | b'c' | b'(' | b'X' | 0x8c | 0x95 | b'q', ..]);
    is_later || bytes.starts_with(b"ccopy_reg\n") || bytes.starts_with(b"(dp0\n") || bytes.starts_with(b"(lp0\n")
}
