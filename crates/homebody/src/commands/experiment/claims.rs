//! `homebody experiment claims`.

use crate::commands::answer::Figures;
use crate::failure::Failure;
use crate::progress::bar;
use homebody_experiment::claims::{CLAIMS, Case, Experiment, Row};
use homebody_kit::Error;
use rayon::prelude::*;

/// What is said is lived, or told before the run: a table of claims.
///
/// Each case puts some sentences over a calm life and measures in the truth what their words say: how often, when, for how
/// long, how far. A claim is lived if it is measured so, told if the program says before the run that it is not, and else
/// neither. The exit code is 0 only if none is neither.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody experiment claims
  homebody experiment claims --days 120 --seed 3 --json claims.json

JSON has \"claims\", each with form, text, claim, expected, measured and verdict, and the line of its case in the table of
claims; and how many are \"lived\", \"told\" and \"neither\".")]
pub struct Arguments {
    /// How many days each case lives, where it says no other
    #[arg(long, default_value_t = 60, value_parser = clap::value_parser!(i32).range(60..=3660))]
    days: i32,
    /// The number all randomness comes from
    #[arg(long, default_value_t = 11)]
    seed: u64,
    #[command(flatten)]
    figures: Figures,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let answer = self.figures.check(&[])?;
        let cases = Case::read(CLAIMS).map_err(Failure::usage)?;
        let rows = lived(&cases, self.days, self.seed)?;
        let experiment = Experiment::of(rows, self.days, self.seed);
        answer.give(&experiment, [])?;
        match experiment.neither {
            0 => Ok(()),
            neither => Err(Failure::usage(format!("{neither} claims are neither lived nor told before the run"))),
        }
    }
}

/// Lives all cases, on all processors: what came of them in their order.
pub fn lived(cases: &[Case], days: i32, seed: u64) -> Result<Vec<Row>, Failure> {
    let progress = bar(cases.len() as u64, "{bar:40} {pos} of {len} cases  {eta} left");
    let live = |case: &Case| {
        let rows = case.live(days, seed);
        progress.inc(1);
        rows
    };
    let pool = rayon::ThreadPoolBuilder::new().build();
    let pool = pool.map_err(|error| Error::Threads(error.to_string()))?;
    let rows: Vec<Vec<Row>> = pool.install(|| cases.par_iter().map(live).collect());
    progress.finish_and_clear();
    Ok(rows.concat())
}
