//! `homebody realism`: a log compared with a real one.

use super::log_input::{LogOptions, read_log};
use super::messages::not_comparable;
use super::result_output::ResultOutput;
use crate::failure::Failure;
use crate::progress::Working;
use homebody_analysis::realism::{ComparedLog, MEASURES, realism};
use homebody_picture::{realism_chart, realism_page};
use homebody_query::LoadedLog;
use std::path::PathBuf;

/// Measure how realistic a log is, compared with a real log
///
/// Homebody compares log B, such as that of a run, with log A, such as that of a real home: gaps, ON lengths, hours, sensors and days. A
/// random forest also tries to tell days and hours of A from those of B. The report has its area under the curve and the features
/// that it used. Each value has a floor: the same measure, between the two halves of A.
///
/// Only motion sensors on whole days count. Sensor shares and ways (transitions between sensors) need logs with the same sensor names.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody realism casas:real.txt runs/older-adult-1
  homebody realism casas:real.txt runs/older-adult-1 --json realism.json --html realism.html
  homebody realism runs/older-adult-1 runs/older-adult-2 --json

Measures:
{}", MEASURES.trim_end()))]
pub struct RealismArguments {
    /// Real log: a file, a run folder, a data set folder, or FORM:FILE
    a: String,
    /// Log to evaluate
    b: String,
    #[command(flatten)]
    how: LogOptions,
    /// Write the report as one HTML page with pictures
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    html: Option<PathBuf>,
    /// The home's time zone, for a log in UTC; not needed for a run folder, which stores it
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    #[command(flatten)]
    output: ResultOutput,
}

impl RealismArguments {
    pub fn run(self) -> Result<(), Failure> {
        let zone = self.time_zone.as_deref();
        let (a, b) = (read_log(&self.a, zone, &self.how)?, read_log(&self.b, zone, &self.how)?);
        let sources: Vec<PathBuf> = [&a, &b].into_iter().flat_map(|log| log.sources.clone()).collect();
        let output = self.output.check_with_table([""], self.html.as_deref(), &sources)?;
        let comparing = Working::on(format!("comparing {} with {}", self.b, self.a));
        let realism = realism(compared(&a), compared(&b)).map_err(|problems| not_comparable(&problems))?;
        drop(comparing);
        output.write_with_table(&realism, [&|| realism_chart(&realism)], &|| realism_page(&realism))
    }
}

fn compared(log: &LoadedLog) -> ComparedLog<'_> {
    ComparedLog { name: &log.name, log: &log.log, recorded: log.recorded }
}
