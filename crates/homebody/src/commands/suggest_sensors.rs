//! `homebody suggest-sensors`: positions for sensors.

use super::devices::device;
use super::install_sheet::build;
use super::result_output::ResultOutput;
use super::scenario::ScenarioArguments;
use crate::failure::Failure;
use crate::progress::bar;
use homebody_analysis::coverage::STEP_M;
use homebody_analysis::measures::MEASURES;
use homebody_core::home::form::HomeFile;
use homebody_picture::floor_plan;
use homebody_placement::people::{CONDITIONS, LoadedScenario};
use homebody_placement::proposal::{self, Proposal, Request, Step};
use homebody_placement::search::{Goal, Layout, Reached, SearchStep};
use indicatif::ProgressBar;
use serde::Serialize;
use std::fmt;
use std::sync::Mutex;

homebody_core::messages! {
    /// Problems with the goals of sensors.
    pub enum GoalsMessage in "goals" {
        /// A goal is a condition to find, a measure to take, bathroom visits at night, or falls:
        ///
        /// ```sh
        /// homebody suggest-sensors my-home --goals depression,meals,falls
        /// ```
        Unknown { names: Vec<String>, conditions: Vec<String>, measures: Vec<String> } error "unknown" (
            "--goals: Homebody does not know {names}",
            names = names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
        )
            hint (
                "choose from the conditions ({conditions}), the measures ({measures}), night-bathroom and falls",
                conditions = conditions.join(", "),
                measures = measures.join(", ")
            );
    }
}

/// Suggest where to mount sensors, and what each sensor adds
///
/// Homebody simulates people in the home with the routine of its first resident and with variations between people. Some of them have
/// a condition of --goals from day 61 on. Candidates are a motion sensor in each room, one above each seat, the shower and the
/// toilet, a sensor in each bed and a contact on each outer door.
///
/// Homebody picks the sensor whose log scores best on the goals, then the one that adds most, and so on. If no single sensor adds
/// anything, it tries pairs. At the end, Homebody replaces a sensor if a different candidate scores better. The report also scores the
/// sensors that the home has. scenarios/tigerplace takes about a minute.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody suggest-sensors scenarios/tigerplace --count 6
  homebody suggest-sensors scenarios/tigerplace --goals depression,night-bathroom,falls --count 8 --png proposed.png
  homebody suggest-sensors my-home --goals urinary-tract-infection,meals --count 4 --json
  homebody suggest-sensors my-home --goals falls --count 5 --device fibaro

Goals: a condition that comes with the program; a measure of homebody measures, such as meals or
time-out; night-bathroom; falls, by the share of the floor that sensors see. The JSON has \"sensors\",
in the form that home.json uses, and \"steps\".")]
pub struct SuggestSensorsArguments {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Purpose of the sensors: conditions, measures, night-bathroom, falls; separated by commas
    #[arg(long, value_name = "GOALS", value_delimiter = ',', default_value = "depression,night-bathroom,falls")]
    goals: Vec<String>,
    /// Largest number of sensors to suggest
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u16).range(1..=64))]
    count: u16,
    /// Number of simulated people
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(4..=1000))]
    people: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Device of the motion sensors, by its name in homebody devices, such as fibaro
    #[arg(long, value_name = "NAME")]
    device: Option<String>,
    #[command(flatten)]
    output: ResultOutput,
}

impl SuggestSensorsArguments {
    pub fn run(self) -> Result<(), Failure> {
        let source = self.scenario.source()?;
        let scenario = source.open()?;
        let output = self.output.check([""], &scenario.paths())?;
        let goals = goals(&self.goals)?;
        let device = self.device.as_deref().map(device).transpose()?;
        let home = &scenario.scenario().home;
        let (people, sensors, seed) = (self.people, usize::from(self.count), self.seed);
        let build = build(scenario.scenario());
        let request = Request { goals: &goals, sensors, people, seed, device, build, step_m: STEP_M };
        let load =
            || Ok(LoadedScenario { scenario: scenario.scenario().clone(), household: scenario.household().clone() });
        let progress = SearchProgress::new(&request);
        let found = proposal::propose(home, &request, load, &|step| progress.show(step));
        progress.bar.lock().expect("nothing panics while it is held").finish_and_clear();
        let found = SuggestionAnswer { proposal: found?, asked: sensors };
        let drawn = HomeFile { sensors: found.proposal.sensors.clone(), ..HomeFile::clone(home) };
        output.write(&found, [&|| floor_plan(&drawn)])
    }
}

/// The progress bar: the simulated people first, then the sensors.
struct SearchProgress {
    bar: Mutex<ProgressBar>,
    sensors: u64,
}

impl SearchProgress {
    fn new(request: &Request) -> SearchProgress {
        let bar = match request.needs_people() {
            true => bar(u64::from(request.people), "{bar:40} {pos} of {len} people  {eta} left"),
            false => bar(request.sensors as u64, PLACING),
        };
        SearchProgress { bar: Mutex::new(bar), sensors: request.sensors as u64 }
    }

    /// Shows a step. The work always continues.
    fn show(&self, step: Step) -> bool {
        let mut shown = self.bar.lock().expect("nothing panics while it is held");
        match step {
            Step::Simulated => shown.inc(1),
            Step::Searching(search, sensors) => {
                if sensors == 0 && search == SearchStep::OneMore {
                    shown.finish_and_clear();
                    *shown = bar(self.sensors, PLACING);
                }
                shown.set_position(sensors as u64);
                shown.set_message(match search {
                    SearchStep::OneMore => "adding one",
                    SearchStep::TwoMore => "adding two",
                    SearchStep::Another => "exchanging",
                });
            }
        }
        true
    }
}

const PLACING: &str = "{bar:40} {pos} of {len} sensors  {msg}";

fn goals(names: &[String]) -> Result<Vec<Goal>, Failure> {
    proposal::goals(names).map_err(|names| {
        let conditions = CONDITIONS.iter().map(|(name, _)| (*name).to_owned()).collect();
        let measures = MEASURES.iter().map(|measure| measure.name.to_owned()).collect();
        Failure::asked(GoalsMessage::Unknown { names, conditions, measures })
    })
}

#[derive(Serialize)]
#[serde(transparent)]
struct SuggestionAnswer {
    proposal: Proposal,
    #[serde(skip)]
    asked: usize,
}

impl fmt::Display for SuggestionAnswer {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Some(first) = self.proposal.found.steps.first() else {
            let text = match self.asked {
                1 => "No single sensor helps with the goals. Try a larger --count.",
                _ => "No sensor helps with the goals.",
            };
            return writeln!(f, "{text}");
        };
        writeln!(f, "Suggested sensors, the most useful first\n")?;
        write!(f, "{:>2}  {:32} {:>6}", "", "sensor", "score")?;
        for Reached { goal, .. } in &first.goals {
            write!(f, " {goal:>24}")?;
        }
        writeln!(f)?;
        write!(f, "{:>2}  {:32} {:>6}", "", "", "0 to 1")?;
        for Reached { unit, goal, .. } in &first.goals {
            let is_error = MEASURES.iter().any(|measure| measure.name == *goal);
            let what = if is_error { format!("error, {unit} a day") } else { (*unit).to_owned() };
            write!(f, " {what:>24}")?;
        }
        writeln!(f)?;
        let row = |f: &mut fmt::Formatter, number: &str, name: &str, layout: &Layout| {
            write!(f, "{number:>2}  {name:32} {:>6.2}", layout.score)?;
            for Reached { value, .. } in &layout.goals {
                write!(f, " {value:>24.2}")?;
            }
            writeln!(f)
        };
        for (number, layout) in self.proposal.found.steps.iter().enumerate() {
            let name = layout.sensors.last().map_or("", String::as_str);
            row(f, &(number + 1).to_string(), name, layout)?;
        }
        for swap in &self.proposal.found.swapped {
            row(f, "", &format!("{} for {}", swap.come, swap.gone), &swap.layout)?;
        }
        if let Some(own) = &self.proposal.own {
            row(f, "", &format!("the home's own {}", own.sensors.len()), own)?;
        }
        let count = self.proposal.found.steps.len();
        if count < self.asked {
            writeln!(f, "\n{count} of {} sensors: another one adds nothing.", self.asked)?;
        }
        match self.proposal.own.as_ref().zip(self.proposal.found.last()) {
            Some((own, proposed)) if own.score < proposed.score => write_why_less(f, own, proposed),
            _ => Ok(()),
        }
    }
}

/// Explains on which goals the home's own sensors score less than the suggested ones.
fn write_why_less(f: &mut fmt::Formatter, own: &Layout, proposed: &Layout) -> fmt::Result {
    let (all, few) = (own.sensors.len(), proposed.sensors.len());
    writeln!(f, "\nThe home's own {all} sensors score less than the {few} suggested ones:")?;
    let goals = own.goals.iter().zip(&proposed.goals);
    for (own, proposed) in goals.filter(|(own, proposed)| own.score < proposed.score) {
        writeln!(f, "  {}: {:.2} instead of {:.2} {}", own.goal, own.value, proposed.value, own.unit)?;
    }
    writeln!(
        f,
        "The suggested sensors were chosen for these goals. More sensors allow more measures, and alerts watch each measure.\n\
         To keep false alarms as rare, alerts then wait for larger changes, and find people later."
    )
}
