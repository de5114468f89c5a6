//! `homebody place`: where sensors go.

use super::alerts::rules;
use super::answer::Answer;
use super::people_with_conditions::{CONDITIONS, Lives, ONSET, People};
use super::scenario::Chosen;
use crate::failure::Failure;
use homebody_analysis::measures::MEASURES;
use homebody_core::scenario::home::{HomeFile, SensorFile};
use homebody_core::scenario::link::LinkFile;
use homebody_experiment::placing::{Goal, Layout, Placed, Reached, Somebody, Trial, Trying, candidates};
use homebody_kit::{OpenScenario, Source};
use homebody_picture::floor_plan;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Proposes where sensors go, one after the other, and says what each additional one buys.
///
/// People live in the home by the routine of its first resident, each a little differently: some with the conditions that are to be
/// seen, from day 61 on, and some without any. The home has a motion sensor in each room, one above each seat, the shower and the
/// toilet, a sensor in each bed and a contact on each door out. Of these the one is taken whose log alone tells most of what
/// is to be seen, then the one that adds most, and so on; two where one adds nothing; in the end others go for them that tell
/// more. Beside them stands what the sensors tell that the home has.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody place scenarios/tigerplace --sensors 6
  homebody place scenarios/tigerplace --to-see depression,night-bathroom,falls --sensors 8 --png proposed.png
  homebody place my-home --to-see urinary-tract-infection,meals --sensors 4 --json

What can be seen: a condition that comes with the program; a measure of homebody measure, such as meals or time-out;
night-bathroom; falls, by the share of the floor that is seen. JSON has \"sensors\", as home.json takes them, and \"steps\".")]
pub struct Arguments {
    #[command(flatten)]
    scenario: Chosen,
    /// What is to be seen, with commas between
    #[arg(long, value_name = "GOALS", value_delimiter = ',', default_value = "depression,night-bathroom,falls")]
    to_see: Vec<String>,
    /// How many sensors there may be
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u16).range(1..=64))]
    sensors: u16,
    /// How many people live in the home
    #[arg(long, default_value_t = 24, value_parser = clap::value_parser!(u32).range(4..=1000))]
    people: u32,
    /// The number all randomness comes from
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The rules of alerts, instead of the usual ones
    #[arg(long, value_name = "FILE")]
    rules: Option<PathBuf>,
    #[command(flatten)]
    answer: Answer,
}

/// So many days after conditions begin are lived: none is looked for later.
const AFTER: u32 = 29;

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let source = self.scenario.source()?;
        let scenario = source.open()?;
        let answer = self.answer.check([""], &scenario.paths())?;
        let rules = rules(self.rules.as_deref())?;
        let goals = goals(&self.to_see)?;
        let wanted = |name: &str| goals.iter().any(|goal| matches!(goal, Goal::Condition(goal) if *goal == name));
        let conditions: Vec<(&str, usize)> = CONDITIONS.into_iter().filter(|(name, _)| wanted(name)).collect();
        let home = &scenario.scenario().home;
        let own: Vec<String> = home.sensors.iter().map(|sensor| sensor.name().to_owned()).collect();
        let candidates = candidates(home);
        let names: Vec<String> = candidates.iter().map(|sensor| sensor.name().to_owned()).collect();
        let with_all = with_all(&scenario, &candidates)?;
        let people = People::of(&with_all, &conditions, self.people, (ONSET as u32 + AFTER, self.seed))?;
        let live = |lives: &Lives| {
            let life = lives.live(&LinkFile::default())?;
            let lived = life.lived();
            Ok((life, lived))
        };
        let people: Vec<Somebody> =
            people.each(live)?.into_iter().map(|(person, (life, lived))| Somebody { person, life, lived }).collect();
        let trial = Trial { home: &with_all.scenario().home, goals: &goals, people: &people, rules: &rules };
        let progress = ProgressBar::new(u64::from(self.sensors));
        let style = ProgressStyle::with_template("{bar:40} {pos} of {len} sensors  {msg}");
        progress.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let told = |trying: Trying, sensors: usize| {
            progress.set_position(sensors as u64);
            progress.set_message(match trying {
                Trying::OneMore => "one more",
                Trying::TwoMore => "two more at once",
                Trying::Another => "others instead",
            });
        };
        let placed = trial.best(&names, self.sensors.into(), &told);
        progress.finish_and_clear();
        let chosen: &[String] = placed.last().map_or(&[], |layout| &layout.sensors);
        let sensor = |name: &String| candidates.iter().find(|sensor| sensor.name() == name).cloned();
        let sensors: Vec<SensorFile> = chosen.iter().filter_map(sensor).collect();
        let drawn = HomeFile { sensors: sensors.clone(), ..HomeFile::clone(home) };
        let own = (!own.is_empty()).then(|| trial.of(&own));
        let proposed = Proposed { sensors, placed, own };
        answer.give(&proposed, [&|| floor_plan(&drawn)])
    }
}

/// What is asked for, or everything of it that is not known.
fn goals(names: &[String]) -> Result<Vec<Goal>, Failure> {
    let conditions: Vec<&'static str> = CONDITIONS.iter().map(|(name, _)| *name).collect();
    let of = |name: &String| Goal::of(name.trim(), &conditions).ok_or_else(|| format!("{:?}", name.trim()));
    let (known, unknown): (Vec<_>, Vec<_>) = names.iter().map(of).partition(Result::is_ok);
    let unknown: Vec<String> = unknown.into_iter().filter_map(Result::err).collect();
    if !unknown.is_empty() {
        let measures: Vec<&str> = MEASURES.iter().map(|measure| measure.name).collect();
        return Err(Failure::Usage(format!(
            "--to-see: there is no {}\n  hint: name conditions ({}), measures ({}), night-bathroom or falls",
            unknown.join(", no "),
            conditions.join(", "),
            measures.join(", ")
        )));
    }
    Ok(known.into_iter().filter_map(Result::ok).collect())
}

/// The scenario with all candidates besides the sensors that it has.
fn with_all(scenario: &OpenScenario, candidates: &[SensorFile]) -> Result<OpenScenario, Failure> {
    let edit = scenario.scenario().edit().home(|home| home.sensors.extend_from_slice(candidates));
    let entry = edit.entry().to_owned();
    Ok(Source::of_texts(edit.into_texts(), entry).open()?)
}

/// Where sensors go.
#[derive(Serialize)]
struct Proposed {
    /// As a home's file takes them, the most telling first.
    sensors: Vec<SensorFile>,
    #[serde(flatten)]
    placed: Placed,
    /// The sensors that the home has.
    #[serde(skip_serializing_if = "Option::is_none")]
    own: Option<Layout>,
}

impl fmt::Display for Proposed {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Some(first) = self.placed.steps.first() else { return Ok(()) };
        writeln!(f, "Where sensors go, the most telling first\n")?;
        write!(f, "{:>2}  {:32} {:>6}", "", "sensor", "score")?;
        for Reached { goal, .. } in &first.goals {
            write!(f, " {goal:>24}")?;
        }
        writeln!(f)?;
        write!(f, "{:>2}  {:32} {:>6}", "", "", "0 to 1")?;
        for Reached { unit, goal, .. } in &first.goals {
            let is_error = MEASURES.iter().any(|measure| measure.name == *goal);
            let what = if is_error { format!("{unit} wrong a day") } else { (*unit).to_owned() };
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
        for (number, layout) in self.placed.steps.iter().enumerate() {
            let name = layout.sensors.last().map_or("", String::as_str);
            row(f, &(number + 1).to_string(), name, layout)?;
        }
        for swap in &self.placed.swapped {
            row(f, "", &format!("{} for {}", swap.come, swap.gone), &swap.layout)?;
        }
        if let Some(own) = &self.own {
            row(f, "", &format!("the {} that the home has", own.sensors.len()), own)?;
        }
        Ok(())
    }
}
