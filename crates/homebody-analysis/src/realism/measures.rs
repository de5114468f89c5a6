//! The measures by themselves: distances of two logs, and figures of one.

use super::firings::MotionFirings;
use crate::compare::distance;
use homebody_core::statistics::{mean, sd};
use homebody_core::time::{HOUR, Interval, MINUTE, SECOND, Span, WallTime};
use std::collections::BTreeMap;

/// Longest time between firings that are together.
pub const TOGETHER: Span = SECOND.times(3);

/// Longest time of a way from one sensor to another.
const ON_THE_WAY: Span = MINUTE;

pub fn gaps(log: &MotionFirings) -> Vec<Span> {
    log.firings.windows(2).map(|pair| pair[1].0 - pair[0].0).collect()
}

pub fn refires(log: &MotionFirings) -> Vec<Span> {
    let mut last = vec![None; log.sensors.len()];
    log.firings.iter().filter_map(|&(at, sensor)| Some(at - last[sensor].replace(at)?)).collect()
}

pub fn on_lengths(log: &MotionFirings) -> Vec<Span> {
    log.on.iter().map(|(on, _)| on.length()).collect()
}

pub fn firings_a_day(log: &MotionFirings) -> Vec<usize> {
    log.each_day().map(|day| log.firings_in(day).len()).collect()
}

pub fn ks<T: Copy + Ord>(of: fn(&MotionFirings) -> Vec<T>, logs: [&MotionFirings; 2]) -> Option<f64> {
    distance(logs.map(of))
}

pub fn profile(log: &MotionFirings) -> [f64; 24] {
    let mut hours = [0.0; 24];
    for (index, hour) in log.each_hour().enumerate() {
        hours[index % 24] += log.firings_in(hour).len() as f64 / log.days_count() as f64;
    }
    hours
}

pub fn hours_apart(logs: [&MotionFirings; 2]) -> Option<f64> {
    let [a, b] = logs.map(profile);
    jensen_shannon(a.into_iter().zip(b))
}

/// Sensors of the same name have at least half of the firings of both logs, so that their names can be compared.
pub fn names_agree(logs: [&MotionFirings; 2]) -> bool {
    let counts = logs.map(MotionFirings::counts);
    let agrees = |which: usize| {
        let own = &counts[which];
        let known: f64 = own.iter().filter(|(name, _)| counts[1 - which].contains_key(*name)).map(|(_, n)| n).sum();
        known > 0.0 && known * 2.0 >= own.values().sum::<f64>()
    };
    agrees(0) && agrees(1)
}

pub fn shares_apart(logs: [&MotionFirings; 2]) -> Option<f64> {
    names_agree(logs).then(|| jensen_shannon_of(&logs.map(MotionFirings::counts)))?
}

pub fn ways_apart(logs: [&MotionFirings; 2]) -> Option<f64> {
    names_agree(logs).then(|| jensen_shannon_of(&logs.map(ways)))?
}

fn ways(log: &MotionFirings) -> BTreeMap<(&str, &str), f64> {
    let mut ways = BTreeMap::new();
    for pair in log.firings.windows(2) {
        if pair[0].1 != pair[1].1 && pair[1].0 - pair[0].0 <= ON_THE_WAY {
            *ways.entry((log.sensors[pair[0].1].as_str(), log.sensors[pair[1].1].as_str())).or_insert(0.0) += 1.0;
        }
    }
    ways
}

/// The distance of the times in which one, two, and three and more sensors are ON at once.
pub fn at_once_apart(logs: [&MotionFirings; 2]) -> Option<f64> {
    let [a, b] = logs.map(|log| at_once(&log.on));
    jensen_shannon(a.into_iter().zip(b))
}

/// The seconds in which exactly one, exactly two, and three and more sensors are ON.
pub fn at_once(on: &[(Interval<WallTime>, usize)]) -> [f64; 3] {
    let mut turns: Vec<(WallTime, i32)> = on.iter().flat_map(|(on, _)| [(on.begin, 1), (on.end, -1)]).collect();
    turns.sort_unstable();
    let (mut spans, mut count, mut since) = ([0.0; 3], 0_i32, WallTime::EPOCH);
    for (at, change) in turns {
        if count > 0 {
            spans[(count as usize - 1).min(2)] += (at - since).seconds();
        }
        (count, since) = (count + change, at);
    }
    spans
}

/// Another sensor fires within `span` of a firing.
pub fn is_together(firings: &[(WallTime, usize)], index: usize, span: Span) -> bool {
    let (at, sensor) = firings[index];
    let before = firings[..index].iter().rev().take_while(|firing| at - firing.0 <= span);
    let after = firings[index + 1..].iter().take_while(|firing| firing.0 - at <= span);
    before.chain(after).any(|firing| firing.1 != sensor)
}

/// The share of firings with another sensor's near them.
pub fn together(log: &MotionFirings) -> Option<f64> {
    let beside = (0..log.firings.len()).filter(|&index| is_together(&log.firings, index, TOGETHER)).count();
    (!log.firings.is_empty()).then(|| beside as f64 / log.firings.len() as f64)
}

pub fn empty_hours(log: &MotionFirings) -> Option<f64> {
    let empty = log.each_hour().filter(|hour| log.firings_in(*hour).is_empty()).count();
    (log.days_count() > 0).then(|| empty as f64 / (24 * log.days_count()) as f64)
}

/// By day, the firings an hour, of hours with firings; `None` for a day without firings.
fn liveliness(log: &MotionFirings) -> Vec<Option<f64>> {
    let of = |day: Interval<WallTime>| {
        let hours = (0..24).map(|hour| Interval::starting(day.begin + hour * HOUR, HOUR));
        let lively = hours.filter(|&hour| !log.firings_in(hour).is_empty()).count();
        (lively > 0).then(|| log.firings_in(day).len() as f64 / lively as f64)
    };
    log.each_day().map(of).collect()
}

/// The differences between days: the standard deviation of their liveliness over its mean.
pub fn days_differ(log: &MotionFirings) -> Option<f64> {
    spread(&liveliness(log).into_iter().flatten().collect::<Vec<f64>>())
}

/// The similarity of days to the day before: the correlation of their liveliness, with four pairs or more.
pub fn days_follow(log: &MotionFirings) -> Option<f64> {
    let pairs: Vec<(f64, f64)> = liveliness(log).windows(2).filter_map(|pair| pair[0].zip(pair[1])).collect();
    if pairs.len() < 4 {
        return None;
    }
    let mean = |of: fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
    let (a, b) = (mean(|pair| pair.0), mean(|pair| pair.1));
    let sum = |of: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>();
    let both = sum(&|pair| (pair.0 - a) * (pair.1 - b));
    let each = sum(&|pair| (pair.0 - a) * (pair.0 - a)) * sum(&|pair| (pair.1 - b) * (pair.1 - b));
    (each > 0.0).then(|| both / each.sqrt())
}

/// The standard deviation over the mean.
pub fn spread(values: &[f64]) -> Option<f64> {
    let mean = mean(values).filter(|mean| *mean > 0.0)?;
    Some(sd(values)? / mean)
}

/// A quantile of a sorted sample: the value at the share, rounded down.
pub fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    sorted.get(((sorted.len() as f64 * share) as usize).min(sorted.len().saturating_sub(1))).copied()
}

fn jensen_shannon_of<K: Ord>(counts: &[BTreeMap<K, f64>; 2]) -> Option<f64> {
    let of_a = counts[0].iter().map(|(key, &a)| (a, counts[1].get(key).copied().unwrap_or(0.0)));
    let of_b = counts[1].iter().filter(|(key, _)| !counts[0].contains_key(key)).map(|(_, &b)| (0.0, b));
    jensen_shannon(of_a.chain(of_b).collect::<Vec<_>>().into_iter())
}

/// The Jensen-Shannon distance of two rows of weights: the root of the divergence, in bits; 0 is equal, 1 has nothing in
/// common. Nothing where a row has no weight.
pub fn jensen_shannon(weights: impl Iterator<Item = (f64, f64)> + Clone) -> Option<f64> {
    let (whole_a, whole_b) = weights.clone().fold((0.0, 0.0), |(a, b), (x, y)| (a + x, b + y));
    if whole_a <= 0.0 || whole_b <= 0.0 {
        return None;
    }
    let term = |p: f64, middle: f64| if p > 0.0 { p * (p / middle).log2() } else { 0.0 };
    let divergence: f64 = weights
        .map(|(a, b)| (a / whole_a, b / whole_b))
        .map(|(p, q)| (term(p, (p + q) / 2.0) + term(q, (p + q) / 2.0)) / 2.0)
        .sum();
    Some(divergence.max(0.0).sqrt())
}
