//! Logs in text: CSV as spreadsheets and we write it, and the form of CASAS.

use super::{analysed, told};
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::{json, sql, tables};
use crate::target::{self, Files, Target, Verdict};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::Source;
use std::fs;
use std::path::Path;

pub const TARGET: Target =
    Target { name: "log", about: "logs as CSV and CASAS: every command on them", cases: 5_000, corpus, mutate, run };

pub const FILE: &str = "log";

/// How a log's table and columns are called, in JSON.
pub const MAPPING: &str = "logger.json";

/// The truth by which it is labelled.
pub const TRUTH: &str = "truth.db";

fn corpus() -> Vec<Files> {
    let texts = corpus::of(TARGET.name).into_iter().flat_map(Files::into_values);
    texts.map(|text| Files::from([(FILE.to_owned(), text), (MAPPING.to_owned(), b"{}".to_vec())])).collect()
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    target::change(files, corpus, dice, |name, text, others, dice| {
        if name == MAPPING {
            mapping(text, dice);
        } else if !json::json(text, others, dice) {
            tables::table(text, dice);
        }
    });
    if dice.is(0.1) {
        let sensors = "CREATE TABLE cause(firing INTEGER, row INTEGER, resident TEXT, seen_at TEXT, sensor TEXT, why TEXT, thing TEXT);\n\
                       INSERT INTO cause VALUES (0, 0, 'a', '2009-03-02 07:12:03', 'bed motion', 'movement', NULL);\n";
        files.insert(TRUTH.to_owned(), sql::database(sensors, dice));
    }
}

/// Another mapping: names of tables and columns that are there, or are not.
pub fn mapping(text: &mut String, dice: &mut Dice) {
    const NAMES: [&str; 10] = ["time", "sensor", "value", "seq", "run_id", "firing", "Time", "a b", "\"", "rowid"];
    let mut name = || *dice.one(&NAMES);
    *text = serde_json::json!({
        "table": name(),
        "columns": { "time": name(), "sensor": name(), "value": name(), "seq": name(), "run": name() },
    })
    .to_string();
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    read_and_analyse(files, folder)
}

/// Writes the files of a case into a folder, and does with the log what can be done.
///
/// # Errors
///
/// An invariant does not hold.
pub fn read_and_analyse(files: &Files, folder: &Path) -> Result<Verdict, String> {
    let write = |name: &str| {
        let path = folder.join(name);
        files.get(name).map_or(Ok(()), |bytes| fs::write(&path, bytes)).map(|()| path)
    };
    let failed = |error: std::io::Error| format!("the folder of the case: {error}");
    let (log, truth) = (write(FILE).map_err(failed)?, write(TRUTH).map_err(failed)?);
    let mapping: LoggerFile = serde_json::from_str(target::text(files, MAPPING)).unwrap_or_default();
    match Source::recognise(&log) {
        Ok(url) => analysed::all(&url, &mapping, &truth, folder),
        Err(error) => told::message(&error.to_string()).map(|()| Verdict::Refused),
    }
}
