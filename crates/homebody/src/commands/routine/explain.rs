//! `homebody routine explain`: the interpretation of routines.

use super::messages::RoutinesMessage;
use crate::commands::scenario::ScenarioArguments;
use crate::failure::Failure;
use crate::print::{print_json, print_text};
use homebody_routine::explain::explain;
use serde_json::json;

/// Explain how Homebody reads each sentence of the routines
///
/// For each sentence of a routine or a condition, a table has probability, time and duration, and a sentence says the same in words.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody routine explain scenarios/tigerplace
  homebody routine explain scenarios/tigerplace --unsaid
  homebody routine explain my-home --json")]
pub struct RoutineExplainArguments {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Also list the defaults that apply where the routine says nothing
    #[arg(long)]
    unsaid: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl RoutineExplainArguments {
    pub fn run(self) -> Result<(), Failure> {
        let opened = self.scenario.source()?.open()?;
        let (scenario, household) = (opened.scenario(), opened.household());
        let of_residents = (0..scenario.residents.len()).filter_map(|resident| household.routine(resident));
        let days = scenario.file.days as i32;
        let routines = of_residents.map(|routine| explain(routine).dated(&scenario.calendar, days));
        // A condition begins with the sentence that shows it, so its own dates are not those of the run.
        let conditions = household.conditions().values().map(explain);
        let unsaid =
            (0..scenario.residents.len()).filter(|_| self.unsaid).filter_map(|resident| household.unsaid(resident));
        let all: Vec<_> = routines.chain(conditions).chain(unsaid.map(|routine| explain(&routine))).collect();
        if all.is_empty() {
            return Err(Failure::asked(RoutinesMessage::NoRoutine { scenario: scenario.file.name.clone() }));
        }
        if self.json {
            return print_json(&json!({ "routines": all }));
        }
        let texts: Vec<String> = all.iter().map(|explanation| explanation.to_text()).collect();
        print_text(&texts.join("\n"))
    }
}
