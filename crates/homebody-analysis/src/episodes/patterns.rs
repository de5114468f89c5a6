//! The changes of measures that conditions make in simulated people: `homebody-lab alerts --fit` writes them.

use crate::measures::MEASURES;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// The distances of a day's measures from the usual ones, in standard deviations, by measure.
pub type Distances = Vec<Option<f64>>;

/// Patterns that were fitted on simulated people. None of those is among the people of the table of accuracy.
const FITTED: &str = include_str!("patterns.json");

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Patterns {
    /// The command that fitted the patterns.
    pub fitted_by: String,
    /// The evidence at which an episode is found, or has become worse.
    pub threshold: f64,
    pub conditions: Vec<ConditionPattern>,
    /// Changes without an illness, such as a guest.
    pub harmless: Vec<ConditionPattern>,
}

/// Shifts of measures that come together.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ConditionPattern {
    pub name: String,
    /// How many times as often news of an episode have this pattern in simulated people with the condition as in others.
    pub likelihood_ratio: f64,
    pub measures: Vec<PatternMeasure>,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct PatternMeasure {
    pub measure: String,
    /// The mean distance from the usual value at the height of a moderate case, in standard deviations.
    pub shift_sd: f64,
    /// The evidence of a day for each standard deviation of distance.
    pub weight: f64,
    #[serde(skip)]
    number: usize,
}

impl Patterns {
    pub fn fitted() -> &'static Patterns {
        static PATTERNS: LazyLock<Patterns> =
            LazyLock::new(|| Patterns::read(FITTED).expect("a test reads the file of patterns"));
        &PATTERNS
    }

    pub fn read(text: &str) -> Result<Patterns, serde_json::Error> {
        let mut patterns: Patterns = serde_json::from_str(text)?;
        for measure in patterns.conditions.iter_mut().chain(&mut patterns.harmless).flat_map(|one| &mut one.measures) {
            let place = MEASURES.iter().position(|known| known.name == measure.measure);
            measure.number = place.ok_or_else(|| serde::de::Error::custom("a pattern has an unknown measure"))?;
        }
        Ok(patterns)
    }
}

impl PatternMeasure {
    /// `number` is that of the measure.
    pub fn new(number: usize, shift_sd: f64, weight: f64) -> PatternMeasure {
        PatternMeasure { measure: MEASURES[number].name.to_owned(), shift_sd, weight, number }
    }
}

impl ConditionPattern {
    /// The log-likelihood ratio of a day with a share of the pattern's shifts to a usual day.
    pub(super) fn evidence(&self, distances: &Distances, share: f64) -> f64 {
        let of = |measure: &PatternMeasure| {
            let beyond = distances[measure.number]? - share * measure.shift_sd / 2.0;
            Some(share * measure.weight * beyond)
        };
        self.measures.iter().filter_map(of).sum()
    }
}
