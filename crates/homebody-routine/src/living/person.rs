//! Who somebody is: what their body is like, and, of one of many, how they differ from the routine that all of them share.

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

/// What a body is like, drawn once for a life.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constitution {
    /// Visits to the toilet in a night and in a day.
    pub toilet_at_night: f64,
    pub toilet_by_day: f64,
    /// How likely tiredness in the afternoon ends in a nap.
    pub naps: f64,
    /// Minutes awake in a night after falling asleep.
    pub awake_min: f64,
    pub pulse: f64,
    pub respiration: f64,
}

impl Constitution {
    /// Somebody's. How what is published of all varies from person to person, and pulse and breath, are ours.
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

/// How one member of a cohort differs from the routine that all of them share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// So many seconds later they get up, go to bed, and do all else that has its time.
    pub up_s: f64,
    pub bed_s: f64,
    pub clock_s: f64,
    /// So many times as long they take.
    pub length: f64,
    /// So many times as fast they walk.
    pub pace: f64,
    /// So many times as much they move while they stay somewhere.
    pub activity: f64,
    /// So many times as much their days differ.
    pub irregular: f64,
    /// How likely they leave out breakfast, lunch and dinner.
    pub skips: [f64; 3],
}

impl Person {
    /// As the routine says.
    pub const AS_WRITTEN: Person = Person {
        up_s: 0.0,
        bed_s: 0.0,
        clock_s: 0.0,
        length: 1.0,
        pace: 1.0,
        activity: 1.0,
        irregular: 1.0,
        skips: [0.0; 3],
    };

    /// Somebody.
    pub(super) fn draw(numbers: &Numbers, stream: &mut Stream) -> Person {
        let of = |number| numbers.of(number);
        let early = stream.normal(0.0, of(&EARLY_S));
        Person {
            up_s: early + stream.normal(0.0, of(&BED_TIMES_S)),
            bed_s: early + stream.normal(0.0, of(&BED_TIMES_S)),
            clock_s: early / 2.0 + stream.normal(0.0, of(&CLOCK_S)),
            length: stream.lognormal(1.0, of(&LENGTH)),
            pace: stream.lognormal(1.0, of(&PACE)).clamp(0.5, 1.7),
            activity: stream.lognormal(1.0, of(&ACTIVITY)),
            irregular: stream.lognormal(1.0, of(&IRREGULAR)),
            skips: Person::skips(numbers, stream),
        }
    }

    /// Of people of 65-75 years 51.6 % eat three meals, 33.5 % leave one out, and 14.9 % eat irregularly. Which one is left
    /// out is ours.
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
