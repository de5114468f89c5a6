//! Randomness from named streams only: a stream depends on the seed and its own name, never on what
//! else there is, so adding a sensor or a resident changes no other's numbers.

use crate::time::Micros;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};

/// One named stream of random numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream(ChaCha8Rng);

impl Stream {
    /// The stream of this name, such as `sensor/bedroom motion/timing`.
    pub fn named(seed: u64, name: &str) -> Stream {
        let key = Sha256::new().chain_update(seed.to_le_bytes()).chain_update(name.as_bytes()).finalize();
        Stream(ChaCha8Rng::from_seed(key.into()))
    }

    /// A span between `range.least` and `range.most`, both possible, every microsecond equally likely.
    ///
    /// A range of one value draws nothing.
    pub fn span(&mut self, range: Range) -> Micros {
        if range.least == range.most {
            return range.least;
        }
        let values = (range.most - range.least + 1) as u128;
        range.least + ((self.0.next_u64() as u128 * values) >> 64) as Micros
    }
}

/// A range of spans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    pub least: Micros,
    pub most: Micros,
}

impl Range {
    /// A range as files write it, in seconds.
    pub fn of_seconds(range: [f64; 2]) -> Range {
        Range { least: crate::time::micros(range[0]), most: crate::time::micros(range[1]) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_fill_their_range_evenly_and_reach_both_ends() {
        let mut stream = Stream::named(7, "test");
        let mut counts = [0u32; 5];
        for _ in 0..50_000 {
            counts[stream.span(Range { least: 10, most: 14 }) as usize - 10] += 1;
        }
        assert!(counts.iter().all(|&count| (9_500..10_500).contains(&count)), "{counts:?}");
    }

    #[test]
    fn a_stream_depends_on_its_name_and_seed_alone() {
        let draw = |seed, name: &str| Stream::named(seed, name).span(Range { least: 0, most: 1_000_000 });
        assert_eq!(draw(1, "sensor/a"), draw(1, "sensor/a"));
        assert_ne!(draw(1, "sensor/a"), draw(1, "sensor/b"));
        assert_ne!(draw(1, "sensor/a"), draw(2, "sensor/a"));
    }
}
