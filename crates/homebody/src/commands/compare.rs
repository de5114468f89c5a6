//! `homebody compare`: two logs, compared.

use super::log_input::{LogOptions, print_remarks, print_skipped, warn_of_incomplete};
use crate::failure::Failure;
use crate::print::{print_json, print_text, tell};
use homebody_analysis::compare::{MEASURES, begins, compare};
use homebody_log::{Log, SensorMap};
use homebody_query::LogRef;
use std::path::PathBuf;

/// Compare the event counts and gaps of two logs
///
/// The report compares the number of events by sensor and in total, their agreement, and the distribution of the times between
/// events. The second log is the reference. With activities, from the ground truth or from the log, it also compares by activity, as
/// Godsey & Skubic do.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody compare runs/tigerplace-2 runs/tigerplace-1
  homebody compare simulated.db casas:real.txt --json
  homebody compare runs/tigerplace-1 casas:real.txt --sensors sensors.csv

Measures:
{}", MEASURES.trim_end()))]
pub struct CompareArguments {
    /// Log: a file, a run folder, a data set folder, or FORM:FILE
    a: String,
    /// Reference log
    b: String,
    #[command(flatten)]
    how: LogOptions,
    /// CSV file with the columns id and name; before the comparison, Homebody gives each sensor id its name in both logs
    #[arg(long, value_name = "FILE")]
    sensors: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl CompareArguments {
    pub fn run(self) -> Result<(), Failure> {
        let map = self.sensors.as_deref().map(SensorMap::read).transpose()?.unwrap_or_default();
        let found = [self.how.find(&self.a)?, self.how.find(&self.b)?];
        // A run knows the sensors of its own log, and of a copy of it.
        let name = |id: &str| found.iter().find_map(|named| named.name_of(id)).unwrap_or(id).to_owned();
        let read = |text: &str, named: &LogRef| {
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

/// The log, with the activities of the ground truth of its run.
fn log(text: &str, named: &LogRef) -> Result<Log, Failure> {
    let log = named.with_activities(None)?;
    print_remarks(text, &log);
    warn_of_incomplete(text, named.incomplete().as_ref());
    print_skipped(text, &log);
    if !log.events.is_empty() && !log.values.iter().any(|value| begins(value)) {
        tell(format_args!("{text}: no row marks the start of an event; its values are {}", listed(&log.values)));
    }
    Ok(log)
}

fn listed(values: &[String]) -> String {
    let first: Vec<String> = values.iter().take(5).map(|value| format!("{value:?}")).collect();
    let others = if values.len() > first.len() { " and others" } else { "" };
    first.join(", ") + others
}
