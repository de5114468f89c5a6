//! A layout that is proposed for a home, by what its sensors would tell of people who live there.

use crate::people::{CONDITIONS, Lives, NotLived, ONSET, Opened, People};
use crate::placing::{Goal, Layout, Placed, Somebody, Trial, Trying, candidates};
use homebody_analysis::alerts::Rules;
use homebody_analysis::coverage;
use homebody_core::home::Build;
use homebody_core::scenario::device::Device;
use homebody_core::scenario::home::{HomeFile, SensorFile};
use homebody_core::scenario::link::LinkFile;
use serde::Serialize;

/// So many days after conditions begin are lived: none is looked for later.
const AFTER: u32 = 29;

/// What is asked for.
pub struct Ask<'a> {
    /// What is to be seen.
    pub goals: &'a [Goal],
    /// How many sensors there may be.
    pub sensors: usize,
    /// How many people live in the home.
    pub people: u32,
    /// The number all randomness comes from.
    pub seed: u64,
    /// The rules of alerts.
    pub rules: &'a Rules,
    /// What motion sensors are to be; `None` as in Godsey & Skubic 2009.
    pub device: Option<Device>,
    /// The body that sensors look for.
    pub build: Build,
    /// The grid on which the floor that is seen is counted: the side of a cell, in metres.
    pub step_m: f64,
}

/// What is being done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doing {
    /// One more has lived.
    Lived,
    /// Layouts are tried; by now there are so many sensors.
    Trying(Trying, usize),
}

/// Where sensors go.
#[derive(Clone, Debug, Serialize)]
pub struct Proposed {
    /// As a home's file takes them, the most telling first.
    pub sensors: Vec<SensorFile>,
    /// How they were found.
    #[serde(flatten)]
    pub placed: Placed,
    /// The sensors that the home has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own: Option<Layout>,
}

/// What names mean that people use, or all of them that mean nothing.
pub fn goals(names: &[String]) -> Result<Vec<Goal>, Vec<String>> {
    let conditions: Vec<&'static str> = CONDITIONS.iter().map(|(name, _)| *name).collect();
    let of = |name: &String| Goal::of(name.trim(), &conditions).ok_or_else(|| name.trim().to_owned());
    let (known, unknown): (Vec<_>, Vec<_>) = names.iter().map(of).partition(Result::is_ok);
    match unknown.is_empty() {
        true => Ok(known.into_iter().filter_map(Result::ok).collect()),
        false => Err(unknown.into_iter().filter_map(Result::err).collect()),
    }
}

impl Ask<'_> {
    /// Whether anybody has to live there: what of the floor is seen is known without.
    pub fn needs_lives(&self) -> bool {
        self.goals.iter().any(|goal| !matches!(goal, Goal::Falls))
    }
}

/// A layout for a home. `opened` is asked for its scenario where somebody has to live there; `told` hears what is done, and says
/// whether it goes on.
pub fn propose(
    home: &HomeFile,
    ask: &Ask,
    opened: impl FnOnce() -> Result<Opened, NotLived>,
    told: &(dyn Fn(Doing) -> bool + Sync),
) -> Result<Proposed, NotLived> {
    let candidates = candidates(home, ask.device);
    let people = if ask.needs_lives() { live(&opened()?, &candidates, ask, told)? } else { Vec::new() };
    let own: Vec<String> = home.sensors.iter().map(|sensor| sensor.name().to_owned()).collect();
    let names: Vec<String> = candidates.iter().map(|sensor| sensor.name().to_owned()).collect();
    let with_all = HomeFile { sensors: [&home.sensors[..], &candidates].concat(), ..home.clone() };
    let trial = Trial { home: &with_all, goals: ask.goals, people: &people, rules: ask.rules, build: ask.build };
    let placed = trial.best(&names, ask.sensors, &|trying, sensors| told(Doing::Trying(trying, sensors)));
    let mut placed = placed.ok_or(NotLived::Stopped)?;
    let mut own = (!own.is_empty()).then(|| trial.of(&own));
    if ask.goals.iter().any(|goal| matches!(goal, Goal::Falls)) {
        if !told(Doing::Trying(Trying::Another, ask.sensors)) {
            return Err(NotLived::Stopped);
        }
        // Tried on a coarse grid, and told as the coverage of the home that takes them.
        let seen = coverage::of_home(&with_all, ask.build, ask.step_m).coverage;
        trial.rescore_falls(placed.layouts_mut().chain(&mut own), &seen);
        placed.take_back();
    }
    let chosen: &[String] = placed.last().map_or(&[], |layout| &layout.sensors);
    let sensor = |name: &String| candidates.iter().find(|sensor| sensor.name() == name).cloned();
    let sensors = chosen.iter().filter_map(sensor).collect();
    Ok(Proposed { sensors, placed, own })
}

/// People who live in the home with all candidates besides the sensors that it has.
fn live(
    opened: &Opened,
    candidates: &[SensorFile],
    ask: &Ask,
    told: &(dyn Fn(Doing) -> bool + Sync),
) -> Result<Vec<Somebody>, NotLived> {
    let with_all = Opened::of(opened.scenario.edit().home(|home| home.sensors.extend_from_slice(candidates)))?;
    let wanted = |name: &str| ask.goals.iter().any(|goal| matches!(goal, Goal::Condition(goal) if *goal == name));
    let conditions: Vec<(&str, usize)> = CONDITIONS.into_iter().filter(|(name, _)| wanted(name)).collect();
    let people = People::of(&with_all, &conditions, ask.people, (ONSET as u32 + AFTER, ask.seed))?;
    let live = |lives: &Lives| -> Result<_, NotLived> {
        let life = lives.live(&LinkFile::default())?;
        let lived = life.lived();
        Ok((life, lived))
    };
    let all = people.each(|| told(Doing::Lived), live)?;
    Ok(all.into_iter().map(|(person, (life, lived))| Somebody { person, life, lived }).collect())
}
