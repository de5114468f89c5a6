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
pub struct RowDestinations {
    /// Also write the results as rows for other programs: FILE.jsonl (jsonl:- for standard output), FILE.db (SQLite), or fhir:FILE
    /// (homebody measures only); repeatable
    #[arg(short = 'o', long = "out", value_name = "DESTINATION")]
    to: Vec<RowDestination>,
}

#[derive(Clone, Debug, PartialEq)]
enum RowDestination {
    Lines(PathBuf),
    Database(PathBuf),
    Fhir(PathBuf),
}

impl FromStr for RowDestination {
    type Err = String;

    fn from_str(text: &str) -> Result<RowDestination, String> {
        if let Some(("fhir", file)) = text.split_once(':').filter(|(_, file)| !file.is_empty()) {
            return Ok(RowDestination::Fhir(file.into()));
        }
        match Scheme::split(text) {
            Ok((Scheme::Jsonl, file)) => Ok(RowDestination::Lines(file.into())),
            Ok((Scheme::Sqlite, file)) => Ok(RowDestination::Database(file.into())),
            _ => Err("\n  hint: write jsonl:FILE, sqlite:FILE, or fhir:FILE for measures".into()),
        }
    }
}

impl RowDestinations {
    /// Refuses destinations that cannot be written, before the work starts.
    pub fn check(&self, has_fhir: bool, sources: &[PathBuf], force: bool) -> Result<(), Failure> {
        if !has_fhir && self.to.iter().any(|to| matches!(to, RowDestination::Fhir(_))) {
            return Err(Failure::asked(ResultMessage::Fhir));
        }
        let files: Vec<&PathBuf> = self.to.iter().filter_map(RowDestination::whole_file).collect();
        let files: Vec<&std::path::Path> = files.into_iter().map(PathBuf::as_path).collect();
        Ok(can_be_written(&files, sources, force)?)
    }

    /// True if rows go to standard output, which must then have nothing else.
    pub fn is_printed(&self) -> bool {
        self.to.contains(&RowDestination::Lines("-".into()))
    }

    /// True if the only destination is standard output, or there is none.
    pub fn is_empty_or_printed(&self) -> bool {
        self.to.iter().all(|to| *to == RowDestination::Lines("-".into()))
    }

    /// Stores rows; `fhir` makes the bundle if a destination needs it.
    pub fn store(&self, records: &Records, fhir: &dyn Fn() -> Value, force: bool) -> Result<(), Failure> {
        for to in &self.to {
            match to {
                RowDestination::Lines(path) if path.as_os_str() == "-" => print_json_text(&records.lines())?,
                RowDestination::Lines(path) => write_file(path, records.lines().as_bytes(), force)?,
                RowDestination::Database(path) => records.store(path, force)?,
                RowDestination::Fhir(path) => write_file(path, json_text(&fhir())?.as_bytes(), force)?,
            }
        }
        Ok(())
    }
}

impl RowDestination {
    /// The file of a destination that is written as a whole.
    fn whole_file(&self) -> Option<&PathBuf> {
        match self {
            RowDestination::Lines(path) | RowDestination::Fhir(path) if path.as_os_str() != "-" => Some(path),
            _ => None,
        }
    }
}

pub fn row(of: &impl serde::Serialize) -> serde_json::Map<String, Value> {
    match serde_json::to_value(of) {
        Ok(Value::Object(row)) => row,
        _ => serde_json::Map::new(),
    }
}
