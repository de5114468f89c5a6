//! Traits of a person: the body, and differences from a shared routine.

use homebody_core::numbers::Numbers;
use homebody_core::random::Stream;

homebody_core::numbers! {
    /// Mean number of visits to the toilet in a night (a Poisson rate with mean 1.7 fits the published shares of
    /// nocturia).
    static TOILET_AT_NIGHT = "constitution.toilet_at_night": 1.7, "1", [0.1, 5.0];
    /// Shape of the gamma distribution over people of the visits to the toilet in a night (standard deviation 0.8).
    static TOILET_AT_NIGHT_SHAPE = "constitution.toilet_at_night_shape": 4.5, "1", [0.5, 50.0];
    /// Mean number of visits to the toilet in a day (BLSA).
    static TOILET_BY_DAY = "constitution.toilet_by_day": 5.0, "1", [3.0, 8.0];
    /// Standard deviation over people of the visits to the toilet in a day.
    static TOILET_BY_DAY_SPREAD = "constitution.toilet_by_day_spread": 0.9, "1", [0.0, 3.0];
    /// Share of people who nap regularly (25 % of those of 75 and more).
    static NAPPERS = "constitution.nappers": 0.25, "1", [0.0, 1.0];
    /// Probability that tiredness in the afternoon ends in a nap, for people who nap regularly.
    static NAPS_OF_NAPPERS = "constitution.naps_of_nappers": 0.8, "1", [0.0, 1.0];
    /// Probability that tiredness in the afternoon ends in a nap, for other people.
    static NAPS_OF_OTHERS = "constitution.naps_of_others": 0.1, "1", [0.0, 1.0];
    /// Mean time awake in a night after falling asleep (actigraphs, 62-90 years).
    static AWAKE_MIN = "constitution.awake": 39.0, "min", [5.0, 150.0];
    /// Shape of the gamma distribution over people of the time awake in a night.
    static AWAKE_SHAPE = "constitution.awake_shape": 4.0, "1", [0.5, 50.0];
    /// Mean pulse during sleep.
    static PULSE_BPM = "constitution.pulse": 62.0, "1/min", [48.0, 80.0];
    /// Standard deviation over people of the pulse.
    static PULSE_SPREAD_BPM = "constitution.pulse_spread": 5.0, "1/min", [0.0, 20.0];
    /// Mean respiration during sleep.
    static RESPIRATION_PM = "constitution.respiration": 15.0, "1/min", [11.0, 20.0];
    /// Standard deviation over people of the respiration.
    static RESPIRATION_SPREAD_PM = "constitution.respiration_spread": 1.2, "1/min", [0.0, 5.0];
    /// Standard deviation over generated people of a shift of the whole day (at a mean age of 73.9 years, the time in
    /// bed has one of 62 minutes).
    static EARLY_S = "person.early": 3_100.0, "s", [0.0, 14_400.0];
    /// Standard deviation over generated people of a further shift of getting up and of going to bed.
    static BED_TIMES_S = "person.bed_times": 2_800.0, "s", [0.0, 14_400.0];
    /// Standard deviation over generated people of a further shift of all other activities.
    static CLOCK_S = "person.clock": 900.0, "s", [0.0, 14_400.0];
    /// Standard deviation over generated people of the logarithm of the factor on all durations.
    static LENGTH = "person.length": 0.15, "1", [0.0, 1.0];
    /// Standard deviation over generated people of the logarithm of the factor on the pace (0.17 m/s around 0.61, Kaye
    /// 2012).
    static PACE = "person.pace": 0.26, "1", [0.0, 1.0];
    /// Standard deviation over generated people of the logarithm of the factor on the amount of movement.
    static ACTIVITY = "person.activity": 0.3, "1", [0.0, 1.0];
    /// Standard deviation over generated people of the logarithm of the factor on the differences between days.
    static IRREGULAR = "person.irregular": 0.3, "1", [0.0, 1.0];
    /// Probability on each day that a person who leaves out a meal does so.
    static LEFT_OUT = "person.left_out": 0.9, "1", [0.0, 1.0];
    /// Probability that a person who eats irregularly leaves out a given meal.
    static IRREGULAR_MEALS = "person.irregular_meals": 0.3, "1", [0.0, 1.0];
}

/// Traits of a body, drawn once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constitution {
    /// Per night and per day.
    pub toilet_at_night: f64,
    pub toilet_by_day: f64,
    /// Probability that tiredness in the afternoon ends in a nap.
    pub naps: f64,
    /// Per night after falling asleep.
    pub awake_min: f64,
    pub pulse: f64,
    pub respiration: f64,
}

impl Constitution {
    /// Distributions of published means are our choice, as are pulse and respiration.
    pub(super) fn draw(numbers: &Numbers, stream: &mut Stream) -> Constitution {
        let of = |number| numbers.of(number);
        Constitution {
            toilet_at_night: stream.gamma(of(&TOILET_AT_NIGHT_SHAPE), of(&TOILET_AT_NIGHT)).clamp(0.1, 5.0),
            toilet_by_day: stream.normal(of(&TOILET_BY_DAY), of(&TOILET_BY_DAY_SPREAD)).clamp(3.0, 8.0),
            naps: of(if stream.chance(of(&NAPPERS)) { &NAPS_OF_NAPPERS } else { &NAPS_OF_OTHERS }),
            awake_min: stream.gamma(of(&AWAKE_SHAPE), of(&AWAKE_MIN)).clamp(5.0, 150.0),
            pulse: stream.normal(of(&PULSE_BPM), of(&PULSE_SPREAD_BPM)).clamp(48.0, 80.0),
            respiration: stream.normal(of(&RESPIRATION_PM), of(&RESPIRATION_SPREAD_PM)).clamp(11.0, 20.0),
        }
    }
}

/// The differences of a member of a cohort from the shared routine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemberDifference {
    /// Seconds later, for rising, going to bed, and all other times.
    pub up_s: f64,
    pub bed_s: f64,
    pub clock_s: f64,
    /// Factor on durations.
    pub length: f64,
    /// Factor on walking speed.
    pub pace: f64,
    /// Factor on movement during stays.
    pub activity: f64,
    /// Factor on the variation between days.
    pub irregular: f64,
    /// Probabilities of skipping breakfast, lunch and dinner.
    pub skips: [f64; 3],
}

impl MemberDifference {
    /// Without differences.
    pub const AS_WRITTEN: MemberDifference = MemberDifference {
        up_s: 0.0,
        bed_s: 0.0,
        clock_s: 0.0,
        length: 1.0,
        pace: 1.0,
        activity: 1.0,
        irregular: 1.0,
        skips: [0.0; 3],
    };

    pub(super) fn draw(numbers: &Numbers, stream: &mut Stream) -> MemberDifference {
        let of = |number| numbers.of(number);
        let early = stream.normal(0.0, of(&EARLY_S));
        MemberDifference {
            up_s: early + stream.normal(0.0, of(&BED_TIMES_S)),
            bed_s: early + stream.normal(0.0, of(&BED_TIMES_S)),
            clock_s: early / 2.0 + stream.normal(0.0, of(&CLOCK_S)),
            length: stream.lognormal(1.0, of(&LENGTH)),
            pace: stream.lognormal(1.0, of(&PACE)).clamp(0.5, 1.7),
            activity: stream.lognormal(1.0, of(&ACTIVITY)),
            irregular: stream.lognormal(1.0, of(&IRREGULAR)),
            skips: MemberDifference::skips(numbers, stream),
        }
    }

    /// Of people of 65-75 years 51.6 % eat three meals, 33.5 % leave one out, and 14.9 % eat irregularly. The choice of the
    /// meal is ours.
    fn skips(numbers: &Numbers, stream: &mut Stream) -> [f64; 3] {
        let kind = stream.pick(&[51.6, 33.5, 14.9]);
        let mut skips = [0.0; 3];
        skips[stream.pick(&[0.35, 0.5, 0.15])] = numbers.of(&LEFT_OUT);
        match kind {
            0 => [0.0; 3],
            1 => skips,
            _ => [numbers.of(&IRREGULAR_MEALS); 3],
        }
    }
}
