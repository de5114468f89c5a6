//! The apartment of the example, with a routine from the test.

use homebody_core::event::{Events, Fact};
use homebody_core::geometry::Point;
use homebody_core::ids::ResidentId;
use homebody_core::motion::MotionState;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, HOUR, Interval, RunTime, Span};
use homebody_routine::household::Household;
use homebody_routine::routine::Routine;
use std::collections::BTreeMap;

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
pub fn run(routine: &str, days: i64) -> Run {
    let (scenario, household) = household(&files(routine, &[]), &[]).unwrap();
    Run::new(&scenario, &household, scenario.file.seed, days * DAY)
}

/// All events of the rest of a run, advanced in steps.
pub fn events(mut run: Run, step: Span) -> Events {
    let mut events = Events::default();
    let end = RunTime::START + run.length();
    while run.now() < end {
        run.advance(run.now() + step, &mut events).unwrap();
    }
    events
}

/// Intervals and labels of a resident's activities.
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

/// The starts of an activity of the first resident in so many days.
pub fn starts(events: &Events, days: i64, name: &str) -> Vec<RunTime> {
    let lived = activities(events, 0, days * DAY);
    lived.into_iter().filter(|(_, what)| what == name).map(|(time, _)| time.begin).collect()
}

pub fn day(at: RunTime) -> i64 {
    at.since_zero() / DAY
}

pub fn hour(at: RunTime) -> f64 {
    (at.since_zero() % DAY).ratio(HOUR)
}

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Days in UTC from a Monday in January, with the activities of the first resident.
pub struct Simulated {
    pub days: i64,
    pub events: Events,
    pub activities: Vec<(Interval<RunTime>, String)>,
    pub places: Vec<(String, Point)>,
    /// By index, as in facts.
    pub things: Vec<String>,
}

impl Simulated {
    pub fn new(routine: &str, days: i64) -> Simulated {
        Simulated::of_changed(routine, days, |_| {})
    }

    /// With values that no sentence gives.
    pub fn of_changed(routine: &str, days: i64, change: impl FnOnce(&mut Routine)) -> Simulated {
        Simulated::of_files(files(routine, &[]), days, change)
    }

    pub fn of_files(mut files: BTreeMap<String, String>, days: i64, change: impl FnOnce(&mut Routine)) -> Simulated {
        let scenario = files["scenario.json"].replace("America/Chicago", "UTC").replace("2009-03-02", "2009-01-05");
        files.insert("scenario.json".into(), scenario);
        let (scenario, household) = household(&files, &[]).unwrap_or_else(|problems| panic!("{problems}"));
        let mut routine = household.routine(0).cloned().unwrap();
        change(&mut routine);
        let household = household.with_routine(0, routine);
        let events = events(Run::new(&scenario, &household, 11, days * DAY), DAY);
        let activities = activities(&events, 0, days * DAY);
        let plan = scenario.home.plan();
        let things = plan.things.iter().map(|thing| thing.name.clone()).collect();
        Simulated { days, events, activities, places: plan.places.clone(), things }
    }

    /// The times of an activity.
    pub fn of<'a>(&'a self, name: &'a str) -> impl Iterator<Item = Interval<RunTime>> + 'a {
        self.activities.iter().filter(move |(_, what)| what == name).map(|(time, _)| *time)
    }

    /// The first beginning of an activity on each day that has it.
    pub fn firsts(&self, name: &str) -> Vec<RunTime> {
        let mut all: Vec<RunTime> = self.of(name).map(|one| one.begin).collect();
        all.dedup_by_key(|at| day(*at));
        all
    }

    /// How far the first resident walks on each day.
    pub fn metres_by_day(&self) -> Vec<f64> {
        let mut metres = vec![0.0; self.days as usize];
        for fact in &self.events.facts {
            if let Fact::Movement { resident, begin, doing: MotionState::Stride { from, to }, .. } = fact
                && resident.index() == 0
            {
                metres[day(*begin) as usize] += from.distance(*to);
            }
        }
        metres
    }
}
