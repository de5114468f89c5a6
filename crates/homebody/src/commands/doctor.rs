//! `homebody doctor`: what is wrong with an installation, a log, a truth, a database, a broker or the folder of a run.

use crate::failure::{EXIT_CODES, Failure};
use crate::installation;
use crate::print::{print_json, print_text, tell};
use homebody_core::problem::counted;
use homebody_kit::{Check, Examined, Examining, Verdict};
use homebody_log::places::RUNS;
use homebody_log::read_mapping;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Says what is wrong, and what to do: with this installation, or with places that are named.
///
/// A place is a log or a truth by its URL or path, a broker, the folder of a run or of a cohort. Each line is one thing that was looked
/// at: ok, warning or wrong. It only reads, unless --write is said; passwords are never printed.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody doctor
  homebody doctor runs/tigerplace-1 --replay
  homebody doctor sqlite:log.db parquet:lives
  homebody doctor postgresql://ann@db.example/homes mqtts://ann@broker/homebody --write

{EXIT_CODES}.
Where something is wrong, and not only warned of, the exit code is 1."))]
pub struct Arguments {
    /// What to look at; without any, the installation
    #[arg(value_name = "PLACE")]
    places: Vec<String>,
    /// A logger.json that says what a log's table and columns are called
    #[arg(long, value_name = "FILE")]
    mapping: Option<PathBuf>,
    /// Also try what leaves nothing behind: say something to a broker that it does not keep
    #[arg(long)]
    write: bool,
    /// Live the run of a folder again, and compare it firing by firing
    #[arg(long)]
    replay: bool,
    /// Print what was found as one JSON object
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let mapping = self.mapping.as_deref().map(read_mapping).transpose()?;
        let examining = Examining { mapping, may_write: self.write, replays: self.replay };
        let mut examined = Vec::new();
        if self.places.is_empty() {
            let checks = installation::examine(Path::new(RUNS));
            examined.push(Examined { place: "this installation".into(), checks });
        }
        for place in &self.places {
            examined.push(examining.examine(place)?);
        }
        let count =
            |verdict| examined.iter().flat_map(|place| &place.checks).filter(|check| check.verdict == verdict).count();
        let (wrong, warnings) = (count(Verdict::Wrong), count(Verdict::Warning));
        match self.json {
            true => print_json(&json!({ "places": examined, "wrong": wrong, "warnings": warnings }))?,
            false => print_text(&examined.iter().map(text).collect::<String>())?,
        }
        match (wrong, warnings) {
            (0, 0) => tell("nothing is wrong"),
            (0, warnings) => tell(format_args!("nothing is wrong; {}", counted(warnings, "warning", "warnings"))),
            (wrong, _) => return Err(Failure::Io(counted(wrong, "thing is wrong", "things are wrong"))),
        }
        Ok(())
    }
}

/// A place and a line for each thing that was looked at.
fn text(examined: &Examined) -> String {
    let width = examined.checks.iter().map(|check| check.about.len()).max().unwrap_or(0);
    let line = |check: &Check| {
        let verdict = match check.verdict {
            Verdict::Ok => "ok",
            Verdict::Warning => "warning",
            Verdict::Wrong => "wrong",
        };
        let hint =
            check.hint.as_ref().map_or_else(String::new, |hint| format!("           {:width$}  hint: {hint}\n", ""));
        format!("  {verdict:7}  {:width$}  {}\n{hint}", check.about, check.says)
    };
    format!("{}\n{}", examined.place, examined.checks.iter().map(line).collect::<String>())
}
