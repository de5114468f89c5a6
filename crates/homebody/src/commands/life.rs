//! `homebody life`: routines from free text.

mod acceptance;
mod from;

pub mod messages;

use crate::failure::Failure;
use clap::Subcommand;

/// Make routines from free text, by a language model or any assistant
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody life from care-plan.txt --home my-home
  homebody life from care-plan.txt --home my-home --prompt > prompt.txt
  homebody life from care-plan.txt --home my-home --answer answer.txt

homebody life from --help explains models, keys and files.")]
pub struct LifeArguments {
    #[command(subcommand)]
    command: LifeCommand,
}

#[derive(Subcommand)]
enum LifeCommand {
    From(Box<from::LifeFromArguments>),
}

impl LifeArguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.command {
            LifeCommand::From(arguments) => arguments.run(),
        }
    }
}
