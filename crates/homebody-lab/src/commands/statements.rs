use super::evaluation::evaluate_each;
use crate::messages::ExperimentMessage;
use crate::statements::{DrawnLife, StatementsExperiment};
use homebody::shared::{Failure, JsonOutput, print_text};
use std::ops::RangeInclusive;

/// Measure whether random statements happen in simulations
///
/// Homebody draws lives with one to three statements about habits, visits, outings, sleep, falls, changes and rules. It simulates them, and
/// measures each field of a statement in the ground truth. A field has one of three verdicts: "happened"; "told", if Homebody reported before
/// the run that it cannot happen or has no room; "neither" otherwise. The exit code is 2 if the verdict of a field is "neither".
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab statements --count 5000 --seed 7 --json statements.json
  homebody-lab statements --seed 7 --only 311

JSON has \"fields\", each with index, kind, field, text, expected, measured, verdict, and the whole routine.")]
pub struct StatementsLabArguments {
    /// Number of statements
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Least and greatest number of days of a run
    #[arg(long, value_name = "FROM..TO", default_value = "30..90", value_parser = days)]
    days: RangeInclusive<i32>,
    /// Repeat only the run with this statement, and print its routine
    #[arg(long, value_name = "INDEX")]
    only: Option<usize>,
    #[command(flatten)]
    output: JsonOutput,
}

fn days(text: &str) -> Result<RangeInclusive<i32>, String> {
    /// Shortest and longest run (our choice): a change needs some days before and after it.
    const ALLOWED: RangeInclusive<i32> = 14..=400;
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let number = |text: &str| {
        text.parse::<i32>().map_err(|_| format!("write two numbers of days, such as 30..90, and not {text:?}"))
    };
    let (from, to) = (number(from)?, number(to)?);
    match from <= to && ALLOWED.contains(&from) && ALLOWED.contains(&to) {
        true => Ok(from..=to),
        false => Err(format!("the days must be in order, and from {} to {}", ALLOWED.start(), ALLOWED.end())),
    }
}

impl StatementsLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(&[])?;
        let count = self.only.map_or(self.count as usize, |only| (self.count as usize).max(only + 1));
        let mut lives = DrawnLife::draw_all(count, self.seed, &self.days);
        if let Some(only) = self.only {
            lives.retain(|life| (life.first..life.first + life.statements.len()).contains(&only));
        }
        let rows = evaluate_each(&lives, "lives", |life| Ok::<_, Failure>(life.measure()))?.concat();
        if let (Some(_), Some(row)) = (self.only, rows.first()) {
            print_text(&format!("# {} days in {}\n{}\n", row.days, row.home, row.routine))?;
        }
        let statements = lives.iter().map(|life| life.statements.len()).sum();
        let experiment = StatementsExperiment::from_rows(rows, statements, self.seed);
        output.write(&experiment, [])?;
        match experiment.neither {
            0 => Ok(()),
            count => Err(Failure::asked(ExperimentMessage::StatementsFail { count })),
        }
    }
}
