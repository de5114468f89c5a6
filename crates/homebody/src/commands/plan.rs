//! `homebody plan`: the floor plan of a scenario's home.

use super::messages::PictureMessage;
use super::result_output::PictureOutput;
use super::scenario::ScenarioArguments;
use crate::failure::Failure;
use homebody_picture::floor_plan;

/// Draw the floor plan of a home
///
/// The plan has rooms, walls, doors, furniture and sensors with their names. It leaves out names of furniture and entrances where the
/// space is too small.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody plan scenarios/tigerplace --svg plan.svg
  homebody plan my-home --png plan.png --force")]
pub struct PlanArguments {
    #[command(flatten)]
    scenario: ScenarioArguments,
    #[command(flatten)]
    pictures: PictureOutput,
}

impl PlanArguments {
    pub fn run(self) -> Result<(), Failure> {
        if self.pictures.is_empty() {
            return Err(Failure::asked(PictureMessage::NoFile));
        }
        let source = self.scenario.source()?;
        let scenario = source.scenario()?;
        self.pictures.check([""], &[], &source.paths(&scenario))?;
        self.pictures.draw([""], [&|| floor_plan(&scenario.home)])
    }
}
