//! Searches the layout of sensors with the most informative log for given goals.
//!
//! Candidates are a motion sensor in the corner of each room with the best view, a motion sensor on the ceiling above
//! each enterable piece of furniture, a sensor in each bed, and a contact on each outer door. People are simulated in
//! the home with all candidates. The search starts with the best single sensor, then adds the one that improves the
//! score most, and so on. If no single sensor improves it, it tries pairs. At the end, a sensor is exchanged if another
//! one in its place improves the score.
//!
//! Each goal has a score from 0 to 1. For a condition, the score is 1 if people with it are found at once, with few
//! false alarms, and 0 if they are found after four weeks or never. For a measure of days, it compares the error of the
//! log with the mean of the truth. For falls, it is the share of the floor in view of sensors, because a fall out of
//! their view has no known place.
//!
//! The search ignores prices, wires and batteries, and layouts of three or more sensors that help only together.

use crate::adequacy::{Adequacy, Person, WITHIN, Watched, adequacy};
use crate::simulated::SimulatedLog;
use homebody_analysis::coverage::{self, Coverage};
use homebody_analysis::measures::{DailyMeasure, MEASURES, Measures};
use homebody_core::geometry::{Point, contains};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::resident::Build;
use homebody_core::role::Role;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::sensors::products::Product;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};

/// Distance of a wall sensor from the corner along each wall, and its height (our choice).
const FROM_CORNER_M: f64 = 0.15;
const HEIGHT_M: f64 = 2.1;
/// Distance around its target that a ceiling sensor sees (our choice).
const AROUND_M: f64 = 0.35;
/// Step in metres of the search of the floor while layouts are tried (our choice).
const STEP_M: f64 = 0.1;

/// Gain below which a sensor adds nothing (our choice).
const ADDS: f64 = 1e-6;
/// Number of sensors, the best single ones, that pairs are made of: all pairs would be too many.
const PAIRED: usize = 8;
/// Largest number of sensors that are exchanged.
const MOST_SWAPS: usize = 3;

#[derive(Clone, Copy, Debug)]
pub enum Goal {
    Condition(&'static str),
    /// Measuring days; the index of the measure.
    Measure(usize),
    Falls,
}

impl Goal {
    /// The goal with a name: a condition, a measure, `falls`, or `night-bathroom`.
    pub fn from_name(name: &str, conditions: &[&'static str]) -> Option<Goal> {
        let is_named = |measure: &DailyMeasure| measure.name == name.replace('-', "_");
        match name {
            "falls" => Some(Goal::Falls),
            "night-bathroom" => Goal::from_name("bathroom_night", conditions),
            _ => {
                let condition = conditions.iter().find(|condition| **condition == name).copied();
                condition.map(Goal::Condition).or(MEASURES.iter().position(is_named).map(Goal::Measure))
            }
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Goal::Condition(name) => name,
            Goal::Measure(number) => MEASURES[number].name,
            Goal::Falls => "falls",
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct Reached {
    pub goal: &'static str,
    /// From 0 to 1.
    pub score: f64,
    /// In `unit`: days until found, the mean error of a day, the share of the floor.
    pub value: f64,
    pub unit: &'static str,
}

#[derive(Clone, Debug, Serialize)]
pub struct Layout {
    pub sensors: Vec<String>,
    /// The mean over the goals.
    pub score: f64,
    pub goals: Vec<Reached>,
}

#[derive(Clone, Debug, Serialize)]
pub struct SuggestedSteps {
    pub steps: Vec<Layout>,
    pub swapped: Vec<Swap>,
}

impl SuggestedSteps {
    pub fn layouts_mut(&mut self) -> impl Iterator<Item = &mut Layout> {
        self.steps.iter_mut().chain(self.swapped.iter_mut().map(|swap| &mut swap.layout))
    }

    /// Removes the last swaps, as long as they gain nothing.
    pub fn drop_useless_swaps(&mut self) {
        let is_worse = |found: &SuggestedSteps| {
            let (last, before) = found.swapped.split_last()?;
            let before = before.last().map(|swap| &swap.layout).or(found.steps.last())?;
            Some(last.layout.score <= before.score)
        };
        while is_worse(self) == Some(true) {
            self.swapped.pop();
        }
    }

    pub fn last(&self) -> Option<&Layout> {
        self.swapped.last().map(|swap| &swap.layout).or(self.steps.last())
    }
}

#[derive(Clone, Debug, Serialize)]
pub struct Swap {
    pub gone: String,
    pub come: String,
    #[serde(flatten)]
    pub layout: Layout,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchStep {
    OneMore,
    TwoMore,
    Another,
}

/// The score and goals of layouts, by the sorted names of their sensors.
type Known = BTreeMap<Vec<String>, (f64, Vec<Reached>)>;

/// The best; the first of equal ones.
fn best_of(layouts: Vec<Layout>) -> Option<Layout> {
    layouts.into_iter().reduce(|best, other| if other.score > best.score { other } else { best })
}

pub struct SimulatedPerson {
    pub person: Person,
    pub log: SimulatedLog,
    pub truth: Measures,
}

pub struct Trial<'a> {
    pub home: &'a HomeFile,
    pub goals: &'a [Goal],
    pub people: &'a [SimulatedPerson],
    pub build: Build,
}

impl Trial<'_> {
    /// The best layouts with one candidate, two, and so on: each adds the best sensor to the last layout, or the best
    /// two if one adds nothing. The search ends when two add nothing either. In the last layout, sensors are exchanged
    /// as long as the score rises. `goes_on` gets the next step and the number of sensors so far; if it returns false,
    /// the search stops.
    pub fn best(
        &self,
        candidates: &[String],
        count: usize,
        goes_on: &dyn Fn(SearchStep, usize) -> bool,
    ) -> Option<SuggestedSteps> {
        let (coverage, mut known) = (self.coverage(), Known::new());
        let count = count.min(candidates.len());
        let mut steps: Vec<Layout> = Vec::new();
        while steps.len() < count {
            if !goes_on(SearchStep::OneMore, steps.len()) {
                return None;
            }
            let (before, score) =
                steps.last().map_or((Vec::new(), 0.0), |layout| (layout.sensors.clone(), layout.score));
            let left: Vec<&String> = candidates.iter().filter(|name| !before.contains(name)).collect();
            let with = |names: &[&String]| {
                [&before[..], &names.iter().map(|name| (*name).clone()).collect::<Vec<_>>()].concat()
            };
            let mut ones = self.all(left.iter().map(|name| with(&[name])).collect(), &coverage, &mut known);
            // The first of equal ones.
            ones.sort_by(|a, b| b.score.total_cmp(&a.score));
            if ones.first().is_some_and(|one| one.score <= score + ADDS) && steps.len() + 2 <= count {
                if !goes_on(SearchStep::TwoMore, steps.len()) {
                    return None;
                }
                let best: Vec<&String> = ones.iter().take(PAIRED).filter_map(|one| one.sensors.last()).collect();
                let pairs = (0..best.len()).flat_map(|a| (a + 1..best.len()).map(move |b| (a, b)));
                let twos = self.all(pairs.map(|(a, b)| with(&[best[a], best[b]])).collect(), &coverage, &mut known);
                let two = best_of(twos).filter(|two| two.score > score + ADDS);
                let one =
                    |two: &Layout| ones.iter().find(|one| one.sensors[..] == two.sensors[..two.sensors.len() - 1]);
                if let Some((one, two)) = two.and_then(|two| Some((one(&two)?.clone(), two))) {
                    steps.extend([one, two]);
                    continue;
                }
            }
            // A sensor that adds nothing is not needed.
            if ones.first().is_none_or(|one| one.score <= score + ADDS) {
                break;
            }
            steps.push(ones.swap_remove(0));
        }
        let swapped = self.swaps(&steps, candidates, (&coverage, &mut known), goes_on)?;
        Some(SuggestedSteps { steps, swapped })
    }

    /// Exchanges sensors of the last layout, as long as the score rises.
    fn swaps(
        &self,
        steps: &[Layout],
        candidates: &[String],
        (coverage, known): (&Coverage, &mut Known),
        goes_on: &dyn Fn(SearchStep, usize) -> bool,
    ) -> Option<Vec<Swap>> {
        let mut swaps: Vec<Swap> = Vec::new();
        while swaps.len() < MOST_SWAPS {
            let Some(layout) = swaps.last().map(|swap| &swap.layout).or(steps.last()) else { break };
            if !goes_on(SearchStep::Another, layout.sensors.len()) {
                return None;
            }
            let left: Vec<&String> = candidates.iter().filter(|name| !layout.sensors.contains(name)).collect();
            let of_place = |place: usize| left.iter().map(move |name| (place, *name));
            let tries: Vec<(usize, &String)> = (0..layout.sensors.len()).flat_map(of_place).collect();
            let instead = |&(place, name): &(usize, &String)| {
                let mut sensors = layout.sensors.clone();
                sensors[place].clone_from(name);
                sensors
            };
            let tried = self.all(tries.iter().map(instead).collect(), coverage, known);
            let best = best_of(tried).filter(|best| best.score > layout.score + ADDS);
            let Some(best) = best else { break };
            let place = (0..best.sensors.len()).find(|&place| best.sensors[place] != layout.sensors[place]);
            let Some(place) = place else { break };
            swaps.push(Swap { gone: layout.sensors[place].clone(), come: best.sensors[place].clone(), layout: best });
        }
        Some(swaps)
    }

    /// In the order of the layouts. The order of the sensors does not matter.
    fn all(&self, layouts: Vec<Vec<String>>, coverage: &Coverage, known: &mut Known) -> Vec<Layout> {
        let sorted = |sensors: &[String]| {
            let mut sensors = sensors.to_vec();
            sensors.sort_unstable();
            sensors
        };
        let new = layouts.iter().map(|sensors| sorted(sensors)).filter(|sensors| !known.contains_key(sensors));
        let new: BTreeSet<Vec<String>> = new.collect();
        let found = new.into_par_iter().map(|sensors| {
            let Layout { score, goals, .. } = self.layout(sensors.clone(), coverage);
            (sensors, (score, goals))
        });
        known.par_extend(found);
        let layout = |sensors: Vec<String>| {
            let (score, goals) = known.get(&sorted(&sensors))?.clone();
            Some(Layout { sensors, score, goals })
        };
        layouts.into_iter().filter_map(layout).collect()
    }

    pub fn of(&self, sensors: &[String]) -> Layout {
        self.layout(sensors.to_vec(), &self.coverage())
    }

    /// Sets the visible share of the floor of each layout, by a finer coverage of all sensors.
    pub fn rescore_falls<'l>(&self, layouts: impl IntoIterator<Item = &'l mut Layout>, coverage: &Coverage) {
        for layout in layouts {
            let falls = self.goals.iter().zip(&mut layout.goals).filter(|(goal, _)| matches!(goal, Goal::Falls));
            for (_, reached) in falls {
                let seen = share_seen(coverage, &layout.sensors);
                (reached.score, reached.value) = (seen, seen);
            }
            layout.score = mean_score(&layout.goals);
        }
    }

    fn coverage(&self) -> Coverage {
        coverage::of_home(self.home, self.build, STEP_M).coverage
    }

    fn layout(&self, sensors: Vec<String>, coverage: &Coverage) -> Layout {
        let keep = |name: &str| sensors.iter().any(|sensor| sensor == name);
        // Sensors without motion measure no day.
        let heard: Vec<Option<Measures>> =
            self.people.iter().map(|person| person.log.measures_by(&keep).ok()).collect();
        let watched: Vec<Watched> = (self.people.iter().zip(&heard))
            .filter_map(|(one, heard)| Some(Watched { person: &one.person, measures: heard.as_ref()? }))
            .collect();
        let shows = |goal: &Goal| matches!(goal, Goal::Condition(_));
        let found = self.goals.iter().any(shows).then(|| adequacy(&watched));
        let reached = |goal: &Goal| match *goal {
            Goal::Condition(name) => condition_score(name, found.as_ref()),
            Goal::Measure(number) => self.measure_score(number, &heard),
            Goal::Falls => {
                let seen = share_seen(coverage, &sensors);
                Reached { goal: "falls", score: seen, value: seen, unit: "of the floor" }
            }
        };
        let goals: Vec<Reached> = self.goals.iter().map(reached).collect();
        Layout { sensors, score: mean_score(&goals), goals }
    }

    /// Compares the log with the truth of the people without a condition. A day without a value in the log counts as wholly wrong.
    fn measure_score(&self, number: usize, heard: &[Option<Measures>]) -> Reached {
        let (mut wrong, mut truth, mut days) = (0.0, 0.0, 0.0);
        for (one, heard) in self.people.iter().zip(heard).filter(|(one, _)| one.person.condition.is_none()) {
            for (day, lived) in one.truth.days.iter().enumerate() {
                let Some(lived) = lived.values[number] else { continue };
                let heard = heard.as_ref().and_then(|heard| heard.days.get(day)?.values[number]);
                wrong += heard.map_or(lived.abs(), |heard| (heard - lived).abs());
                (truth, days) = (truth + lived.abs(), days + 1.0);
            }
        }
        let score = if truth > 0.0 { (1.0 - wrong / truth).max(0.0) } else { 0.0 };
        let DailyMeasure { name, unit, .. } = MEASURES[number];
        Reached { goal: name, score, value: wrong / f64::max(days, 1.0), unit: unit.name }
    }
}

fn mean_score(goals: &[Reached]) -> f64 {
    goals.iter().map(|goal| goal.score).sum::<f64>() / goals.len().max(1) as f64
}

fn condition_score(name: &'static str, found: Option<&Adequacy>) -> Reached {
    let days = found
        .into_iter()
        .flat_map(|found| &found.by_condition)
        .find(|(condition, _)| condition == name)
        .map(|(_, days)| *days);
    let value = days.unwrap_or(WITHIN as f64);
    Reached { goal: name, score: 1.0 - value / WITHIN as f64, value, unit: "days until found" }
}

/// The share of the floor in view of at least one of the sensors.
fn share_seen(coverage: &Coverage, sensors: &[String]) -> f64 {
    let kept: Vec<bool> = coverage.sensors.iter().map(|sensor| sensors.contains(&sensor.name)).collect();
    let floor = coverage.grid.cells.iter().flatten();
    let seen = floor.clone().filter(|seen| seen.iter().any(|sensor| kept[sensor.index()])).count();
    seen as f64 / floor.count().max(1) as f64
}

/// The candidate sensors of a home, with names that its own sensors do not have. Motion sensors are of the given
/// product, if any.
pub fn candidates(home: &HomeFile, device: Option<Product>) -> Vec<SensorFile> {
    let plan = Plan::new(home);
    let mut all: Vec<SensorFile> = Vec::new();
    for (room, named) in plan.rooms.iter().enumerate() {
        let corners = corners(&named.outline).into_iter().enumerate();
        let sensors = corners.filter_map(|(number, (at, facing_deg))| {
            let name = format!("{} corner {number}", named.name);
            let at = [at.x, at.y].map(in_centimetres);
            let file =
                json!({ "kind": "motion", "name": name, "at": at, "height_m": HEIGHT_M, "facing_deg": facing_deg });
            with_product(sensor(file), device)
        });
        let sensors: Vec<SensorFile> = sensors.collect();
        all.extend(best_in_room(home, &plan, room, sensors).map(|mut best| {
            *best.name_mut() = format!("{} motion", named.name);
            best
        }));
    }
    for piece in &home.furniture {
        all.extend(with_product(piece_sensor(piece, &plan), device));
    }
    for door in home.doors.iter().filter(|door| door.outside) {
        all.extend(sensor(json!({ "kind": "contact", "name": format!("{} contact", door.name), "on": door.name })));
    }
    let taken = |name: &str| home.sensors.iter().any(|sensor| sensor.name() == name);
    for candidate in &mut all {
        if taken(candidate.name()) {
            *candidate.name_mut() = format!("new {}", candidate.name());
        }
    }
    all
}

fn sensor(file: serde_json::Value) -> Option<SensorFile> {
    serde_json::from_value(file).ok()
}

fn with_product(sensor: Option<SensorFile>, device: Option<Product>) -> Option<SensorFile> {
    sensor.map(|mut sensor| {
        device.inspect(|device| device.put_into(&mut sensor));
        sensor
    })
}

fn in_centimetres(metres: f64) -> f64 {
    (metres * 100.0).round() / 100.0
}

/// The corners of an outline that point outward, moved a little inside, with the direction into the outline.
fn corners(outline: &[Point]) -> Vec<(Point, f64)> {
    let count = outline.len();
    let looks = |number: usize| {
        let (before, at, after) =
            (outline[(number + count - 1) % count], outline[number], outline[(number + 1) % count]);
        let along = |to: Point| (to - at) / to.distance(at).max(1e-9);
        let into = along(before) + along(after);
        let inside = at + FROM_CORNER_M * into;
        let facing_deg = into.y.atan2(into.x).to_degrees().round();
        contains(outline, inside).then_some((inside, facing_deg))
    };
    (0..count).filter_map(looks).collect()
}

fn best_in_room(home: &HomeFile, plan: &Plan, room: usize, sensors: Vec<SensorFile>) -> Option<SensorFile> {
    let with = HomeFile { sensors: sensors.clone(), ..home.clone() };
    let seen = coverage::of_home(&with, Build::adult(), STEP_M);
    let grid = &seen.coverage.grid;
    let of_room = |cell: &usize| plan.room_at(grid.middle(*cell)) == Some(room);
    let sees = |name: &str| {
        let number = seen.coverage.sensors.iter().position(|sensor| sensor.name == name);
        let cells = (0..grid.cells.len()).filter(of_room).filter_map(|cell| grid.cells[cell].as_ref());
        cells.filter(|cell| cell.iter().any(|sensor| Some(sensor.index()) == number)).count()
    };
    let counted = sensors.into_iter().map(|sensor| (sees(sensor.name()), sensor));
    counted.reduce(|best, other| if other.0 > best.0 { other } else { best }).map(|(_, sensor)| sensor)
}

/// The sensor of an enterable piece of furniture: one in a bed, else one above it.
fn piece_sensor(piece: &FurnitureFile, plan: &Plan) -> Option<SensorFile> {
    if !piece.enterable {
        return None;
    }
    let middle = plan.places.iter().find(|(name, _)| *name == piece.name).map(|(_, at)| *at)?;
    let role = piece.role.or_else(|| Role::from_name(&piece.name.to_lowercase()).next());
    if role == Some(Role::Bed) {
        return sensor(json!({ "kind": "bed", "name": format!("{} sensor", piece.name), "on": piece.name }));
    }
    let room = plan.rooms.get(plan.room_at(middle)?)?;
    let [width, depth] = piece.size_m?;
    let reach = f64::max(width, depth) / 2.0 + AROUND_M;
    // The part in the room of the square around it.
    let bound = |low: f64, high: f64, axis: fn(Point) -> f64| {
        let of_room = room.outline.iter().map(|corner| axis(*corner));
        let (least, most) = of_room.fold((f64::MAX, f64::MIN), |(least, most), at| (least.min(at), most.max(at)));
        [low.max(least + FROM_CORNER_M), high.min(most - FROM_CORNER_M)].map(in_centimetres)
    };
    let [west, east] = bound(middle.x - reach, middle.x + reach, |p| p.x);
    let [south, north] = bound(middle.y - reach, middle.y + reach, |p| p.y);
    let area = [[west, south], [east, south], [east, north], [west, north]];
    sensor(json!({ "kind": "ceiling_motion", "name": format!("{} motion", piece.name), "area": area }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_look_into_the_room() {
        let outline = [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (2.0, 2.0), (2.0, 4.0), (0.0, 4.0)];
        let outline = outline.map(|(x, y)| Point::new(x, y));
        let found = corners(&outline);
        assert_eq!(found.len(), 5, "the inward corner has no wall to hang on: {found:?}");
        assert_eq!(found[0].1, 45.0);
        assert!((found[0].0.x - FROM_CORNER_M).abs() < 1e-9);
    }

    #[test]
    fn goals_are_known_by_name() {
        let known = ["depression"];
        assert!(matches!(Goal::from_name("depression", &known), Some(Goal::Condition("depression"))));
        assert_eq!(Goal::from_name("night-bathroom", &known).map(Goal::name), Some("bathroom_night"));
        assert_eq!(Goal::from_name("time-out", &known).map(Goal::name), Some("time_out"));
        assert!(Goal::from_name("luck", &known).is_none());
    }
}
