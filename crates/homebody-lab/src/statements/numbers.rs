//! Drawn numbers.

use homebody_core::random::Stream;

/// A stream of drawn numbers.
pub struct Draw(Stream);

impl Draw {
    pub fn named(seed: u64, name: &str) -> Draw {
        Draw(Stream::named(seed, name))
    }

    pub fn below(&mut self, count: u32) -> u32 {
        self.0.below(count)
    }

    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        self.0.between(least, most)
    }

    pub fn one_in(&mut self, count: u32) -> bool {
        self.0.below(count) == 0
    }
}
