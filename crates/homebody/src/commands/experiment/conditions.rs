//! `homebody experiment conditions`.

use super::claims::lived;
use crate::commands::answer::Figures;
use crate::failure::Failure;
use homebody_experiment::claims::{CONDITIONS, Case, Conditions};

/// What conditions do to a life, beside the sizes that their sources cite.
///
/// Each condition is lived by one who is else the same as a twin who does not show it. What changes is measured in the truth, and
/// told beside what was published, or what was taken where nothing was.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody experiment conditions
  homebody experiment conditions --seed 3 --json conditions.json

JSON has \"conditions\", each with the condition, what is measured, the size that is expected, its source, what was measured, and
whether it lies within.")]
pub struct Arguments {
    /// The number all randomness comes from
    #[arg(long, default_value_t = 11)]
    seed: u64,
    #[command(flatten)]
    figures: Figures,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let answer = self.figures.check(&[])?;
        let cases = Case::read(CONDITIONS).map_err(Failure::usage)?;
        let rows = lived(&cases, 0, self.seed)?;
        answer.give(&Conditions::of(rows, self.seed), [])
    }
}
