//! `homebody routine check`: everything that is wrong with routines.

use crate::failure::Failure;
use crate::folder;
use crate::print::{print_json, tell};
use serde_json::json;
use std::path::PathBuf;

/// Reports everything that is wrong with the routines of a scenario and the conditions that they show: each at its word,
/// with what was expected and the nearest known name.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody routine check scenarios/tigerplace
  homebody routine check my-home/scenario.json --json")]
pub struct Arguments {
    /// The scenario's folder, or its scenario.json
    scenario: PathBuf,
    /// Print the problems as one JSON object
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let loaded = folder::load_lives(&self.scenario, &[]);
        if self.json {
            match &loaded {
                Ok(_) => print_json(&json!({ "problems": [] }))?,
                Err(Failure::Problems(problems)) => print_json(&json!({ "problems": problems }))?,
                Err(_) => {}
            }
        }
        let (scenario, _, household) = loaded?;
        let mut routines = 0;
        for (index, resident) in scenario.residents.iter().enumerate() {
            let Some(routine) = household.routine(index) else { continue };
            routines += 1;
            let counted = |count: usize, one: &str, more: &str| match count {
                1 => format!("1 {one}"),
                count => format!("{count} {more}"),
            };
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
