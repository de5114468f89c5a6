//! `homebody alerts`: what is different from before.

use super::answer::Answer;
use super::measure::Measured;
use crate::failure::{EXIT_CODES, Failure};
use homebody_analysis::alerts::{Rules, USUAL, alerts};
use std::fs;
use std::path::{Path, PathBuf};

/// Says what is different from before in what somebody does, day by day: each measure is held against the resident's own last
/// two weeks.
///
/// Days away, days that are not whole, and what needs a sensor that is silent do not count; of such a sensor there is an alert of
/// its own. The rules are a few lines of JSON, which --rules replaces: the usual ones
/// stand in docs/measures.md.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody alerts runs/tigerplace-depression-1
  homebody alerts casas:tm000.txt --home my-home --json
  homebody alerts runs/tigerplace-1 --rules rules.json

{EXIT_CODES}."))]
pub struct Arguments {
    #[command(flatten)]
    measured: Measured,
    /// The rules, instead of the usual ones
    #[arg(long, value_name = "FILE")]
    rules: Option<PathBuf>,
    #[command(flatten)]
    answer: Answer,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let rules = match &self.rules {
            Some(path) => rules(path)?,
            None => usual()?,
        };
        let read = self.measured.read()?;
        let answer = self.answer.check([], &read.sources)?;
        let measures = self.measured.measures(&read)?;
        answer.give(&alerts(&measures, &rules), [])
    }
}

/// The rules that hold where nobody says others.
pub fn usual() -> Result<Rules, Failure> {
    Rules::read(USUAL).map_err(|problems| Failure::Io(problems.join("; ")))
}

/// The rules of a file.
pub fn rules(path: &Path) -> Result<Rules, Failure> {
    let name = path.display();
    let text = fs::read_to_string(path).map_err(|error| Failure::usage(format!("{name}: {error}")))?;
    Rules::read(&text).map_err(|problems| {
        let told: Vec<String> = problems.iter().map(|problem| format!("{name}: {problem}")).collect();
        Failure::usage(told.join("\nerror: "))
    })
}
