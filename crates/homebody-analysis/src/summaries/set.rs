//! The values of a measure in a sentence, as fuzzy sets.

use homebody_core::fuzzy::Fuzzy;
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Set {
    /// So many times, or more often.
    AtLeast(u32),
    Exactly(u32),
    Between(f64, f64),
    /// More than before, or less: from half a standard deviation on a little, from one and a half on fully.
    Beyond {
        mean: f64,
        sd: f64,
        is_more: bool,
    },
}

impl Set {
    pub fn fuzzy(self) -> Fuzzy {
        match self {
            Set::AtLeast(times) => {
                let times = f64::from(times);
                Fuzzy { low: times - 1.0, from: times, to: f64::MAX, high: f64::MAX }
            }
            Set::Exactly(times) => Fuzzy::around(f64::from(times), 1.0),
            Set::Between(from, to) => Fuzzy { low: from - BORDER, from, to, high: to + BORDER },
            Set::Beyond { mean, sd, is_more: true } => {
                Fuzzy { low: mean + 0.5 * sd, from: mean + 1.5 * sd, to: f64::MAX, high: f64::MAX }
            }
            Set::Beyond { mean, sd, is_more: false } => {
                Fuzzy { low: f64::MIN, from: f64::MIN, to: mean - 1.5 * sd, high: mean - 0.5 * sd }
            }
        }
    }
}

/// Width of the border of a set of hours, in hours (our choice).
pub(super) const BORDER: f64 = 0.25;
