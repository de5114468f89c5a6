//! Fuzzy numbers and quantifiers: what "about", "give or take" and "most" mean in numbers.
//!
//! A fuzzy number is a trapezoid: the agreement of a value with the words, from 0 to 1. The density of a draw is
//! proportional to that agreement, so the values that fit the words best are the most frequent.

use crate::random::Stream;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A trapezoid: nothing below `low`, full agreement from `from` to `to`, nothing above `high`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fuzzy {
    /// Below it nothing agrees.
    pub low: f64,
    /// From here on all agree fully.
    pub from: f64,
    /// As far as this.
    pub to: f64,
    /// Above it nothing agrees.
    pub high: f64,
}

impl Fuzzy {
    /// Exactly this value.
    pub const fn exactly(value: f64) -> Fuzzy {
        Fuzzy { low: value, from: value, to: value, high: value }
    }

    /// This value, give or take `spread`.
    pub fn around(value: f64, spread: f64) -> Fuzzy {
        Fuzzy { low: value - spread, from: value, to: value, high: value + spread }
    }

    /// From one value to another, all alike.
    pub fn between(from: f64, to: f64) -> Fuzzy {
        Fuzzy { low: from, from, to, high: to }
    }

    /// The agreement of a value with the words, from 0 to 1.
    pub fn agreement(&self, value: f64) -> f64 {
        if value < self.low || value > self.high {
            0.0
        } else if value < self.from {
            (value - self.low) / (self.from - self.low)
        } else if value <= self.to {
            1.0
        } else {
            (self.high - value) / (self.high - self.to)
        }
    }

    /// A value drawn with a density proportional to the agreement; one raw number is drawn, always.
    pub fn draw(&self, stream: &mut Stream) -> f64 {
        self.at(stream.unit())
    }

    /// The value below which this share of all that is drawn lies; 0.5 is the median.
    pub fn at(&self, share: f64) -> f64 {
        let (rise, flat, fall) = self.areas();
        let area = share * (rise + flat + fall);
        if area < rise {
            self.low + libm::sqrt(2.0 * area * (self.from - self.low))
        } else if area <= rise + flat || fall == 0.0 {
            self.from + (area - rise).min(flat)
        } else {
            let left = rise + flat + fall - area;
            self.high - libm::sqrt((2.0 * left * (self.high - self.to)).max(0.0))
        }
    }

    /// The mean of what is drawn.
    pub fn mean(&self) -> f64 {
        let (rise, flat, fall) = self.areas();
        let whole = rise + flat + fall;
        if whole == 0.0 {
            return self.from;
        }
        let rise_at = self.low + (self.from - self.low) * 2.0 / 3.0;
        let fall_at = self.high - (self.high - self.to) * 2.0 / 3.0;
        (rise * rise_at + flat * (self.from + self.to) / 2.0 + fall * fall_at) / whole
    }

    /// Every value changed by a function that keeps their order.
    pub fn map(&self, change: impl Fn(f64) -> f64) -> Fuzzy {
        Fuzzy { low: change(self.low), from: change(self.from), to: change(self.to), high: change(self.high) }
    }

    fn areas(&self) -> (f64, f64, f64) {
        ((self.from - self.low) / 2.0, self.to - self.from, (self.high - self.to) / 2.0)
    }
}

crate::worded::worded! {
    /// The fuzzy quantifiers of linguistic summaries, such as "often".
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
    #[serde(rename_all = "snake_case")]
    pub enum Quantifier {
        /// In one case of twenty or fewer.
        AlmostNever = "almost never",
        /// In one case of ten.
        Rarely = "rarely",
        /// In one case of five.
        Sometimes = "sometimes",
        /// In one case of two.
        AboutHalf = "about half the time",
        /// In two cases of three and more.
        Often = "often",
        /// In four cases of five and more.
        Most = "most days",
        /// In nineteen cases of twenty and more.
        AlmostAlways = "almost always",
        /// In each case.
        Every = "every day",
    }
    /// From the least to the greatest.
    ALL
    /// The word itself.
    fn word
}

impl Quantifier {
    /// Which shares of all occasions the word fits.
    ///
    /// `most` is Zadeh's, as Kacprzyk and Yager use it; the other trapezoids are ours, in their order.
    pub fn share(self) -> Fuzzy {
        let trapezoid = |low, from, to, high| Fuzzy { low, from, to, high };
        match self {
            Quantifier::AlmostNever => trapezoid(0.0, 0.0, 0.05, 0.15),
            Quantifier::Rarely => trapezoid(0.0, 0.05, 0.15, 0.25),
            Quantifier::Sometimes => trapezoid(0.05, 0.15, 0.25, 0.35),
            Quantifier::AboutHalf => trapezoid(0.3, 0.45, 0.55, 0.7),
            Quantifier::Often => trapezoid(0.4, 0.6, 0.8, 0.9),
            Quantifier::Most => trapezoid(0.3, 0.8, 1.0, 1.0),
            Quantifier::AlmostAlways => trapezoid(0.8, 0.95, 1.0, 1.0),
            Quantifier::Every => trapezoid(1.0, 1.0, 1.0, 1.0),
        }
    }

    /// The probability on one occasion that fits the word best, so that a summary of the results agrees with the word
    /// in the routine.
    pub fn probability(self) -> f64 {
        match self {
            // All shares above 0.8 fit as well; this leaves room for chance on both sides.
            Quantifier::Most => 0.85,
            Quantifier::AlmostAlways => 0.97,
            Quantifier::AlmostNever => 0.025,
            other => {
                let share = other.share();
                (share.from + share.to) / 2.0
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_follow_the_agreement() {
        for fuzzy in [
            Fuzzy::around(100.0, 30.0),
            Fuzzy::between(2.0, 3.0),
            Fuzzy { low: 0.0, from: 1.0, to: 3.0, high: 3.0 },
            Fuzzy { low: 5.0, from: 5.0, to: 5.0, high: 9.0 },
        ] {
            let shares = 10_000;
            let values: Vec<f64> = (0..shares).map(|i| fuzzy.at((f64::from(i) + 0.5) / f64::from(shares))).collect();
            assert!(values.windows(2).all(|pair| pair[0] <= pair[1]));
            let mean = values.iter().sum::<f64>() / f64::from(shares);
            assert!((mean - fuzzy.mean()).abs() < 1e-3 * (fuzzy.high - fuzzy.low), "{fuzzy:?}: {mean}");
            // In each of twenty parts of the span the share of values is that of the agreement's area.
            let width = (fuzzy.high - fuzzy.low) / 20.0;
            let area: f64 = (fuzzy.from - fuzzy.low) / 2.0 + fuzzy.to - fuzzy.from + (fuzzy.high - fuzzy.to) / 2.0;
            for part in 0..20 {
                let start = fuzzy.low + f64::from(part) * width;
                let inside = values.iter().filter(|&&value| value >= start && value < start + width).count();
                let middle = fuzzy.agreement(start + width / 2.0) * width / area;
                assert!((inside as f64 / f64::from(shares) - middle).abs() < 0.03, "{fuzzy:?} part {part}");
            }
        }
        assert_eq!(Fuzzy::exactly(7.0).at(0.3), 7.0);
        assert_eq!(Fuzzy::exactly(7.0).mean(), 7.0);
    }

    #[test]
    fn every_quantifier_fits_its_own_probability_fully_and_they_are_in_order() {
        for pair in Quantifier::ALL.windows(2) {
            assert!(pair[0].probability() < pair[1].probability());
        }
        for quantifier in Quantifier::ALL {
            assert_eq!(quantifier.share().agreement(quantifier.probability()), 1.0, "{quantifier:?}");
        }
    }
}
