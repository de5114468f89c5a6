//! Rows for programs: results as lines of JSON, as a table of a database, or as FHIR.

use crate::failure::Failure;
use crate::print::{ResultMessage, json_text, print_json_text, write_file};
use homebody_core::scenario::scheme::Scheme;
use homebody_log::records::Records;
use homebody_log::run::places::can_be_written;
use serde_json::Value;
use std::path::PathBuf;
use std::str::FromStr;

/// Destinations of rows for programs.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct ForPrograms {
    /// Also write the results as rows for other programs: FILE.jsonl (jsonl:- for standard output), FILE.db (SQLite), or fhir:FILE
    /// (homebody measures only); repeatable
    #[arg(short = 'o', long = "out", value_name = "DESTINATION")]
    to: Vec<To>,
}

/// A place for rows.
#[derive(Clone, Debug, PartialEq)]
enum To {
    Lines(PathBuf),
    Database(PathBuf),
    Fhir(PathBuf),
}

impl FromStr for To {
    type Err = String;

    fn from_str(text: &str) -> Result<To, String> {
        if let Some(("fhir", file)) = text.split_once(':').filter(|(_, file)| !file.is_empty()) {
            return Ok(To::Fhir(file.into()));
        }
        match Scheme::split(text) {
            Ok((Scheme::Jsonl, file)) => Ok(To::Lines(file.into())),
            Ok((Scheme::Sqlite, file)) => Ok(To::Database(file.into())),
            _ => Err("\n  hint: write jsonl:FILE, sqlite:FILE, or fhir:FILE for measures".into()),
        }
    }
}

impl ForPrograms {
    /// Refuses destinations that cannot be written, before the command starts its work.
    pub fn check(&self, has_fhir: bool, sources: &[PathBuf], force: bool) -> Result<(), Failure> {
        if !has_fhir && self.to.iter().any(|to| matches!(to, To::Fhir(_))) {
            return Err(Failure::asked(ResultMessage::Fhir));
        }
        let files: Vec<&PathBuf> = self.to.iter().filter_map(To::whole_file).collect();
        let files: Vec<&std::path::Path> = files.into_iter().map(PathBuf::as_path).collect();
        Ok(can_be_written(&files, sources, force)?)
    }

    /// Whether rows go to standard output, so that nothing else may.
    pub fn is_printed(&self) -> bool {
        self.to.contains(&To::Lines("-".into()))
    }

    /// Whether nothing is asked for but lines on standard output.
    pub fn is_empty_or_printed(&self) -> bool {
        self.to.iter().all(|to| *to == To::Lines("-".into()))
    }

    /// Stores rows; `fhir` makes the bundle where it is asked for.
    pub fn store(&self, records: &Records, fhir: &dyn Fn() -> Value, force: bool) -> Result<(), Failure> {
        for to in &self.to {
            match to {
                To::Lines(path) if path.as_os_str() == "-" => print_json_text(&records.lines())?,
                To::Lines(path) => write_file(path, records.lines().as_bytes(), force)?,
                To::Database(path) => records.store(path, force)?,
                To::Fhir(path) => write_file(path, json_text(&fhir())?.as_bytes(), force)?,
            }
        }
        Ok(())
    }
}

impl To {
    /// The file that is written as a whole.
    fn whole_file(&self) -> Option<&PathBuf> {
        match self {
            To::Lines(path) | To::Fhir(path) if path.as_os_str() != "-" => Some(path),
            _ => None,
        }
    }
}

/// A row of the named values of something.
pub fn row(of: &impl serde::Serialize) -> serde_json::Map<String, Value> {
    match serde_json::to_value(of) {
        Ok(Value::Object(row)) => row,
        _ => serde_json::Map::new(),
    }
}
