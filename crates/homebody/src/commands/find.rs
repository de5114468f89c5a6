//! `homebody find`: when something was so, over a whole log.

use super::answer::Figures;
use super::read_log::{HowRead, read_log};
use crate::failure::Failure;
use crate::length::span;
use clap::builder::PossibleValue;
use homebody_analysis::dates::{clock_s, date_of};
use homebody_core::time::{Micros, SECOND, seconds};
use homebody_kit::find::{Hours, Query, What};
use homebody_kit::find_in_log;
use serde::Serialize;
use std::fmt;

/// Finds when something was so, over a whole log: each span with its beginning and how long it was.
///
/// Where a run's truth lies beside the log, rooms, activities, falls and lost messages are the truth's; without it, somebody is in a
/// room from what its sensors say until another room's sensors say something. What is asked is cut to the hours of --between
/// first, and then held against --at-least.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody find runs/tigerplace-1 room bathroom --between 0-6
  homebody find runs/tigerplace-1 on 'stove motion' --at-least 30m
  homebody find casas:tm000.txt still --between 8-20 --at-least 3h
  homebody find runs/tigerplace-1 doing napping --json
  homebody find runs/tigerplace-1 fall
  homebody find runs/cameras-1 seen-fall
  homebody find runs/tigerplace-depression-1 alert")]
pub struct Arguments {
    /// A log: a file, the folder of a run or of a data set, or FORM:FILE
    log: String,
    #[command(flatten)]
    how: HowRead,
    /// What is looked for
    what: Wanted,
    /// Which room, sensor or activity; of lost messages those of a sensor, of alerts and falls that cameras see those of a rule
    name: Option<String>,
    /// Between which hours of the day, such as 0-6, 22-6 or 08:30-20
    #[arg(long, value_name = "HOURS")]
    between: Option<Hours>,
    /// For how long at least, such as 30m
    #[arg(long, value_name = "SPAN", value_parser = span)]
    at_least: Option<Micros>,
    /// The home's time zone, for logs in UTC; a run knows its own
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    #[command(flatten)]
    figures: Figures,
}

/// What is looked for, as a word of the command line.
#[derive(Clone, Copy)]
struct Wanted(What);

impl clap::ValueEnum for Wanted {
    fn value_variants<'a>() -> &'a [Wanted] {
        const ALL: [Wanted; What::ALL.len()] = {
            let mut all = [Wanted(What::Room); What::ALL.len()];
            let mut at = 0;
            while at < all.len() {
                all[at] = Wanted(What::ALL[at]);
                at += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let help = match self.0 {
            What::Room => "Somebody is in a room",
            What::On => "A sensor has said that something goes on, and not yet that it ends",
            What::Still => "No sensor says anything but readings, while somebody is at home",
            What::Doing => "Somebody does something, by the truth",
            What::Fall => "Somebody has fallen, by the truth",
            What::SeenFall => "Cameras take something for a fall, beside those of the truth",
            What::Lost => "A message never reached the logger, by the truth",
            What::Alert => "Something is different from before, by the usual rules",
        };
        Some(PossibleValue::new(self.0.word()).help(help))
    }
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let read = read_log(&self.log, self.time_zone.as_deref(), &self.how)?;
        let answer = self.figures.check(&read.sources)?;
        let what = self.what.0;
        let query = Query { what, name: self.name.clone(), hours: self.between, least: self.at_least.unwrap_or(0) };
        let found = find_in_log(&query, &read)?;
        let one = |hit: homebody_kit::find::Hit| One {
            begin: instant(hit.begin),
            end: instant(hit.end),
            lasts_s: seconds(hit.end - hit.begin),
            name: hit.name,
            words: hit.words,
        };
        let found = Answered {
            name: read.name.clone(),
            what: what.word(),
            of: self.name.filter(|_| what.has_name()),
            between: self.between.map(|hours| hours.to_string()),
            remarks: found.remarks,
            found: found.hits.into_iter().map(one).collect(),
        };
        answer.give(&found, [])
    }
}

/// Such as `2009-03-02 07:12:03`.
fn instant(at: Micros) -> String {
    format!("{} {}", date_of(at), clock_s(at))
}

/// All that was found.
#[derive(Serialize)]
struct Answered {
    name: String,
    what: &'static str,
    of: Option<String>,
    between: Option<String>,
    remarks: Vec<String>,
    found: Vec<One>,
}

#[derive(Serialize)]
struct One {
    begin: String,
    end: String,
    lasts_s: f64,
    /// The room, the sensor, what was done, or the rule.
    name: String,
    words: String,
}

impl fmt::Display for Answered {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let of = self.of.as_ref().map_or_else(String::new, |of| format!(" {of}"));
        let between = self.between.as_ref().map_or_else(String::new, |hours| format!(", between {hours}"));
        let times = if self.found.len() == 1 { "once" } else { &format!("{} times", self.found.len()) };
        writeln!(formatter, "{}: {}{of}{between}: {times}", self.name, self.what)?;
        self.remarks.iter().try_for_each(|remark| writeln!(formatter, "{remark}"))?;
        for one in &self.found {
            let whole = (one.lasts_s * SECOND as f64) as Micros / SECOND;
            let lasts = match whole {
                0 => String::new(),
                _ => format!("  {} h {:02} min {:02} s", whole / 3600, whole / 60 % 60, whole % 60),
            };
            writeln!(formatter, "{}{lasts}  {}", one.begin, one.words)?;
        }
        Ok(())
    }
}
