//! `homebody translate`: a log walked back through the plan of its home.

use super::read_log::read_log;
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{print_json, print_text, tell};
use homebody_kit::Cancel;
use homebody_kit::walked::walk_into;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::PathBuf;

/// Walks a log back through the plan of its home: where everybody was at each instant, with how much doubt; and lives that
/// again, so that it can be seen, and held against the log. In a folder of runs, the page's Playback shows it.
///
/// The home says what its sensors see and how fast its residents walk; of how they live nothing is known. What sensors say counts,
/// and what they leave unsaid. Who of several people was where cannot be told: sensors know nobody. Where one person lives,
/// somebody else is told of only where the log is much less likely without.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody translate runs/tigerplace-1 --home scenarios/tigerplace --to walked
  homebody translate casas:week.txt --home my-home --to walked && homebody day walked/run
  homebody translate week.csv --home my-home --to walked --json

In the new folder:
  where.csv      a row for each change: time, who, room, chance of the room, x and y in
                 metres, doing (out, walks, stands, busy, still, motionless)
  rooms.csv      how likely each room is: time, who, room, chance from then on; a row where
                 a chance changes by 0.05 or more. The room is out for not at home, and
                 empty for between rooms
  scenario.json  with the home and a path for everybody: homebody run, homebody serve
  run            that path lived again: its log, its truth, its recording
  given          a copy of the log
  report.json    what did not fit, sensors that could not be believed, and by sensor how
                 many of the log's firings the path explains

Times are those of the clock on the wall of the home.

{EXIT_CODES}."))]
pub struct Arguments {
    /// The log: a file, the folder of a run, or sqlite:FILE, csv:FILE or casas:FILE
    log: String,
    /// The folder of a scenario whose home the log is of
    #[arg(long, value_name = "SCENARIO")]
    home: PathBuf,
    /// The folder to create
    #[arg(long, value_name = "FOLDER")]
    to: PathBuf,
    /// The time zone of the home, for a log in UTC; the scenario's own without it
    #[arg(long)]
    time_zone: Option<String>,
    /// Print the report as one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    trust: Trust,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        if self.to.exists() {
            let what = format!("{} exists already\n  hint: name a folder that does not", self.to.display());
            return Err(Failure::Io(what));
        }
        let home = self.trust.source(&self.home)?.open()?;
        let zone = self.time_zone.clone().unwrap_or_else(|| home.scenario().file.time_zone.clone());
        let read = read_log(&self.log, Some(&zone))?;
        let bar = ProgressBar::new(1000);
        let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let progress = |share| bar.set_position((share * 1000.0) as u64);
        let report = walk_into(&self.to, (&self.log, &read), home.scenario(), &Cancel::new(), progress)?;
        bar.finish_and_clear();
        report.remarks.iter().for_each(|remark| tell(format_args!("{}: {remark}", self.log)));
        if self.json {
            return print_json(&report);
        }
        print_text(&report.explained.to_string())?;
        tell(format_args!("{} is ready.\n  homebody day {0}/run\n  homebody serve {0}", self.to.display()));
        Ok(())
    }
}
