//! The changes of measures that conditions make in simulated lives, as `homebody-lab alerts --fit` writes them.

use crate::measures::MEASURES;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Patterns of conditions, fitted on simulated people. None of those is among the people of the published table of accuracy.
const FITTED: &str = include_str!("patterns.json");

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Patterns {
    /// The command that fitted the patterns.
    pub fitted_by: String,
    /// Evidence at which an episode is found.
    pub threshold: f64,
    pub patterns: Vec<Pattern>,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Pattern {
    pub condition: String,
    /// How many times as often an episode has this pattern in simulated people with the condition as in others.
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
}

impl Patterns {
    pub fn fitted() -> &'static Patterns {
        static PATTERNS: LazyLock<Patterns> =
            LazyLock::new(|| serde_json::from_str(FITTED).expect("a test reads the file of patterns"));
        &PATTERNS
    }
}
