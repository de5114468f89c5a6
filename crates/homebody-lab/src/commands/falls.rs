use crate::falls::{CameraHome, FIRST_SEED, experiment};
use homebody::shared::{Failure, ResultOutput};
use homebody_analysis::falls::rules::FallRules;
use homebody_simulation::template;

/// Measure how well cameras and motion sensors detect falls
///
/// A person falls, or does something similar, in a room with two cameras and motion sensors. The person falls while walking, while
/// standing, while getting up or out of bed, or sinks to the floor. The person then lies there for 2 to 59 minutes. The other cases are
/// exercise on the floor, kneeling, sitting still, bending, going to bed, picking something up, and a cat that passes. Each case has
/// four variants: normal, without noise, with three times the noise, and behind more furniture. The experiment also searches weeks of
/// a simulated home with cameras and falls.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab falls
  homebody-lab falls --cases 100 --json falls.json --png falls.png

JSON has \"rows\" of \"method\", \"cameras\", \"condition\", \"sensitivity\", \"false_alarms_per_day\" and
\"seconds_to_alarm\", with 95 % confidence intervals. The picture shows the sensitivity of each method
against its false alarms.")]
pub struct FallsLabArguments {
    /// Number of cases of each kind
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    cases: u32,
    /// Seed of the first case; keep seeds 1 to 1000 for fitting rules
    #[arg(long, value_name = "N", default_value_t = FIRST_SEED)]
    seed: u64,
    /// Weeks of the template `cameras` to simulate and search for falls
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(0..=520))]
    weeks: u32,
    #[command(flatten)]
    output: ResultOutput,
}

const SCENARIO: &str = "cameras";

impl FallsLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check([""], &[])?;
        let template = template(SCENARIO)?;
        let home = CameraHome { scenario: template.scenario(), drivers: template.household() };
        let rules = FallRules::default();
        let found = experiment(self.cases, self.seed, &rules, (&home, self.weeks))?;
        output.write(&found, [&|| found.picture()])
    }
}
