//! `homebody sensor-faults`: the faults of a home's sensors.

use super::log_input::LogArguments;
use super::result_output::JsonOutput;
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::tell;
use crate::progress;
use homebody_tracking::health;
use std::path::PathBuf;

/// Detect sensor faults from the log of a home
///
/// Homebody reports sensors that are stuck, dead or weak, lose messages, fire without cause, face a different direction from that
/// in the plan, or have a wrong clock, and since when.
///
/// It locates the residents from all sensors, and again four times, each time without a quarter of the sensors, which it compares with both paths. It
/// also compares each sensor with its own behaviour on other days; use a log of two weeks or more if you can.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody sensor-faults runs/tigerplace-1 --home scenarios/tigerplace
  homebody sensor-faults casas:spring.txt --home my-home --json faults.json

The experiment sensor-faults of homebody-lab measures how many simulated faults this command finds.

{EXIT_CODES}."))]
pub struct SensorFaultsArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Scenario with the home of the log
    #[arg(long, value_name = "SCENARIO")]
    home: PathBuf,
    /// Time zone of the home, for a log in UTC (default: that of the scenario)
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    #[command(flatten)]
    output: JsonOutput,
    #[command(flatten)]
    trust: Trust,
}

impl SensorFaultsArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(&[])?;
        let home = self.trust.source(&self.home)?.open()?;
        let zone = self.time_zone.clone().unwrap_or_else(|| home.scenario().file.time_zone.clone());
        let read = self.log.read(Some(&zone))?;
        let health = progress::show_share(|progress| health(&read.log, home.scenario(), progress))?;
        health.remarks.iter().for_each(|remark| tell(format_args!("{}: {remark}", self.log)));
        output.write(&health, [])
    }
}
