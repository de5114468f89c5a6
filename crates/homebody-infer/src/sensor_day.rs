//! Messages of each sensor by day, compared with the number expected from the located people.

use crate::message::{LastMessage, LogMessage, MessageKind, ReportTiming};
use crate::smoother::InstantEstimate;
use homebody_core::geometry::Point;
use homebody_core::time::{DAY, Interval, RunTime, SECOND, Span};

/// Rate, in messages a second, below which a message is unexplained (our choice): a sensor with a person in view sends
/// some a minute.
const UNEXPLAINED: f32 = 1e-3;
/// Step of the search for a clock's error, and largest number of steps (our choice): an hour.
const LAG: Span = SECOND.times(5);
const MOST_LAGS: i64 = 720;
/// Messages a day that a clock's error is estimated from (our choice).
const FOR_LAG: usize = 20;
/// Smallest rate of a sensor with a person in view, in messages a second (our choice).
const SEES: f32 = 0.03;
/// Smallest margin of the best error of a clock over an arbitrary one, in standard deviations (our choice).
const SURE: f64 = 4.0;

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SensorDayCounts {
    /// Expected number of ON messages.
    pub expected: f64,
    /// ON messages with a person in its field.
    pub explained: u32,
    /// Places of people at ON messages without a person in the field; `None` while all were out.
    pub unexplained: Vec<Option<Point>>,
    /// Error of its clock in seconds, positive if fast, if it can be estimated.
    pub ahead_s: Option<f64>,
}

/// Observes sensors during smoothing, including those that are ignored.
#[derive(Clone, Debug)]
pub(crate) struct SensorWatch<'a> {
    timing: &'a [ReportTiming],
    /// By sensor.
    messages: &'a [Vec<LogMessage>],
    /// By sensor: number of messages so far, and the state after the last.
    heard: Vec<(usize, LastMessage)>,
    days: Vec<Vec<SensorDayCounts>>,
    /// By sensor: the expected rate over the day so far, in steps of [`LAG`].
    levels: Vec<Vec<f32>>,
    /// The last instant, and the expected rates then.
    last: RunTime,
    before: Vec<f32>,
}

impl<'a> SensorWatch<'a> {
    pub fn new(timing: &'a [ReportTiming], messages: &'a [Vec<LogMessage>]) -> SensorWatch<'a> {
        let sensors = timing.len();
        SensorWatch {
            timing,
            messages,
            heard: vec![(0, LastMessage::default()); sensors],
            days: vec![vec![SensorDayCounts::default()]; sensors],
            levels: vec![vec![0.0; (DAY / LAG) as usize]; sensors],
            last: RunTime::START,
            before: vec![0.0; sensors],
        }
    }

    pub fn see(&mut self, instant: &InstantEstimate) {
        let now = instant.expected(self.timing.len());
        let place = instant.guesses().first().and_then(|guess| guess.state.at);
        let day = |at: RunTime| at.since_zero() / DAY;
        while day(self.last) < day(instant.at) {
            self.pass(RunTime::START + (day(self.last) + 1) * DAY, &now, place);
            self.end_day();
        }
        self.pass(instant.at, &now, place);
        self.before = now;
    }

    pub fn finish(mut self) -> Vec<Vec<SensorDayCounts>> {
        self.end_day();
        self.days.iter_mut().for_each(|days| {
            days.pop();
        });
        self.days
    }

    /// Advances within a day; `now` are the rates until then.
    fn pass(&mut self, to: RunTime, now: &[f32], place: Option<Point>) {
        let from = std::mem::replace(&mut self.last, to);
        let first = (from.since_zero() % DAY / LAG) as usize;
        let end = (((to.since_zero() - Span::MICROSECOND).rem_euclid(DAY) / LAG) as usize).max(first);
        for sensor in 0..self.timing.len() {
            let (before, now) = (self.before[sensor], now[sensor]);
            let rate = (before + now) / 2.0;
            let Some(day) = self.days[sensor].last_mut() else { continue };
            let (heard, last) = &mut self.heard[sensor];
            let mut since = from;
            let mut deaf = Span::ZERO;
            while let Some(message) = self.messages[sensor].get(*heard).filter(|message| message.at <= to) {
                let until = Interval::new(since, message.at.max(since));
                deaf += last.deaf(until).min(until.length());
                since = until.end;
                if message.said == MessageKind::On {
                    match before.max(now) >= UNEXPLAINED {
                        true => day.explained += 1,
                        false => day.unexplained.push(place),
                    }
                }
                last.hear(message, &self.timing[sensor]);
                *heard += 1;
            }
            deaf += last.deaf(Interval::new(since, to)).min(to - since);
            day.expected += f64::from(rate) * (to - from - deaf).seconds();
            self.levels[sensor][first..=end].iter_mut().for_each(|level| *level = level.max(rate));
        }
    }

    fn end_day(&mut self) {
        // Midnight belongs to the day before.
        let last = (self.last.since_zero() - Span::MICROSECOND).max(Span::ZERO);
        let begin = RunTime::START + last / DAY * DAY;
        for (sensor, days) in self.days.iter_mut().enumerate() {
            let heard = &self.messages[sensor][..self.heard[sensor].0];
            let today = heard.iter().rev().take_while(|message| message.at >= begin);
            let said: Vec<RunTime> =
                today.filter(|message| message.said == MessageKind::On).map(|message| message.at).collect();
            if let Some(day) = days.last_mut() {
                day.ahead_s = ahead(&self.levels[sensor], &said);
            }
            self.levels[sensor].fill(0.0);
            days.push(SensorDayCounts::default());
        }
    }
}

/// Error of a clock in seconds, from messages that match the expected rates best when shifted; `None` with few messages or
/// without a clear best.
fn ahead(levels: &[f32], said: &[RunTime]) -> Option<f64> {
    if said.len() < FOR_LAG {
        return None;
    }
    let sees: Vec<f64> = levels.iter().map(|&level| f64::from(level.min(SEES) / SEES)).collect();
    let places: Vec<i64> = said.iter().map(|said| said.since_zero() % DAY / LAG).collect();
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
    is_sure.then(|| best as f64 * LAG.seconds())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_clock_that_is_ahead() {
        let steps = (DAY / LAG) as usize;
        let mut levels = vec![0.0; steps];
        let visits: Vec<usize> = (0..40).map(|visit| 1_000 + visit * 347 + visit * visit % 61).collect();
        visits.iter().for_each(|&visit| levels[visit..visit + 6].fill(0.2));
        let said = |ahead: i64| -> Vec<RunTime> {
            visits.iter().map(|&visit| RunTime::START + (visit as i64 + 2 + ahead) * LAG).collect()
        };
        assert_eq!(ahead(&levels, &said(0)), Some(0.0));
        assert_eq!(ahead(&levels, &said(0)[..5]), None);
        assert_eq!(ahead(&vec![0.2; steps], &said(0)), None);
        let found = ahead(&levels, &said(24)).unwrap();
        assert!((found - 120.0).abs() <= 20.0, "{found}");
        let found = ahead(&levels, &said(-100)).unwrap();
        assert!((found + 500.0).abs() <= 20.0, "{found}");
    }
}
