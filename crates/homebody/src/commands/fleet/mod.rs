//! `homebody fleet`: thousands of homes on the world's clock, to see what a back end bears.

pub mod told;

use super::lived::{DestinationTimeout, failure, go_on_by, how_far_ahead};
use super::replacing::Replacing;
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::length::span;
use crate::print::{tell, write_file};
use crate::signals::Signals;
use crate::start::Start;
use crate::watched::Watched;
use homebody_core::problem::Problems;
use homebody_core::time::{Micros, SECOND};
use homebody_kit::fleet::{Churn, FleetOf, FleetRun, FleetSetup, MOST_HOMES, Patience, Storms};
use homebody_kit::{Error, News, OpenScenario, Url};
use homebody_log::fleet::has_rows_of_fleet;
use homebody_log::fresh::FreshFile;
use homebody_log::places::can_be_written;
use homebody_log::plain;
use jiff::Timestamp;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use told::{Telling, bar};

/// Lives thousands of homes on the world's clock from one process, to see what a back end bears.
///
/// Each home has a life of its own: its number and the seed decide it, whatever else is asked for here. Of several scenarios each home
/// has one, in turn. It is said every few seconds how many messages there are and how late they come, and at the end for the whole.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody fleet scenarios/tigerplace --homes 1000 --out 'mqtt://localhost/load?discovery=off' --for 10min
  homebody fleet scenarios/tigerplace --homes 500 --out postgresql://ann@localhost/homes --report report.jsonl
  homebody fleet scenarios/studio scenarios/tigerplace --homes 50 --out jsonl:- --storm 'every 5min for 30s' | consumer
  homebody fleet scenarios/tigerplace --homes 200 --out jsonl:fleet.jsonl --skew 2s --churn 'stay 30min gone 5min' --list homes.csv

{EXIT_CODES},
129, 130 or 143 it was ended by SIGHUP, SIGINT or SIGTERM."))]
pub struct Arguments {
    /// The scenarios' folders, or their scenario.json; home 1 has the first, home 2 the second, and so on in turn
    #[arg(required = true, value_name = "SCENARIO")]
    scenarios: Vec<PathBuf>,
    #[command(flatten)]
    trust: Trust,
    /// How many homes
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=MOST_HOMES as i64))]
    homes: u32,
    /// The number of the first home, where other fleets live those before it
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=MOST_HOMES as i64))]
    first: u32,
    /// Tell this place: mqtt://HOST/PREFIX, postgresql://USER@HOST/DATABASE, jsonl:FILE or jsonl:-; may be given several times
    #[arg(long, value_name = "URL", required = true)]
    out: Vec<Url>,
    /// From when on homes are lived: now, today, 2026-11-01 or 2026-11-01T08:00, on the clock of the home. What lies before now is lived
    /// as fast as it goes
    #[arg(long, value_name = "TIME", default_value = "now")]
    from: Start,
    /// Go this many times as fast as life from then on, 0.1 to 1000, instead of by the world's clock
    #[arg(long, value_name = "TIMES", value_parser = speed)]
    speed: Option<f64>,
    /// How long it tells by the world's clock, such as 10min; without it until somebody stops it
    #[arg(long = "for", value_name = "TIME", value_parser = span)]
    lasts: Option<Micros>,
    /// The number all randomness comes from, instead of the first scenario's
    #[arg(long)]
    seed: Option<u64>,
    /// Leave out a condition that a routine shows; may be given several times
    #[arg(long, value_name = "CONDITION")]
    without: Vec<String>,
    /// The network of all homes is away again and again, and then all of them report at once: 'every 5min for 30s'
    #[arg(long, value_name = "WHEN", value_parser = storms)]
    storm: Option<Storms>,
    /// The clock of each home is off by up to so much, either way
    #[arg(long, value_name = "TIME", value_parser = span)]
    skew: Option<Micros>,
    /// Homes come and go; these are averages: 'stay 30min gone 5min'
    #[arg(long, value_name = "HOW", value_parser = churn)]
    churn: Option<Churn>,
    /// What becomes of the fleet while a place is away: it ends with an error, or waits for the place, for a day at most
    #[arg(long, value_name = "WHAT", value_enum, default_value_t)]
    on_sink_down: WhenAway,
    #[command(flatten)]
    deadline: DestinationTimeout,
    /// How often it says how it goes
    #[arg(long, value_name = "TIME", default_value = "5s", value_parser = span)]
    every: Micros,
    /// Write all reports into this file, a JSON object a line; the last is on the whole
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write the homes into this CSV file: scenario, seed and run of each, and how much its clock is ahead
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    #[command(flatten)]
    watched: Watched,
    #[command(flatten)]
    replacing: Replacing,
    /// Say nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Print the report on the whole as one JSON object on standard output
    #[arg(long)]
    json: bool,
}

/// What becomes of a fleet while a place is away.
#[derive(Clone, Copy, Default, PartialEq, clap::ValueEnum)]
enum WhenAway {
    #[default]
    Error,
    Retry,
}

/// Longest wait for a destination (our choice).
const RETRY_FOR: Duration = Duration::from_secs(86_400);

/// Time before now at which a fleet may start and run faster than real time at first (our choice): homes take time to
/// create.
const BEFORE_NOW: i64 = 600 * SECOND;

fn speed(text: &str) -> Result<f64, String> {
    let speed = text.parse().ok().filter(|speed| (0.1..=1000.0).contains(speed));
    speed.ok_or_else(|| "write a number from 0.1 to 1000".into())
}

/// Outages as people write them.
fn storms(text: &str) -> Result<Storms, String> {
    let [every, lasts] = two_spans(text, ["every", "for"]).ok_or("write 'every 5min for 30s'")?;
    Storms::new(every?, lasts?).ok_or_else(|| "an outage is shorter than the time from one to the next".into())
}

/// How homes come and go, as people write it.
fn churn(text: &str) -> Result<Churn, String> {
    let [stays, away] = two_spans(text, ["stay", "gone"]).ok_or("write 'stay 30min gone 5min'")?;
    let (stays, away) = (stays?, away?);
    match stays.min(away) >= SECOND {
        true => Ok(Churn { stays, away }),
        false => Err("no home comes or goes for less than a second".into()),
    }
}

/// Two spans of time, each behind its word.
fn two_spans(text: &str, [first, second]: [&str; 2]) -> Option<[Result<Micros, String>; 2]> {
    let words: Vec<&str> = text.split_whitespace().collect();
    match words[..] {
        [one, a, other, b] if one == first && other == second => Some([span(a), span(b)]),
        _ => None,
    }
}

fn duration(span: Micros) -> Duration {
    Duration::from_micros(u64::try_from(span).unwrap_or(0))
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let signals = Signals::listen()?;
        if self.json && self.out.iter().any(Url::is_output) {
            let hint = "leave --json out, or write the reports into --report FILE";
            return Err(Failure::usage(format!(
                "rows and the report cannot both go to standard output\n  hint: {hint}"
            )));
        }
        let scenarios = self.scenarios()?;
        self.files_can_be_written(&scenarios)?;
        let started = |opened: &OpenScenario| opened.scenario().calendar.timestamp(0).as_microsecond();
        let is_late = |opened| started(opened) < Timestamp::now().as_microsecond() - BEFORE_NOW;
        let is_fast = self.speed.map_or_else(|| scenarios.iter().any(is_late), |speed| speed > 1.0);
        let mut run = FleetRun::new(&self.out, is_fast, |place| self.replacing.how(place))?;
        let names: Vec<String> = scenarios.iter().map(|opened| opened.name().to_owned()).collect();
        if !self.quiet && self.speed.is_none() {
            let ahead = |opened: &OpenScenario| how_far_ahead(&opened.scenario().calendar);
            if let Some(ahead) = scenarios.iter().find_map(ahead) {
                tell(format_args!("homes say nothing before {ahead}"));
            }
        }
        let fleet = self.make(scenarios)?;
        if let Some(list) = &self.list {
            write_list(list, &told::list(&fleet), self.replacing.force)?;
        }
        let report = self.report.as_ref().map(|path| reports(path, self.replacing.force)).transpose()?;
        let look = self.watched.begin_fleet(&names.join(", "))?;
        let mut telling = Telling::begin(self.quiet, self.json, report, look);
        run.patience = Patience {
            retry_for: if self.on_sink_down == WhenAway::Retry { RETRY_FOR } else { Duration::ZERO },
            answers_within: Some(self.deadline.within()),
            cancel: signals.cancel().clone(),
            tell: (!self.quiet).then(|| Arc::new(|news: &News| tell(news)) as _),
        };
        run.lasts = self.lasts.map(duration);
        run.every = duration(self.every);
        let mut failed = None;
        let last = fleet.live(run, |lived| {
            if let Err(error) = telling.hear(lived) {
                failed.get_or_insert(error);
            }
        });
        let last = last.map_err(|error| failure(error, go_on_by, &signals))?;
        telling.end(&last)?;
        failed.map_or(Ok(()), Err)?;
        let is_over = self.lasts.is_some_and(|lasts| last.running_s * 1e6 >= lasts as f64);
        signals.ended(!is_over)
    }

    /// The scenarios, each begun when the fleet is; all that is wrong with any of them.
    fn scenarios(&self) -> Result<Vec<OpenScenario>, Failure> {
        let (mut all, mut problems) = (Vec::new(), Vec::new());
        for path in &self.scenarios {
            let opened = self.trust.source(path)?.open();
            match opened {
                Ok(opened) => all.push(self.from.of(&opened)?),
                Err(Error::Problems(Problems(found))) => problems.extend(found),
                Err(error) => return Err(error.into()),
            }
        }
        if problems.is_empty() { Ok(all) } else { Err(Problems(problems).into()) }
    }

    fn files_can_be_written(&self, scenarios: &[OpenScenario]) -> Result<(), Failure> {
        // The same command adds to its rows and its reports, and keeps its list.
        let rows = self.out.iter().filter_map(Url::file).filter(|path| !has_rows_of_fleet(path));
        let report = self.report.as_deref().filter(|path| reports_in(path).is_none());
        let list = self.list.as_deref().filter(|path| !path.is_file());
        let files: Vec<&Path> = rows.chain(report).chain(list).collect();
        let sources: Vec<PathBuf> = scenarios.iter().flat_map(OpenScenario::paths).collect();
        Ok(can_be_written(&files, &sources, self.replacing.force)?)
    }

    /// Makes the homes, and shows how far that is.
    fn make(&self, scenarios: Vec<OpenScenario>) -> Result<FleetOf, Failure> {
        let begun = Instant::now();
        let bar = bar(self.quiet, "homes made", Some(self.homes.into()));
        let setup = FleetSetup {
            scenarios,
            homes: self.homes,
            first: self.first,
            seed: self.seed,
            without: self.without.clone(),
            speed: self.speed,
            skew: self.skew.unwrap_or(0),
            churn: self.churn,
            storms: self.storm,
        };
        let fleet = setup.make(|made| bar.set_position(made as u64));
        bar.finish_and_clear();
        let fleet = fleet?;
        if !self.quiet {
            let homes = told::counted(self.homes.into());
            tell(format_args!("{homes} homes made in {:.1} s; Ctrl-C ends them", begun.elapsed().as_secs_f64()));
        }
        Ok(fleet)
    }
}

/// The reports that a file holds already, whole lines alone; None where it is not there, or something else.
fn reports_in(path: &Path) -> Option<Vec<u8>> {
    let mut text = plain::read(path, LARGEST_REPORTS_BYTES).ok()?;
    // A program that was killed may have left a line half written.
    text.truncate(text.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1));
    let is_report = |line: &[u8]| {
        let report: Option<serde_json::Value> = serde_json::from_slice(line).ok();
        report.is_some_and(|report| report["running_s"].is_number() && report["is_last"].is_boolean())
    };
    text.split(|&byte| byte == b'\n').filter(|line| !line.is_empty()).all(is_report).then_some(text)
}

/// Largest size of the file of reports that a fleet appends to. A report every five seconds fills half of it in a year.
const LARGEST_REPORTS_BYTES: u64 = 8 << 30;

/// Opens the file of reports: a new one, or the one that the same command left, to add to it.
fn reports(path: &Path, force: bool) -> Result<FreshFile, Failure> {
    let before = if force { None } else { reports_in(path) };
    let mut file = FreshFile::create(path, force || before.is_some())?;
    file.write(&before.unwrap_or_default())?;
    Ok(file)
}

/// Writes the list of homes; the same list may be there already.
fn write_list(path: &Path, list: &str, force: bool) -> Result<(), Failure> {
    let is_there = plain::read(path, list.len() as u64).is_ok_and(|found| found == list.as_bytes());
    if is_there { Ok(()) } else { write_file(path, list.as_bytes(), force) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn storms_and_churn_are_read_as_people_write_them() {
        let five_minutes = 300 * SECOND;
        assert_eq!(storms("every 5min for 30s"), Ok(Storms::new(five_minutes, 30 * SECOND).unwrap()));
        assert_eq!(churn("stay 5m gone 1h"), Ok(Churn { stays: five_minutes, away: 3600 * SECOND }));
        for wrong in ["", "5min", "every 5min", "every 30s for 5min", "for 30s every 5min", "every 5 min for 30 s"] {
            assert!(storms(wrong).is_err(), "{wrong}");
        }
        for wrong in ["10%", "stay 5min", "stay 5min gone 0s", "stay 0.1s gone 5s"] {
            assert!(churn(wrong).is_err(), "{wrong}");
        }
        assert!(speed("2").is_ok() && speed("max").is_err() && speed("0").is_err() && speed("NaN").is_err());
    }
}
