//! `homebody experiment falls`.

use crate::commands::answer::Answer;
use crate::failure::Failure;
use homebody_analysis::falls::rules::FallRules;
use homebody_experiment::falls::{FIRST_SEED, Home, experiment};
use homebody_kit::template;

/// Lets somebody fall in a room with two cameras and motion sensors, or do what looks like it, and says what silhouettes, motion
/// sensors, and both tell of it.
///
/// Falls: while walking, from standing, while rising, out of bed, and sinking down; then they lie there for 2 to 59 minutes. What
/// looks like them: exercise on the floor, kneeling, sitting still, bending, going to bed, picking something up, and a cat. Each
/// case is lived as usual, without noise, with three times the noise, and behind more furniture. Besides, weeks of a life with falls
/// in a home with cameras are looked at.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody experiment falls
  homebody experiment falls --cases 100 --json falls.json --png falls.png

JSON has \"rows\" of \"method\", \"cameras\", \"condition\", \"sensitivity\", \"false_alarms_per_day\" and
\"seconds_to_alarm\", with intervals of 95 %. The picture has what each method finds as its limits
are loosened.")]
pub struct Arguments {
    /// How many cases of each kind
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    cases: u32,
    /// The seed of the first case; those from 1 to 1000 are there to fit rules on
    #[arg(long, default_value_t = FIRST_SEED)]
    seed: u64,
    /// How many weeks of the life in the template `cameras` are looked at besides
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(0..=520))]
    weeks: u32,
    #[command(flatten)]
    answer: Answer,
}

/// Where weeks are lived.
const SCENARIO: &str = "cameras";

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let answer = self.answer.check([""], &[])?;
        let lived = template(SCENARIO)?;
        let home = Home { scenario: lived.scenario(), drivers: lived.household() };
        let rules = FallRules::default();
        let found = experiment(self.cases, self.seed, &rules, (&home, self.weeks))?;
        answer.give(&found, [&|| found.picture()])
    }
}
