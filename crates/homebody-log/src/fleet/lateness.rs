//! The lateness of messages, counted in the same memory for any number of them.
//!
//! Counts of intervals from one microsecond on, each at most a thirty-second wider than its begin: a quantile is exact to 3 %, and never
//! too small.

use homebody_core::time::Span;

/// Each power of two has so many spans, as a power of two itself.
const SPLIT_BITS: u32 = 5;
const SPLIT: usize = 1 << SPLIT_BITS;

/// The lateness of messages.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lateness {
    counts: Vec<u64>,
    count: u64,
    most_us: u64,
}

impl Lateness {
    /// A message was so late; one that was early was not late at all.
    pub fn add(&mut self, late: Span) {
        let late = u64::try_from(late.micros()).unwrap_or(0);
        let span = span_of(late);
        if self.counts.len() <= span {
            self.counts.resize(span + 1, 0);
        }
        self.counts[span] += 1;
        self.count += 1;
        self.most_us = self.most_us.max(late);
    }

    /// Takes in what was counted elsewhere.
    pub fn join(&mut self, other: &Lateness) {
        if self.counts.len() < other.counts.len() {
            self.counts.resize(other.counts.len(), 0);
        }
        self.counts.iter_mut().zip(&other.counts).for_each(|(own, other)| *own += other);
        self.count += other.count;
        self.most_us = self.most_us.max(other.most_us);
    }

    /// The number of messages.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The latest, in microseconds.
    pub fn most_us(&self) -> u64 {
        self.most_us
    }

    /// So late were this share of the messages at most, in microseconds: 0.99 is the 99th percentile. 0 where there were none.
    pub fn quantile_us(&self, share: f64) -> u64 {
        let wanted = (share * self.count as f64).ceil().max(1.0) as u64;
        let mut seen = 0;
        let span = self.counts.iter().position(|count| {
            seen += count;
            seen >= wanted
        });
        span.map_or(self.most_us, |span| end_of(span).min(self.most_us))
    }
}

/// The span that a number is in: the first ones are one number each.
fn span_of(late: u64) -> usize {
    if late < SPLIT as u64 {
        return late as usize;
    }
    let power = late.ilog2();
    let within = (late >> (power - SPLIT_BITS)) as usize - SPLIT;
    (power - SPLIT_BITS + 1) as usize * SPLIT + within
}

/// The last number of a span.
fn end_of(span: usize) -> u64 {
    if span < SPLIT {
        return span as u64;
    }
    let (power, within) = ((span / SPLIT - 1) as u32, (span % SPLIT + SPLIT) as u64);
    ((within + 1) << power) - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_is_in_a_span_that_is_little_wider_than_it() {
        for late in (0..10_000).chain((14..60).flat_map(|power| [(1 << power) - 1, 1 << power, (1 << power) + 12_345]))
        {
            let end = end_of(span_of(late));
            assert!(end >= late && end - late <= late / SPLIT as u64, "{late} is told as {end}");
            assert_eq!(span_of(end), span_of(late));
            assert_eq!(span_of(end + 1), span_of(late) + 1);
        }
    }

    #[test]
    fn quantiles_are_those_of_the_sorted_list_and_early_is_not_late() {
        let mut lateness = Lateness::default();
        assert_eq!((lateness.quantile_us(0.99), lateness.count()), (0, 0));
        (1..=1000).rev().for_each(|ms| lateness.add(Span::from_millis(ms)));
        for (share, expected) in [(0.5, 500_000), (0.99, 990_000), (1.0, 1_000_000)] {
            let told = lateness.quantile_us(share);
            assert!((expected..=expected + expected / 32).contains(&told), "{share}: {told}");
        }
        (0..1000).for_each(|_| lateness.add(Span::from_micros(-5)));
        assert!((lateness.quantile_us(0.5), lateness.count()) == (0, 2000));
        assert_eq!(lateness.most_us(), 1_000_000);
        let mut both = Lateness::default();
        both.add(Span::from_seconds(2.0));
        both.join(&lateness);
        assert_eq!((both.count(), both.most_us()), (2001, 2_000_000));
        // The control: the mean says nothing of the one that was late.
        assert!(both.quantile_us(0.5) < 300_000);
    }
}
