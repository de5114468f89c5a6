//! Measuring in rounds.
//!
//! A device that measures does so every so often, whatever happens.
//!
//! We assume that all rounds are equally long.
//!
//! The first instant comes of the device's own random numbers, so that not all of a home measure at once; the others follow.
//!
//! Left out: clocks that run fast or slow, which the link has.

use crate::random::{Range, Stream};
use crate::time::Micros;

/// Instants at which a device measures: every so often, from one on that its own random numbers give, so that not all of a
/// home measure at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounds {
    every: Micros,
    first: Micros,
}

impl Rounds {
    /// Rounds of this length, in microseconds; the first is at 0 until [`Rounds::begin`] draws it.
    pub fn new(every: Micros) -> Rounds {
        Rounds { every, first: 0 }
    }

    /// The same rounds, with a first instant within one of their length drawn from a stream.
    pub fn begin(self, stream: &mut Stream) -> Rounds {
        Rounds { first: stream.span(Range { least: 0, most: self.every - 1 }), ..self }
    }

    /// The length of a round, in microseconds.
    pub fn every(&self) -> Micros {
        self.every
    }

    /// The first instant at which it measures, in microseconds since the run's start.
    pub fn first(&self) -> Micros {
        self.first
    }

    /// The first one later than `at`, which is not before 0.
    pub fn after(&self, at: Micros) -> Micros {
        match at - self.first {
            before if before < 0 => self.first,
            since => at + self.every - since % self.every,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_come_every_so_often() {
        let rounds = Rounds { every: 10, first: 3 };
        let next = [0, 2, 3, 4, 12, 13, 14].map(|at| rounds.after(at));
        assert_eq!(next, [3, 3, 13, 13, 13, 23, 23]);
        let first = Rounds::new(10).begin(&mut Stream::named(1, "rounds")).first();
        assert!((0..10).contains(&first));
    }
}
