//! Evidence of a change, day by day: cumulative sums of likelihood ratios (Page 1954), one for each condition's pattern.
//!
//! A pattern says by how many standard deviations each measure of a day shifts, and how much each standard deviation weighs. The sum
//! of a pattern grows on days that fit it better than usual days or days with a harmless change, and is never below 0.

use super::patterns::{ConditionPattern, Distances, Patterns};
use homebody_core::statistics::mean;

/// Shares of a pattern's shifts that have a sum each (our choice): a change that begins, a mild one and a moderate one.
const SHARES: [f64; 3] = [0.3, 0.6, 1.0];
/// The most evidence of one day for or against a pattern (our choice).
const MOST_OF_A_DAY: f64 = 4.0;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    pub value: f64,
    /// The number of the first day since the sum was 0.
    pub since: usize,
}

impl Sum {
    pub fn add(&mut self, evidence: f64, day: usize) {
        if self.value <= 0.0 {
            self.since = day;
        }
        self.value = (self.value + evidence).max(0.0);
    }
}

/// The pattern of a condition with the most evidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leading {
    pub pattern: usize,
    pub share: usize,
    pub sum: Sum,
}

/// The evidence of a day, by pattern and share.
pub type DayEvidence = Vec<[f64; SHARES.len()]>;

/// The sums of all conditions' patterns.
#[derive(Clone, Debug)]
pub struct Sums(Vec<[Sum; SHARES.len()]>);

impl Sums {
    pub fn new(patterns: &Patterns) -> Sums {
        Sums(vec![Default::default(); patterns.conditions.len()])
    }

    pub fn add(&mut self, day: usize, evidence: &DayEvidence) {
        for (sums, evidence) in self.0.iter_mut().zip(evidence) {
            sums.iter_mut().zip(evidence).for_each(|(sum, evidence)| sum.add(*evidence, day));
        }
    }

    pub fn leading(&self) -> Option<Leading> {
        let all = self.0.iter().enumerate().flat_map(|(pattern, sums)| {
            sums.iter().enumerate().map(move |(share, sum)| Leading { pattern, share, sum: *sum })
        });
        all.max_by(|a, b| a.sum.value.total_cmp(&b.sum.value))
    }

    pub fn clear(&mut self) {
        self.0.fill(Default::default());
    }
}

impl Patterns {
    /// The evidence of a day for each condition, against usual days and harmless changes.
    pub(super) fn evidence(&self, distances: &Distances) -> DayEvidence {
        let harmless = self.harmless.iter().map(|pattern| pattern.evidence(distances, 1.0)).fold(0.0, f64::max);
        let limited = |evidence: f64| (evidence - harmless).clamp(-MOST_OF_A_DAY, MOST_OF_A_DAY);
        (self.conditions.iter())
            .map(|pattern| SHARES.map(|share| limited(pattern.evidence(distances, share))))
            .collect()
    }

    /// By condition, the mean evidence of some days at the share that fits best.
    pub(super) fn mean_evidence(&self, days: &[Distances]) -> Vec<f64> {
        let known = || days.iter().filter(|day| day.iter().any(Option::is_some));
        let of = |pattern: &ConditionPattern, share: f64| {
            mean(&known().map(|day| pattern.evidence(day, share)).collect::<Vec<f64>>()).unwrap_or(0.0)
        };
        let best = |pattern: &ConditionPattern| SHARES.map(|share| of(pattern, share)).into_iter().fold(0.0, f64::max);
        self.conditions.iter().map(best).collect()
    }
}

/// The mean distances of some days, by measure.
pub fn mean_distances(days: &[Distances]) -> Distances {
    let measures = days.first().map_or(0, Vec::len);
    let of = |measure: usize| mean(&days.iter().filter_map(|day| day[measure]).collect::<Vec<f64>>());
    (0..measures).map(of).collect()
}

/// The distances of a day from the means of other days.
pub fn beyond(distances: &Distances, means: &Distances) -> Distances {
    distances.iter().zip(means).map(|(distance, mean)| Some((*distance)? - mean.unwrap_or(0.0))).collect()
}
