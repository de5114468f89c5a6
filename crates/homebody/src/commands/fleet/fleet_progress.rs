//! The progress of a fleet: a line every few seconds and a file of reports.

use crate::commands::run_output::span_in_words;
use crate::failure::Failure;
use crate::print::{counted, grouped, not_written, print_json, tell, tell_with, warn};
use crate::progress::on_terminal;
use crate::prometheus::LastReport;
use homebody_core::time::SECOND;
use homebody_fleet::{FleetHomes, FleetReport, FleetStatus};
use homebody_log::files::fresh::FreshFile;
use homebody_log::sink::csv_line;
use indicatif::ProgressBar;
use std::fmt::Write;
use std::sync::PoisonError;
use std::time::{Duration, Instant};

homebody_core::messages! {
    /// Remarks on the end of a fleet.
    pub enum FleetEndMessage in "fleet-end" {
        /// A routine asked a resident to do something impossible, such as to use furniture that no path leads to. The other homes
        /// continued.
        StoppedHomes { homes: usize } warning "stopped-homes" (
            "{homes} stopped early: a routine asked for something impossible",
            homes = counted(*homes as u64, "home", "homes")
        )
            hint ("homebody check reports the problems of a scenario");
    }
}

pub struct FleetProgress {
    is_quiet: bool,
    is_json: bool,
    bar: ProgressBar,
    file: Option<FreshFile>,
    last: LastReport,
    /// The largest lag behind the clock at the start, in seconds.
    caught_up_s: f64,
    noted_at: Instant,
}

/// Time between two notes of a fleet that catches up (our choice).
const BETWEEN_NOTES: Duration = Duration::from_secs(10);

impl FleetProgress {
    pub fn new(is_quiet: bool, is_json: bool, file: Option<FreshFile>, last: LastReport) -> FleetProgress {
        let bar = on_terminal(is_quiet, None, "{spinner} {msg}");
        FleetProgress { is_quiet, is_json, bar, file, last, caught_up_s: 0.0, noted_at: Instant::now() }
    }

    pub fn show(&mut self, status: FleetStatus) -> Result<(), Failure> {
        match status {
            FleetStatus::CatchesUp { behind_s, waiting } => {
                self.caught_up_s = self.caught_up_s.max(behind_s);
                if self.bar.is_hidden() && !self.is_quiet && self.noted_at.elapsed() >= BETWEEN_NOTES {
                    self.noted_at = Instant::now();
                    tell(format_args!("starting: {}", lag(behind_s, waiting)));
                }
                if !self.bar.is_hidden() {
                    self.bar.set_message(lag(behind_s, waiting));
                    self.bar.tick();
                }
            }
            FleetStatus::Begun => {
                self.bar.finish_and_clear();
                if !self.is_quiet && self.caught_up_s >= 1.0 {
                    tell(format_args!("caught up: simulated the {} before now", span(self.caught_up_s)));
                }
            }
            FleetStatus::Report(report) => {
                if !self.is_quiet {
                    tell_with(line(report), "fleet", report);
                }
                self.keep(report)?;
            }
        }
        Ok(())
    }

    pub fn finish(mut self, report: &FleetReport) -> Result<(), Failure> {
        self.bar.finish_and_clear();
        self.keep(report)?;
        if let Some(file) = self.file.take() {
            file.finish()?;
        }
        if report.failed > 0 {
            warn(FleetEndMessage::StoppedHomes { homes: report.failed });
        }
        if self.is_json {
            return print_json(report);
        }
        if !self.is_quiet {
            tell_with(format!("{}\n{}", totals(report), line(report)), "fleet", report);
        }
        Ok(())
    }

    fn keep(&mut self, report: &FleetReport) -> Result<(), Failure> {
        *self.last.lock().unwrap_or_else(PoisonError::into_inner) = report.clone();
        if let Some(file) = &mut self.file {
            let text = serde_json::to_string(report).map_err(not_written)?;
            file.write(text.as_bytes())?;
            file.write(b"\n")?;
            // Other programs can follow the file from the first report on.
            match file.part().is_some() {
                true => file.name_early()?,
                false => file.flush()?,
            }
        }
        Ok(())
    }
}

/// The lag of a fleet before its delivery starts. A fleet without a lag waits for its destinations.
fn lag(behind_s: f64, waiting: usize) -> String {
    let waiting = format!("{} in transit", message_count(waiting as u64));
    if behind_s >= 1.0 { format!("{} behind the clock, {waiting}", span(behind_s)) } else { waiting }
}

fn span(s: f64) -> String {
    span_in_words(SECOND.share(s))
}

fn line(report: &FleetReport) -> String {
    let FleetReport { late_median_ms, late_99_ms, late_most_ms, behind_s, .. } = report;
    let mut line = format!("{} homes", grouped(report.homes as u64));
    // Writing to a string never fails.
    let _ = write!(line, "  {:.0} messages/s", report.messages_per_s);
    let _ = write!(line, "  late {} median, {} 99 %, {} most", ms(*late_median_ms), ms(*late_99_ms), ms(*late_most_ms));
    if *behind_s >= 0.1 || report.waiting > 0 {
        let _ = write!(line, "  {} behind, {} waiting", seconds(*behind_s), grouped(report.waiting as u64));
    }
    if report.ahead_s < 1.0 {
        let _ = write!(line, "  simulated {} ahead", seconds(report.ahead_s));
    }
    if let Some(memory) = report.memory_mb {
        let _ = write!(line, "  {memory:.0} MB");
    }
    if let Some(processors) = report.processors {
        let _ = write!(line, "  {:.0} % of a processor", 100.0 * processors);
    }
    if report.retries > 0 {
        let _ = write!(line, "  {} retries", report.retries);
    }
    if report.came + report.went > 0 {
        let _ = write!(line, "  {} came, {} went", report.came, report.went);
    }
    if report.is_away {
        line.push_str("  outage");
    }
    line
}

fn totals(report: &FleetReport) -> String {
    let FleetReport { running_s, messages, homes_in_all, storms: outages, .. } = report;
    let outages = if *outages > 0 { format!(", {}", counted(*outages, "outage", "outages")) } else { String::new() };
    let homes = grouped(*homes_in_all as u64);
    let mut text =
        format!("total      {} from {homes} homes in {}{outages}", message_count(*messages), seconds(*running_s));
    for destination in &report.destinations {
        let _ = write!(text, "\nsent       {} {}", destination.place, message_count(destination.messages));
    }
    text
}

fn message_count(count: u64) -> String {
    counted(count, "message", "messages")
}

fn ms(ms: f64) -> String {
    if ms < 10.0 { format!("{ms:.1} ms") } else { format!("{ms:.0} ms") }
}

fn seconds(s: f64) -> String {
    if s.abs() < 10.0 { format!("{s:.1} s") } else { format!("{s:.0} s") }
}

pub fn homes_table(fleet: &FleetHomes) -> String {
    let mut text = String::from("home,scenario,seed,run,clock_ahead_s,there_at_begin\n");
    for (home, index) in fleet.fleet.homes.iter().zip(0..) {
        let scenario = fleet.fleet.layouts[home.layout].run.scenario.as_str();
        let ahead_s = fleet.skew(index).seconds();
        let numbers =
            [home.seed.to_string(), home.run.to_string(), ahead_s.to_string(), fleet.is_there(index).to_string()];
        let line = csv_line([home.name.as_str(), scenario].into_iter().chain(numbers.iter().map(String::as_str)));
        text += &(line + "\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_a_report_as_a_line_and_as_metrics() {
        let report = FleetReport {
            homes: 12_345,
            messages_per_s: 612.4,
            late_median_ms: 0.42,
            late_99_ms: 31.0,
            ..Default::default()
        };
        assert_eq!(
            line(&report),
            "12,345 homes  612 messages/s  late 0.4 ms median, 31 ms 99 %, 0.0 ms most  simulated 0.0 s ahead"
        );
        let numbers = crate::prometheus::fleet_numbers("a\"b", &report);
        assert!(numbers.contains("homebody_late_seconds{scenario=\"a\\\"b\",quantile=\"0.99\"} 0.031\n"), "{numbers}");
        assert_eq!((grouped(7), grouped(1_000), grouped(1_234_567)), ("7".into(), "1,000".into(), "1,234,567".into()));
    }

    #[test]
    fn a_fleet_without_a_lag_waits_for_destinations() {
        assert_eq!(lag(11_160.0, 1), "3.1 hours behind the clock, 1 message in transit");
        assert_eq!(lag(0.0, 1_200), "1,200 messages in transit");
    }
}
