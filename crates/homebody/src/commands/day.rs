//! `homebody day`: one day of a log.

use super::answer::Answer;
use super::read_log::{HowRead, read_log};
use crate::failure::Failure;
use homebody_analysis::dates::Asked;
use homebody_analysis::day::Day;
use homebody_picture::{DayChart, day_chart};

/// Says and draws one day of a log: what each sensor said when, and, where a run's truth or the log's own notes tell it,
/// what residents did and in which room.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody day runs/tigerplace-1 first --png day.png
  homebody day casas:aruba.txt 2010-11-04")]
pub struct Arguments {
    /// A log: a file, the folder of a run or of a data set, or FORM:FILE
    log: String,
    #[command(flatten)]
    how: HowRead,
    /// The day, such as 2009-03-02; or first, or last
    #[arg(value_name = "DATE")]
    date: Asked,
    /// The home's time zone, for logs in UTC; a run knows its own
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    #[command(flatten)]
    answer: Answer,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let read = read_log(&self.log, self.time_zone.as_deref(), &self.how)?;
        let answer = self.answer.check([""], &read.sources)?;
        let no_rows = || Failure::usage(format!("{}: it has no rows, so no day", self.log));
        let there = read.dates().ok_or_else(no_rows)?;
        let no_day = || {
            let ((first, last), asked, log) = (there, self.date, &self.log);
            Failure::usage(format!(
                "{log} has no {asked}\n  hint: it goes from {first} to {last}; first and last are days, too"
            ))
        };
        let date = self.date.within(there).ok_or_else(no_day)?;
        let day = Day::of(&read.name, &read.log, &read.lives, read.ended(), date);
        answer.give(&day, [&|| day_chart(&DayChart::of(&day))])
    }
}
