//! `homebody day`: one day of a log.

use super::log_input::LogArguments;
use super::messages::LogContentMessage;
use super::result_output::ResultOutput;
use crate::failure::Failure;
use homebody_analysis::dates::DayChoice;
use homebody_analysis::day::DayRecord;
use homebody_picture::{DayChart, day_chart};

/// Show one day of a log with a chart
///
/// The report has the events of each sensor. With the ground truth of a run, or activities in the log, it also has what residents did,
/// and where.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody day runs/tigerplace-1 first --png day.png
  homebody day casas:aruba.txt 2010-11-04")]
pub struct DayArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Date such as 2009-03-02, or first or last
    #[arg(value_name = "DATE")]
    date: DayChoice,
    /// The home's time zone, for a log in UTC; not needed for a run folder, which stores it
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    #[command(flatten)]
    output: ResultOutput,
}

impl DayArguments {
    pub fn run(self) -> Result<(), Failure> {
        let read = self.log.read(self.time_zone.as_deref())?;
        let output = self.output.check([""], &read.sources)?;
        let log = || self.log.to_string();
        let there = read.dates().ok_or_else(|| Failure::asked(LogContentMessage::NoRows { log: log() }))?;
        let no_day = || {
            let [day, first, last] = [self.date.to_string(), there.0.to_string(), there.1.to_string()];
            Failure::asked(LogContentMessage::NoDay { log: log(), day, first, last })
        };
        let date = self.date.within(there).ok_or_else(no_day)?;
        let day = DayRecord::from_log(&read.name, &read.log, &read.timeline.people, read.ended(), date);
        output.write(&day, [&|| day_chart(&DayChart::new(&day))])
    }
}
