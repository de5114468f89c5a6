//! `homebody check`: all problems of a scenario at once, and the sentences without room in its days.

use super::scenario::ScenarioArguments;
use crate::failure::Failure;
use crate::print::{print_json, tell, tell_message};
use crate::progress::Working;
use homebody_core::problem::{Problem, Problems, Severity, counted};
use homebody_core::time::Span;
use homebody_simulation::{Cancel, OpenScenario, SAMPLE_TIME, SampledRun, ScenarioSource, SimulationError};
use serde_json::json;

/// Report all problems of a scenario
///
/// Each problem has its file, its line and a hint. Warnings name likely mistakes, such as a fault that begins after the end of the
/// run. They also name reasons why a run cannot start or writes an empty log, such as a home without sensors.
///
/// Homebody simulates the first days for two seconds at most, and warns of sentences that do not happen as they say. The largest
/// loss comes first. `homebody routine check --lived` simulates the whole run.
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
        let CheckedScenario { opened, verdict } =
            CheckedScenario::load(self.scenario.source(), self.json, OpenScenario::remarks)?;
        let scenario = opened.scenario();
        let home = &scenario.home;
        tell(format_args!(
            "{}: {verdict}. {}, {}, {}, {}; {}.",
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

/// A scenario without problems, whose warnings were printed.
pub struct CheckedScenario {
    pub opened: OpenScenario,
    /// The result in words, such as "no problems".
    pub verdict: String,
}

impl CheckedScenario {
    /// Loads a scenario with its routines, simulates a sample, and prints warnings. As JSON, it prints empty lists, too.
    pub fn load(
        source: Result<ScenarioSource, SimulationError>,
        json: bool,
        remarks: impl Fn(&OpenScenario, Span) -> Vec<Problem>,
    ) -> Result<CheckedScenario, Failure> {
        let checked = source.and_then(ScenarioSource::open).and_then(|opened| {
            let scenario = opened.scenario();
            let length = scenario.calendar.span_of_days(scenario.file.days);
            let sampled = sample(&opened)?;
            let warnings = sampled.iter().flat_map(SampledRun::warnings).collect::<Vec<_>>();
            let is_as_said = warnings.is_empty() && opened.sentence_remarks(length).is_empty();
            let verdict = match (&sampled, is_as_said && opened.missing_parts().is_empty()) {
                (_, false) => "the files are valid; see the warnings above".to_owned(),
                (Some(SampledRun { days, of_days, .. }), true) if days < of_days => {
                    format!("no problems in the first {:.0} of {:.0} days", days.floor(), of_days)
                }
                (_, true) => "no problems".to_owned(),
            };
            Ok((remarks(&opened, length).into_iter().chain(warnings).collect::<Vec<_>>(), opened, verdict))
        });
        let (warnings, problems) = match &checked {
            Ok((warnings, ..)) => (&warnings[..], Some(&Problems::default())),
            Err(SimulationError::Problems(problems)) => (&[][..], Some(problems)),
            Err(_) => (&[][..], None),
        };
        if let Some(problems) = problems.filter(|_| json) {
            print_json(&json!({ "problems": problems, "warnings": warnings }))?;
        }
        warnings.iter().for_each(tell_remark);
        let (_, opened, verdict) = checked?;
        Ok(CheckedScenario { opened, verdict })
    }
}

/// The first days of the scenario's run; `None` without a routine, because a path has no sentences.
fn sample(opened: &OpenScenario) -> Result<Option<SampledRun>, SimulationError> {
    if !opened.has_routine() {
        return Ok(None);
    }
    let _working = Working::on("simulating the first days");
    opened.run().plan()?.sample(SAMPLE_TIME, &Cancel::new())
}

pub fn tell_remark(remark: &Problem) {
    tell_message(&Problem { severity: Severity::Warning, ..remark.clone() });
}
