//! `homebody routine`: the problems of a routine, its interpretation, and a day of it.

mod check;
mod day;
mod explain;
pub mod messages;

use crate::failure::Failure;
use clap::Subcommand;

/// Check, explain and try routines, which describe days in plain language
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody routine check scenarios/tigerplace
  homebody routine explain scenarios/tigerplace-depression
  homebody routine day scenarios/tigerplace 2009-03-03 --png day.png

docs/reference/routine-language.md describes the language.")]
pub struct RoutineArguments {
    #[command(subcommand)]
    question: Question,
}

#[derive(Subcommand)]
enum Question {
    Check(check::RoutineCheckArguments),
    Explain(explain::RoutineExplainArguments),
    Day(day::RoutineDayArguments),
}

impl RoutineArguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.question {
            Question::Check(arguments) => arguments.run(),
            Question::Explain(arguments) => arguments.run(),
            Question::Day(arguments) => arguments.run(),
        }
    }
}
