//! `homebody check`: everything that is wrong with a scenario, at once.

use super::scenario::Chosen;
use crate::failure::Failure;
use crate::length::Length;
use crate::print::{print_json, tell};
use homebody_core::problem::{Problem, Problems, counted};
use homebody_kit::{Error, OpenScenario, Source};
use serde_json::json;

/// Reports everything that is wrong with a scenario, with file, line and a hint; and warns of what is hardly meant, such as a
/// fault that comes when the run is over, and of what keeps a life or a log from coming of it, such as a home without sensors.
///
/// What a file means is looked at once its keys and values are such as may be there: until then the rest of its problems, and
/// those of routines where the file is the home's, are not known.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  homebody check scenarios/tigerplace\n  homebody check my-home --json")]
pub struct Arguments {
    #[command(flatten)]
    scenario: Chosen,
    /// Print the problems as one JSON object
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let remarks = |opened: &OpenScenario| {
            let scenario = opened.scenario();
            opened.remarks(Length::Days(scenario.file.days).by(&scenario.calendar))
        };
        let opened = load_and_say(self.scenario.source(), self.json, remarks)?;
        let scenario = opened.scenario();
        let home = &scenario.home;
        let found = match opened.lifeless().is_empty() {
            true => "nothing is wrong",
            false => "its files are right, and a life or a log lacks what is said above",
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

/// Loads a scenario with its routines, and warns of what there is to remark; as JSON, problems and warnings are said
/// whether or not there are any.
pub fn load_and_say(
    source: Result<Source, Error>,
    json: bool,
    remarks: impl Fn(&OpenScenario) -> Vec<Problem>,
) -> Result<OpenScenario, Failure> {
    let opened = source.and_then(Source::open);
    let remarks = opened.as_ref().map_or_else(|_| Vec::new(), &remarks);
    let none = Problems::default();
    let problems = match &opened {
        Ok(_) => Some(&none),
        Err(Error::Problems(problems)) => Some(problems),
        Err(_) => None,
    };
    if let Some(problems) = problems.filter(|_| json) {
        print_json(&json!({ "problems": problems, "warnings": remarks }))?;
    }
    remarks.iter().for_each(tell_remark);
    Ok(opened?)
}

/// Tells people what is hardly meant.
pub fn tell_remark(remark: &Problem) {
    tell(format_args!("warning: {remark}"));
}
