//! `homebody mqtt`: what there is to do with a broker besides telling it what happens.

use crate::failure::Failure;
use crate::print::{print_json, print_text};
use clap::Subcommand;
use homebody_core::problem::counted;
use homebody_kit::{Tidied, Url, tidy_up};
use serde_json::json;

/// Tidies a broker up that homes were told to.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody run my-home --speed 1 --out mqtt://ann@broker/homebody?password-file=secret
  homebody mqtt clean mqtt://ann@broker/homebody?password-file=secret --look
  homebody mqtt clean mqtt://ann@broker/homebody?password-file=secret

What homes say to a broker, and what they can be told, is described in docs/how-to/mqtt-and-home-assistant.md.")]
pub struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Remove what a broker keeps of our homes below a prefix, and what Home Assistant was told of them
    Clean(Clean),
}

/// Removes what a broker keeps of our homes below a prefix: states, and what Home Assistant was told of them.
///
/// Only homes that have our mark are touched. One that is being lived says all of it again when it next connects.
#[derive(clap::Args)]
struct Clean {
    /// The broker and the prefix: mqtt://USER@HOST/PREFIX
    broker: Url,
    /// Say what would be removed, and remove nothing
    #[arg(long)]
    look: bool,
    /// Print what was found as one JSON object on standard output
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.what {
            What::Clean(arguments) => arguments.run(),
        }
    }
}

impl Clean {
    fn run(self) -> Result<(), Failure> {
        let Tidied { homes, topics, others } = tidy_up(&self.broker, self.look)?;
        if self.json {
            return print_json(&json!({ "removed": !self.look, "homes": homes, "topics": topics, "others": others }));
        }
        let mut text: String = topics.iter().map(|topic| format!("  {topic}\n")).collect();
        let (topics, homes) = (counted(topics.len(), "topic", "topics"), counted(homes.len(), "home", "homes"));
        text += &match self.look {
            true => format!("{topics} of {homes} would be removed\n"),
            false => format!("{topics} of {homes} removed\n"),
        };
        if others > 0 {
            text += &format!(
                "{} below the prefix are of nobody that is known, and stay\n",
                counted(others, "topic", "topics")
            );
        }
        print_text(&text)
    }
}
