//! `homebody experiment measures`.

use super::walk_back::{every_fault, lived, of_homes, of_one};
use crate::commands::answer::Answer;
use crate::failure::Failure;
use homebody_core::scenario::link::LinkFile;
use homebody_experiment::measures::{Error, case};
use serde::Serialize;
use std::fmt;

/// Measures days by the logs of homes, and says how far that is from what residents did.
///
/// Homes are those of templates with one resident, one after the other, each with a life of its own. Each is lived twice: with
/// a link that loses nothing, and with every fault on.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody experiment measures
  homebody experiment measures --homes 8 --days 14 --json measures.json")]
pub struct Arguments {
    /// How many homes and lives
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    homes: u32,
    /// How many days of each
    #[arg(long, default_value_t = 28, value_parser = clap::value_parser!(u32).range(2..=366))]
    days: u32,
    #[command(flatten)]
    answer: Answer,
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
        let answer = self.answer.check([], &[])?;
        let asked: Vec<(usize, bool)> =
            (0..self.homes as usize).flat_map(|home| [(home, false), (home, true)]).collect();
        let cases = of_homes(
            &asked,
            |&(home, _)| of_one(home),
            |opened, &(home, faults)| {
                let link = if faults {
                    every_fault(opened.scenario(), home, (0.0, self.days.into()))
                } else {
                    LinkFile::default()
                };
                lived(opened, &link, |lived| case(lived, 1 + home as u64, self.days))
            },
        )?;
        let all = |faults: bool| {
            let same = asked.iter().zip(&cases).filter(|(asked, _)| asked.1 == faults);
            Error::all(same.flat_map(|(_, case)| case).collect::<Vec<_>>().into_iter())
        };
        answer.give(&OfLogs { days: self.days, clean: all(false), faults: all(true) }, [])
    }
}

impl fmt::Display for OfLogs {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "Measures of {} days by logs, beside what residents did\n", self.days)?;
        for (link, errors) in [("a link that loses nothing", &self.clean), ("every fault on", &self.faults)] {
            writeln!(f, "With {link}")?;
            writeln!(
                f,
                "  {:16} {:8} {:>6} {:>10} {:>8} {:>11} {:>10} {:>7}",
                "measure", "unit", "days", "truly", "bias", "mean error", "90 % error", "r"
            )?;
            for error in errors {
                let Error { measure, unit, days, mean_true, bias, mean_error, p90_error, correlation, .. } = error;
                let r = correlation.map_or("-".to_owned(), |r| format!("{r:.2}"));
                writeln!(
                    f,
                    "  {measure:16} {unit:8} {days:>6} {mean_true:>10.2} {bias:>8.2} {mean_error:>11.2} {p90_error:>10.2} {r:>7}"
                )?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}
