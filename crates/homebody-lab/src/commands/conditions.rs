use super::claims::{cases, simulated};
use crate::claims::{CONDITIONS, ConditionsExperiment};
use homebody::shared::{Failure, JsonOutput};

/// Compare the effects of conditions with published sizes
///
/// Homebody simulates a person with a condition and a twin without it, measures the differences in the ground truth, and compares
/// them with published sizes, or else with our estimate.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab conditions
  homebody-lab conditions --seed 3 --json conditions.json

JSON has \"conditions\", each with the condition, the measure, the expected size, its source, the measured
size, and whether it is in range.")]
pub struct ConditionsLabArguments {
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 11)]
    seed: u64,
    #[command(flatten)]
    output: JsonOutput,
}

impl ConditionsLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(&[])?;
        let cases = cases(CONDITIONS)?;
        let rows = simulated(&cases, 0, self.seed)?;
        output.write(&ConditionsExperiment::from_rows(rows, self.seed), [])
    }
}
