//! `homebody replay`: live a recording again.

use super::lived::{Output, live};
use crate::failure::Failure;
use crate::pace::Asked;
use crate::signals::Signals;
use homebody_kit::{Error, Recorded};
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
        let signals = Signals::listen()?;
        let recorded = Recorded::open(&self.recording).map_err(|error| match error {
            Error::NoRecording { .. } => Failure::Io(format!("{error}{MADE}")),
            Error::Recording { .. } => Failure::usage(format!("{error}{MADE}")),
            Error::Unfinished { folder: Some(ref folder), .. } => {
                let go_on = format!("homebody run --resume {} goes on with it first", folder.display());
                Failure::usage(format!("{error}\n  hint: {go_on}"))
            }
            Error::Unfinished { .. } => Failure::usage(format!("{error}{MADE} of a run that comes to its end")),
            error => error.into(),
        })?;
        let recorded = recorded.paced(self.pace.pace(), self.pace.commands()?, signals.cancel());
        live(recorded.start(), None, &self.output, &signals)
    }
}

/// What to do where there is no recording.
const MADE: &str = "\n  hint: homebody run makes one";
