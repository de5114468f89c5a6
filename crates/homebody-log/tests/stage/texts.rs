//! Short tables, written by tests and read as logs.

use super::Folder;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Diagnostic;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{MINUTE, WallTime};
use homebody_log::source::TableOptions;
use homebody_log::{Log, LogError, LogSource, SensorInfo, Transfer, Url, WriteMode, convert, read, survey};
use std::fs;
use std::path::{Path, PathBuf};

/// 2 March 2009, 07:00.
pub const SEVEN: WallTime = WallTime::from_micros(1_235_977_200_000_000);

pub fn folder() -> Folder {
    Folder::new("texts")
}

pub fn written(folder: &Folder, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    path
}

/// A file as its beginning says, and its rows.
pub fn from_file(path: &Path) -> (LogSource, Log) {
    let source = LogSource::recognise(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let log = read(&source, &LoggerFile::default()).unwrap();
    (source, log)
}

/// Reads a text that is recognised as of a form.
pub fn from_text(folder: &Folder, form: &str, name: &str, text: &str) -> Log {
    let (source, log) = from_file(&written(folder, name, text));
    assert_eq!(source.form().name, form, "{text}");
    log
}

/// Writes a log anew; how many rows it has.
pub fn carry(from: impl Into<LogSource>, to: &Url, zone: &str, how: WriteMode) -> Result<u64, LogError> {
    let mapping = LoggerFile::default();
    let from = &from.into();
    let about = survey(from, &mapping)?;
    convert(&Transfer { from, mapping: &mapping, to, name: "a log", zone, how }, &about, |_| ())
}

/// A log without what its form says of its columns.
pub fn content(log: Log) -> Log {
    Log { columns: Vec::new(), ..log }
}

pub fn known<'l>(log: &'l Log, sensor: &str) -> &'l SensorInfo {
    log.known.iter().find(|known| known.id == sensor).unwrap_or_else(|| panic!("{sensor} of {:?}", log.known))
}

/// The lines that are not understood.
pub fn skipped(log: &Log) -> Vec<u64> {
    log.problems.iter().map(|problem| problem.line).collect()
}

/// Rows as minutes since an instant, sensor, value.
pub fn minutes(log: &Log, since: WallTime) -> Vec<(f64, &str, &str)> {
    log.events.iter().map(|event| ((event.at - since).ratio(MINUTE), log.sensor(event), log.value(event))).collect()
}

/// Activities in minutes since seven, to a thousandth: one that lasts to the last row ends a microsecond after it.
pub fn done(log: &Log) -> Vec<(&str, f64, f64)> {
    let minutes = |at: WallTime| ((at - SEVEN).ratio(MINUTE) * 1e3).round() / 1e3;
    log.activities.iter().map(|of| (of.label.as_str(), minutes(of.begin()), minutes(of.end()))).collect()
}

/// The form and the rows of a file with this text.
pub fn read_with(folder: &Folder, name: &str, text: &str, options: TableOptions) -> Result<(String, Log), LogError> {
    let source = LogSource::recognise(&written(folder, name, text))?.with_options(options);
    Ok((source.form().name.to_owned(), read(&source, &LoggerFile::default())?))
}

pub fn read_as(name: &str, text: &str) -> Result<(String, Log), LogError> {
    read_with(&folder(), name, text, TableOptions::default())
}

pub fn read_text(text: &str) -> Result<(String, Log), LogError> {
    read_as("log.csv", text)
}

/// The error of a text that cannot be read as a log.
pub fn why(text: &str) -> Diagnostic {
    match read_text(text) {
        Err(error) => error.diagnostic(),
        Ok((form, log)) => panic!("{form} of {} sensors: {text}", log.sensors.len()),
    }
}

/// Rows as seconds since seven, sensor, value.
pub fn told(log: &Log) -> Vec<(f64, &str, &str)> {
    log.events.iter().map(|event| ((event.at - SEVEN).seconds(), log.sensor(event), log.value(event))).collect()
}

/// Rows of three sensors that switch, a minute apart; `row` writes one.
pub fn rows(count: usize, row: impl Fn(usize, &str, &str) -> String) -> String {
    let sensors = ["hall", "kitchen", "bath"];
    (0..count).map(|index| row(index, sensors[index / 2 % 3], ["ON", "OFF"][index % 2]) + "\n").collect()
}

pub fn clock(minute: usize) -> String {
    format!("{:02}:{:02}:00", 7 + minute / 60, minute % 60)
}
