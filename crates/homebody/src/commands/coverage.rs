//! `homebody coverage`: the fields of view of a home's sensors.

use super::install_sheet::build;
use super::result_output::ResultOutput;
use super::scenario::ScenarioArguments;
use crate::failure::Failure;
use homebody_analysis::coverage::{self, STEP_M};
use homebody_picture::coverage_map;

/// Map what the sensors of a home see, and what they miss
///
/// The report has the shares of the floor that no, one, two, three or more sensors see, the dead zones, and the overlaps of sensors. It
/// uses the same fields of view as a run.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody coverage scenarios/tigerplace
  homebody coverage my-home --png map.png --json coverage.json")]
pub struct CoverageArguments {
    #[command(flatten)]
    scenario: ScenarioArguments,
    #[command(flatten)]
    output: ResultOutput,
}

impl CoverageArguments {
    pub fn run(self) -> Result<(), Failure> {
        let source = self.scenario.source()?;
        let scenario = source.scenario()?;
        let output = self.output.check([""], &source.paths(&scenario))?;
        let seen = coverage::of_home(&scenario.home, build(&scenario), STEP_M);
        let map = || coverage_map(&seen.home, &seen.coverage, &seen.beams());
        output.write(&seen.coverage, [&map])
    }
}
