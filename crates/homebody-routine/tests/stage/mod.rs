//! The apartment of the example, with the routine of a test.

use homebody_core::event::{Events, Fact};
use homebody_core::ids::ResidentId;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, HOUR, Interval, RunTime, Span};
use homebody_routine::household::Household;
use std::collections::BTreeMap;

#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub const ORDINARY: &str = include_str!("../../../../scenarios/tigerplace/margaret.routine");

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

/// A household of these files, or its problems.
pub fn household(files: &BTreeMap<String, String>, without: &[&str]) -> Result<(Scenario, Household), String> {
    let without: Vec<String> = without.iter().map(|name| name.to_string()).collect();
    Household::load(files, "scenario.json", &without).map_err(|problems| problems.to_string())
}

/// A run in the example's apartment.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn run(routine: &str, days: i64) -> Run {
    let (scenario, household) = household(&files(routine, &[]), &[]).unwrap();
    Run::new(&scenario, &household, scenario.file.seed, days * DAY)
}

/// All events of the rest of a run, advanced in steps.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn events(mut run: Run, step: Span) -> Events {
    let mut events = Events::default();
    let end = RunTime::START + run.length();
    while run.now() < end {
        run.advance(run.now() + step, &mut events).unwrap();
    }
    events
}

/// Intervals and labels of a resident's activities.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn activities(events: &Events, resident: u32, length: Span) -> Vec<(Interval<RunTime>, String)> {
    let mut all: Vec<(Interval<RunTime>, String)> = Vec::new();
    for fact in &events.facts {
        if let Fact::Activity { resident: who, at, name } = fact
            && *who == ResidentId(resident)
        {
            if let Some(last) = all.last_mut() {
                last.0.end = *at;
            }
            all.extend(name.clone().map(|name| (Interval::new(*at, RunTime::START + length), name)));
        }
    }
    all
}

#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn day(at: RunTime) -> i64 {
    at.since_zero() / DAY
}

#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn hour(at: RunTime) -> f64 {
    (at.since_zero() % DAY).ratio(HOUR)
}
