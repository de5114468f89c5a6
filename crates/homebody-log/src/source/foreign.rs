//! Recognises files of other kinds by their first bytes, and says in a sentence what the user can do instead.

use super::start::Start;

/// The first bytes of a kind of file, and the sentence about it.
struct Foreign {
    begins: &'static [u8],
    what: &'static str,
}

const fn foreign(begins: &'static [u8], what: &'static str) -> Foreign {
    Foreign { begins, what }
}

const ARCHIVE: &str = "it is an archive, or a spreadsheet's own form: take the log out of it, or save it as CSV";
const PICTURE: &str = "it is a picture: give the log whose rows it shows";
const PACKED: &str = "it is packed in a way that is not read: unpack it first";
const MATRIX: &str =
    "it is a file of MATLAB: write its table as CSV there, with writetable, or in Python with scipy.io.loadmat";
const HDF: &str =
    "it is a file of HDF5, as MATLAB and pandas write: write its table as CSV there, with writetable or to_csv";
const R: &str = "it is a file of R: write its table as CSV there, with write.csv";
const MYSQL: &str = "it is a dump of a MySQL database: load it there, and write the table as CSV with a time, a sensor and a \
                     value in each row";
const POSTGRES: &str = "it is a dump of a PostgreSQL database: load it there and read it as postgresql:, or write the table as \
                        CSV with \\copy";
const PAGE: &str = "it is a web page, perhaps the error page of a download: download the file itself again";
const EVENTS: &str = "it is a stream of events as a server sends them: take the JSON out of it, with sed -n 's/^data: //p' FILE > FILE.json, \
                      and read that";
const NO_DATA: &str = "it is a pointer of Git LFS, and the data itself is not here: fetch it with git lfs pull";

/// By the first bytes.
const FOREIGN: [Foreign; 42] = [
    foreign(b"version https://git-lfs.github.com/spec/", NO_DATA),
    foreign(
        b"/annex/objects/",
        "it is a pointer of git-annex, and the data itself is not here: fetch it with git annex get",
    ),
    foreign(b"\xff\xfe", "it is a text in UTF-16: save it in UTF-8"),
    foreign(b"\xfe\xff", "it is a text in UTF-16: save it in UTF-8"),
    foreign(b"PK\x03\x04", ARCHIVE),
    foreign(b"PK\x05\x06", ARCHIVE),
    foreign(b"7z\xbc\xaf\x27\x1c", "it is a 7z archive: take the log out of it"),
    foreign(b"Rar!\x1a\x07", "it is a RAR archive: take the log out of it"),
    foreign(b"\xfd7zXZ\0", PACKED),
    foreign(b"BZh", PACKED),
    foreign(b"\x04\x22\x4d\x18", PACKED),
    foreign(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "it is an old file of Microsoft Office: save its table as CSV"),
    foreign(b"%PDF-", "it is a PDF: export the table that it shows as CSV"),
    foreign(b"{\\rtf", "it is a text of a word processor: save it as plain text"),
    foreign(b"\x89PNG\r\n", PICTURE),
    foreign(b"\xff\xd8\xff", PICTURE),
    foreign(b"GIF8", PICTURE),
    foreign(b"II*\0", PICTURE),
    foreign(b"MM\0*", PICTURE),
    foreign(b"<svg", PICTURE),
    foreign(b"\x89HDF\r\n\x1a\n", HDF),
    foreign(b"CDF\x01", "it is a file of NetCDF: write its table as CSV"),
    foreign(b"MATLAB 5.0 MAT-file", MATRIX),
    foreign(b"MATLAB 7.3 MAT-file", MATRIX),
    foreign(
        b"\x93NUMPY",
        "it is an array of NumPy: write it as CSV with times and names of sensors, as numpy.savetxt does",
    ),
    foreign(b"RDX2\n", R),
    foreign(b"RDX3\n", R),
    foreign(b"$FL2", "it is a file of SPSS: save its table as CSV there"),
    foreign(b"<stata_dta>", "it is a file of Stata: save its table as CSV there"),
    foreign(b"FEA1", "it is an old Feather file: write it as Parquet or CSV"),
    foreign(b"-- MySQL dump", MYSQL),
    foreign(b"-- MariaDB dump", MYSQL),
    foreign(b"/*M!999999", MYSQL),
    foreign(b"-- phpMyAdmin SQL Dump", MYSQL),
    foreign(b"-- PostgreSQL database", POSTGRES),
    foreign(b"--\n-- PostgreSQL database", POSTGRES),
    foreign(b"PGDMP", POSTGRES),
    foreign(
        b"PRAGMA foreign_keys",
        "it is a dump of a SQLite database: make it one again with sqlite3 log.db < FILE, and read log.db",
    ),
    foreign(
        b"\0\xb5\0mosquitto db",
        "it is the store of mosquitto, which keeps the last message of each topic and no log: record one with \
                             mosquitto_sub -v -F '%U %t %p'",
    ),
    foreign(b"\x7fELF", "it is a program"),
    foreign(b"MZ\x90\0", "it is a program"),
    foreign(
        b"BEGIN:VCALENDAR",
        "it is a calendar: write its entries as CSV with the columns start_time, end_time and activity",
    ),
];

/// The sentence about a file of another kind; None for any other file.
pub(super) fn foreign_kind(start: &Start) -> Option<String> {
    let bytes = start.bytes();
    if start.is_sqlite() {
        return None;
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if text.is_empty() {
        return Some("it is empty: nothing has been written to it".into());
    }
    let begins = |known: &Foreign| bytes.starts_with(known.begins) || text.starts_with(known.begins);
    if let Some(known) = FOREIGN.iter().find(|known| begins(known)) {
        return Some(known.what.into());
    }
    let contains = |part: &[u8]| memchr::memmem::find(bytes, part).is_some();
    let lower: Vec<u8> = text.iter().take(200).map(u8::to_ascii_lowercase).collect();
    match () {
        () if lower.starts_with(b"<!doctype html") || lower.starts_with(b"<html") => Some(PAGE.into()),
        () if start.lines().filter(|line| line.starts_with("data: {") || line.starts_with("data: [")).count() > 1 => {
            Some(EVENTS.into())
        }
        () if is_pickle(bytes) => Some("it is a pickle of Python, which runs what is in it: open it where it was written, and write the table as CSV with to_csv".into()),
        () if bytes.get(257..262) == Some(b"ustar") => Some(ARCHIVE.into()),
        () if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") => Some(PICTURE.into()),
        () if contains(b"\nINSERT INTO ") || text.starts_with(b"INSERT INTO ") || text.starts_with(b"CREATE TABLE ") => {
            Some("it is a dump of a database in SQL: load it there, and write the table as CSV with a time, a sensor and a value in each row".into())
        }
        () => None,
    }
}

/// The sentence about a file without a form that has no text of rows.
pub(super) fn no_text(start: &Start) -> Option<String> {
    // No text has this byte; in programs and packed files it comes soon.
    let is_other = !start.is_sqlite() && start.bytes().contains(&0);
    let is_xml = start.lines().next().is_some_and(|line| line.starts_with("<?xml") || line.starts_with('<'));
    let xml = || is_xml.then(|| "it is XML, and no event log in XES: write its rows as CSV".to_owned());
    foreign_kind(start).or_else(|| is_other.then(|| "it is neither a text nor a database".into())).or_else(xml)
}

/// Whether bytes begin as Python writes its objects, in the protocols 2 to 5; in the first, as pandas and lists do.
fn is_pickle(bytes: &[u8]) -> bool {
    let is_later = matches!(bytes, [0x80, 2..=5, b'}' | b']' | b'c' | b'(' | b'X' | 0x8c | 0x95 | b'q', ..]);
    is_later || bytes.starts_with(b"ccopy_reg\n") || bytes.starts_with(b"(dp0\n") || bytes.starts_with(b"(lp0\n")
}
