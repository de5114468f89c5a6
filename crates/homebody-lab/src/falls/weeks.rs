//! Weeks of a simulated home with cameras: detected falls and false alarms.
//!
//! The number of similar activities follows from the routine of the resident. An alarm is false if no person lies on the floor, or if it
//! comes later than [`LATE`] after the person got up. Alarms within [`ONE`] of each other count once.

use super::detectors::{DetectorSetup, FallDetector, Method, way};
use super::intervals::{poisson_exact, share};
use super::room::Condition;
use crate::simulated::all_events;
use homebody_analysis::falls::rules::FallRules;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::{Events, Fact};
use homebody_core::posture::Posture;
use homebody_core::run::{DriverProvider, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, Interval, MINUTE, RunTime, SECOND, Span, joined};
use rayon::prelude::*;
use serde::Serialize;
use std::fmt;

/// An alarm this long after a person got up still belongs to the fall.
const LATE: Span = SECOND.times(5);

/// Alarms within this time count as one.
const ONE: Span = MINUTE.times(10);

const WEEK: Span = DAY.times(7);

pub struct CameraHome<'a> {
    pub scenario: &'a Scenario,
    pub drivers: &'a (dyn DriverProvider + Sync),
}

#[derive(Clone, Debug, Serialize)]
pub struct WeeksResult {
    #[serde(flatten)]
    pub way: DetectorSetup,
    pub days: u32,
    pub falls: u32,
    /// Falls with an alarm while the person lay there.
    pub found: u32,
    /// The interval of 95 % of the share of detected falls (Wilson 1927).
    pub sensitivity_interval: [f64; 2],
    /// Alarms without a fall.
    pub false_alarms: u32,
    pub false_alarms_per_day: f64,
    /// The exact interval of 95 % (Garwood 1936).
    pub false_alarms_per_day_interval: [f64; 2],
}

const ALL: [DetectorSetup; 3] = [
    way(Method::Silhouettes, &[0, 1, 2], "all cameras", Condition::Usual),
    way(Method::Passive, &[], "motion sensors", Condition::Usual),
    way(Method::Fused, &[0, 1, 2], "cameras and motion", Condition::Usual),
];

/// Simulates some weeks, each with its own seed, and searches them for falls.
pub(super) fn evaluate_weeks(
    home: &CameraHome,
    weeks: u32,
    seed: u64,
    rules: &FallRules,
) -> Result<Vec<WeeksResult>, DriverError> {
    let looks = ALL.map(|way| FallDetector::new(way, &home.scenario.home, rules));
    let seeds: Vec<u64> = (0..u64::from(weeks)).map(|week| seed + week).collect();
    let lived = |&seed: &u64| -> Result<Vec<[u32; 3]>, DriverError> {
        let mut run = Run::new(home.scenario, home.drivers, seed, WEEK);
        let events = all_events(&mut run)?;
        let lies = lies(&events);
        Ok(looks.iter().map(|look| count_alarms(&lies, &look.alarms(&events, RunTime::START + WEEK)[0])).collect())
    };
    let all = seeds.par_iter().map(lived).collect::<Result<Vec<_>, _>>()?;
    let of = |(index, look): (usize, &FallDetector)| {
        let [falls, found, false_alarms] = [0, 1, 2].map(|what| all.iter().map(|week| week[index][what]).sum::<u32>());
        let days = 7 * weeks;
        let a_day = |count: f64| count / f64::from(days);
        WeeksResult {
            way: look.way,
            days,
            falls,
            found,
            sensitivity_interval: if falls > 0 { share(found, falls).1 } else { [0.0, 1.0] },
            false_alarms,
            false_alarms_per_day: a_day(false_alarms.into()),
            false_alarms_per_day_interval: poisson_exact(false_alarms).map(a_day),
        }
    };
    Ok(if weeks == 0 { Vec::new() } else { looks.iter().enumerate().map(of).collect() })
}

fn count_alarms(lies: &[Interval<RunTime>], alarms: &[RunTime]) -> [u32; 3] {
    let is_of = |lie: &Interval<RunTime>, at: RunTime| (lie.begin..=lie.end + LATE).contains(&at);
    let found = lies.iter().filter(|lie| alarms.iter().any(|&at| is_of(lie, at))).count();
    let (mut wrong, mut last) = (0, None);
    for &at in alarms.iter().filter(|&&at| !lies.iter().any(|lie| is_of(lie, at))) {
        wrong += u32::from(last.is_none_or(|last| at - last > ONE));
        last = Some(at);
    }
    [lies.len() as u32, found as u32, wrong]
}

/// The intervals in which the person lay on the floor, by the ground truth.
pub(super) fn lies(events: &Events) -> Vec<Interval<RunTime>> {
    let down = |fact: &Fact| match *fact {
        Fact::Movement { begin, end, posture: Posture::Down, .. } => Some(Interval::new(begin, end)),
        _ => None,
    };
    joined(events.facts.iter().filter_map(down), Span::ZERO)
}

impl fmt::Display for WeeksResult {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let WeeksResult { way, days, falls, found, false_alarms, false_alarms_per_day: a_day, .. } = self;
        let [least, most] = self.false_alarms_per_day_interval;
        write!(
            f,
            "{days} days of a life, {}: {found} of {falls} falls found, {false_alarms} false alarms, ",
            way.name
        )?;
        write!(f, "{a_day:.2} a day [{least:.2} to {most:.2}]")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alarms_during_a_lie_find_it_and_all_others_are_false() {
        let at = |seconds: i64| RunTime::START + seconds * SECOND;
        let lies = [Interval::new(at(100), at(200)), Interval::new(at(5000), at(6000))];
        let alarms = [at(50), at(150), at(204), at(1000), at(1300), at(3000)];
        // At 1000 and 1300 s it is one; 204 s is still of the first.
        assert_eq!(count_alarms(&lies, &alarms), [2, 1, 3]);
    }
}
