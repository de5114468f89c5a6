//! What each sensor said each day, beside what it would have said of people who were where all sensors together tell.

use crate::said::{Last, Message, Said, Timing};
use crate::smooth::Instant;
use homebody_core::geometry::Point;
use homebody_core::time::{DAY, Micros, SECOND, seconds};

/// Rate, in messages a second, below which a message is unexplained (our choice): a sensor with a person in view sends
/// some a minute.
const UNEXPLAINED: f32 = 1e-3;
/// Step of the search for a clock's error, and largest number of steps (our choice): an hour.
const LAG: Micros = 5 * SECOND;
const MOST_LAGS: i64 = 720;
/// Messages a day that a clock's error is estimated from (our choice).
const FOR_LAG: usize = 20;
/// Smallest rate of a sensor with a person in view, in messages a second (our choice).
const SEES: f32 = 0.03;
/// Smallest margin of the best error of a clock over an arbitrary one, in standard deviations (our choice).
const SURE: f64 = 4.0;

/// One day of a sensor.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Day {
    /// How often it would have said ON.
    pub expected: f64,
    /// How often it did, of people who were where it looks.
    pub explained: u32,
    /// Where people were when it did though nobody was there; none while all were out.
    pub unexplained: Vec<Option<Point>>,
    /// How far its clock was ahead, in seconds, where that can be told.
    pub ahead_s: Option<f64>,
}

/// Watches sensors while a log is walked back, whether what they say is believed or not.
#[derive(Clone, Debug)]
pub(crate) struct Watch<'a> {
    timing: &'a [Timing],
    /// By sensor: when it said what.
    messages: &'a [Vec<Message>],
    /// By sensor: how many of them have come, and what they left it in.
    heard: Vec<(usize, Last)>,
    /// By sensor and day.
    days: Vec<Vec<Day>>,
    /// By sensor: how often it would speak in the day so far, by steps of [`LAG`].
    levels: Vec<Vec<f32>>,
    /// When the last instant was, and how often each would have spoken then.
    last: Micros,
    before: Vec<f32>,
}

impl<'a> Watch<'a> {
    pub fn new(timing: &'a [Timing], messages: &'a [Vec<Message>]) -> Watch<'a> {
        let sensors = timing.len();
        Watch {
            timing,
            messages,
            heard: vec![(0, Last::default()); sensors],
            days: vec![vec![Day::default()]; sensors],
            levels: vec![vec![0.0; (DAY / LAG) as usize]; sensors],
            last: 0,
            before: vec![0.0; sensors],
        }
    }

    /// Takes the next instant.
    pub fn see(&mut self, instant: &Instant) {
        let now = instant.expected(self.timing.len());
        let place = instant.guesses().first().and_then(|guess| guess.state.at);
        while self.last / DAY < instant.at / DAY {
            self.pass((self.last / DAY + 1) * DAY, &now, place);
            self.end_day();
        }
        self.pass(instant.at, &now, place);
        self.before = now;
    }

    /// Ends the last day: the days of each sensor.
    pub fn finish(mut self) -> Vec<Vec<Day>> {
        self.end_day();
        self.days.iter_mut().for_each(|days| {
            days.pop();
        });
        self.days
    }

    /// Time goes on to an instant of the same day, or its end, at which people are at a place.
    fn pass(&mut self, to: Micros, now: &[f32], place: Option<Point>) {
        let from = std::mem::replace(&mut self.last, to);
        let first = (from % DAY / LAG) as usize;
        let end = (((to - 1).rem_euclid(DAY) / LAG) as usize).max(first);
        for sensor in 0..self.timing.len() {
            let (before, now) = (self.before[sensor], now[sensor]);
            let rate = (before + now) / 2.0;
            let Some(day) = self.days[sensor].last_mut() else { continue };
            let (heard, last) = &mut self.heard[sensor];
            let mut since = from;
            let mut deaf = 0;
            while let Some(message) = self.messages[sensor].get(*heard).filter(|message| message.at <= to) {
                deaf += last.deaf(since, message.at.max(since)).min(message.at.max(since) - since);
                since = message.at.max(since);
                if message.said == Said::On {
                    match before.max(now) >= UNEXPLAINED {
                        true => day.explained += 1,
                        false => day.unexplained.push(place),
                    }
                }
                last.hear(message, &self.timing[sensor]);
                *heard += 1;
            }
            deaf += last.deaf(since, to).min(to - since);
            day.expected += f64::from(rate) * seconds(to - from - deaf);
            self.levels[sensor][first..=end].iter_mut().for_each(|level| *level = level.max(rate));
        }
    }

    fn end_day(&mut self) {
        // An instant at midnight belongs to the day before.
        let begin = (self.last - 1).max(0) / DAY * DAY;
        for (sensor, days) in self.days.iter_mut().enumerate() {
            let heard = &self.messages[sensor][..self.heard[sensor].0];
            let today = heard.iter().rev().take_while(|message| message.at >= begin);
            let said: Vec<Micros> =
                today.filter(|message| message.said == Said::On).map(|message| message.at).collect();
            if let Some(day) = days.last_mut() {
                day.ahead_s = ahead(&self.levels[sensor], &said);
            }
            self.levels[sensor].fill(0.0);
            days.push(Day::default());
        }
    }
}

/// How far a clock is ahead, in seconds, whose messages come when its sensor would have seen somebody that much earlier; `None`
/// where there are few, or any time does as well.
fn ahead(levels: &[f32], said: &[Micros]) -> Option<f64> {
    if said.len() < FOR_LAG {
        return None;
    }
    let sees: Vec<f64> = levels.iter().map(|&level| f64::from(level.min(SEES) / SEES)).collect();
    let places: Vec<i64> = said.iter().map(|said| said % DAY / LAG).collect();
    let mean = |lag: i64| {
        let inside = places.iter().filter_map(|place| sees.get(usize::try_from(place - lag).ok()?));
        let (count, sum) = inside.fold((0usize, 0.0), |(count, sum), sees| (count + 1, sum + sees));
        if count * 2 < said.len() { 0.0 } else { sum / count as f64 }
    };
    let all: Vec<(i64, f64)> = (-MOST_LAGS..=MOST_LAGS).map(|lag| (lag, mean(lag))).collect();
    let (best, fits) = all.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.abs().cmp(&a.0.abs())))?;
    let average = all.iter().map(|one| one.1).sum::<f64>() / all.len() as f64;
    let variance = all.iter().map(|one| libm::pow(one.1 - average, 2.0)).sum::<f64>() / all.len() as f64;
    let is_sure = fits - average > SURE * libm::sqrt(variance);
    is_sure.then(|| best as f64 * seconds(LAG))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_that_is_ahead_is_found_by_when_somebody_was_there() {
        let steps = (DAY / LAG) as usize;
        let mut levels = vec![0.0; steps];
        let visits: Vec<usize> = (0..40).map(|visit| 1_000 + visit * 347 + visit * visit % 61).collect();
        visits.iter().for_each(|&visit| levels[visit..visit + 6].fill(0.2));
        let said =
            |ahead: i64| -> Vec<Micros> { visits.iter().map(|&visit| (visit as i64 + 2 + ahead) * LAG).collect() };
        assert_eq!(ahead(&levels, &said(0)), Some(0.0));
        assert_eq!(ahead(&levels, &said(0)[..5]), None);
        assert_eq!(ahead(&vec![0.2; steps], &said(0)), None);
        let found = ahead(&levels, &said(24)).unwrap();
        assert!((found - 120.0).abs() <= 20.0, "{found}");
        let found = ahead(&levels, &said(-100)).unwrap();
        assert!((found + 500.0).abs() <= 20.0, "{found}");
    }
}
