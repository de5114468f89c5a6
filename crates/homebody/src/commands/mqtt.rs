//! `homebody mqtt`: maintenance of a broker.

use crate::failure::Failure;
use crate::print::{print_json, print_text};
use clap::Subcommand;
use homebody_core::problem::counted;
use homebody_simulation::{BrokerCleanup, Url, tidy_up};
use serde_json::json;

/// Clean up an MQTT broker that homes sent messages to
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody run my-home --speed 1 --out mqtt://ann@broker/homebody?password-file=secret
  homebody mqtt clean mqtt://ann@broker/homebody?password-file=secret --dry-run
  homebody mqtt clean mqtt://ann@broker/homebody?password-file=secret

docs/how-to/mqtt-and-home-assistant.md describes the messages of homes, and the commands for them.")]
pub struct MqttArguments {
    #[command(subcommand)]
    what: MqttCommand,
}

#[derive(Subcommand)]
enum MqttCommand {
    Clean(CleanArguments),
}

/// Remove the retained messages of Homebody's homes below a prefix
///
/// Retained messages are the states of sensors and the discovery messages for Home Assistant. Homebody removes only the messages of
/// homes that it has marked as its own, in the topic PREFIX/HOME/run. A running home sends its messages again at its next connection.
#[derive(clap::Args)]
struct CleanArguments {
    /// Broker and prefix: mqtt://USER@HOST/PREFIX
    broker: Url,
    /// List the topics, and remove nothing
    #[arg(long)]
    dry_run: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl MqttArguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.what {
            MqttCommand::Clean(arguments) => arguments.run(),
        }
    }
}

impl CleanArguments {
    fn run(self) -> Result<(), Failure> {
        let BrokerCleanup { homes, topics, others } = tidy_up(&self.broker, self.dry_run)?;
        if self.json {
            return print_json(
                &json!({ "removed": !self.dry_run, "homes": homes, "topics": topics, "others": others }),
            );
        }
        let mut text: String = topics.iter().map(|topic| format!("  {topic}\n")).collect();
        let (topics, homes) = (counted(topics.len(), "topic", "topics"), counted(homes.len(), "home", "homes"));
        text += &match self.dry_run {
            true => format!("would remove {topics} of {homes}\n"),
            false => format!("removed {topics} of {homes}\n"),
        };
        if others > 0 {
            text += &format!(
                "kept {} below the prefix that belong to other programs\n",
                counted(others, "topic", "topics")
            );
        }
        print_text(&text)
    }
}
