//! `homebody replay`: repeat a recorded run.

use super::run_output::{Output, store};
use crate::failure::Failure;
use crate::pace::PaceArguments;
use crate::signals::Signals;
use homebody_simulation::RecordedRun;
use std::path::PathBuf;

/// Repeat a recorded run, and verify each event
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody replay runs/tigerplace-1/recording.json
  homebody replay recording.json --speed 10 --out csv:again.csv")]
pub struct ReplayArguments {
    /// Recording of a run (recording.json)
    recording: PathBuf,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    pace: PaceArguments,
}

impl ReplayArguments {
    pub fn run(self) -> Result<(), Failure> {
        let signals = Signals::listen()?;
        let recorded = RecordedRun::open(&self.recording)?;
        let recorded = recorded.paced(self.pace.pace(), self.pace.commands()?, signals.cancel());
        store(recorded.start(), None, &self.output, &signals, None)
    }
}
