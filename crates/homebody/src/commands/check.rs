//! `homebody check`: everything that is wrong with a scenario, at once.

use crate::failure::Failure;
use crate::folder;
use crate::print::{print_json, tell};
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
        let loaded = folder::load_lives(&self.scenario, &[]);
        if self.json {
            match &loaded {
                Ok(_) => print_json(&json!({ "problems": [] }))?,
                Err(Failure::Problems(problems)) => print_json(&json!({ "problems": problems }))?,
                Err(_) => {}
            }
        }
        let (scenario, ..) = loaded?;
        let home = &scenario.home;
        tell(format_args!(
            "{}: nothing is wrong. {}, {}, {}, {}; {}.",
            scenario.file.name,
            counted(home.rooms.len(), "room", "rooms"),
            counted(home.doors.len(), "door", "doors"),
            counted(home.furniture.len(), "piece of furniture", "pieces of furniture"),
            counted(home.sensors.len(), "sensor", "sensors"),
            counted(scenario.residents.len(), "resident", "residents"),
        ));
        Ok(())
    }
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
