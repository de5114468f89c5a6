//! Randomness from named streams only: a stream depends on the seed and its own name, never on what
//! else there is, so adding a sensor or a resident changes no other's numbers.

use crate::time::Span;
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
    pub fn span(&mut self, range: SpanRange) -> Span {
        if range.least == range.most {
            return range.least;
        }
        let values = (range.most - range.least + Span::MICROSECOND).micros() as u128;
        range.least + Span::from_micros(((self.0.next_u64() as u128 * values) >> 64) as i64)
    }

    /// A whole number below `count`, every one equally likely. Draws one value.
    pub fn below(&mut self, count: u32) -> u32 {
        ((u128::from(self.0.next_u64()) * u128::from(count)) >> 64) as u32
    }

    /// A number from 0 up to, but not including, 1, in steps of 2^-53. Draws one value.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * UNIT_STEP
    }

    /// Several numbers at once. Draws one value.
    pub fn draw_many(&mut self) -> DrawnValue {
        DrawnValue(self.0.next_u64())
    }

    /// Marks that nothing else has. Draws one value.
    pub fn marks(mut self) -> Marks {
        Marks(self.0.next_u64())
    }

    /// True with this probability; never for 0 or less, always for 1 or more. Draws one value in any case.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// A number between `least` and `most`, every one equally likely. Draws one value.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.unit()
    }

    /// A number of the normal distribution, by Box & Muller (1958). Draws two values.
    pub fn normal(&mut self, mean: f64, sd: f64) -> f64 {
        // Not 0, whose logarithm is infinite; so no number is further out than 8.6 standard deviations.
        let away = 1.0 - self.unit();
        let turn = self.unit();
        mean + sd * libm::sqrt(-2.0 * libm::log(away)) * libm::cos(std::f64::consts::TAU * turn)
    }

    /// A number whose logarithm is normal with this standard deviation, half of them below the median. Draws two values.
    ///
    /// The mean is median * exp(sigma^2 / 2), and the standard deviation mean * sqrt(exp(sigma^2) - 1).
    pub fn lognormal(&mut self, median: f64, sigma: f64) -> f64 {
        median * libm::exp(self.normal(0.0, sigma))
    }

    /// A number of the gamma distribution of this shape (above 0) and mean, whose standard deviation is
    /// mean / sqrt(shape); by Marsaglia & Tsang (2000). Draws four values as a rule, and never more than 97.
    pub fn gamma(&mut self, shape: f64, mean: f64) -> f64 {
        // A shape below 1 is drawn as that shape + 1, and made smaller.
        let smaller = 1.0 - self.unit();
        let (d, factor) = if shape < 1.0 {
            (shape + 1.0 - 1.0 / 3.0, libm::pow(smaller, 1.0 / shape))
        } else {
            (shape - 1.0 / 3.0, 1.0)
        };
        let c = 1.0 / libm::sqrt(9.0 * d);
        let mut drawn = 1.0;
        for _ in 0..GAMMA_TRIES {
            let x = self.normal(0.0, 1.0);
            let v = 1.0 + c * x;
            let cube = v * v * v;
            let accepting = 1.0 - self.unit();
            if v > 0.0 && libm::log(accepting) < 0.5 * x * x + d * (1.0 - cube + libm::log(cube)) {
                drawn = cube;
                break;
            }
        }
        d * drawn * factor * mean / shape
    }

    /// A number of events with the mean `mean`; 0 for a mean of 0 or less. Takes one value up to a mean of 256, by
    /// inversion; beyond, two, for the normal distribution of the same mean and variance.
    pub fn poisson(&mut self, mean: f64) -> u32 {
        if mean > POISSON_BY_INVERSION {
            return libm::round(self.normal(mean, libm::sqrt(mean))).max(0.0) as u32;
        }
        poisson_by_inversion(mean, self.unit())
    }

    /// An index, each as likely as its weight says; weights below 0 count as 0. Draws one value.
    ///
    /// If no weight is above 0, it is 0.
    pub fn pick(&mut self, weights: &[f64]) -> usize {
        let positive = || weights.iter().map(|weight| weight.max(0.0));
        let mut left = self.unit() * positive().sum::<f64>();
        let mut picked = 0;
        for (index, weight) in positive().enumerate().filter(|(_, weight)| *weight > 0.0) {
            // Rounding may leave a rest after the last one.
            picked = index;
            if left < weight {
                break;
            }
            left -= weight;
        }
        picked
    }
}

/// A number of events with the mean `mean`, from a number from 0 up to 1: the first count at which the sum of the
/// probabilities exceeds that number.
pub(crate) fn poisson_by_inversion(mean: f64, drawn: f64) -> u32 {
    let mut count = 0;
    let mut share = libm::exp(-mean.max(0.0));
    let mut up_to = share;
    while drawn >= up_to {
        count += 1;
        share *= mean / f64::from(count);
        // The shares have become too small to add to the sum, which rounding has left below 1.
        if f64::from(count) > mean && up_to + share == up_to {
            break;
        }
        up_to += share;
    }
    count
}

/// Numbers from one drawn value. Each costs time only when it is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawnValue(u64);

impl DrawnValue {
    /// One of its numbers, from 0 up to, but not including, 1; by SplitMix64 (Steele, Lea & Flood 2014), begun at the value.
    pub fn unit(self, index: u32) -> f64 {
        let state = self.0.wrapping_add((u64::from(index) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 * UNIT_STEP
    }
}

/// Random numbers that are not drawn one after the other but looked up: each belongs to a number, whenever and however often it is
/// asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Marks(u64);

impl Marks {
    /// The marks of this name, such as `sensor/bedroom motion/notice`.
    pub fn named(seed: u64, name: &str) -> Marks {
        Marks(Stream::named(seed, name).0.next_u64())
    }

    /// The random numbers that belong to a number.
    pub fn of(self, number: u64) -> DrawnValue {
        // Two rounds of SplitMix64, so that the numbers of neighbours have nothing in common.
        let mixed = (self.0 ^ number).wrapping_mul(0xd1b5_4a32_d192_ed03);
        DrawnValue((mixed ^ (mixed >> 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }
}

/// 2^-53: the distance of the numbers just below 1.
const UNIT_STEP: f64 = 1.0 / (1u64 << 53) as f64;

/// Largest number of tries for a gamma variate (our choice): more than 19 in 20 tries are accepted, so the last is
/// never reached.
const GAMMA_TRIES: u32 = 32;

/// Mean above which a Poisson distribution is computed as a normal one, to within a skewness of 1/16 (our choice).
const POISSON_BY_INVERSION: f64 = 256.0;

/// A range of spans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpanRange {
    /// The shortest span.
    pub least: Span,
    /// The longest span; drawn as often as any other.
    pub most: Span,
}

impl SpanRange {
    /// A range as files write it, in seconds.
    pub fn from_seconds(range: [f64; 2]) -> SpanRange {
        let [least, most] = range.map(Span::from_seconds);
        SpanRange { least, most }
    }
}

/// A stream that is not drawn from, as a placeholder until a run begins.
pub fn no_stream() -> Stream {
    Stream::named(0, "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::SECOND;

    #[test]
    fn marks_are_spread_evenly_and_those_of_neighbours_have_nothing_in_common() {
        let marks = Marks::named(7, "test");
        assert_eq!(marks.of(5), Marks::named(7, "test").of(5));
        let of = |number: u64, index| marks.of(number).unit(index);
        let count = 100_000;
        let mean_of = |of: &dyn Fn(u64) -> f64| (0..count).map(of).sum::<f64>() / count as f64;
        assert!((mean_of(&|n| of(n, 0)) - 0.5).abs() < 0.005 && (mean_of(&|n| of(n, 1)) - 0.5).abs() < 0.005);
        // The covariance of numbers of 1/12 variance each.
        let together = |a: &dyn Fn(u64) -> f64| mean_of(&|n| (of(n, 0) - 0.5) * (a(n) - 0.5)) * 12.0;
        assert!((together(&|n| of(n, 0)) - 1.0).abs() < 0.02);
        assert!(together(&|n| of(n + 1, 0)).abs() < 0.02 && together(&|n| of(n, 1)).abs() < 0.02);
        assert!(together(&|n| Marks::named(8, "test").of(n).unit(0)).abs() < 0.02);
    }

    #[test]
    fn spans_fill_their_range_evenly_and_reach_both_ends() {
        let mut stream = Stream::named(7, "test");
        let mut counts = [0u32; 5];
        let [least, most] = [10, 14].map(Span::from_micros);
        for _ in 0..50_000 {
            counts[(stream.span(SpanRange { least, most }) - least).micros() as usize] += 1;
        }
        assert!(counts.iter().all(|&count| (9_500..10_500).contains(&count)), "{counts:?}");
    }

    /// Mean, standard deviation and skewness of many draws.
    fn moments(mut draw: impl FnMut(&mut Stream) -> f64) -> [f64; 3] {
        let mut stream = Stream::named(11, "moments");
        let drawn: Vec<f64> = (0..100_000).map(|_| draw(&mut stream)).collect();
        let mean_of = |of: &dyn Fn(f64) -> f64| drawn.iter().map(|&x| of(x)).sum::<f64>() / drawn.len() as f64;
        let mean = mean_of(&|x| x);
        let sd = mean_of(&|x| (x - mean) * (x - mean)).sqrt();
        [mean, sd, mean_of(&|x| libm::pow((x - mean) / sd, 3.0))]
    }

    /// The number of raw values that a draw takes.
    fn values<T>(draw: impl Fn(&mut Stream) -> T) -> usize {
        let (mut drawn, mut counted) = (Stream::named(5, "values"), Stream::named(5, "values"));
        draw(&mut drawn);
        let mut count = 0;
        while counted != drawn {
            counted.unit();
            count += 1;
            assert!(count < 200, "it draws without end");
        }
        count
    }

    fn assert_near(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
        let is_near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() <= tolerance);
        assert!(is_near, "{found:?} instead of {expected:?}");
    }

    #[test]
    fn evenly_spread_numbers_have_their_moments_and_keep_in_their_range() {
        assert_near(moments(Stream::unit), [0.5, 1.0 / 12.0_f64.sqrt(), 0.0], 0.01);
        assert_near(moments(|stream| stream.between(-3.0, 9.0)), [3.0, 12.0_f64.sqrt(), 0.0], 0.05);
        let mut stream = Stream::named(2, "range");
        assert!((0..100_000).all(|_| (0.0..1.0).contains(&stream.unit())));
    }

    #[test]
    fn a_chance_comes_as_often_as_it_says() {
        let often = |probability| moments(|stream| f64::from(u8::from(stream.chance(probability))))[0];
        assert!((often(0.3) - 0.3).abs() < 0.005);
        assert_eq!([often(0.0), often(-1.0), often(1.0), often(f64::NAN)], [0.0, 0.0, 1.0, 0.0]);
    }

    #[test]
    fn normal_and_lognormal_numbers_have_their_moments() {
        assert_near(moments(|stream| stream.normal(5.0, 2.0)), [5.0, 2.0, 0.0], 0.03);
        // exp(0.02), times sqrt(exp(0.04) - 1); the skewness is (exp(0.04) + 2) times that root.
        assert_near(moments(|stream| stream.lognormal(1.0, 0.2)), [1.0202, 0.2061, 0.6143], 0.03);
        let mut stream = Stream::named(3, "median");
        let below = (0..100_000).filter(|_| stream.lognormal(0.65, 0.5) < 0.65).count();
        assert!((49_000..51_000).contains(&below), "{below}");
    }

    #[test]
    fn gamma_numbers_have_their_moments() {
        for shape in [0.5_f64, 1.0, 3.0, 40.0] {
            let skewness = 2.0 / shape.sqrt();
            assert_near(moments(|stream| stream.gamma(shape, 2.0)), [2.0, 2.0 / shape.sqrt(), skewness], 0.1);
        }
    }

    #[test]
    fn poisson_numbers_have_their_moments() {
        for mean in [0.01_f64, 0.7, 4.0, 30.0, 255.0, 400.0] {
            let [found, sd, _] = moments(|stream| f64::from(stream.poisson(mean)));
            assert!((found - mean).abs() < 0.02 * mean.sqrt(), "{found} instead of {mean}");
            assert!((sd / mean.sqrt() - 1.0).abs() < 0.05, "{sd} instead of {}", mean.sqrt());
        }
        let mut stream = Stream::named(4, "none");
        assert_eq!([0.0, -1.0, f64::NAN].map(|mean| stream.poisson(mean)), [0, 0, 0]);
    }

    #[test]
    fn picks_follow_their_weights() {
        let mut counts = [0; 4];
        let mut stream = Stream::named(6, "picks");
        for _ in 0..60_000 {
            counts[stream.pick(&[1.0, 0.0, 3.0, 2.0])] += 1;
        }
        for (count, expected) in counts.into_iter().zip([10_000, 0, 30_000, 20_000_i32]) {
            assert!((count - expected).abs() < 600 && (expected > 0 || count == 0), "{counts:?}");
        }
        assert_eq!([stream.pick(&[]), stream.pick(&[0.0, -1.0]), stream.pick(&[-1.0, 0.0, 2.0])], [0, 0, 2]);
    }

    #[test]
    fn draws_take_as_many_values_as_they_say() {
        let of_one: [fn(&mut Stream) -> f64; 5] = [
            |stream| stream.unit(),
            |stream| f64::from(u8::from(stream.chance(0.0))),
            |stream| stream.between(1.0, 1.0),
            |stream| f64::from(stream.poisson(200.0)),
            |stream| stream.pick(&[0.0]) as f64,
        ];
        assert_eq!(of_one.map(values), [1; 5]);
        let of_two: [fn(&mut Stream) -> f64; 3] = [
            |stream| stream.normal(0.0, 1.0),
            |stream| stream.lognormal(1.0, 1.0),
            |stream| f64::from(stream.poisson(300.0)),
        ];
        assert_eq!(of_two.map(values), [2; 3]);
        assert_eq!(values(|stream| stream.gamma(3.0, 1.0)), 4);
    }

    /// A change of method, or of how many values it draws, changes every log made with it.
    #[test]
    fn a_stream_draws_what_it_always_drew() {
        let mut stream = Stream::named(1, "always");
        let drawn = [stream.unit(), stream.normal(0.0, 1.0), stream.lognormal(1.0, 0.5), stream.gamma(0.7, 2.0)];
        assert_eq!(
            drawn.map(|number| libm::round(number * 1e9) as i64),
            [790_033_040, 462_250_241, 523_572_490, 1_637_024_423]
        );
        assert_eq!((stream.poisson(20.0), stream.pick(&[1.0, 2.0, 3.0]), stream.chance(0.5)), (15, 1, true));
    }

    #[test]
    fn a_stream_depends_on_its_name_and_seed_alone() {
        let draw = |seed, name: &str| Stream::named(seed, name).span(SpanRange { least: Span::ZERO, most: SECOND });
        assert_eq!(draw(1, "sensor/a"), draw(1, "sensor/a"));
        assert_ne!(draw(1, "sensor/a"), draw(1, "sensor/b"));
        assert_ne!(draw(1, "sensor/a"), draw(2, "sensor/a"));
    }
}
