//! Suggests a layout of sensors for a home, by the logs of people who are simulated in it.

use crate::people::{CONDITIONS, LoadedScenario, ONSET, People, PeopleError, PersonRun};
use crate::search::{Goal, Layout, SearchStep, SimulatedPerson, SuggestedSteps, Trial, candidates};
use homebody_analysis::coverage;
use homebody_core::home::form::HomeFile;
use homebody_core::link::form::LinkFile;
use homebody_core::resident::Build;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::sensors::products::Product;
use serde::Serialize;

/// Simulated days after the onset of conditions: later alerts do not count.
const AFTER: u32 = 29;

pub struct Request<'a> {
    pub goals: &'a [Goal],
    pub sensors: usize,
    pub people: u32,
    pub seed: u64,
    /// The product of motion sensors; `None` for the sensor of Godsey & Skubic 2009.
    pub device: Option<Product>,
    pub build: Build,
    /// Side of a cell of the grid of the visible floor, in metres.
    pub step_m: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    Simulated,
    /// The search begins a step, with this number of sensors so far.
    Searching(SearchStep, usize),
}

#[derive(Clone, Debug, Serialize)]
pub struct Proposal {
    /// The sensors in the form of a home's file, the most useful first.
    pub sensors: Vec<SensorFile>,
    #[serde(flatten)]
    pub found: SuggestedSteps,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own: Option<Layout>,
}

pub fn goals(names: &[String]) -> Result<Vec<Goal>, Vec<String>> {
    let conditions: Vec<&'static str> = CONDITIONS.iter().map(|(name, _)| *name).collect();
    let of = |name: &String| Goal::from_name(name.trim(), &conditions).ok_or_else(|| name.trim().to_owned());
    let (known, unknown): (Vec<_>, Vec<_>) = names.iter().map(of).partition(Result::is_ok);
    match unknown.is_empty() {
        true => Ok(known.into_iter().filter_map(Result::ok).collect()),
        false => Err(unknown.into_iter().filter_map(Result::err).collect()),
    }
}

impl Request<'_> {
    /// False if the visible floor decides all goals.
    pub fn needs_people(&self) -> bool {
        self.goals.iter().any(|goal| !matches!(goal, Goal::Falls))
    }
}

/// Suggests a layout for a home. `load` loads the scenario, if people have to be simulated. `goes_on` gets each step;
/// if it returns false, the work stops.
pub fn propose(
    home: &HomeFile,
    request: &Request,
    load: impl FnOnce() -> Result<LoadedScenario, PeopleError>,
    goes_on: &(dyn Fn(Step) -> bool + Sync),
) -> Result<Proposal, PeopleError> {
    let candidates = candidates(home, request.device);
    let people = if request.needs_people() { simulate(&load()?, &candidates, request, goes_on)? } else { Vec::new() };
    let own: Vec<String> = home.sensors.iter().map(|sensor| sensor.name().to_owned()).collect();
    let names: Vec<String> = candidates.iter().map(|sensor| sensor.name().to_owned()).collect();
    let with_all = HomeFile { sensors: [&home.sensors[..], &candidates].concat(), ..home.clone() };
    let trial = Trial { home: &with_all, goals: request.goals, people: &people, build: request.build };
    let found = trial.best(&names, request.sensors, &|step, sensors| goes_on(Step::Searching(step, sensors)));
    let mut found = found.ok_or(PeopleError::Stopped)?;
    let mut own = (!own.is_empty()).then(|| trial.of(&own));
    if request.goals.iter().any(|goal| matches!(goal, Goal::Falls)) {
        if !goes_on(Step::Searching(SearchStep::Another, request.sensors)) {
            return Err(PeopleError::Stopped);
        }
        // Candidates are tried on a coarse grid, and scored on the fine one.
        let seen = coverage::of_home(&with_all, request.build, request.step_m).coverage;
        trial.rescore_falls(found.layouts_mut().chain(&mut own), &seen);
        found.drop_useless_swaps();
    }
    let chosen: &[String] = found.last().map_or(&[], |layout| &layout.sensors);
    let sensor = |name: &String| candidates.iter().find(|sensor| sensor.name() == name).cloned();
    let sensors = chosen.iter().filter_map(sensor).collect();
    Ok(Proposal { sensors, found, own })
}

fn simulate(
    home: &LoadedScenario,
    candidates: &[SensorFile],
    request: &Request,
    goes_on: &(dyn Fn(Step) -> bool + Sync),
) -> Result<Vec<SimulatedPerson>, PeopleError> {
    let with_all =
        LoadedScenario::from_edit(home.scenario.edit().home(|home| home.sensors.extend_from_slice(candidates)))?;
    let wanted = |name: &str| request.goals.iter().any(|goal| matches!(goal, Goal::Condition(goal) if *goal == name));
    let conditions: Vec<(&str, usize)> = CONDITIONS.into_iter().filter(|(name, _)| wanted(name)).collect();
    let people = People::new(&with_all, &conditions, request.people, (ONSET as u32 + AFTER, request.seed))?;
    let simulate = |person: &PersonRun| -> Result<_, PeopleError> {
        let log = person.simulate(&LinkFile::default())?;
        let truth = log.true_measures();
        Ok((log, truth))
    };
    let all = people.each(|| goes_on(Step::Simulated), simulate)?;
    Ok(all.into_iter().map(|(person, (log, truth))| SimulatedPerson { person, log, truth }).collect())
}
