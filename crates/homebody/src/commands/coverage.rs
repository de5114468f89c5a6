//! `homebody coverage`: where in the home the sensors see.

use super::answer::Answer;
use super::install_sheet::build;
use super::scenario::Chosen;
use crate::failure::Failure;
use homebody_analysis::coverage::{self, STEP_M};
use homebody_picture::coverage_map;

/// Says which share of the floor is seen by no, one, two, three or more sensors, where the dead zones are, and how
/// sensors overlap; from the very fields that a run senses with.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody coverage scenarios/tigerplace
  homebody coverage my-home --png map.png --json coverage.json")]
pub struct Arguments {
    #[command(flatten)]
    scenario: Chosen,
    #[command(flatten)]
    answer: Answer,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let source = self.scenario.source()?;
        let scenario = source.scenario()?;
        let answer = self.answer.check([""], &source.paths(&scenario))?;
        let seen = coverage::of_home(&scenario.home, build(&scenario), STEP_M);
        let map = || coverage_map(&seen.home, &seen.coverage, &seen.beams());
        answer.give(&seen.coverage, [&map])
    }
}
