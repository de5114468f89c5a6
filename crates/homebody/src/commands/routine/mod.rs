//! `homebody routine`: what is wrong with a routine, how it was understood, and a day that is lived by it.

mod check;
mod day;
mod explain;

use crate::failure::Failure;
use clap::Subcommand;

/// Checks, explains and tries routines: lives in plain language.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody routine check scenarios/tigerplace
  homebody routine explain scenarios/tigerplace-depression
  homebody routine day scenarios/tigerplace 2009-03-03 --png day.png

The language is described in docs/reference/routine-language.md.")]
pub struct Arguments {
    #[command(subcommand)]
    question: Question,
}

#[derive(Subcommand)]
enum Question {
    /// Report everything that is wrong with the routines of a scenario, each at its word
    Check(check::Arguments),
    /// Say how each sentence was understood: how likely, when, for how long
    Explain(explain::Arguments),
    /// Live a day and say what was done, with a chart
    Day(day::Arguments),
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.question {
            Question::Check(arguments) => arguments.run(),
            Question::Explain(arguments) => arguments.run(),
            Question::Day(arguments) => arguments.run(),
        }
    }
}
