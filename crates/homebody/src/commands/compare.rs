//! `homebody compare`: how alike two logs are.

use super::read_log::{HowRead, tell_remarks, tell_unfinished};
use crate::failure::Failure;
use crate::print::{print_json, print_text, tell};
use homebody_analysis::compare::{MEASURES, begins, compare};
use homebody_kit::NamedLog;
use homebody_log::{Log, SensorMap};
use std::path::PathBuf;

/// Compares the firings of two logs: by sensor and in all, the agreement of their numbers, and how their times between
/// firings are spread. The second is the reference. Where activities are known, from the truth beside the log or from
/// notes in it, also by activity, as Godsey & Skubic have it.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody compare runs/tigerplace-2 runs/tigerplace-1
  homebody compare simulated.db casas:real.txt --json
  homebody compare runs/tigerplace-1 casas:real.txt --sensors sensors.csv

Measures:
{}", MEASURES.trim_end()))]
pub struct Arguments {
    /// A log: a file, the folder of a run or of a data set, or FORM:FILE
    a: String,
    /// The log to compare with
    b: String,
    #[command(flatten)]
    how: HowRead,
    /// A table with the columns id and name: what one log calls a sensor, and what the other does
    #[arg(long, value_name = "FILE")]
    sensors: Option<PathBuf>,
    /// Print the comparison as one JSON object
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let map = self.sensors.as_deref().map(SensorMap::read).transpose()?.unwrap_or_default();
        let found = [self.how.find(&self.a)?, self.how.find(&self.b)?];
        // A run knows what its own log's ids mean, and those of a copy of it.
        let name = |id: &str| found.iter().find_map(|named| named.name_of(id)).unwrap_or(id).to_owned();
        let read = |text: &str, named: &NamedLog| {
            let mut log = log(text, named)?;
            for sensor in &mut log.sensors {
                *sensor = map.name(sensor).map_or_else(|| name(sensor), str::to_owned);
            }
            Ok::<_, Failure>(log)
        };
        let comparison = compare(&read(&self.a, &found[0])?, &read(&self.b, &found[1])?);
        if self.json { print_json(&comparison) } else { print_text(&comparison.to_string()) }
    }
}

/// The log, with the activities that the truth of its run tells.
fn log(text: &str, named: &NamedLog) -> Result<Log, Failure> {
    let log = named.with_activities(None)?;
    tell_remarks(text, &log);
    tell_unfinished(text, named.unfinished().as_ref());
    if log.skipped > 0 {
        tell(format_args!("{text}: {} lines were left out; homebody look says which", log.skipped));
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
