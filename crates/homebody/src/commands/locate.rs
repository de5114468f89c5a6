//! `homebody locate`: the location of residents from the log of their home.

use super::follow::FollowedLog;
use super::log_input::LogArguments;
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{print_json, print_text, tell};
use crate::progress;
use homebody_simulation::{Cancel, SimulationError};
use homebody_tracking::located_folder::locate_into;
use std::path::PathBuf;

/// Locate residents over time from the log of their home
///
/// Homebody infers the room of each resident at each instant, with a probability. It uses the plan, the fields of the sensors and the
/// walking speed of the residents. Both events and the absence of events count. Homebody then simulates the inferred path, so that
/// you can compare the result with the log. To watch it, open the new folder with homebody serve.
///
/// Sensors do not identify people. With several residents, Homebody cannot tell which of them was where. In a home with one resident,
/// it reports another person only if the log is much less likely without one.
///
/// With --follow, Homebody writes no files. It prints changes as rows arrive, using only the rows received so far.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody locate runs/tigerplace-1 --home scenarios/tigerplace --out located
  homebody locate casas:week.txt --home my-home --out located && homebody day located/run first
  homebody locate week.csv --home my-home --out located --json
  homebody locate casas:home.txt --home my-home --follow
  tail -n +1 -F home.txt | homebody locate casas:- --home my-home --follow --json

With --follow, Homebody prints a line when the room of a resident or its probability changes; with
--json one object per line. Homebody stops at the end of standard input; it follows a file until you
stop the program.
Between two rows, Homebody evaluates each 30 s of log time, and prints changes with the next row.

Files in the new folder:
  where.csv      a row for each change: time, resident, room, probability of the room, x and y in
                 metres, doing (out, walks, stands, busy, still, motionless)
  rooms.csv      the probability of each room: time, resident, room, probability from then on; a
                 row for each change by 0.05 or more. The room is \"out\" if the resident is not at
                 home, and empty if the resident is between rooms
  scenario.json  the home with a path for each resident, for homebody run and homebody serve
  run            the run of that path: log, ground truth, recording
  given          a copy of the log
  report.json    unexplained events, sensors that Homebody does not trust, and the share of
                 each sensor's events that the path explains

Times are local times of the home.

{EXIT_CODES}."))]
pub struct LocateArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Scenario with the home of the log
    #[arg(long, value_name = "SCENARIO")]
    home: PathBuf,
    /// New folder for the results
    #[arg(short, long, value_name = "FOLDER", required_unless_present = "follow", conflicts_with = "follow")]
    out: Option<PathBuf>,
    /// Follow the log as it grows, and print changes; FORM:- reads standard input
    #[arg(long)]
    follow: bool,
    /// Seconds between two reads of the log with --follow
    #[arg(long, value_name = "SECONDS", default_value_t = 5, requires = "follow", value_parser = clap::value_parser!(u64).range(1..=86_400))]
    poll: u64,
    /// Time zone of the home, for a log in UTC (default: that of the scenario)
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    /// Print the report as one JSON object; with --follow one object per line
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    trust: Trust,
}

impl LocateArguments {
    pub fn run(self) -> Result<(), Failure> {
        if let Some(to) = self.out.as_ref().filter(|to| to.exists()) {
            return Err(SimulationError::Exists { path: to.clone() }.into());
        }
        let home = self.trust.source(&self.home)?.open()?;
        let zone = self.time_zone.clone().unwrap_or_else(|| home.scenario().file.time_zone.clone());
        let Some(to) = &self.out else {
            let followed = FollowedLog { log: &self.log, zone: &zone, every_s: self.poll, is_json: self.json };
            return followed.follow(home.scenario());
        };
        let read = self.log.read(Some(&zone))?;
        let report = progress::show_share(|progress| {
            locate_into(to, (self.log.text(), &read), home.scenario(), &Cancel::new(), progress)
        })?;
        report.remarks.iter().for_each(|remark| tell(format_args!("{}: {remark}", self.log)));
        if self.json {
            return print_json(&report);
        }
        print_text(&report.explained.to_string())?;
        tell(format_args!("{} is ready.\n  homebody day {0}/run first\n  homebody serve {0}", to.display()));
        Ok(())
    }
}
