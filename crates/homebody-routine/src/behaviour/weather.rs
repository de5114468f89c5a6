//! The weather of a day, and days that begin at random, drawn from streams of their own.

use super::resident_routine::ResidentRoutine;
use crate::routine::{DayEpisode, DaySelection, Weather};
use homebody_core::random::Stream;

/// Days of each month with at least 0.01 inches of rain or snow, with a high of 90 °F or more, and with a low of 32 °F or
/// less: Chicago O'Hare International Airport, climate normals of 1981 to 2010 (Illinois State Climatologist,
/// stateclimatologist.web.illinois.edu/chicago-ohare-international-airport-climate-normals).
const RAINY: [f64; 12] = [10.5, 8.8, 11.1, 12.0, 11.6, 10.2, 9.8, 9.8, 8.3, 10.2, 10.8, 11.0];
const HOT: [f64; 12] = [0.0, 0.0, 0.0, 0.0, 0.5, 3.0, 5.9, 3.6, 1.0, 0.0, 0.0, 0.0];
const FROSTY: [f64; 12] = [28.0, 24.0, 19.6, 6.3, 0.3, 0.0, 0.0, 0.0, 0.1, 3.5, 14.0, 26.0];

/// Mean length of a month, in days.
const MONTH_DAYS: f64 = 30.4375;

/// Correlation of the weather on a day with that on the day before (our choice).
const DAY_LIKE: f64 = 0.4;

/// Number of days that the weather depends on (our choice).
const REMEMBERED: i32 = 7;

impl ResidentRoutine {
    /// Whether a day has this weather. It is the same for all residents of a home.
    pub fn has_weather(&self, weather: Weather, day: i32) -> bool {
        let (_, month, _) = self.calendar.date(day);
        let share = |days: &[f64; 12]| days[usize::from(month - 1) % 12] / MONTH_DAYS;
        let is_rainy = || self.rank_of("rain", day) < share(&RAINY);
        match weather {
            Weather::Rainy => is_rainy(),
            Weather::Dry => !is_rainy(),
            Weather::Hot => self.rank_of("temperature", day) > 1.0 - share(&HOT),
            Weather::Frosty => self.rank_of("temperature", day) < share(&FROSTY),
        }
    }

    /// The share of days with less of it: an autoregression of the first order, cut off after a week.
    fn rank_of(&self, what: &str, day: i32) -> f64 {
        let of = |day: i32| self.stream_of_home(&format!("weather/{what}/day/{day}")).normal(0.0, 1.0);
        let sum: f64 = (0..REMEMBERED).map(|ago| libm::pow(DAY_LIKE, f64::from(ago)) * of(day - ago)).sum();
        let level = libm::sqrt(1.0 - DAY_LIKE * DAY_LIKE) * sum;
        libm::erfc(-level / std::f64::consts::SQRT_2) / 2.0
    }

    /// Whether a day lies in an episode. Those of equal frequency and length are the same days.
    fn is_in(&self, episode: DayEpisode, day: i32) -> bool {
        let begins = |day: i32| -> bool {
            let mut stream: Stream =
                self.stream_of_day(day, &format!("episode/{}/{}", episode.every_days, episode.lasts_days));
            stream.chance(1.0 / f64::from(episode.every_days.max(1)))
        };
        (0..episode.lasts_days as i32).any(|ago| begins(day - ago))
    }

    /// Whether the weather and the episodes of a day are those of a sentence.
    pub(super) fn is_such_a_day(&self, days: &DaySelection, day: i32) -> bool {
        days.weather.is_none_or(|weather| self.has_weather(weather, day))
            && days.episode.is_none_or(|episode| self.is_in(episode, day))
    }
}
