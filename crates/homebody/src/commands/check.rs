//! `homebody check`: everything that is wrong with a scenario, at once.

use super::print_json;
use crate::failure::Failure;
use crate::folder;
use serde_json::json;
use std::path::PathBuf;

/// Reports everything that is wrong with a scenario, with file, line and a hint.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  homebody check scenarios/tigerplace\n  homebody check my-home --json")]
pub struct Arguments {
    /// The scenario's folder, or its scenario.json
    scenario: PathBuf,
    /// Print the problems as one JSON object
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let loaded = folder::load(&self.scenario);
        if self.json {
            match &loaded {
                Ok(_) => print_json(&json!({ "problems": [] }))?,
                Err(Failure::Problems(problems)) => print_json(&json!({ "problems": problems }))?,
                Err(_) => {}
            }
        }
        let (scenario, _) = loaded?;
        let home = &scenario.home;
        eprintln!(
            "{}: nothing is wrong. {} rooms, {} doors, {} pieces of furniture, {} sensors; {} residents.",
            scenario.file.name,
            home.rooms.len(),
            home.doors.len(),
            home.furniture.len(),
            home.sensors.len(),
            scenario.residents.len(),
        );
        Ok(())
    }
}
