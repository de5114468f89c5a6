//! Evidence of a change, day by day: cumulative sums of likelihood ratios (Page 1954), one for each pattern.
//!
//! A pattern says by how many standard deviations each measure of a day shifts, and how much each standard deviation weighs. The sum
//! of a pattern grows on days that fit it better than usual days, and is never below 0.

use super::patterns::{Pattern, Patterns};
use crate::measures::{DailyMeasure, MEASURES};

/// The distances of a day's measures from the usual ones, in standard deviations, by measure.
pub type Distances = Vec<Option<f64>>;

/// Shares of a pattern's shifts that have a sum each: a mild change and a moderate one (our choice).
pub const AMPLITUDES: [f64; 2] = [0.5, 1.0];
/// Evidence of one day for or against a pattern, at most (our choice): no single day decides.
const MOST_OF_A_DAY: f64 = 3.0;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    pub value: f64,
    /// The number of the first day since the sum was 0.
    pub since: Option<usize>,
}

impl Sum {
    pub fn add(&mut self, evidence: f64, day: usize) {
        self.value += evidence;
        if self.value <= 0.0 {
            *self = Sum::default();
        } else {
            self.since.get_or_insert(day);
        }
    }
}

/// The pattern with the most evidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leading {
    pub pattern: usize,
    pub amplitude: f64,
    pub sum: Sum,
}

/// The sums of all patterns.
#[derive(Clone, Debug)]
pub struct Sums<'a> {
    patterns: &'a Patterns,
    /// By pattern, by amplitude.
    sums: Vec<[Sum; AMPLITUDES.len()]>,
}

impl<'a> Sums<'a> {
    pub fn new(patterns: &'a Patterns) -> Sums<'a> {
        Sums { patterns, sums: vec![Default::default(); patterns.patterns.len()] }
    }

    pub fn take(&mut self, day: usize, distances: &Distances) {
        for (pattern, sums) in self.patterns.patterns.iter().zip(&mut self.sums) {
            for (sum, amplitude) in sums.iter_mut().zip(AMPLITUDES) {
                sum.add(pattern.evidence(distances, amplitude), day);
            }
        }
    }

    pub fn leading(&self) -> Option<Leading> {
        let all = self.sums.iter().enumerate().flat_map(|(pattern, sums)| {
            sums.iter().zip(AMPLITUDES).map(move |(sum, amplitude)| Leading { pattern, amplitude, sum: *sum })
        });
        all.filter(|leading| leading.sum.since.is_some()).max_by(|a, b| a.sum.value.total_cmp(&b.sum.value))
    }

    pub fn clear(&mut self) {
        self.sums.fill(Default::default());
    }
}

impl Pattern {
    /// The log-likelihood ratio of a day with the pattern to a usual day.
    pub fn evidence(&self, distances: &Distances, amplitude: f64) -> f64 {
        let of = |measure: &super::patterns::PatternMeasure| {
            let number = MEASURES.iter().position(|DailyMeasure { name, .. }| *name == measure.measure)?;
            Some(amplitude * measure.weight * (distances[number]? - amplitude * measure.shift_sd / 2.0))
        };
        let sum: f64 = self.measures.iter().filter_map(of).sum();
        sum.clamp(-MOST_OF_A_DAY, MOST_OF_A_DAY)
    }
}
