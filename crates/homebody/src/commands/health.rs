//! `homebody health`: what is wrong with the sensors of a home.

use super::answer::Figures;
use super::read_log::{HowRead, read_log};
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::tell;
use crate::progress;
use homebody_kit::health;
use std::path::PathBuf;

/// Says what is wrong with the sensors of a home, by its log alone: which are stuck, dead or weak, lose messages, fire for no
/// reason, look elsewhere than the plan says, or have a clock that is off, and since when.
///
/// The log is walked back through the plan, and each sensor is held against where people were by all of them, and by all
/// others. What a sensor notices is compared with what it noticed on its other days, so that a log of two weeks or more tells
/// most.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody health runs/tigerplace-1 --home scenarios/tigerplace
  homebody health casas:spring.txt --home my-home --json health.json

`homebody experiment sensor-health` plants faults and says how many of them are found.

{EXIT_CODES}."))]
pub struct Arguments {
    /// The log: a file, the folder of a run, or sqlite:FILE, csv:FILE or casas:FILE
    log: String,
    #[command(flatten)]
    how: HowRead,
    /// The folder of a scenario whose home the log is of
    #[arg(long, value_name = "SCENARIO")]
    home: PathBuf,
    /// The time zone of the home, for a log in UTC; the scenario's own without it
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    #[command(flatten)]
    figures: Figures,
    #[command(flatten)]
    trust: Trust,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let answer = self.figures.check(&[])?;
        let home = self.trust.source(&self.home)?.open()?;
        let zone = self.time_zone.clone().unwrap_or_else(|| home.scenario().file.time_zone.clone());
        let read = read_log(&self.log, Some(&zone), &self.how)?;
        let bar = progress::bar(1000, progress::SHARE);
        let health = health(&read.log, home.scenario(), |share| bar.set_position((share * 1000.0) as u64))?;
        bar.finish_and_clear();
        health.remarks.iter().for_each(|remark| tell(format_args!("{}: {remark}", self.log)));
        answer.give(&health, [])
    }
}
