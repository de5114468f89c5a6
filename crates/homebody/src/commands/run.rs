//! `homebody run`: live a scenario.

use super::cohort::Cohort;
use super::live::{Live, Output};
use crate::failure::Failure;
use crate::folder;
use crate::length::{Length, length};
use crate::pace::Asked;
use crate::remarks;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use std::path::PathBuf;

/// Lives a scenario and stores what its sensors say.
///
/// Without --out, everything goes into a new folder under runs/: the log as the scenario's logger.json
/// says, the ground truth apart from it, and the recording that replays the run.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody run scenarios/tigerplace
  homebody run scenarios/tigerplace --for 2h --speed 60
  homebody run scenarios/tigerplace-depression --without depression
  homebody run scenarios/tigerplace --residents 100 --for 28d
  homebody run my-home --out sqlite:log.db --out csv:log.csv --truth truth.db --force
  printf 'step 60\\nstop\\n' | homebody run my-home --control --paused")]
pub struct Arguments {
    /// The scenario's folder, or its scenario.json
    scenario: PathBuf,
    /// How long to live: 90s, 15m, 2h, 7d or 52w; the scenario's days without it
    ///
    /// Days and weeks are those of the calendar: a run of 7d ends at the hour at which it began, also where clocks change.
    #[arg(long = "for", value_name = "SPAN", value_parser = length)]
    length: Option<Length>,
    /// The number all randomness comes from, instead of the scenario's
    #[arg(long)]
    seed: Option<u64>,
    /// Leave out a condition that a routine shows; may be given several times
    ///
    /// All that the condition does not touch draws the same random numbers with it and without.
    #[arg(long, value_name = "CONDITION")]
    without: Vec<String>,
    /// Live so many lives side by side, on all processors: each differs from the routines as people differ, and goes into
    /// a folder of its own
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=100_000),
          conflicts_with_all = ["out", "truth", "record", "force", "control", "speed", "paused"])]
    residents: Option<u32>,
    #[command(flatten)]
    output: Output,
    /// Record what is needed to replay the run into this file
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    #[command(flatten)]
    pace: Asked,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let (scenario, entry, household) = folder::load_lives(&self.scenario, &self.without)?;
        let seed = self.seed.unwrap_or(scenario.file.seed);
        let length = self.length.unwrap_or(Length::Days(scenario.file.days)).from_start(&scenario.calendar);
        if !self.output.quiet {
            remarks::of(&scenario, length).iter().for_each(remarks::tell_remark);
        }
        let recording = Recording {
            version: env!("CARGO_PKG_VERSION").into(),
            entry,
            files: scenario.sources.clone(),
            seed,
            length_us: length,
            without: self.without,
            one_of_many: false,
            firings: 0,
            sha256: String::new(),
        };
        let sources = folder::files(&self.scenario, &scenario);
        if let Some(residents) = self.residents {
            let cohort = Cohort { scenario: &scenario, household: &household, recording, sources, output: self.output };
            return cohort.live(residents);
        }
        let run = Run::new(&scenario, &household, seed, length);
        let live = Live { scenario: &scenario, recording, record: self.record, output: self.output, sources };
        live.live(run, &self.pace)
    }
}
