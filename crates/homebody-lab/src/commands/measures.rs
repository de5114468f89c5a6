//! `homebody-lab measures`.

use super::locate::{of_one, with_and_without_faults};
use crate::measures::{Error, beside, case};
use crate::messages::ExperimentMessage;
use homebody::shared::{Failure, Figures, HowRead, not_measurable, read_log, within};
use homebody_analysis::measures::Measures;
use homebody_query::LoadedLog;
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Measure the accuracy of the command homebody measures
///
/// Homebody compares the measures from logs with those from the ground truth. The homes cycle through the templates that have one
/// resident, each with its own seed. Each home has two logs: one without losses, and one with every sensor fault.
///
/// With --data, it compares the measures from sensors of real homes with the activities that their logs note.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab measures
  homebody-lab measures --homes 8 --days 14 --json measures.json
  homebody-lab measures --data OrdonezA_Sensors.txt --data kasterenSenseData.txt")]
pub struct Arguments {
    /// Number of homes
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    homes: u32,
    /// Days to simulate for each home
    #[arg(long, value_name = "N", default_value_t = 28, value_parser = clap::value_parser!(u32).range(2..=366))]
    days: u32,
    /// Log of a real home with activities, instead of simulated homes; repeatable
    #[arg(long, value_name = "LOG", conflicts_with_all = ["homes", "days"])]
    data: Vec<String>,
    #[command(flatten)]
    figures: Figures,
}

/// Measures of logs of real homes, beside what people wrote down.
#[derive(Serialize)]
struct OfRealLogs {
    logs: Vec<OfRealLog>,
}

#[derive(Serialize)]
struct OfRealLog {
    name: String,
    errors: Vec<Error>,
}

#[derive(Serialize)]
struct OfLogs {
    days: u32,
    /// Over all homes, with a link that loses nothing.
    clean: Vec<Error>,
    /// The same with every fault on.
    faults: Vec<Error>,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        if !self.data.is_empty() {
            return self.of_real_logs();
        }
        let answer = self.figures.check(&[])?;
        let cases = with_and_without_faults(self.homes, self.days, of_one, case)?;
        let all = |faults: bool| {
            let same = cases.iter().filter(|(with_faults, _)| *with_faults == faults);
            Error::all(same.flat_map(|(_, case)| case).collect::<Vec<_>>().into_iter())
        };
        answer.give(&OfLogs { days: self.days, clean: all(false), faults: all(true) }, [])
    }
}

impl Arguments {
    fn of_real_logs(self) -> Result<(), Failure> {
        let read = |log: &String| read_log(log, None, &HowRead::default());
        let mut read = self.data.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let sources: Vec<PathBuf> = read.iter().flat_map(|read| read.sources.clone()).collect();
        let answer = self.figures.check(&sources)?;
        let of_log = |(log, read): (&String, &mut LoadedLog)| {
            // A measure by the notes alone cannot be compared with the notes.
            let notes = std::mem::take(&mut read.log.activities);
            let heard = read.measures().map_err(|why| not_measurable(log, &why))?;
            let told = Measures::from_notes(&read.name, &notes, within(read).unwrap_or_default());
            let told = told.ok_or_else(|| Failure::asked(ExperimentMessage::NoActivities { log: log.clone() }))?;
            Ok(OfRealLog { name: read.name.clone(), errors: beside(&heard, &told) })
        };
        let logs = self.data.iter().zip(&mut read).map(of_log).collect::<Result<Vec<_>, Failure>>()?;
        answer.give(&OfRealLogs { logs }, [])
    }
}

fn table(f: &mut fmt::Formatter, errors: &[Error]) -> fmt::Result {
    writeln!(
        f,
        "  {:18} {:8} {:>6} {:>10} {:>8} {:>11} {:>10} {:>7}",
        "measure", "unit", "days", "true", "bias", "mean error", "90 % error", "r"
    )?;
    for error in errors {
        let Error { measure, unit, days, mean_true, bias, mean_error, p90_error, correlation, .. } = error;
        let r = correlation.map_or("-".to_owned(), |r| format!("{r:.2}"));
        writeln!(
            f,
            "  {measure:18} {unit:8} {days:>6} {mean_true:>10.2} {bias:>8.2} {mean_error:>11.2} {p90_error:>10.2} {r:>7}"
        )?;
    }
    writeln!(f)
}

impl fmt::Display for OfLogs {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "Measures of {} days from logs, compared with the ground truth\n", self.days)?;
        for (link, errors) in [("no losses", &self.clean), ("every sensor fault", &self.faults)] {
            writeln!(f, "With {link}")?;
            table(f, errors)?;
        }
        Ok(())
    }
}

impl fmt::Display for OfRealLogs {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "Measures from sensors of real homes, compared with noted activities\n")?;
        for OfRealLog { name, errors } in &self.logs {
            writeln!(f, "{name}")?;
            table(f, errors)?;
        }
        Ok(())
    }
}
