//! Short tables, written by tests and read as logs.

use super::Folder;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Diagnostic;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::WallTime;
use homebody_log::source::TableOptions;
use homebody_log::{Log, LogError, LogSource, read};
use std::fs;

/// 2 March 2009, 07:00.
pub const SEVEN: WallTime = WallTime::from_micros(1_235_977_200_000_000);

pub fn folder() -> Folder {
    Folder::new("texts")
}

/// The form and the rows of a file with this text.
pub fn read_with(folder: &Folder, name: &str, text: &str, options: TableOptions) -> Result<(String, Log), LogError> {
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    let source = LogSource::recognise(&path)?.with_options(options);
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
