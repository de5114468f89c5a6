//! Explanation of a log by the log of a repeated simulation, sensor by sensor.
//!
//! | measure | definition |
//! |---|---|
//! | explained | the share of a sensor's firings for which the same sensor fires in the other log at most 10 s away; each firing explains one |
//! | invented | the share of the other log's firings of that sensor that explain none |
//!
//! A firing is a row that means a beginning. Both logs name their sensors alike and have the same clock.

use crate::compare::begins;
use homebody_core::time::{SECOND, Span, WallTime};
use homebody_log::Log;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// Longest time between two firings that count as one (our choice): sensors look again every 6 to 8 s at a person who
/// keeps moving.
pub const NEAR: Span = SECOND.times(10);

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explained {
    pub sensors: Vec<SensorExplained>,
    pub all: ExplainedCounts,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorExplained {
    pub sensor: String,
    #[serde(flatten)]
    pub counts: ExplainedCounts,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ExplainedCounts {
    pub real: u64,
    pub relived: u64,
    pub matched: u64,
}

impl ExplainedCounts {
    /// The share of the real firings that are explained; `None` without real firings.
    pub fn explained(&self) -> Option<f64> {
        (self.real > 0).then(|| self.matched as f64 / self.real as f64)
    }

    /// The share of the other log's firings that explain no firing; `None` if it has no firing.
    pub fn invented(&self) -> Option<f64> {
        (self.relived > 0).then(|| (self.relived - self.matched) as f64 / self.relived as f64)
    }
}

pub fn explained(real: &Log, relived: &Log) -> Explained {
    let mut times: BTreeMap<&str, [Vec<WallTime>; 2]> = BTreeMap::new();
    for (number, log) in [real, relived].into_iter().enumerate() {
        for event in log.events.iter().filter(|event| begins(log.value(event))) {
            times.entry(log.sensor(event)).or_default()[number].push(event.at);
        }
    }
    let of = |(sensor, mut times): (&str, [Vec<WallTime>; 2])| {
        times.iter_mut().for_each(|times| times.sort_unstable());
        let [real, relived] = times.each_ref().map(|times| times.len() as u64);
        let counts = ExplainedCounts { real, relived, matched: matched(&times) };
        SensorExplained { sensor: sensor.to_owned(), counts }
    };
    let sensors: Vec<SensorExplained> = times.into_iter().map(of).collect();
    let mut all = ExplainedCounts::default();
    for SensorExplained { counts, .. } in &sensors {
        all.real += counts.real;
        all.relived += counts.relived;
        all.matched += counts.matched;
    }
    Explained { sensors, all }
}

/// The number of first times with one of the second near them; each of these counts once.
fn matched([real, relived]: &[Vec<WallTime>; 2]) -> u64 {
    let (mut count, mut next) = (0, 0);
    for &at in real {
        while relived.get(next).is_some_and(|&other| other < at - NEAR) {
            next += 1;
        }
        if relived.get(next).is_some_and(|&other| other <= at + NEAR) {
            count += 1;
            next += 1;
        }
    }
    count
}

impl fmt::Display for Explained {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let share = |share: Option<f64>| share.map_or("-".into(), |share| format!("{share:.2}"));
        let width = self.sensors.iter().map(|sensor| sensor.sensor.chars().count()).max().unwrap_or(0).max(3);
        writeln!(f, "{:width$}  {:>9}  {:>9}  {:>9}  {:>9}", "", "firings", "relived", "explained", "invented")?;
        let line = |f: &mut fmt::Formatter, name: &str, counts: &ExplainedCounts| {
            let ExplainedCounts { real, relived, .. } = counts;
            let (explained, invented) = (share(counts.explained()), share(counts.invented()));
            writeln!(f, "{name:width$}  {real:>9}  {relived:>9}  {explained:>9}  {invented:>9}")
        };
        self.sensors.iter().try_for_each(|sensor| line(f, &sensor.sensor, &sensor.counts))?;
        line(f, "all", &self.all)?;
        write!(
            f,
            "\nA firing is explained where the same sensor fires within {} s when the path is lived again.",
            NEAR.seconds()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_firing_explains_one_at_most() {
        let at = |seconds: &[i64]| seconds.iter().copied().map(crate::sample::at).collect::<Vec<WallTime>>();
        assert_eq!(matched(&[at(&[0, 5, 100]), at(&[3])]), 1);
        assert_eq!(matched(&[at(&[0, 5, 100]), at(&[3, 4, 111])]), 2);
        assert_eq!(matched(&[at(&[0, 5, 100]), at(&[3, 4, 110])]), 3);
        assert_eq!(matched(&[at(&[]), at(&[3])]), 0);
    }

    #[test]
    fn shares_are_of_their_own_log() {
        let counts = ExplainedCounts { real: 10, relived: 16, matched: 8 };
        assert_eq!((counts.explained(), counts.invented()), (Some(0.8), Some(0.5)));
        assert_eq!((ExplainedCounts::default().explained(), ExplainedCounts::default().invented()), (None, None));
    }
}
