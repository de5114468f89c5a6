//! Chance for mutators: all of a case follows from the target's name, a seed and the case's number.

use homebody_core::random::Stream;

/// Draws what a mutator does.
pub struct Dice(Stream);

impl Dice {
    /// Those of a case.
    pub fn of(target: &str, seed: u64, number: u64) -> Dice {
        Dice(Stream::named(seed, &format!("fuzz/{target}/{number}")))
    }

    /// A number from 0 up to, but not including, `count`; 0 where that is 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.0.unit() * count as f64) as usize
    }

    /// One of a list that is not empty.
    pub fn one<'t, T>(&mut self, of: &'t [T]) -> &'t T {
        &of[self.below(of.len())]
    }

    /// True with this probability.
    pub fn is(&mut self, probability: f64) -> bool {
        self.0.chance(probability)
    }

    /// A number from 1 to `most`, of any magnitude: small ones as often as large ones.
    pub fn size(&mut self, most: usize) -> usize {
        ((most as f64).powf(self.0.unit()) as usize).clamp(1, most)
    }

    /// A number between two.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        self.0.between(least, most)
    }

    /// A part of something of this length: where it begins and ends, at most 40 long as a rule.
    pub fn part(&mut self, length: usize) -> std::ops::Range<usize> {
        let begin = self.below(length + 1);
        let most = if self.is(0.9) { 40 } else { length };
        begin..(begin + self.below(most + 1)).min(length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_always_the_same_and_no_other() {
        let drawn = |target, seed, number| {
            let mut dice = Dice::of(target, seed, number);
            [dice.below(1 << 40), dice.size(1 << 40)]
        };
        assert_eq!(drawn("log", 1, 2), drawn("log", 1, 2));
        assert_ne!(drawn("log", 1, 2), drawn("log", 1, 3));
        assert_ne!(drawn("log", 1, 2), drawn("log", 2, 2));
        assert_ne!(drawn("log", 1, 2), drawn("plan", 1, 2));
    }

    #[test]
    fn sizes_are_of_any_magnitude() {
        let mut dice = Dice::of("size", 1, 0);
        let sizes: Vec<usize> = (0..1000).map(|_| dice.size(10_000)).collect();
        assert!(sizes.iter().all(|size| (1..=10_000).contains(size)));
        let small = sizes.iter().filter(|&&size| size < 100).count();
        assert!((400..600).contains(&small), "{small}");
    }
}
