//! The apartment of the example, lived in by whatever routine a test writes.

use homebody_core::event::{Events, Fact};
use homebody_core::ids::ResidentId;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_routine::household::Household;
use std::collections::BTreeMap;

#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub const HOUR: Micros = 3600 * SECOND;

/// The routine of the example.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub const ORDINARY: &str = include_str!("../../../../scenarios/tigerplace/margaret.routine");

/// The files of the scenario, with this routine and, if any, these other files.
pub fn files(routine: &str, others: &[(&str, &str)]) -> BTreeMap<String, String> {
    let text = |name: &str, text: &str| (name.to_owned(), text.to_owned());
    let mut files = BTreeMap::from([
        text("scenario.json", include_str!("../../../../scenarios/tigerplace/scenario.json")),
        text("home.json", include_str!("../../../../scenarios/tigerplace/home.json")),
        text("logger.json", include_str!("../../../../scenarios/tigerplace/logger.json")),
        text("margaret.json", include_str!("../../../../scenarios/tigerplace/margaret.json")),
        text("margaret.routine", routine),
    ]);
    files.extend(others.iter().map(|(name, of)| text(name, of)));
    files
}

/// A household of these files, or what is wrong with it.
pub fn household(files: &BTreeMap<String, String>, without: &[&str]) -> Result<(Scenario, Household), String> {
    let without: Vec<String> = without.iter().map(|name| name.to_string()).collect();
    Household::load(files, "scenario.json", &without).map_err(|problems| problems.to_string())
}

/// A run of a routine in the apartment.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn run(routine: &str, days: i64) -> Run {
    let (scenario, household) = household(&files(routine, &[]), &[]).unwrap();
    Run::new(&scenario, &household, scenario.file.seed, days * DAY)
}

/// Everything that happens in the rest of a run, advanced in steps.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn events(mut run: Run, step: Micros) -> Events {
    let mut events = Events::default();
    while run.now() < run.length() {
        run.advance(run.now() + step, &mut events).unwrap();
    }
    events
}

/// From when to when, who, and what.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn activities(events: &Events, resident: u32, end: Micros) -> Vec<(Micros, Micros, String)> {
    let mut spans: Vec<(Micros, Micros, String)> = Vec::new();
    for fact in &events.facts {
        if let Fact::Activity { resident: who, at, name } = fact
            && *who == ResidentId(resident)
        {
            if let Some(last) = spans.last_mut() {
                last.1 = *at;
            }
            spans.extend(name.clone().map(|name| (*at, end, name)));
        }
    }
    spans
}
