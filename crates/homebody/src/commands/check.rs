//! `homebody check`: all problems of a scenario at once.

use super::scenario::ScenarioArguments;
use crate::failure::Failure;
use crate::print::{print_json, tell, tell_message};
use homebody_core::problem::{Problem, Problems, Severity, counted};
use homebody_simulation::{OpenScenario, ScenarioSource, SimulationError};
use serde_json::json;

/// Report all problems of a scenario
///
/// Each problem has its file, its line and a hint. Warnings name likely mistakes, such as a fault that begins after the end of the
/// run. They also name reasons why a run cannot start or writes an empty log, such as a home without sensors.
///
/// Homebody checks the meaning of a file once its keys and values are valid. Until then the report omits other problems of the
/// file; if the file is home.json, it also omits problems of the routines.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:\n  homebody check scenarios/tigerplace\n  homebody check my-home --json")]
pub struct CheckArguments {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Print the problems as one JSON object
    #[arg(long)]
    json: bool,
}

impl CheckArguments {
    pub fn run(self) -> Result<(), Failure> {
        let remarks = |opened: &OpenScenario| {
            let scenario = opened.scenario();
            opened.remarks(scenario.calendar.span_of_days(scenario.file.days))
        };
        let opened = load_with_warnings(self.scenario.source(), self.json, remarks)?;
        let scenario = opened.scenario();
        let home = &scenario.home;
        let found = match opened.missing_parts().is_empty() {
            true => "no problems",
            false => "the files are valid; the warnings above name what a simulation lacks",
        };
        tell(format_args!(
            "{}: {found}. {}, {}, {}, {}; {}.",
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

/// Loads a scenario with its routines, and prints warnings. As JSON, it prints empty lists, too.
pub fn load_with_warnings(
    source: Result<ScenarioSource, SimulationError>,
    json: bool,
    remarks: impl Fn(&OpenScenario) -> Vec<Problem>,
) -> Result<OpenScenario, Failure> {
    let opened = source.and_then(ScenarioSource::open);
    let remarks = opened.as_ref().map_or_else(|_| Vec::new(), &remarks);
    let none = Problems::default();
    let problems = match &opened {
        Ok(_) => Some(&none),
        Err(SimulationError::Problems(problems)) => Some(problems),
        Err(_) => None,
    };
    if let Some(problems) = problems.filter(|_| json) {
        print_json(&json!({ "problems": problems, "warnings": remarks }))?;
    }
    remarks.iter().for_each(tell_remark);
    Ok(opened?)
}

pub fn tell_remark(remark: &Problem) {
    tell_message(&Problem { severity: Severity::Warning, ..remark.clone() });
}
