//! Falls and similar activities in a room with two cameras and motion sensors: falls found by silhouettes, by passive sensors, and by
//! both, and false alarms.
//!
//! Each case takes place in a living room with a bed, an armchair and a table. A person falls in one of five ways and lies there for 2 to
//! 59 minutes, or does one of eight activities that look similar. Cameras sleep until a motion sensor wakes them. Detectors use both
//! cameras, one camera, the motion sensors, or both kinds of sensors. Each case is repeated without noise, with more noise, and behind
//! more furniture.
//!
//! An alarm finds a fall if it comes while the person lies there. False alarms a day follow from the share of cases with an alarm and from
//! the number of such activities a day, which is our choice; only the first alarm of a case counts. Alarms before a fall do not count.
//!
//! Rules may be fitted to cases from seed 1 on. The experiment uses cases from [`FIRST_SEED`] on.
//!
//! Left out: two people at once, poor light, and falls that start out of view of the cameras.

mod cases;
mod detectors;
mod intervals;
mod room;
mod weeks;

pub use cases::FallCase;
pub use detectors::{DETECTORS, DetectorSetup};
pub use room::Condition;
pub use weeks::{CameraHome, WeeksResult};

use crate::simulated::all_events;
use detectors::{FallDetector, settings};
use homebody::shared::TextTable;
use homebody_analysis::falls::rules::FallRules;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_picture::{TotalsLine, totals_chart};
use intervals::EventCount;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// The seed of the first case that counts; rules may be fitted to the cases before it.
pub const FIRST_SEED: u64 = 1001;

/// Time after the end of a case, so that the ground truth of the case is complete.
const AFTERWARDS: Span = SECOND.times(5);

#[derive(Clone, Debug, Serialize)]
pub struct DetectorRow {
    #[serde(flatten)]
    pub way: DetectorSetup,
    pub falls: u32,
    /// The share of falls that were found.
    pub sensitivity: f64,
    /// The interval of 95 % (Wilson 1927).
    pub sensitivity_interval: [f64; 2],
    pub false_alarms_per_day: f64,
    /// The interval of 95 %: exact Poisson limits of the sum of counts (Dobson et al. 1991).
    pub false_alarms_per_day_interval: [f64; 2],
    /// Median from a fall to its alarm; `None` without an alarm.
    pub seconds_to_alarm: Option<f64>,
    /// The interval of the median, by ranks.
    pub seconds_to_alarm_interval: Option<[f64; 2]>,
    /// The share of cases with an alarm, by kind of case.
    pub alarms: BTreeMap<&'static str, f64>,
    pub curve: Vec<(f64, f64)>,
}

#[derive(Clone, Debug, Serialize)]
pub struct FallsExperiment {
    pub cases: u32,
    pub seed: u64,
    pub rows: Vec<DetectorRow>,
    pub weeks: Vec<WeeksResult>,
}

/// For each setting, the seconds from the fall of a case to its alarm; 0 is an alarm without a fall.
type Outcome = Vec<Option<f64>>;

/// Simulates `cases` of each kind and some weeks of a home with cameras, and evaluates all detectors.
pub fn experiment(
    cases: u32,
    seed: u64,
    rules: &FallRules,
    (home, weeks): (&CameraHome, u32),
) -> Result<FallsExperiment, DriverError> {
    // The room is the same in all cases of a condition.
    let room = |way: &DetectorSetup| room::scenario(FallCase::Cat, 0, way.condition).0;
    let looks: Vec<FallDetector> =
        DETECTORS.iter().map(|way| FallDetector::new(*way, &room(way).home, rules)).collect();
    let of_kind = |case: FallCase| (0..u64::from(cases)).map(move |number| (case, seed + number));
    let all: Vec<(FallCase, u64)> = FallCase::ALL.into_iter().flat_map(of_kind).collect();
    let outcomes: Vec<Vec<Outcome>> = all.par_iter().map(|&(case, seed)| outcomes_of(case, seed, &looks)).collect();
    let row = |(index, &way): (usize, &DetectorSetup)| {
        let of_way = all.iter().zip(&outcomes).map(|(&(case, _), outcome)| (case, &outcome[index]));
        row(way, cases, &of_way.collect::<Vec<_>>())
    };
    let rows = DETECTORS.iter().enumerate().map(row).collect();
    Ok(FallsExperiment { cases, seed, rows, weeks: weeks::evaluate_weeks(home, weeks, seed, rules)? })
}

fn row(way: DetectorSetup, cases: u32, outcomes: &[(FallCase, &Outcome)]) -> DetectorRow {
    let alarms = |case: FallCase, setting: usize| {
        outcomes.iter().filter(|(of, outcome)| *of == case && outcome[setting].is_some()).count() as u32
    };
    let all = |is_fall: bool| FallCase::ALL.into_iter().filter(move |case| case.is_fall() == is_fall);
    let falls = cases * all(true).count() as u32;
    let found = |setting: usize| intervals::share(all(true).map(|case| alarms(case, setting)).sum(), falls);
    let wrong = |setting: usize| {
        let counted =
            |case: FallCase| EventCount { events: alarms(case, setting), days: f64::from(cases) / case.per_day() };
        intervals::per_day(&all(false).map(counted).collect::<Vec<_>>())
    };
    let times = outcomes.iter().filter(|(case, _)| case.is_fall()).filter_map(|(_, outcome)| outcome[0]);
    let after = intervals::median(times.collect());
    let (sensitivity, sensitivity_interval) = found(0);
    let (false_alarms_per_day, false_alarms_per_day_interval) = wrong(0);
    let mut curve: Vec<(f64, f64)> =
        (0..settings(way.method).len()).map(|setting| (wrong(setting).0, found(setting).0)).collect();
    curve.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1)));
    DetectorRow {
        way,
        falls,
        sensitivity,
        sensitivity_interval,
        false_alarms_per_day,
        false_alarms_per_day_interval,
        seconds_to_alarm: after.map(|(median, _)| median),
        seconds_to_alarm_interval: after.map(|(_, interval)| interval),
        alarms: FallCase::ALL
            .into_iter()
            .map(|case| (case.name(), f64::from(alarms(case, 0)) / f64::from(cases)))
            .collect(),
        curve,
    }
}

fn outcomes_of(case: FallCase, seed: u64, looks: &[FallDetector]) -> Vec<Outcome> {
    let mut outcomes = vec![Vec::new(); looks.len()];
    for condition in Condition::ALL {
        let (scenario, length_s) = room::scenario(case, seed, condition);
        let end = RunTime::START + Span::from_seconds(length_s) + AFTERWARDS;
        let events = simulate(&scenario, seed, end);
        let lies = weeks::lies(&events).first().copied();
        for (look, outcome) in looks.iter().zip(&mut outcomes).filter(|(look, _)| look.way.condition == condition) {
            let first = |alarms: Vec<RunTime>| match lies {
                Some(lie) => {
                    let of_it = alarms.into_iter().find(|alarm| (lie.begin..=lie.end).contains(alarm));
                    of_it.map(|alarm| (alarm - lie.begin).seconds())
                }
                None => alarms.first().map(|_| 0.0),
            };
            *outcome = look.alarms(&events, end).into_iter().map(first).collect();
        }
    }
    outcomes
}

fn simulate(scenario: &Scenario, seed: u64, end: RunTime) -> Events {
    let mut run = Run::new(scenario, &(), seed, end.since_zero());
    // A path contains no impossible step.
    all_events(&mut run).unwrap_or_default()
}

impl FallsExperiment {
    pub fn picture(&self) -> String {
        let usual = self.rows.iter().filter(|row| row.way.condition == Condition::Usual);
        let line = |row: &DetectorRow| {
            let points = row.curve.iter().map(|&(wrong, found)| (wrong, 100.0 * found));
            TotalsLine { label: row.way.name.into(), points: points.collect() }
        };
        let lines: Vec<TotalsLine> = usual.map(line).collect();
        let title = format!("Falls found and false alarms, {} cases of each kind", self.cases);
        totals_chart(&title, ["false alarms a day", "% of falls found"], &lines, None)
    }
}

impl fmt::Display for FallsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{} cases of each kind, from seed {}\n", self.cases, self.seed)?;
        let table = TextTable::new("-46 looked at by|18 falls found|24 false alarms a day|24 told after");
        f.write_str(&table.heading())?;
        for row in &self.rows {
            let [from, to] = row.sensitivity_interval.map(|share| 100.0 * share);
            let found = format!("{:.0} % [{from:.0} to {to:.0}]", 100.0 * row.sensitivity);
            let [least, most] = row.false_alarms_per_day_interval;
            let wrong = format!("{:.2} [{least:.2} to {most:.2}]", row.false_alarms_per_day);
            let after = row.seconds_to_alarm.zip(row.seconds_to_alarm_interval);
            let after =
                after.map_or("-".into(), |(median, [from, to])| format!("{median:.0} s [{from:.0} to {to:.0}]"));
            let name = format!("{}, {}", row.way.name, row.way.condition.name());
            f.write_str(&table.row(&[&name, &found, &wrong, &after]))?;
        }
        writeln!(f, "\nshare with an alarm in %, by what somebody does, in the order of these rows:")?;
        for case in FallCase::ALL {
            let shares: Vec<String> =
                self.rows.iter().map(|row| format!("{:>4.0}", 100.0 * row.alarms[case.name()])).collect();
            writeln!(f, "  {:24} {}", case.name(), shares.join(" "))?;
        }
        for of in &self.weeks {
            write!(f, "\n{of}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One case of each kind, under all conditions.
    #[test]
    fn cases_end_with_falls_in_the_ground_truth() {
        for case in FallCase::ALL {
            for condition in Condition::ALL {
                let (scenario, length_s) = room::scenario(case, 3, condition);
                let end = RunTime::START + Span::from_seconds(length_s) + AFTERWARDS;
                let events = simulate(&scenario, 3, end);
                let lies = weeks::lies(&events);
                assert_eq!(lies.len(), usize::from(case.is_fall()), "{case:?}");
                // A distant cat is too small for the cameras.
                let is_seen = !events.frames.is_empty() || case == FallCase::Cat;
                assert!(is_seen && !events.firings.is_empty(), "{case:?} {condition:?}");
                if let Some(lie) = lies.first() {
                    assert!((120.0..3541.0).contains(&lie.length().seconds()), "{case:?}: {lie:?}");
                }
            }
        }
    }

    #[test]
    fn finds_falls_in_view_of_two_cameras_without_alarms_for_sitting() {
        let rules = FallRules::default();
        let (scenario, _) = room::scenario(FallCase::FallsWalking, 2, Condition::Usual);
        let home = CameraHome { scenario: &scenario, drivers: &() };
        let lived = || experiment(1, 2, &rules, (&home, 1)).unwrap();
        let found = lived();
        assert_eq!(found.rows.len(), DETECTORS.len());
        let two = &found.rows[0];
        assert!(two.sensitivity >= 0.6 && two.seconds_to_alarm.unwrap() < 120.0, "{two:?}");
        assert_eq!(two.alarms["sits in the armchair"], 0.0, "{two:?}");
        // The result does not depend on the number of threads.
        assert_eq!(serde_json::to_string(&found).unwrap(), serde_json::to_string(&lived()).unwrap());
        // The week has one fall.
        assert_eq!((found.weeks[0].falls, found.weeks[0].found), (1, 1), "{:?}", found.weeks);
        let svg = found.picture();
        assert!(svg.contains("motion sensors") && svg.contains("false alarms a day"), "{svg}");
    }
}
