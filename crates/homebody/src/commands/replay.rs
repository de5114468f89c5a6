//! `homebody replay`: live a recording again.

use super::live::{Live, Output};
use crate::failure::Failure;
use crate::pace::Speed;
use homebody_core::recording::Recording;
use std::fs;
use std::path::PathBuf;

/// Lives a recording again, and makes sure that every firing is the same.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody replay runs/tigerplace-1/recording.json
  homebody replay recording.json --speed 10 --out csv:again.csv")]
pub struct Arguments {
    /// A recording, as `homebody run` makes it
    recording: PathBuf,
    #[command(flatten)]
    output: Output,
    /// Seconds of the run in a second: 0.1 to 1000, or max
    #[arg(long, default_value = "max")]
    speed: Speed,
    /// Take commands by lines on standard input: pause, resume, step [SECONDS], speed X, stop
    #[arg(long)]
    control: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let text = fs::read_to_string(&self.recording).map_err(|error| Failure::io(&self.recording, error))?;
        let recording: Recording = serde_json::from_str(&text)
            .map_err(|error| Failure::usage(format!("{} is no recording: {error}", self.recording.display())))?;
        let scenario = recording.scenario()?;
        let run = recording.run(&scenario);
        let live = Live { scenario: &scenario, recording, record: None, output: self.output };
        live.live(run, self.speed, self.control)
    }
}
