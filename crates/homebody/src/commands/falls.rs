//! `homebody falls`: falls in the silhouettes of a run's cameras.

use super::result_output::JsonOutput;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::print_text;
use crate::progress;
use homebody_analysis::falls::rules::{FallRules, USUAL};
use homebody_core::time::RunTime;
use homebody_log::LogError;
use homebody_log::files::plain;
use homebody_log::limits::LARGEST_OF_SCENARIO_BYTES;
use homebody_query::{FallReport, LogRef, ReportedFall, RunSilhouettes, falls_in};
use indicatif::ProgressBar;
use serde::Serialize;
use std::fmt;
use std::path::{Path, PathBuf};

/// Detect falls in the silhouettes of a run's cameras
///
/// With two cameras in a room, Homebody computes the volume that both see as a body: the voxel person of Anderson et al. (2009). With one
/// camera, it uses the shape of the silhouette. Fuzzy rules rate how far a person is upright, in between or on the ground. A second
/// level of rules decides whether the sequence is a fall. --rules replaces the default rules by those of a JSON file.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody falls runs/cameras-1
  homebody falls runs/cameras-1 --json falls.json
  homebody falls --show-rules > rules.json
  homebody falls runs/cameras-1 --rules rules.json
  homebody silhouettes runs/cameras-1 --from 2025-06-03T03:12 --every 0.5s --png fall.png

{EXIT_CODES}."))]
pub struct FallsArguments {
    /// Folder of a run with cameras
    #[arg(required_unless_present = "show_rules")]
    log: Option<String>,
    /// JSON file with rules of falls, instead of the default rules
    #[arg(long, value_name = "FILE")]
    rules: Option<PathBuf>,
    /// Print the default rules
    #[arg(long, conflicts_with_all = ["log", "rules", "json"])]
    show_rules: bool,
    #[command(flatten)]
    output: JsonOutput,
}

impl FallsArguments {
    pub fn run(self) -> Result<(), Failure> {
        if self.show_rules {
            return print_text(USUAL);
        }
        let rules = self.rules.as_deref().map(rules).transpose()?.unwrap_or_default();
        let named = LogRef::find(&self.log.unwrap_or_default())?;
        let sources: Vec<PathBuf> = named.place.files().into_iter().chain(self.rules.clone()).collect();
        let output = self.output.check(&sources)?;
        let bar = looking_bar(&named);
        let found = falls_in(&named, &rules, |at| {
            bar.set_position(position(at));
            true
        });
        bar.finish_and_clear();
        output.write(&FallsAnswer(found?), [])
    }
}

pub fn looking_bar(named: &LogRef) -> ProgressBar {
    let span = RunSilhouettes::beside(named).and_then(|kept| Ok(kept.silhouettes.span()?));
    let end = span.ok().flatten().map_or(0, |span| position(span.end));
    progress::bar(end, progress::SHARE)
}

pub fn position(at: RunTime) -> u64 {
    at.micros().max(0) as u64
}

fn rules(path: &Path) -> Result<FallRules, Failure> {
    let text = plain::read_text(path, LARGEST_OF_SCENARIO_BYTES)
        .map_err(|error| Failure::asked(LogError::reading(path, error)))?;
    FallRules::parse(&text).map_err(|problems| Failure::in_file(path, problems))
}

#[derive(Serialize)]
#[serde(transparent)]
struct FallsAnswer(FallReport);

impl fmt::Display for FallsAnswer {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let FallReport { name, cameras, pictures, voxel_persons, falls } = &self.0;
        let cameras = if *cameras == 1 { "1 camera".into() } else { format!("{cameras} cameras") };
        writeln!(f, "{name}: {cameras}, {pictures} pictures of a person, {voxel_persons} voxel persons")?;
        if falls.is_empty() {
            return writeln!(f, "no falls");
        }
        for ReportedFall { at, seconds_to_alarm, room, rule, confidence, words, .. } in falls {
            let place = room.as_deref().map_or(String::new(), |room| format!(", {room}"));
            writeln!(f, "{at}{place}: {words} ({confidence:.2}; {rule}), alarm after {seconds_to_alarm:.1} s")?;
        }
        Ok(())
    }
}
