use super::evaluation::evaluate_each;
use super::locate::is_person;
use crate::messages::ExperimentMessage;
use crate::possible::{HouseholdHome, HouseholdTruth, ImpossibleEvents, ScenarioRow};
use crate::simulated::each_step;
use crate::statements::DrawnLife;
use homebody::shared::{Failure, Trust, print_json, print_text};
use homebody_core::drivers::error::DriverError;
use homebody_core::role::Role;
use homebody_core::run::{DriverProvider, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, HOUR};
use homebody_routine::household::Household;
use homebody_simulation::{OpenScenario, Template};
use std::path::PathBuf;

/// Count impossible events in simulations
///
/// Impossible events are people who touch in passing or wait for many minutes, activities of the bathroom in other rooms, passages of a
/// shut front door, visits without a host or a visitor, meals eaten before they are cooked, and rows without length. Without a scenario,
/// Homebody simulates all templates with routines; scripts and paths decide for themselves. With --routines, it also simulates random
/// routines, those of the command `statements`. The exit code is 1 if an impossible event occurs.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab possible
  homebody-lab possible my-home --days 365 --json
  homebody-lab possible --days 365 --routines 200 --seed 7")]
pub struct PossibleLabArguments {
    /// Scenario folders (default: all templates with routines)
    scenarios: Vec<PathBuf>,
    /// Days to simulate for each scenario
    #[arg(long, value_name = "N", default_value_t = 90, value_parser = clap::value_parser!(u32).range(1..=3660))]
    days: u32,
    /// Number of random routines
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    routines: u32,
    /// Seed of the random routines
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    trust: Trust,
}

impl PossibleLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let opened: Vec<OpenScenario> = match self.scenarios.is_empty() {
            true => {
                let all = Template::all().map(|template| template.source().open()).collect::<Result<Vec<_>, _>>()?;
                all.into_iter().filter(OpenScenario::has_routine).collect()
            }
            false => {
                let open = |path: &PathBuf| self.trust.source(path)?.open();
                self.scenarios.iter().map(open).collect::<Result<_, _>>()?
            }
        };
        let scenarios = evaluate_each(&opened, "scenarios", |opened| {
            let scenario = opened.scenario();
            simulate(scenario.clone(), opened.household(), scenario.file.seed, self.days)
        })?;
        let days = self.days as i32;
        let drawn = DrawnLife::draw_lives(self.routines as usize, self.seed, &(days..=days));
        let routines = evaluate_each(&drawn, "routines", |life| {
            let Some((scenario, household, seed)) = life.scenario() else { return Ok(None) };
            let row = simulate(scenario, &household, seed, self.days)?;
            Ok::<_, DriverError>(Some(ScenarioRow { scenario: format!("routine of statement {}", life.first), ..row }))
        })?;
        let routines = routines.into_iter().flatten().collect();
        let possible = ImpossibleEvents { days: self.days, scenarios, routines };
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

fn simulate(mut scenario: Scenario, household: &Household, seed: u64, days: u32) -> Result<ScenarioRow, DriverError> {
    scenario.home = scenario.home.without_cameras();
    let residents = scenario.residents.len();
    let guests: Vec<String> = household.guests().into_iter().map(|guest| guest.name).collect();
    let host_of = |guest: &String| {
        let is_of = |host: &usize| guest.starts_with(&format!("{}'s ", scenario.residents[*host].file.name));
        (0..residents).find(is_of)
    };
    let hosts = guests.iter().enumerate().filter_map(|(guest, name)| Some((residents + guest, host_of(name)?)));
    let are_people: Vec<bool> = (0..residents + guests.len()).map(|body| is_person(household, body)).collect();
    let people = are_people.iter().filter(|&&is| is).count();
    let home = household_home(&scenario);
    let mut lives = HouseholdTruth::new(are_people, hosts.collect(), home);
    let mut run = Run::new(&scenario, household, seed, i64::from(days) * DAY);
    each_step(&mut run, HOUR, |events| events.facts.iter().for_each(|fact| lives.take(fact)))?;
    Ok(ScenarioRow {
        scenario: scenario.file.name.clone(),
        people,
        visits: lives.visits(),
        impossible: lives.impossible(),
    })
}

/// The front door and the bathrooms, by roles and names.
fn household_home(scenario: &Scenario) -> HouseholdHome {
    let (home, plan) = (&scenario.home, scenario.home.plan());
    let is_of = |role: Role, name: &str| {
        let piece = home.furniture.iter().find(|piece| piece.name == name);
        piece.and_then(|piece| piece.role).map_or_else(|| role.is_called(&name.to_lowercase()), |said| said == role)
    };
    let mut are_bathrooms = vec![false; plan.rooms.len()];
    for (name, at) in &plan.places {
        let room = plan.room_at(*at).filter(|_| is_of(Role::Toilet, name) || is_of(Role::Shower, name));
        room.into_iter().for_each(|room| are_bathrooms[room] = true);
    }
    let outside = home.doors.iter().position(|door| door.outside);
    let front_door = outside.or_else(|| Role::FrontDoor.row().names.iter().find_map(|name| plan.thing(name)));
    HouseholdHome { front_door, are_bathrooms }
}
