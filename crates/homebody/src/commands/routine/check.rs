//! `homebody routine check`: everything that is wrong with routines.

use crate::commands::check::load_and_say;
use crate::commands::scenario::Chosen;
use crate::failure::Failure;
use crate::print::tell;
use homebody_core::problem::counted;

/// Reports everything that is wrong with the routines of a scenario and the conditions that they show: each at its word,
/// with what was expected and the nearest known name.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody routine check scenarios/tigerplace
  homebody routine check my-home/scenario.json --json")]
pub struct Arguments {
    #[command(flatten)]
    scenario: Chosen,
    /// Print the problems as one JSON object
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let opened = load_and_say(self.scenario.source(), self.json, |_| Vec::new())?;
        let (scenario, household) = (opened.scenario(), opened.household());
        let mut routines = 0;
        for (index, resident) in scenario.residents.iter().enumerate() {
            let Some(routine) = household.routine(index) else { continue };
            routines += 1;
            tell(format_args!(
                "{}: nothing is wrong. {} has {}, {} and {}.",
                routine.file,
                resident.file.name,
                counted(routine.habits.len(), "habit", "habits"),
                counted(routine.rules.len(), "rule", "rules"),
                counted(routine.changes.len(), "change to come", "changes to come"),
            ));
        }
        if routines == 0 {
            tell(format_args!("{}: nobody lives by a routine here.", scenario.file.name));
        }
        Ok(())
    }
}
