//! `homebody replay`: live a recording again.

use super::live::{Live, Output};
use crate::failure::Failure;
use crate::pace::Asked;
use homebody_core::recording::{LONGEST, Recording};
use homebody_routine::household::Household;
use std::fmt::Display;
use std::fs;
use std::io::ErrorKind;
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
    #[command(flatten)]
    pace: Asked,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let recording = self.recording()?;
        let (scenario, household) = Household::recorded(&recording)?;
        let run = recording.run(&scenario, &household);
        let sources = vec![self.recording];
        let live = Live { scenario: &scenario, recording, record: None, output: self.output, sources };
        live.live(run, &self.pace)
    }

    fn recording(&self) -> Result<Recording, Failure> {
        let path = &self.recording;
        let text = fs::read_to_string(path).map_err(|error| match error.kind() {
            ErrorKind::NotFound => Failure::io(path, "there is no such recording\n  hint: homebody run makes one"),
            ErrorKind::IsADirectory => Failure::io(path, "it is a folder\n  hint: name the recording.json in it"),
            _ => Failure::io(path, error),
        })?;
        let wrong = |why: &dyn Display| {
            Failure::usage(format!("{} is no recording: {why}\n  hint: homebody run makes one", path.display()))
        };
        let recording: Recording = serde_json::from_str(&text).map_err(|error| wrong(&error))?;
        if !(0..=LONGEST).contains(&recording.length_us) {
            return Err(wrong(&"a run is at most 100 years long"));
        }
        if recording.sha256.is_empty() {
            return Err(wrong(&"the SHA-256 of its firings is missing"));
        }
        Ok(recording)
    }
}
