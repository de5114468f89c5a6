//! `homebody translate`: a log walked back through the plan of its home.

use super::follow::Followed;
use super::read_log::{HowRead, read_log};
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{print_json, print_text, tell};
use crate::progress;
use homebody_kit::Cancel;
use homebody_kit::walked::walk_into;
use std::path::PathBuf;

/// Walks a log back through the plan of its home: where everybody was at each instant, with how much doubt; and lives that
/// again, so that it can be seen, and held against the log. In a folder of runs, the page's Playback shows it.
///
/// The home says what its sensors see and how fast its residents walk; of how they live nothing is known. What sensors say counts,
/// and what they leave unsaid. Who of several people was where cannot be told: sensors know nobody. Where one person lives,
/// somebody else is told of only where the log is much less likely without.
///
/// With --follow nothing is written: where everybody is, is told as rows come, by what was said until then.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody translate runs/tigerplace-1 --home scenarios/tigerplace --to walked
  homebody translate casas:week.txt --home my-home --to walked && homebody day walked/run
  homebody translate week.csv --home my-home --to walked --json
  homebody translate casas:home.txt --home my-home --follow
  tail -n +1 -F home.txt | homebody translate casas:- --home my-home --follow --json

With --follow, a line each time somebody is in another room, or it is surer or less sure that
they are; with --json an object a line. Of standard input it ends with the input, and of a file
when the program is stopped. Between two rows it is asked every 30 s of the log's own time, and
told with the next row.

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
    #[command(flatten)]
    how: HowRead,
    /// The folder of a scenario whose home the log is of
    #[arg(long, value_name = "SCENARIO")]
    home: PathBuf,
    /// The folder to create
    #[arg(long, value_name = "FOLDER", required_unless_present = "follow", conflicts_with = "follow")]
    to: Option<PathBuf>,
    /// Go on reading the log as it grows, and tell where everybody is; FORM:- reads standard input
    #[arg(long)]
    follow: bool,
    /// How many seconds pass from one look at the log to the next
    #[arg(long, value_name = "SECONDS", default_value_t = 5, requires = "follow", value_parser = clap::value_parser!(u64).range(1..=86_400))]
    every: u64,
    /// The time zone of the home, for a log in UTC; the scenario's own without it
    #[arg(long)]
    time_zone: Option<String>,
    /// Print the report as one JSON object; with --follow an object a line
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    trust: Trust,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        if let Some(to) = self.to.as_ref().filter(|to| to.exists()) {
            let what = format!("{} exists already\n  hint: name a folder that does not", to.display());
            return Err(Failure::Io(what));
        }
        let home = self.trust.source(&self.home)?.open()?;
        let zone = self.time_zone.clone().unwrap_or_else(|| home.scenario().file.time_zone.clone());
        let Some(to) = &self.to else {
            let followed =
                Followed { log: &self.log, how: &self.how, zone: &zone, every_s: self.every, is_json: self.json };
            return followed.follow(home.scenario());
        };
        let read = read_log(&self.log, Some(&zone), &self.how)?;
        let bar = progress::bar(1000, progress::SHARE);
        let progress = |share| bar.set_position((share * 1000.0) as u64);
        let report = walk_into(to, (&self.log, &read), home.scenario(), &Cancel::new(), progress)?;
        bar.finish_and_clear();
        report.remarks.iter().for_each(|remark| tell(format_args!("{}: {remark}", self.log)));
        if self.json {
            return print_json(&report);
        }
        print_text(&report.explained.to_string())?;
        tell(format_args!("{} is ready.\n  homebody day {0}/run\n  homebody serve {0}", to.display()));
        Ok(())
    }
}
