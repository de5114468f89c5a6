//! Figures of a span of a log, from which a forest tells whose it is.

use super::firings::MotionFirings;
use super::measures::{TOGETHER, is_together, quantile};
use homebody_core::time::{HOUR, Interval, MINUTE, Span, WallTime};
use std::collections::BTreeSet;

/// The value of an unknown figure, such as the gaps of an hour without firings.
const UNKNOWN: f64 = -1.0;

/// Number of sensors, those with the most firings, whose shares are figures.
const MOST_SENSORS: usize = 24;

/// Silence that ends a burst.
const BURST: Span = MINUTE;

/// The figures of rows: they are the same for both logs.
pub struct DayFigures {
    /// The sensors whose shares count, by name.
    sensors: Vec<String>,
    /// Both logs have the lengths of ONs.
    with_on: bool,
    of_days: bool,
}

impl DayFigures {
    pub fn from_firings(logs: [&MotionFirings; 2], of_days: bool) -> DayFigures {
        let counts = logs.map(MotionFirings::counts);
        let both = counts[0].iter().filter_map(|(name, a)| Some((a + counts[1].get(name)?, (*name).to_owned())));
        let mut sensors: Vec<(f64, String)> = both.collect();
        sensors.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
        let sensors = sensors.into_iter().take(MOST_SENSORS).map(|(_, name)| name).collect();
        DayFigures { sensors, with_on: logs.iter().all(|log| !log.on.is_empty()), of_days }
    }

    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = [
            "firings",
            "short gaps (10th percentile)",
            "median gap",
            "long gaps (90th percentile)",
            "longest silence",
            "sensors that fired",
            "share of firings that repeat the sensor before",
            "share of firings beside another sensor's within 3 s",
            "median time to the same sensor's next firing",
            "bursts",
            "firings a burst",
        ]
        .map(String::from)
        .into();
        if self.with_on {
            names.extend(
                ["short ONs (10th percentile)", "median ON", "long ONs (90th percentile)", "share of ON time shared"]
                    .map(String::from),
            );
        }
        if self.of_days {
            names.extend((0..8).map(|block| format!("firings from {} to {} h", block * 3, block * 3 + 3)));
            names.extend(["empty hours", "spread of the hours' firings"].map(String::from));
        } else {
            names.push("hour of the day".into());
        }
        names.extend(self.sensors.iter().map(|sensor| format!("share of {sensor}")));
        names
    }

    /// The figures of an interval, in the order of their names.
    pub fn row(&self, log: &MotionFirings, span: Interval<WallTime>) -> Vec<f64> {
        let firings = log.firings_in(span);
        let mut row = vec![firings.len() as f64];
        let gaps = sorted(firings.windows(2).map(|pair| (pair[1].0 - pair[0].0).seconds()));
        row.extend([0.1, 0.5, 0.9].map(|share| quantile(&gaps, share).unwrap_or(UNKNOWN)));
        let ends = [span.begin].into_iter().chain(firings.iter().map(|firing| firing.0)).chain([span.end]);
        let ends: Vec<WallTime> = ends.collect();
        row.push(ends.windows(2).map(|pair| (pair[1] - pair[0]).seconds()).fold(0.0, f64::max));
        row.push(firings.iter().map(|firing| firing.1).collect::<BTreeSet<_>>().len() as f64);
        let pairs = firings.len().saturating_sub(1);
        row.push(share(firings.windows(2).filter(|pair| pair[0].1 == pair[1].1).count(), pairs));
        let beside = (0..firings.len()).filter(|&index| is_together(firings, index, TOGETHER)).count();
        row.push(share(beside, firings.len()));
        let mut last = vec![None; log.sensors.len()];
        let again = firings.iter().filter_map(|&(at, sensor)| Some((at - last[sensor].replace(at)?).seconds()));
        row.push(quantile(&sorted(again), 0.5).unwrap_or(UNKNOWN));
        let bursts = firings.windows(2).filter(|pair| pair[1].0 - pair[0].0 > BURST).count();
        let bursts = bursts + usize::from(!firings.is_empty());
        row.extend([bursts as f64, share(firings.len(), bursts)]);
        if self.with_on {
            let on = log.on_in(span);
            let lengths = sorted(on.iter().map(|(on, _)| on.length().seconds()));
            row.extend([0.1, 0.5, 0.9].map(|share| quantile(&lengths, share).unwrap_or(UNKNOWN)));
            row.push(shared(on));
        }
        if self.of_days {
            let block = |number: i64| Interval::starting(span.begin + number * 3 * HOUR, 3 * HOUR);
            row.extend((0..8).map(|number| log.firings_in(block(number)).len() as f64));
            let hour = |number: i64| Interval::starting(span.begin + number * HOUR, HOUR);
            let counts: Vec<f64> = (0..24).map(|number| log.firings_in(hour(number)).len() as f64).collect();
            row.push(counts.iter().filter(|&&count| count == 0.0).count() as f64);
            row.push(super::measures::spread(&counts).unwrap_or(UNKNOWN));
        } else {
            row.push((span.begin.time_of_day() / HOUR) as f64);
        }
        let of = |name: &String| firings.iter().filter(|firing| log.sensors[firing.1] == *name).count();
        row.extend(self.sensors.iter().map(|name| share(of(name), firings.len())));
        row
    }
}

/// The share of the time with a sensor ON in which another is ON, too.
fn shared(on: &[(Interval<WallTime>, usize)]) -> f64 {
    let [one, two, more] = super::measures::at_once(on);
    let whole = one + two + more;
    if whole > 0.0 { (two + more) / whole } else { UNKNOWN }
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

fn share(of: usize, all: usize) -> f64 {
    if all == 0 { UNKNOWN } else { of as f64 / all as f64 }
}
