use super::evaluation::evaluate_each;
use crate::claims::{CLAIMS, ClaimCase, ClaimRow, ClaimsExperiment};
use crate::messages::ExperimentMessage;
use homebody::shared::{Failure, JsonOutput};

/// Measure whether simulations follow the sentences of routines
///
/// Each case adds sentences to a simple routine. It then measures in the ground truth whether they hold: how often, when, how long and
/// how far. A claim has one of three verdicts: "lived", if the measured value agrees; "told", if it does not, and Homebody warned before
/// the run; "neither" otherwise. The exit code is 2 if the verdict of a claim is "neither".
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab claims
  homebody-lab claims --days 120 --seed 3 --json claims.json

JSON has \"claims\", each with form, text, claim, expected, measured, verdict and the line of its case in
the table of claims; and the numbers of \"lived\", \"told\" and \"neither\".")]
pub struct ClaimsLabArguments {
    /// Number of days, for cases that do not set it
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(i32).range(60..=3660))]
    days: i32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 11)]
    seed: u64,
    #[command(flatten)]
    output: JsonOutput,
}

impl ClaimsLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(&[])?;
        let cases = cases(CLAIMS)?;
        let rows = simulated(&cases, self.days, self.seed)?;
        let experiment = ClaimsExperiment::from_rows(rows, self.days, self.seed);
        output.write(&experiment, [])?;
        match experiment.neither {
            0 => Ok(()),
            count => Err(Failure::asked(ExperimentMessage::ClaimsFail { count })),
        }
    }
}

pub fn cases(table: &str) -> Result<Vec<ClaimCase>, Failure> {
    ClaimCase::read(table).map_err(|why| Failure::asked(ExperimentMessage::Cases { why: why.to_string() }))
}

/// Simulates all cases, on all processors, and returns their results in order.
pub fn simulated(cases: &[ClaimCase], days: i32, seed: u64) -> Result<Vec<ClaimRow>, Failure> {
    let rows = evaluate_each(cases, "cases", |case| Ok::<_, Failure>(case.simulate(days, seed)))?;
    Ok(rows.concat())
}
