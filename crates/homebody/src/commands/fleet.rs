//! `homebody fleet`: thousands of homes in real time, to load a back end.

pub mod fleet_progress;

use super::replacing::Replacing;
use super::run_output::{DestinationTimeout, failure, future_start, resume_command};
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::metrics::MetricsArguments;
use crate::print::{ResultMessage, counted, tell, write_file};
use crate::progress::on_terminal;
use crate::signals::Signals;
use fleet_progress::{FleetProgress, homes_table};
use homebody_core::problem::Problems;
use homebody_core::time::{MINUTE, RunTime, SECOND, Span, UtcTime};
use homebody_fleet::{Churn, FleetError, FleetHomes, FleetRun, FleetSetup, MOST_HOMES, Outages, Patience};
use homebody_log::files::fresh::FreshFile;
use homebody_log::files::plain;
use homebody_log::fleet::has_rows_of_fleet;
use homebody_log::run::places::can_be_written;
use homebody_simulation::run_length::span;
use homebody_simulation::{OpenScenario, RunStart, SimulationError, SinkNews, Url, VariantOptions};
use jiff::Timestamp;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Load-test a back end with thousands of homes in real time
///
/// One process simulates all homes. The events of a home depend on its scenario, the start, the seed and its own number in the fleet.
/// They do not depend on the size of the fleet or the speed. With several scenarios, the homes use them in rotation, and the seed of the
/// first is the default. Homebody reports the message rate and the delays every few seconds, and the totals at the end.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody fleet scenarios/tigerplace --homes 1000 --out 'mqtt://localhost/load?discovery=off' --for 10min
  homebody fleet scenarios/tigerplace --homes 500 --out postgresql://ann@localhost/homes --report report.jsonl
  homebody fleet scenarios/studio scenarios/tigerplace --homes 50 --out jsonl:- --outages 'every 5min for 30s' | consumer
  homebody fleet scenarios/tigerplace --homes 200 --out jsonl:fleet.jsonl --skew 2s --churn 'stay 30min gone 5min' --list homes.csv

{EXIT_CODES},
129, 130 or 143 SIGHUP, SIGINT or SIGTERM ended it."))]
pub struct FleetArguments {
    /// Scenario folders, or their scenario.json files; the homes use them in rotation
    #[arg(required = true, value_name = "SCENARIO")]
    scenarios: Vec<PathBuf>,
    #[command(flatten)]
    trust: Trust,
    /// Number of homes
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST_HOMES as i64))]
    homes: u32,
    /// Number of the first home, to split one fleet over several processes
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=MOST_HOMES as i64))]
    first_home: u32,
    /// Send messages to this destination: mqtt://HOST/PREFIX, postgresql://USER@HOST/DATABASE, jsonl:FILE or jsonl:-; repeatable
    #[arg(short, long, value_name = "DESTINATION", required = true)]
    out: Vec<Url>,
    /// Start of the simulation in the home's local time: now, today, 2026-11-01 or 2026-11-01T08:00
    ///
    /// Homebody simulates the time before now as fast as possible.
    #[arg(long, value_name = "TIME", default_value = "now")]
    start: RunStart,
    /// Simulated seconds per real second, from the start on: 0.1 to 1000 (default: real time)
    #[arg(long, value_name = "FACTOR", value_parser = speed)]
    speed: Option<f64>,
    /// Duration in real time, such as 10min (default: the fleet runs until you stop it)
    #[arg(long = "for", value_name = "DURATION", value_parser = span)]
    lasts: Option<Span>,
    #[command(flatten)]
    variant: VariantOptions,
    /// Network outages of all homes, such as 'every 5min for 30s'; after each outage, all homes send their messages at once
    #[arg(long, value_name = "WHEN", value_parser = outages)]
    outages: Option<Outages>,
    /// Largest error of a home's clock, such as 2s; a clock can be fast or slow
    #[arg(long, value_name = "DURATION", value_parser = span)]
    skew: Option<Span>,
    /// Make homes disconnect and connect again, with average times such as 'stay 30min gone 5min'
    #[arg(long, value_name = "TIMES", value_parser = churn)]
    churn: Option<Churn>,
    /// Action while a destination is unavailable
    #[arg(long, value_name = "ACTION", value_enum, default_value_t)]
    on_unavailable: WhenAway,
    #[command(flatten)]
    deadline: DestinationTimeout,
    /// Time between two reports
    #[arg(long, value_name = "DURATION", default_value = "5s", value_parser = span)]
    report_every: Span,
    /// Write all reports to this file, one JSON object per line; the last has the totals
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write a CSV file with the scenario, seed, run and clock error of each home
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    #[command(flatten)]
    metrics: MetricsArguments,
    #[command(flatten)]
    replacing: Replacing,
    /// Print errors only
    #[arg(short, long)]
    quiet: bool,
    /// Print the totals as one JSON object on standard output
    #[arg(long)]
    json: bool,
}

/// Action while a destination is unavailable.
#[derive(Clone, Copy, Default, PartialEq, clap::ValueEnum)]
enum WhenAway {
    /// End the fleet with an error
    #[default]
    Error,
    /// Wait for the destination, for a day at most
    Retry,
}

/// Longest wait for a destination (our choice).
const RETRY_FOR: Duration = Duration::from_secs(86_400);

/// A fleet that starts this long before now is faster than real time at first (our choice): making homes takes time.
const BEFORE_NOW: Span = MINUTE.times(10);

fn speed(text: &str) -> Result<f64, String> {
    let speed = text.parse().ok().filter(|speed| (0.1..=1000.0).contains(speed));
    speed.ok_or_else(|| "write a number from 0.1 to 1000".into())
}

fn outages(text: &str) -> Result<Outages, String> {
    let [every, lasts] = two_spans(text, ["every", "for"]).ok_or("write 'every 5min for 30s'")?;
    Outages::new(every?, lasts?).ok_or_else(|| "an outage must be shorter than the time between two".into())
}

fn churn(text: &str) -> Result<Churn, String> {
    let [stays, away] = two_spans(text, ["stay", "gone"]).ok_or("write 'stay 30min gone 5min'")?;
    let (stays, away) = (stays?, away?);
    match stays.min(away) >= SECOND {
        true => Ok(Churn { stays, away }),
        false => Err("a home stays, or is gone, for a second at least".into()),
    }
}

fn two_spans(text: &str, [first, second]: [&str; 2]) -> Option<[Result<Span, String>; 2]> {
    let words: Vec<&str> = text.split_whitespace().collect();
    match words[..] {
        [word, a, other, b] if word == first && other == second => Some([span(a), span(b)]),
        _ => None,
    }
}

impl FleetArguments {
    pub fn run(self) -> Result<(), Failure> {
        let signals = Signals::listen()?;
        if self.json && self.out.iter().any(Url::is_output) {
            return Err(Failure::asked(ResultMessage::StandardOutput { what: "report" }));
        }
        let scenarios = self.scenarios()?;
        self.files_can_be_written(&scenarios)?;
        let start = |opened: &OpenScenario| UtcTime::from(opened.scenario().calendar.timestamp(RunTime::START));
        let is_late = |opened| start(opened) < UtcTime::from(Timestamp::now()) - BEFORE_NOW;
        let is_fast = self.speed.map_or_else(|| scenarios.iter().any(is_late), |speed| speed > 1.0);
        let mut run = FleetRun::new(&self.out, is_fast, |place| self.replacing.how(place))?;
        let names: Vec<String> = scenarios.iter().map(|opened| opened.name().to_owned()).collect();
        if !self.quiet && self.speed.is_none() {
            let ahead = |opened: &OpenScenario| future_start(&opened.scenario().calendar);
            if let Some(ahead) = scenarios.iter().find_map(ahead) {
                tell(format_args!("homes send nothing before {ahead}"));
            }
        }
        let fleet = self.homes(scenarios)?;
        if let Some(list) = &self.list {
            write_list(list, &homes_table(&fleet), self.replacing.force)?;
        }
        let report = self.report.as_ref().map(|path| reports(path, self.replacing.force)).transpose()?;
        let look = self.metrics.begin_fleet(&names.join(", "))?;
        let mut progress = FleetProgress::new(self.quiet, self.json, report, look);
        run.patience = Patience {
            retry_for: if self.on_unavailable == WhenAway::Retry { RETRY_FOR } else { Duration::ZERO },
            answers_within: Some(self.deadline.within()),
            cancel: signals.cancel().clone(),
            tell: (!self.quiet).then(|| Arc::new(|news: &SinkNews| tell(news)) as _),
        };
        run.lasts = self.lasts.map(Span::to_duration);
        run.every = self.report_every.to_duration();
        let mut failed = None;
        let last = fleet.run(run, |status| {
            if let Err(error) = progress.show(status) {
                failed.get_or_insert(error);
            }
        });
        let last = last.map_err(|error| match error {
            FleetError::Simulation(error) => failure(error, resume_command, &signals),
            error => error.into(),
        })?;
        progress.finish(&last)?;
        failed.map_or(Ok(()), Err)?;
        let is_over = self.lasts.is_some_and(|lasts| last.running_s * 1e6 >= lasts.micros() as f64);
        signals.ended(!is_over)
    }

    /// The scenarios with the start of the fleet, or all their problems.
    fn scenarios(&self) -> Result<Vec<OpenScenario>, Failure> {
        let (mut all, mut problems) = (Vec::new(), Vec::new());
        for path in &self.scenarios {
            let opened = self.trust.source(path)?.open();
            match opened {
                Ok(opened) => all.push(self.start.in_scenario(&opened)?),
                Err(SimulationError::Problems(Problems(found))) => problems.extend(found),
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

    fn homes(&self, scenarios: Vec<OpenScenario>) -> Result<FleetHomes, Failure> {
        let began = Instant::now();
        let bar = on_terminal(self.quiet, Some(self.homes.into()), "{bar:40} {pos} of {len} homes made");
        let setup = FleetSetup {
            scenarios,
            homes: self.homes,
            first: self.first_home,
            variant: self.variant.clone(),
            speed: self.speed,
            skew: self.skew.unwrap_or(Span::ZERO),
            churn: self.churn,
            outages: self.outages,
        };
        let fleet = setup.make(|made| bar.set_position(made as u64));
        bar.finish_and_clear();
        let fleet = fleet?;
        if !self.quiet {
            let homes = counted(self.homes.into(), "home", "homes");
            tell(format_args!("made {homes} in {:.1} s; press Ctrl-C to stop", began.elapsed().as_secs_f64()));
        }
        Ok(fleet)
    }
}

/// The complete lines of a file of reports; `None` if the file is missing, or is not one of reports.
fn reports_in(path: &Path) -> Option<Vec<u8>> {
    let mut text = plain::read(path, LARGEST_REPORTS_BYTES).ok()?;
    // A killed program may have left an incomplete line.
    text.truncate(text.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1));
    let is_report = |line: &[u8]| {
        let report: Option<serde_json::Value> = serde_json::from_slice(line).ok();
        report.is_some_and(|report| report["running_s"].is_number() && report["is_last"].is_boolean())
    };
    text.split(|&byte| byte == b'\n').filter(|line| !line.is_empty()).all(is_report).then_some(text)
}

/// Largest size of the file of reports that a fleet appends to. A report every five seconds fills half of it in a year.
const LARGEST_REPORTS_BYTES: u64 = 8 << 30;

/// Opens the file of reports. A file of the same command stays, and new reports follow.
fn reports(path: &Path, force: bool) -> Result<FreshFile, Failure> {
    let before = if force { None } else { reports_in(path) };
    let mut file = FreshFile::create(path, force || before.is_some())?;
    file.write(&before.unwrap_or_default())?;
    Ok(file)
}

/// Writes the list of homes, unless the file has the same list.
fn write_list(path: &Path, list: &str, force: bool) -> Result<(), Failure> {
    let is_same = plain::read(path, list.len() as u64).is_ok_and(|found| found == list.as_bytes());
    if is_same { Ok(()) } else { write_file(path, list.as_bytes(), force) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::HOUR;

    #[test]
    fn reads_outages_and_churn() {
        let five_minutes = 5 * MINUTE;
        assert_eq!(outages("every 5min for 30s"), Ok(Outages::new(five_minutes, 30 * SECOND).unwrap()));
        assert_eq!(churn("stay 5m gone 1h"), Ok(Churn { stays: five_minutes, away: HOUR }));
        for wrong in ["", "5min", "every 5min", "every 30s for 5min", "for 30s every 5min", "every 5 min for 30 s"] {
            assert!(outages(wrong).is_err(), "{wrong}");
        }
        for wrong in ["10%", "stay 5min", "stay 5min gone 0s", "stay 0.1s gone 5s"] {
            assert!(churn(wrong).is_err(), "{wrong}");
        }
        assert!(speed("2").is_ok() && speed("max").is_err() && speed("0").is_err() && speed("NaN").is_err());
    }
}
