//! The choices of mutators, read from bytes that proptest draws and shrinks: fewer and smaller bytes give a simpler mutant.

use arbitrary::Unstructured;
use std::ops::Range;

/// Bytes that become choices. After the last byte, every choice is the first or smallest.
pub struct Choices<'b>(Unstructured<'b>);

impl<'b> Choices<'b> {
    pub fn new(bytes: &'b [u8]) -> Choices<'b> {
        Choices(Unstructured::new(bytes))
    }

    /// A number from 0 to `count - 1`; 0 where `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        self.0.int_in_range(0..=count.saturating_sub(1)).unwrap_or(0)
    }

    pub fn one<'t, T>(&mut self, of: &'t [T]) -> &'t T {
        &of[self.below(of.len())]
    }

    /// A number from 0 to 1.
    fn unit(&mut self) -> f64 {
        f64::from(self.0.int_in_range(0..=u16::MAX).unwrap_or(0)) / f64::from(u16::MAX)
    }

    /// True with this probability.
    pub fn is(&mut self, probability: f64) -> bool {
        self.unit() > 1.0 - probability
    }

    /// A number from 1 to `most`; small and large magnitudes are equally likely.
    pub fn size(&mut self, most: usize) -> usize {
        ((most as f64).powf(self.unit()) as usize).clamp(1, most)
    }

    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + self.unit() * (most - least)
    }

    /// A range within a length, usually at most 40 long.
    pub fn part(&mut self, length: usize) -> Range<usize> {
        let begin = self.below(length + 1);
        let most = if self.is(0.1) { length } else { 40 };
        begin..(begin + self.below(most + 1)).min(length)
    }
}

/// Bytes for tests of mutators.
#[cfg(test)]
pub fn bytes(seed: u64) -> Vec<u8> {
    let mut stream = homebody_core::random::Stream::named(seed, "fuzz");
    (0..4096).map(|_| (stream.unit() * 256.0) as u8).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_of_every_magnitude_and_small_without_bytes() {
        let bytes = bytes(1);
        let mut choices = Choices::new(&bytes);
        let sizes: Vec<usize> = (0..1000).map(|_| choices.size(10_000)).collect();
        assert!(sizes.iter().all(|size| (1..=10_000).contains(size)));
        let small = sizes.iter().filter(|&&size| size < 100).count();
        assert!((400..600).contains(&small), "{small}");
        let mut empty = Choices::new(&[]);
        assert_eq!((empty.size(9), empty.below(9), empty.is(0.9)), (1, 0, false));
    }
}
