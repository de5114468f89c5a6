//! Measuring in rounds.
//!
//! A device that measures does so every so often, whatever happens.
//!
//! We assume that all rounds are equally long.
//!
//! The first instant comes of the device's own random numbers, so that not all of a home measure at once; the others follow.
//!
//! Left out: clocks that run fast or slow, which the link has.

use crate::random::{SpanRange, Stream};
use crate::time::{RunTime, Span};

/// Instants at which a device measures: every so often, from one on that its own random numbers give, so that not all of a
/// home measure at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounds {
    every: Span,
    first: RunTime,
    next: RunTime,
}

impl Rounds {
    /// Rounds of this length; the first is at the start until [`Rounds::begin`] draws it.
    pub fn new(every: Span) -> Rounds {
        Rounds { every, first: RunTime::START, next: RunTime::START }
    }

    /// The same rounds, with a first instant within one of their length drawn from a stream.
    pub fn begin(self, stream: &mut Stream) -> Rounds {
        let range = SpanRange { least: Span::ZERO, most: self.every - Span::MICROSECOND };
        let first = RunTime::START + stream.span(range);
        Rounds { first, next: first, ..self }
    }

    /// The length of a round.
    pub fn every(&self) -> Span {
        self.every
    }

    /// The instant of the next measurement.
    pub fn next(&self) -> RunTime {
        self.next
    }

    /// Measures at this instant, too.
    pub fn wake(&mut self, at: RunTime) {
        self.next = at;
    }

    /// Goes to the first measurement later than `at`.
    pub fn advance(&mut self, at: RunTime) {
        self.next = self.after(at);
    }

    /// The first one later than `at`, which is not before the start.
    pub fn after(&self, at: RunTime) -> RunTime {
        match at - self.first {
            before if before < Span::ZERO => self.first,
            since => at + self.every - since % self.every,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_come_every_so_often() {
        let every = Span::from_micros(10);
        let first = RunTime::from_micros(3);
        let rounds = Rounds { every, first, next: first };
        let next = [0, 2, 3, 4, 12, 13, 14].map(|at| rounds.after(RunTime::from_micros(at)).micros());
        assert_eq!(next, [3, 3, 13, 13, 13, 23, 23]);
        let first = Rounds::new(every).begin(&mut Stream::named(1, "rounds")).next();
        assert!((0..10).contains(&first.micros()));
    }
}
