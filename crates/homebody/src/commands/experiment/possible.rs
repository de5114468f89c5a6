//! `homebody experiment possible`.

use super::messages::ExperimentMessage;
use crate::commands::scenario::Trust;
use crate::failure::Failure;
use crate::print::{print_json, print_text};
use crate::progress::bar;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::{DriverProvider, Run};
use homebody_core::time::{DAY, SECOND};
use homebody_experiment::possible::{Lives, Possible, Row};
use homebody_kit::{OpenScenario, Template};
use homebody_routine::routine::Kind;
use rayon::prelude::*;
use std::path::PathBuf;

/// Count impossible events in simulations
///
/// Impossible events are two people in one spot or walking through each other, visits to an empty home, meals eaten before they are
/// cooked, and intervals that end before they begin. Without a scenario, Homebody simulates all templates. The exit code is 1 if an
/// impossible event occurs.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody experiment possible
  homebody experiment possible my-home --days 365 --json")]
pub struct Arguments {
    /// Scenario folders (default: all templates)
    scenarios: Vec<PathBuf>,
    /// Days to simulate for each scenario
    #[arg(long, value_name = "N", default_value_t = 90, value_parser = clap::value_parser!(u32).range(1..=3660))]
    days: u32,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    trust: Trust,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let opened: Vec<OpenScenario> = match self.scenarios.is_empty() {
            true => Template::all().map(|template| template.source().open()).collect::<Result<_, _>>()?,
            false => {
                let open = |path: &PathBuf| self.trust.source(path)?.open();
                self.scenarios.iter().map(open).collect::<Result<_, _>>()?
            }
        };
        let progress = bar(opened.len() as u64, "{bar:40} {pos} of {len} scenarios  {eta} left");
        let rows: Result<Vec<Row>, DriverError> = opened
            .par_iter()
            .map(|opened| {
                let row = lived(opened, self.days);
                progress.inc(1);
                row
            })
            .collect();
        progress.finish_and_clear();
        let possible = Possible { days: self.days, scenarios: rows? };
        if self.json {
            print_json(&possible)?
        } else {
            print_text(&possible.to_string())?
        }
        if possible.is_clean() {
            return Ok(());
        }
        Err(Failure::file(ExperimentMessage::Impossible))
    }
}

/// What of the lives in a scenario cannot be.
fn lived(opened: &OpenScenario, days: u32) -> Result<Row, DriverError> {
    let (mut scenario, household) = (opened.scenario().clone(), opened.household());
    scenario.home = scenario.home.without_cameras();
    let residents = scenario.residents.len();
    let guests: Vec<String> = household.guests().into_iter().map(|guest| guest.name).collect();
    let host_of = |guest: &String| {
        let is_of = |host: &usize| guest.starts_with(&format!("{}'s ", scenario.residents[*host].file.name));
        (0..residents).find(is_of)
    };
    let hosts = guests.iter().enumerate().filter_map(|(guest, name)| Some((residents + guest, host_of(name)?)));
    let is_person = |body: usize| {
        let person = household.routine(body).and_then(|routine| routine.person.as_ref());
        person.is_none_or(|person| person.kind == Kind::Person)
    };
    let are_people: Vec<bool> = (0..residents + guests.len()).map(is_person).collect();
    let people = are_people.iter().filter(|&&is| is).count();
    let mut lives = Lives::new(are_people, hosts.collect());
    let mut run = Run::new(&scenario, household, scenario.file.seed, i64::from(days) * DAY);
    let mut events = Events::default();
    while run.now() < run.length() {
        run.advance(run.now() + 3600 * SECOND, &mut events)?;
        events.facts.iter().for_each(|fact| lives.take(fact));
        events.clear();
    }
    Ok(Row { scenario: scenario.file.name.clone(), people, visits: lives.visits(), impossible: lives.impossible() })
}
