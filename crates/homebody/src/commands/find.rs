//! `homebody find`: intervals of a log.

use super::log_input::LogArguments;
use super::result_output::JsonOutput;
use crate::failure::Failure;
use clap::builder::PossibleValue;
use homebody_analysis::dates::clock_s;
use homebody_core::time::{SECOND, Span, WallTime};
use homebody_query::find_in_log;
use homebody_query::{search::DayHours, search::Query, search::SearchSubject};
use homebody_simulation::run_length::span;
use serde::Serialize;
use std::fmt;

/// Find intervals in a log, such as stays in a room, falls or alerts
///
/// Each result has its start and its duration. For a run, rooms, activities, falls and lost messages come from the ground truth.
/// For another log, a resident is in a room from an event there until the next event in another room. Homebody first cuts the
/// intervals to the hours of --between, and then drops those shorter than --min-duration.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody find runs/tigerplace-1 room bathroom --between 0-6
  homebody find runs/tigerplace-1 on 'stove motion' --min-duration 30m
  homebody find casas:tm000.txt still --between 8-20 --min-duration 3h
  homebody find runs/tigerplace-1 doing napping --json
  homebody find runs/tigerplace-1 fall
  homebody find runs/cameras-1 seen-fall
  homebody find runs/tigerplace-depression-1 alert")]
pub struct FindArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Kind of interval
    what: FindSubject,
    /// Name to find: a room, a sensor (for `on` and `lost`), an activity, or a rule (for `alert` and `seen-fall`)
    name: Option<String>,
    /// Find only in these hours of the day, such as 0-6, 22-6 or 08:30-20
    #[arg(long, value_name = "HOURS")]
    between: Option<DayHours>,
    /// Shortest interval to report, such as 30m
    #[arg(long, value_name = "DURATION", value_parser = span)]
    min_duration: Option<Span>,
    /// The home's time zone, for a log in UTC; not needed for a run folder, which stores it
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    #[command(flatten)]
    output: JsonOutput,
}

#[derive(Clone, Copy)]
struct FindSubject(SearchSubject);

impl clap::ValueEnum for FindSubject {
    fn value_variants<'a>() -> &'a [FindSubject] {
        const ALL: [FindSubject; SearchSubject::ALL.len()] = {
            let mut all = [FindSubject(SearchSubject::Room); SearchSubject::ALL.len()];
            let mut at = 0;
            while at < all.len() {
                all[at] = FindSubject(SearchSubject::ALL[at]);
                at += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let help = match self.0 {
            SearchSubject::Room => "A resident is in a room",
            SearchSubject::On => "A sensor is on",
            SearchSubject::Still => "No sensor fires while a resident is at home (readings do not count)",
            SearchSubject::Doing => "A resident does an activity, by the ground truth",
            SearchSubject::Fall => "A resident falls, by the ground truth",
            SearchSubject::SeenFall => "Cameras detect a fall, compared with the ground truth",
            SearchSubject::Lost => "A message never reaches the logger, by the ground truth",
            SearchSubject::Alert => "An alert, by the default rules",
        };
        Some(PossibleValue::new(self.0.word()).help(help))
    }
}

impl FindArguments {
    pub fn run(self) -> Result<(), Failure> {
        let read = self.log.read(self.time_zone.as_deref())?;
        let output = self.output.check(&read.sources)?;
        let what = self.what.0;
        let least = self.min_duration.unwrap_or(Span::ZERO);
        let query = Query { what, name: self.name.clone(), hours: self.between, least };
        let found = find_in_log(&query, &read)?;
        let one = |hit: homebody_query::search::Hit<WallTime>| FoundInterval {
            begin: instant(hit.time.begin),
            end: instant(hit.time.end),
            lasts_s: hit.time.length().seconds(),
            name: hit.name,
            words: hit.words,
        };
        let found = FindAnswer {
            name: read.name.clone(),
            what: what.word(),
            of: self.name.filter(|_| what.has_name()),
            between: self.between.map(|hours| hours.to_string()),
            remarks: found.remarks,
            found: found.hits.into_iter().map(one).collect(),
        };
        output.write(&found, [])
    }
}

/// Such as `2009-03-02 07:12:03`.
fn instant(at: WallTime) -> String {
    format!("{} {}", at.date(), clock_s(at))
}

#[derive(Serialize)]
struct FindAnswer {
    name: String,
    what: &'static str,
    of: Option<String>,
    between: Option<String>,
    remarks: Vec<String>,
    found: Vec<FoundInterval>,
}

#[derive(Serialize)]
struct FoundInterval {
    begin: String,
    end: String,
    lasts_s: f64,
    name: String,
    words: String,
}

impl fmt::Display for FindAnswer {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let of = self.of.as_ref().map_or_else(String::new, |of| format!(" {of}"));
        let between = self.between.as_ref().map_or_else(String::new, |hours| format!(", between {hours}"));
        let times = if self.found.len() == 1 { "once" } else { &format!("{} times", self.found.len()) };
        writeln!(formatter, "{}: {}{of}{between}: {times}", self.name, self.what)?;
        self.remarks.iter().try_for_each(|remark| writeln!(formatter, "{remark}"))?;
        for one in &self.found {
            let whole = SECOND.share(one.lasts_s) / SECOND;
            let lasts = match whole {
                0 => String::new(),
                _ => format!("  {} h {:02} min {:02} s", whole / 3600, whole / 60 % 60, whole % 60),
            };
            writeln!(formatter, "{}{lasts}  {}", one.begin, one.words)?;
        }
        Ok(())
    }
}
