//! `homebody routine check`: the problems of routines.

use super::messages::RoutinesMessage;
use crate::commands::check::CheckedScenario;
use crate::commands::scenario::ScenarioArguments;
use crate::failure::Failure;
use crate::print::{json_text, print_json, print_text, tell, write_file};
use homebody_core::problem::counted;
use homebody_simulation::{Difference, OpenScenario, Simulation};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Report all problems of the routines of a scenario
///
/// For each problem of a routine or a condition, the report gives the offending word, the expected input and the nearest known
/// name. Homebody simulates the first days for two seconds at most, and warns of sentences that do not happen as they say.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody routine check scenarios/tigerplace
  homebody routine check my-home/scenario.json --json
  homebody routine check scenarios/tigerplace --lived --days 60 --json lived.json

With --lived, JSON has \"sentences\" that the simulation did not follow, each with resident, file, line,
text, the expected and the simulated value, and whether Homebody warned before the run.")]
pub struct RoutineCheckArguments {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Print the problems as JSON; with --lived, print the sentences as JSON or write them to FILE
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    json: Option<PathBuf>,
    /// Simulate the scenario, and list the sentences that it did not follow
    #[arg(long)]
    lived: bool,
    /// Days to simulate with --lived (default: all days of the scenario)
    #[arg(long, value_name = "N", requires = "lived", value_parser = clap::value_parser!(u32).range(1..=36_525))]
    days: Option<u32>,
    /// Seed of all random numbers with --lived (default: that of the scenario)
    #[arg(long, value_name = "N", requires = "lived")]
    seed: Option<u64>,
    /// Replace an existing file
    #[arg(short, long, requires = "json")]
    force: bool,
}

impl RoutineCheckArguments {
    pub fn run(self) -> Result<(), Failure> {
        let to_output = self.json.as_deref() == Some(Path::new("-"));
        if !to_output && self.json.is_some() && !self.lived {
            return Err(Failure::asked(RoutinesMessage::NeedsLived));
        }
        if self.lived {
            return self.simulate(&self.scenario.source()?.open()?);
        }
        let CheckedScenario { opened, verdict } =
            CheckedScenario::load(self.scenario.source(), to_output, OpenScenario::sentence_remarks)?;
        let (scenario, household) = (opened.scenario(), opened.household());
        let mut routines = 0;
        for (index, resident) in scenario.residents.iter().enumerate() {
            let Some(routine) = household.routine(index) else { continue };
            routines += 1;
            tell(format_args!(
                "{}: {verdict}. {} has {}, {} and {}.",
                routine.file,
                resident.file.name,
                counted(routine.habits.len(), "habit", "habits"),
                counted(routine.rules.len(), "rule", "rules"),
                counted(routine.changes.len(), "later change", "later changes"),
            ));
        }
        if routines == 0 {
            tell(format_args!("{}: no resident has a routine.", scenario.file.name));
        }
        Ok(())
    }

    /// Simulates the scenario, and reports the sentences that it did not follow.
    fn simulate(&self, opened: &OpenScenario) -> Result<(), Failure> {
        let scenario = opened.scenario();
        let days = self.days.map_or(scenario.file.days, f64::from);
        let run = opened.run().seed(self.seed.unwrap_or(scenario.file.seed));
        let mut run: Simulation = run.days(days).start()?;
        while run.next_batch()?.is_some() {}
        let sentences = run.differences();
        match self.json.as_deref() {
            Some(path) if path == Path::new("-") => print_json(&json!({ "sentences": sentences })),
            Some(path) => write_file(path, json_text(&json!({ "sentences": sentences }))?.as_bytes(), self.force),
            None => print_text(&in_words(&sentences)),
        }
    }
}

/// The sentences that the simulation did not follow, two lines each, the largest loss first.
pub fn in_words(sentences: &[Difference]) -> String {
    if sentences.is_empty() {
        return "The simulation followed every sentence.\n".to_owned();
    }
    let line = |of: &Difference| {
        let said = of.text.split_whitespace().collect::<Vec<_>>().join(" ");
        format!("{}:{}: {said}\n  expected: {}; simulated: {}\n", of.file, of.line, of.expected, of.lived)
    };
    sentences.iter().map(line).collect()
}
