//! Sensors that never fire: no resident can stand in their view, or no routine uses their thing.

use crate::scenario_warnings::ScenarioWarning;
use homebody_analysis::coverage;
use homebody_core::geometry::signed_area;
use homebody_core::problem::Problem;
use homebody_core::resident::Build;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::source::JsonSource;
use homebody_core::sensors::form::ReportedInstant;
use homebody_core::sensors::kinds::SensorFile;
use homebody_routine::household::Household;

/// Step in metres of the search of the floor (our choice).
const STEP_M: f64 = 0.1;

/// Area of floor above which a home is not searched (our choice): it would take too long.
const LARGEST_M2: f64 = 2_000.0;

/// Area of floor below which a sensor sees nothing (our choice).
const LEAST_M2: f64 = 0.05;

/// A warning for each sensor that never fires with these routines.
pub(crate) fn remarks(scenario: &Scenario, household: &Household) -> Vec<Problem> {
    let file = &scenario.file.home;
    let text = scenario.sources.get(file).map(String::as_str).unwrap_or_default();
    let Ok(source) = JsonSource::parse(file, text) else { return Vec::new() };
    let sensors = scenario.home.sensors.iter().enumerate();
    let at = |index: usize| format!("/sensors/{index}");
    let blind = blind(scenario);
    let mut all: Vec<(usize, Problem)> = Vec::new();
    for (index, sensor) in sensors.clone().filter(|(_, sensor)| blind.contains(&sensor.name().to_owned())) {
        let message = ScenarioWarning::Blind { sensor: sensor.name().to_owned() };
        all.push((index, source.problem(&at(index), message, None)));
    }
    if let Some(used) = household.used_things() {
        for (index, sensor) in sensors {
            let Some(ReportedInstant::Used(thing)) = sensor.moment() else { continue };
            if !used.contains(&thing.to_lowercase()) {
                let message = ScenarioWarning::Unused { sensor: sensor.name().to_owned(), thing: thing.to_owned() };
                all.push((index, source.problem(&at(index), message, None)));
            }
        }
    }
    all.sort_by_key(|(index, _)| *index);
    all.into_iter().map(|(_, remark)| remark).collect()
}

/// The names of the sensors of movement that see nothing of any resident who stands.
fn blind(scenario: &Scenario) -> Vec<String> {
    let floor_m2: f64 = scenario.home.plan().rooms.iter().map(|room| signed_area(&room.outline).abs()).sum();
    if floor_m2 > LARGEST_M2 || !scenario.home.sensors.iter().any(SensorFile::senses_motion) {
        return Vec::new();
    }
    let tallest = scenario.residents.iter().map(|resident| Build::new(&resident.file));
    let build = tallest.max_by(|a, b| a.height_m.total_cmp(&b.height_m)).unwrap_or(Build::adult());
    let seen = coverage::of_home(&scenario.home, build, STEP_M).coverage;
    seen.sensors.into_iter().filter(|sensor| sensor.seen_m2 < LEAST_M2).map(|sensor| sensor.name).collect()
}
