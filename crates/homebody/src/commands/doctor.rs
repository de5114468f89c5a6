//! `homebody doctor`: problems of an installation, a log, a ground truth, a database, a broker or a run folder.

use crate::failure::{EXIT_CODES, Failure};
use crate::installation;
use crate::print::{print_json, print_text, tell};
use homebody_core::problem::counted;
use homebody_log::read_mapping;
use homebody_log::run::places::RUNS;
use homebody_query::{Check, CheckVerdict, PlaceCheck, PlaceReport};
use serde_json::json;
use std::path::{Path, PathBuf};

homebody_core::messages! {
    /// The result of `homebody doctor`.
    pub enum DoctorMessage in "doctor" {
        /// At least one check is wrong. The report lists each check with its result and a hint. Warnings do not count.
        Wrong { count: usize } error "wrong" ("number of checks marked wrong: {count}")
            hint ("follow the hints of the report, and run homebody doctor again");
    }
}

/// Diagnose an installation, a log, a database, a broker or a run
///
/// A place is a log, a ground truth, a database, a broker, a run folder or a cohort folder. Each line is one check: ok, warning or
/// wrong, with a hint. The command only reads, unless you add --write. It never prints passwords. The exit code is 1 if a check is
/// wrong; warnings do not count.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody doctor
  homebody doctor runs/tigerplace-1 --replay
  homebody doctor sqlite:log.db parquet:lives
  homebody doctor postgresql://ann@db.example/homes mqtts://ann@broker/homebody --write

{EXIT_CODES}."))]
pub struct DoctorArguments {
    /// Places to check (default: the installation)
    #[arg(value_name = "PLACE")]
    places: Vec<String>,
    /// File such as logger.json with the table and column names of a log
    #[arg(long, value_name = "FILE")]
    mapping: Option<PathBuf>,
    /// Also test writing, without leaving data: the test message to a broker is not retained
    #[arg(long)]
    write: bool,
    /// Replay the run in a run folder, and compare each event
    #[arg(long)]
    replay: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl DoctorArguments {
    pub fn run(self) -> Result<(), Failure> {
        let mapping = self.mapping.as_deref().map(read_mapping).transpose()?;
        let examining = PlaceCheck { mapping, may_write: self.write, replays: self.replay };
        let mut examined = Vec::new();
        if self.places.is_empty() {
            let checks = installation::examine(Path::new(RUNS));
            examined.push(PlaceReport { place: "this installation".into(), checks });
        }
        for place in &self.places {
            examined.push(examining.examine(place)?);
        }
        let count =
            |verdict| examined.iter().flat_map(|place| &place.checks).filter(|check| check.verdict == verdict).count();
        let (wrong, warnings) = (count(CheckVerdict::Wrong), count(CheckVerdict::Warning));
        match self.json {
            true => print_json(&json!({ "places": examined, "wrong": wrong, "warnings": warnings }))?,
            false => print_text(&examined.iter().map(text).collect::<String>())?,
        }
        match (wrong, warnings) {
            (0, 0) => tell("no problems"),
            (0, warnings) => tell(format_args!("no problems; {}", counted(warnings, "warning", "warnings"))),
            (count, _) => return Err(Failure::file(DoctorMessage::Wrong { count })),
        }
        Ok(())
    }
}

fn text(examined: &PlaceReport) -> String {
    let width = examined.checks.iter().map(|check| check.about.len()).max().unwrap_or(0);
    let line = |check: &Check| {
        let verdict = match check.verdict {
            CheckVerdict::Ok => "ok",
            CheckVerdict::Warning => "warning",
            CheckVerdict::Wrong => "wrong",
        };
        let hint =
            check.hint.as_ref().map_or_else(String::new, |hint| format!("           {:width$}  hint: {hint}\n", ""));
        format!("  {verdict:7}  {:width$}  {}\n{hint}", check.about, check.says)
    };
    format!("{}\n{}", examined.place, examined.checks.iter().map(line).collect::<String>())
}
