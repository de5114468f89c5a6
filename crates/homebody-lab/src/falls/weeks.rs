//! Weeks of a life in a home with cameras: what is told of falls in them, and how often for nothing.
//!
//! Here nobody guesses how often somebody bends or sits down: they live by a routine. An alarm while nobody lies on the floor is
//! a false one, and so is one later than [`LATE`] after they rose; alarms within [`ONE`] of each other count once.

use super::intervals::{poisson_exact, share};
use super::look::{Look, Method, Way, way};
use super::room::Condition;
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

/// An alarm so long after somebody rose is still of their fall.
const LATE: Span = SECOND.times(5);

/// Alarms within so long are one.
const ONE: Span = MINUTE.times(10);

const WEEK: Span = DAY.times(7);

/// A home with cameras, and the lives in it.
pub struct Home<'a> {
    /// The home.
    pub scenario: &'a Scenario,
    /// Who lives there, and how.
    pub drivers: &'a (dyn DriverProvider + Sync),
}

/// What was told in weeks of a life.
#[derive(Clone, Debug, Serialize)]
pub struct OfWeeks {
    /// The way of looking.
    #[serde(flatten)]
    pub way: Way,
    /// How many days were lived.
    pub days: u32,
    /// How often somebody fell.
    pub falls: u32,
    /// How many of these falls were told of while they lay there.
    pub found: u32,
    /// The interval of 95 % of that share (Wilson 1927).
    pub sensitivity_interval: [f64; 2],
    /// How many alarms there were for nothing.
    pub false_alarms: u32,
    /// The same a day.
    pub false_alarms_per_day: f64,
    /// Its exact interval of 95 % (Garwood 1936).
    pub false_alarms_per_day_interval: [f64; 2],
}

const ALL: [Way; 3] = [
    way(Method::Silhouettes, &[0, 1, 2], "all cameras", Condition::Usual),
    way(Method::Passive, &[], "motion sensors", Condition::Usual),
    way(Method::Fused, &[0, 1, 2], "cameras and motion", Condition::Usual),
];

/// Simulates some weeks, each with its own seed, and searches them for falls.
pub(super) fn looked_at(home: &Home, weeks: u32, seed: u64, rules: &FallRules) -> Result<Vec<OfWeeks>, DriverError> {
    let looks = ALL.map(|way| Look::new(way, &home.scenario.home, rules));
    let seeds: Vec<u64> = (0..u64::from(weeks)).map(|week| seed + week).collect();
    let lived = |&seed: &u64| -> Result<Vec<[u32; 3]>, DriverError> {
        let mut run = Run::new(home.scenario, home.drivers, seed, WEEK);
        let mut events = Events::default();
        let end = RunTime::START + WEEK;
        run.advance(end, &mut events)?;
        let lies = lies(&events);
        Ok(looks.iter().map(|look| counted(&lies, &look.alarms(&events, end)[0])).collect())
    };
    let all = seeds.par_iter().map(lived).collect::<Result<Vec<_>, _>>()?;
    let of = |(index, look): (usize, &Look)| {
        let [falls, found, false_alarms] = [0, 1, 2].map(|what| all.iter().map(|week| week[index][what]).sum::<u32>());
        let days = 7 * weeks;
        let a_day = |count: f64| count / f64::from(days);
        OfWeeks {
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

/// The falls, the falls that were found, and the false alarms.
fn counted(lies: &[Interval<RunTime>], alarms: &[RunTime]) -> [u32; 3] {
    let is_of = |lie: &Interval<RunTime>, at: RunTime| (lie.begin..=lie.end + LATE).contains(&at);
    let found = lies.iter().filter(|lie| alarms.iter().any(|&at| is_of(lie, at))).count();
    let (mut wrong, mut last) = (0, None);
    for &at in alarms.iter().filter(|&&at| !lies.iter().any(|lie| is_of(lie, at))) {
        wrong += u32::from(last.is_none_or(|last| at - last > ONE));
        last = Some(at);
    }
    [lies.len() as u32, found as u32, wrong]
}

/// The intervals in which the person lay on the floor, by the truth.
pub(super) fn lies(events: &Events) -> Vec<Interval<RunTime>> {
    let down = |fact: &Fact| match *fact {
        Fact::Movement { begin, end, posture: Posture::Down, .. } => Some(Interval::new(begin, end)),
        _ => None,
    };
    joined(events.facts.iter().filter_map(down), Span::ZERO)
}

impl fmt::Display for OfWeeks {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let OfWeeks { way, days, falls, found, false_alarms, false_alarms_per_day: a_day, .. } = self;
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
        assert_eq!(counted(&lies, &alarms), [2, 1, 3]);
    }
}
