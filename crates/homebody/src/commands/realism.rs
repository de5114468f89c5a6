//! `homebody realism`: how near a log is to a real one, and what gives it away.

use super::answer::Answer;
use super::read_log::{HowRead, read_log};
use crate::failure::Failure;
use crate::progress::Working;
use homebody_analysis::realism::{MEASURES, NotComparable, Told, realism};
use homebody_kit::LogWithRun;
use homebody_picture::{realism_chart, realism_page};
use std::path::PathBuf;

/// Holds log B against log A, such as a run's against that of a real home: how their gaps, ON lengths, hours, sensors and days
/// differ, and how well a random forest tells their days and hours apart, and by what. Beside each value stands its floor: the
/// same of the two halves of A.
///
/// Only motion sensors on whole days count. Shares of sensors and ways between them are compared where both logs name their
/// sensors alike.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody realism casas:real.txt runs/older-adult-1
  homebody realism casas:real.txt runs/older-adult-1 --json realism.json --html realism.html
  homebody realism runs/older-adult-1 runs/older-adult-2 --json

Measures:
{}", MEASURES.trim_end()))]
pub struct Arguments {
    /// The log that is taken for what is real: a file, the folder of a run or of a data set, or FORM:FILE
    a: String,
    /// The log to hold against it
    b: String,
    #[command(flatten)]
    how: HowRead,
    /// Write everything as one page with pictures, which needs no other file
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// The home's time zone, for logs in UTC; a run knows its own
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    #[command(flatten)]
    answer: Answer,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let zone = self.time_zone.as_deref();
        let (a, b) = (read_log(&self.a, zone, &self.how)?, read_log(&self.b, zone, &self.how)?);
        let sources: Vec<PathBuf> = [&a, &b].into_iter().flat_map(|log| log.sources.clone()).collect();
        let answer = self.answer.check_beside([""], self.html.as_deref(), &sources)?;
        let comparing = Working::on(format!("comparing {} with {}", self.b, self.a));
        let realism = realism(told(&a), told(&b)).map_err(|problems| {
            let said: Vec<String> = problems.iter().map(NotComparable::to_string).collect();
            Failure::usage(said.join("\nerror: "))
        })?;
        drop(comparing);
        answer.give_beside(&realism, [&|| realism_chart(&realism)], &|| realism_page(&realism))
    }
}

fn told(log: &LogWithRun) -> Told<'_> {
    Told { name: &log.name, log: &log.log, recorded: log.recorded.as_ref() }
}
