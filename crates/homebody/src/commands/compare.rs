//! `homebody compare`: how alike two logs are.

use super::convert::tell_remarks;
use crate::failure::Failure;
use crate::print::{print_json, print_text, tell};
use homebody_analysis::compare::{MEASURES, begins, compare};
use homebody_core::scenario::logger::LoggerFile;
use homebody_kit::place_of_log;
use homebody_log::{Log, activities, read};

/// Compares the firings of two logs: by sensor and in all, the agreement of their numbers, and how their times between
/// firings are spread. The second is the reference. Where activities are known, from a truth.db beside the log or from
/// notes in it, also by activity, as Godsey & Skubic have it.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody compare runs/tigerplace-2 runs/tigerplace-1
  homebody compare simulated.db casas:real.txt --json

Measures:
{}", MEASURES.trim_end()))]
pub struct Arguments {
    /// A log: a file, a run's folder, or sqlite:FILE, csv:FILE or casas:FILE
    a: String,
    /// The log to compare with
    b: String,
    /// Print the comparison as one JSON object
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let comparison = compare(&log(&self.a)?, &log(&self.b)?);
        if self.json { print_json(&comparison) } else { print_text(&comparison.to_string()) }
    }
}

/// The log, with the activities that the truth of its run tells.
fn log(text: &str) -> Result<Log, Failure> {
    let place = place_of_log(text)?;
    let mut log = read(&place, &LoggerFile::default())?;
    let truth = place.file().unwrap_or(std::path::Path::new("")).with_file_name("truth.db");
    if truth.is_file() {
        log.activities = activities(&truth)?;
    }
    tell_remarks(text, &log);
    if log.skipped > 0 {
        tell(format_args!("{text}: {} lines were left out; homebody convert says which", log.skipped));
    }
    if !log.events.is_empty() && !log.values.iter().any(|value| begins(value)) {
        tell(format_args!("{text}: no row says that something began; its values are {}", listed(&log.values)));
    }
    Ok(log)
}

/// The first of the values.
fn listed(values: &[String]) -> String {
    let first: Vec<String> = values.iter().take(5).map(|value| format!("{value:?}")).collect();
    let others = if values.len() > first.len() { " and others" } else { "" };
    first.join(", ") + others
}
