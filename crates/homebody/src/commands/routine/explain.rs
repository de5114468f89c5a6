//! `homebody routine explain`: how routines were understood.

use crate::commands::scenario::Chosen;
use crate::failure::Failure;
use crate::print::{print_json, print_text};
use homebody_routine::explain::explain;
use serde_json::json;

/// Says how each sentence of the routines of a scenario was understood, and of the conditions that they show: in a table
/// (how likely, when, for how long) and in words.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody routine explain scenarios/tigerplace
  homebody routine explain scenarios/tigerplace --unsaid
  homebody routine explain my-home --json")]
pub struct Arguments {
    #[command(flatten)]
    scenario: Chosen,
    /// Add what is not said, and goes as it usually does
    #[arg(long)]
    unsaid: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let opened = self.scenario.source()?.open()?;
        let (scenario, household) = (opened.scenario(), opened.household());
        let routines = (0..scenario.residents.len()).filter_map(|resident| household.routine(resident).cloned());
        let unsaid =
            (0..scenario.residents.len()).filter(|_| self.unsaid).filter_map(|resident| household.unsaid(resident));
        let all: Vec<_> = routines.chain(household.conditions().values().cloned()).chain(unsaid).collect();
        if all.is_empty() {
            let what = format!("{}: nobody lives by a routine here", scenario.file.name);
            return Err(Failure::usage(format!("{what}\n  hint: link one as a resident's driver")));
        }
        if self.json {
            return print_json(&json!({ "routines": all.iter().map(explain).collect::<Vec<_>>() }));
        }
        let texts: Vec<String> = all.iter().map(|routine| explain(routine).to_text()).collect();
        print_text(&texts.join("\n"))
    }
}
