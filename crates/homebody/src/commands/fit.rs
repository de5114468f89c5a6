//! `homebody fit`: a scenario fitted to the log of its home.

use super::log_input::LogArguments;
use super::messages::{LogContentMessage, not_comparable};
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{json_text, print_json, print_text, tell, write_file};
use crate::progress;
use homebody_analysis::realism::{ComparedLog, Realism, RealismMeasure, realism};
use homebody_core::time::{DAY, Interval, Span, WallTime};
use homebody_log::{Log, LogError};
use homebody_scaffold::create;
use homebody_simulation::{OpenScenario, ScenarioSource, SimulationError};
use homebody_tracking::{Calibration, Fitted, SensorSight, calibrate, simulated_log};
use jiff::civil::Date;
use serde::Serialize;
use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

homebody_core::messages! {
    /// Problems with the days that a scenario is fitted to.
    pub enum TrainingMessage in "training" {
        /// Homebody fits the scenario to the training days and evaluates it on the others, the test days. Without `--training-days`, the
        /// first half of the log is for training.
        FewDays { log: String, training_days: usize, test_days: usize, first: String, last: String } error "few-days"
            ("{log}: too few days: {training_days} for training and {test_days} for the test")
            hint (
                "choose --training-days from {first} to {last}, or use a longer log: a fit needs {LEAST_DAYS} training days and 1 test day"
            );
    }
}

/// Fit a scenario to the log of its home, and evaluate the fit
///
/// Homebody fits the timing and the reach of the sensors, the share of passing people that they miss, the routine of the resident, the
/// amount of movement, the variation between days, and the shares of repeated and lost messages. It simulates the fitted scenario and
/// compares it with days that it did not use.
///
/// The scenario must have one resident. Its sensors must have the names that the log uses, unless its logger.json maps their ids.
/// Walls, furniture and everything else that a log does not show stay as in the scenario.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody fit week.csv --home my-home --out fitted
  homebody fit casas:month.txt --home my-home --training-days 2016-07-01..2016-07-14 --out fitted
  homebody fit runs/older-adult-1 --home scenarios/older-adult --out fitted --json

Files in the new folder:
  scenario.json   the fitted scenario, with its home, its logger, its link and its routine
  fitted.routine  the routine in sentences: homebody routine explain fitted
  report.json     the fitted values, and each measure of homebody realism on the test days

The report compares the test days with the fitted scenario, with the training days (how much the home
differs from itself), and with the scenario before the fit.

{EXIT_CODES}."))]
pub struct FitArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Scenario with the home of the log
    #[arg(long, value_name = "SCENARIO")]
    home: PathBuf,
    /// First and last training day (default: the first half of the log). The other days are test days
    #[arg(long, value_name = "FROM..TO", value_parser = days)]
    training_days: Option<(Date, Date)>,
    /// New folder for the fitted scenario
    #[arg(short, long, value_name = "FOLDER")]
    out: PathBuf,
    /// Time zone of the home, for a log in UTC (default: that of the scenario)
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    /// Print the report as one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    trust: Trust,
}

fn days(text: &str) -> Result<(Date, Date), String> {
    let dates = text.split_once("..").map(|(from, to)| (from.trim().parse::<Date>(), to.trim().parse::<Date>()));
    match dates {
        Some((Ok(from), Ok(to))) if from <= to => Ok((from, to)),
        Some((Ok(_), Ok(_))) => Err("the last day is before the first".into()),
        _ => Err("write two days such as 2016-07-01..2016-07-14".into()),
    }
}

/// Simulated days that are compared with the test days.
const LIVED_DAYS: u32 = 28;
/// Another seed than that of the fit.
const SEED: u64 = 1000;

#[derive(Serialize)]
struct FitReport {
    log: String,
    seen_days: Vec<String>,
    unseen_days: Vec<String>,
    fitted: Fitted,
    measures: Vec<FitMeasure>,
}

#[derive(Serialize)]
struct FitMeasure {
    measure: &'static str,
    about: &'static str,
    fitted: Option<f64>,
    /// Distance from the training days: the variation of the home.
    seen_days: Option<f64>,
    before: Option<f64>,
}

impl FitArguments {
    pub fn run(self) -> Result<(), Failure> {
        if self.out.exists() {
            return Err(SimulationError::Exists { path: self.out }.into());
        }
        let home = self.trust.source(&self.home)?.open()?;
        let zone = self.time_zone.clone().unwrap_or_else(|| home.scenario().file.time_zone.clone());
        let read = self.log.read(Some(&zone))?;
        let parts = self.split(&read.log, read.recorded)?;
        let seen = parts.part(&read.log, true);
        let calibration = progress::show_share(|progress| calibrate(&seen, &home, progress))?;
        let report = FitReport {
            log: self.log.to_string(),
            seen_days: parts.dates(true),
            unseen_days: parts.dates(false),
            measures: self.measures(&read.log, &parts, &home, &calibration)?,
            fitted: calibration.fitted.clone(),
        };
        create(&self.out, |part, _| {
            for (name, text) in &calibration.files {
                let path = part.join(name);
                path.parent().map_or(Ok(()), std::fs::create_dir_all).map_err(|error| LogError::file(&path, error))?;
                write_file(&path, text.as_bytes(), false)?;
            }
            write_file(&part.join("report.json"), json_text(&report)?.as_bytes(), false)
        })?;
        report.fitted.doubt().iter().for_each(|doubt| tell(format_args!("{}: {doubt}", self.log)));
        if self.json {
            return print_json(&report);
        }
        print_text(&report.to_string())?;
        tell(format_args!("{} is ready.\n  homebody run {0}\n  homebody routine explain {0}", self.out.display()));
        Ok(())
    }

    fn split(&self, log: &Log, recorded: Option<Interval<WallTime>>) -> Result<LogSplit, Failure> {
        let rows = || log.events.iter().map(|event| event.at);
        let of_rows = |(first, last)| Interval::new(first, last + Span::MICROSECOND);
        let whole = recorded.or_else(|| rows().min().zip(rows().max()).map(of_rows));
        let no_rows = || Failure::asked(LogContentMessage::NoRows { log: self.log.to_string() });
        let whole = whole.ok_or_else(no_rows)?;
        let last_instant = whole.end - Span::MICROSECOND;
        let (first, last) = (whole.begin.day_number(), last_instant.day_number() + 1);
        let seen = match self.training_days {
            None => first..first + (last - first) / 2,
            Some((from, to)) => WallTime::midnight(from).day_number()..WallTime::midnight(to).day_number() + 1,
        };
        let seen = seen.start.max(first)..seen.end.min(last);
        let (count, unseen) = (seen.end - seen.start, last - first - (seen.end - seen.start).max(0));
        if count < LEAST_DAYS || unseen < 1 {
            return Err(Failure::asked(TrainingMessage::FewDays {
                log: self.log.to_string(),
                training_days: count.max(0) as usize,
                test_days: unseen.max(0) as usize,
                first: whole.begin.date().to_string(),
                last: last_instant.date().to_string(),
            }));
        }
        // The test days are the longer part, before or after the training days.
        let unseen = if last - seen.end >= seen.start - first { seen.end..last } else { first..seen.start };
        let midnight = |day: i64| WallTime::EPOCH + day * DAY;
        let within = |days: Range<i64>| Interval::new(midnight(days.start), midnight(days.end)).intersection(whole);
        Ok(LogSplit { seen: within(seen), unseen: within(unseen) })
    }

    fn measures(
        &self,
        log: &Log,
        parts: &LogSplit,
        home: &OpenScenario,
        calibration: &Calibration,
    ) -> Result<Vec<FitMeasure>, Failure> {
        let open = ScenarioSource::from_texts(calibration.files.clone(), calibration.entry.clone()).open()?;
        let log = Log { sensors: calibration.names.clone(), ..log.clone() };
        let unseen = parts.part(&log, false);
        let seen = parts.part(&log, true);
        let against = |name: &str, other: &Log, recorded: Option<Interval<WallTime>>| -> Result<Realism, Failure> {
            let real = ComparedLog { name: self.log.text(), log: &unseen, recorded: Some(parts.unseen) };
            realism(real, ComparedLog { name, log: other, recorded }).map_err(|problems| not_comparable(&problems))
        };
        let fitted = against("the fitted scenario", &simulated_log(&open, SEED, LIVED_DAYS)?, None)?;
        let own = against("the training days", &seen, Some(parts.seen))?;
        let before = against("the scenario before the fit", &simulated_log(home, SEED, LIVED_DAYS)?, None)?;
        let rows = fitted.measures().into_iter().zip(own.measures()).zip(before.measures());
        let value = |measure: RealismMeasure| measure.value;
        Ok(rows
            .map(|(((measure, about, fitted), (_, _, own)), (_, _, before))| FitMeasure {
                measure,
                about,
                fitted: value(fitted),
                seen_days: value(own),
                before: value(before),
            })
            .collect())
    }
}

/// Fewest days for a rhythm (our choice).
const LEAST_DAYS: i64 = 3;

/// The training days and the test days of a log, in local time.
struct LogSplit {
    seen: Interval<WallTime>,
    unseen: Interval<WallTime>,
}

impl LogSplit {
    fn part(&self, log: &Log, seen: bool) -> Log {
        let span = if seen { self.seen } else { self.unseen };
        let events = log.events.iter().filter(|event| span.contains(event.at)).copied().collect();
        Log { events, ..log.clone() }
    }

    fn dates(&self, seen: bool) -> Vec<String> {
        let span = if seen { self.seen } else { self.unseen };
        [span.begin, span.end - Span::MICROSECOND].map(|at| at.date().to_string()).into()
    }
}

/// The reach and the misses of the sensors, one line each.
fn sights(f: &mut fmt::Formatter, sights: &[SensorSight]) -> fmt::Result {
    if sights.is_empty() {
        return Ok(());
    }
    let width = sights.iter().map(|sight| sight.sensor.chars().count()).max().unwrap_or(0);
    writeln!(f, "  {:width$}  {:>5}  {:>6}  {:>9}  {:>6}", "", "reach", "missed", "agreement", "before")?;
    for SensorSight { sensor, reach, missed, agreement: [before, after] } in sights {
        let missed = missed.map_or("-".into(), |missed| format!("{missed:.2}"));
        writeln!(f, "  {sensor:width$}  {reach:>5.2}  {missed:>6}  {after:>9.2}  {before:>6.2}")?;
    }
    writeln!(f)
}

impl fmt::Display for FitReport {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let FitReport { log, seen_days, unseen_days, fitted, measures } = self;
        let [real, ours] = fitted.firings_an_hour;
        writeln!(f, "{log}, fitted to {}, tested on {}\n", seen_days.join(" to "), unseen_days.join(" to "))?;
        writeln!(f, "{}", fitted.timing.all)?;
        writeln!(
            f,
            "repeated messages {:.2} %, missing messages {:.2} %",
            100.0 * fitted.timing.repeated,
            100.0 * fitted.timing.missing
        )?;
        writeln!(
            f,
            "events an hour: up {:.1} (fitted {:.1}), in bed {:.1} (fitted {:.1})",
            real.up, ours.up, real.in_bed, ours.in_bed
        )?;
        writeln!(
            f,
            "movement {:.2} times the default, turning {:.2} times, spread of days {:.2}\n",
            fitted.movement, fitted.turning, fitted.day_spread
        )?;
        sights(f, &fitted.sights)?;
        fitted.routine.iter().try_for_each(|sentence| writeln!(f, "  {sentence}"))?;
        writeln!(f, "\n{:<18} {:>8} {:>10} {:>8}", "test days against", "fitted", "training", "before")?;
        for row in measures {
            let cell = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.3}"));
            let [fitted, own, before] = [row.fitted, row.seen_days, row.before].map(cell);
            writeln!(f, "{:<18} {fitted:>9} {own:>10} {before:>8}  {}", row.measure, row.about)?;
        }
        Ok(())
    }
}
