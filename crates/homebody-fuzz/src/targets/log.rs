//! Logs in text: CSV by spreadsheets and by this program, and the form of CASAS.

use super::{analysis, messages};
use crate::choices::Choices;
use crate::mutate::{json, sql, tables};
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::LogSource;
use std::fs;
use std::path::Path;

pub const TARGET: Target = Target { name: "log", cases: 5_000, seeds, mutate, run: read_and_analyse };

pub const FILE: &str = "log";

/// The names of a log's table and columns, in JSON.
pub const MAPPING: &str = "logger.json";

/// The truth for its labels.
pub const TRUTH: &str = "truth.db";

fn seeds() -> Vec<CaseFiles> {
    let mut seeds = seeds::files(TARGET.name, FILE);
    seeds.iter_mut().for_each(|files| drop(files.insert(MAPPING.to_owned(), b"{}".to_vec())));
    seeds
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    target::change(files, seeds, choices, |name, text, others, choices| {
        if name == MAPPING {
            mapping(text, choices);
        } else if !json::json(text, others, choices) {
            tables::table(text, choices);
        }
    });
    if choices.is(0.1) {
        let sensors = "CREATE TABLE cause(firing INTEGER, row INTEGER, resident TEXT, seen_at TEXT, sensor TEXT, why TEXT, thing TEXT);\n\
                       INSERT INTO cause VALUES (0, 0, 'a', '2009-03-02 07:12:03', 'bed motion', 'movement', NULL);\n";
        files.insert(TRUTH.to_owned(), sql::database(sensors, choices));
    }
}

/// Another mapping, with names of tables and columns that exist or not.
pub fn mapping(text: &mut String, choices: &mut Choices) {
    const NAMES: [&str; 10] = ["time", "sensor", "value", "seq", "run_id", "firing", "Time", "a b", "\"", "rowid"];
    let mut name = || *choices.one(&NAMES);
    *text = serde_json::json!({
        "table": name(),
        "columns": { "time": name(), "sensor": name(), "value": name(), "seq": name(), "run": name() },
    })
    .to_string();
}

/// Writes the files of a case into a folder, and analyses the log.
pub fn read_and_analyse(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let write = |name: &str| {
        let path = folder.join(name);
        files.get(name).map_or(Ok(()), |bytes| fs::write(&path, bytes)).map(|()| path)
    };
    let failed = |error: std::io::Error| format!("the folder of the case: {error}");
    let (log, truth) = (write(FILE).map_err(failed)?, write(TRUTH).map_err(failed)?);
    let mapping: LoggerFile = serde_json::from_str(target::text(files, MAPPING)).unwrap_or_default();
    match LogSource::recognise(&log) {
        Ok(url) => analysis::all(&url, &mapping, &truth, folder),
        Err(error) => messages::refusal(&error).map(|()| ReadVerdict::Refused),
    }
}
