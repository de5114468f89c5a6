//! Civil days of a run as the page counts them, and its nights.

use crate::wire::{DateView, PlaybackView};
use homebody_core::calendar::Calendar;
use homebody_core::time::{ClockChange, Interval, MINUTE, RunTime, Span};
use homebody_query::search::SearchDay;
use homebody_timeline::Episode;
use std::ops::Range;

pub fn all_days(calendar: &Calendar, length: Span) -> Vec<DateView> {
    days(calendar, length, 0..last_day(calendar, length) + 1)
}

pub fn days(calendar: &Calendar, length: Span, days: Range<u32>) -> Vec<DateView> {
    let turns: Vec<ClockChange<RunTime>> = calendar.scale(length).run_changes().collect();
    let day = |day: u32| {
        let number = day as i32;
        let begin = calendar.instant(number, Span::ZERO).max(RunTime::START);
        let end = calendar.instant(number + 1, Span::ZERO).min(RunTime::START + length);
        let turn = turns.iter().find(|turn| Interval::new(begin, end).contains(turn.at));
        DateView {
            date: date(calendar, day),
            begin_us: begin.micros(),
            end_us: end.micros(),
            clock_us: if day == 0 { calendar.start_of_day().micros() } else { 0 },
            turn: turn.map(|turn| (turn.at.micros(), turn.by.micros())),
        }
    };
    days.map(day).collect()
}

/// Such as `2009-03-02`.
pub fn date(calendar: &Calendar, day: u32) -> String {
    let (year, month, of_month) = calendar.date(day as i32);
    format!("{year:04}-{month:02}-{of_month:02}")
}

pub fn last_day(calendar: &Calendar, length: Span) -> u32 {
    let at = RunTime::START + (length - Span::MICROSECOND).max(Span::ZERO);
    u32::try_from(calendar.day(at)).unwrap_or(0)
}

pub fn hour(calendar: &Calendar, at: RunTime) -> usize {
    usize::try_from(calendar.local(at).hour()).unwrap_or(0)
}

/// Interval of the computed positions of the sun (our choice). Sunrise and sunset are interpolated between them.
const STEP: Span = MINUTE.times(10);

/// The intervals in which the sun is down, by the sine of its height.
pub fn nights(height: impl Fn(RunTime) -> f64, length: Span) -> Vec<(i64, i64)> {
    let mut nights: Vec<Interval<RunTime>> = Vec::new();
    let last = RunTime::START + length;
    let mut at = RunTime::START;
    let mut before = height(at);
    let mut since = (before < 0.0).then_some(at);
    while at < last {
        let next = (at + STEP).min(last);
        let now = height(next);
        let turn = || at + Span::from_micros(((next - at).micros() as f64 * before / (before - now)) as i64);
        match (since, now < 0.0) {
            (None, true) => since = Some(turn()),
            (Some(begin), false) => {
                nights.push(Interval::new(begin, turn()));
                since = None;
            }
            _ => {}
        }
        (at, before) = (next, now);
    }
    nights.extend(since.map(|begin| Interval::new(begin, last)));
    nights.into_iter().map(|night| (night.begin.micros(), night.end.micros())).collect()
}

/// An episode whose label is a number in a list of names.
pub type NumberedEpisode = Episode<RunTime, u32>;

/// The form of an episode in messages: begin, end and label.
pub fn in_micros<L: Copy>(episode: &Episode<RunTime, L>) -> (i64, i64, L) {
    (episode.begin().micros(), episode.end().micros(), episode.label)
}

impl DateView {
    pub fn interval(&self) -> Interval<RunTime> {
        Interval::new(RunTime::from_micros(self.begin_us), RunTime::from_micros(self.end_us))
    }

    pub fn clock(&self) -> SearchDay<RunTime> {
        let Interval { begin, end } = self.interval();
        let turn = self.turn.map(|(at, by)| ClockChange { at: RunTime::from_micros(at), by: Span::from_micros(by) });
        SearchDay { begin, end, clock: Span::from_micros(self.clock_us), turn }
    }
}

impl PlaybackView {
    pub fn length(&self) -> Span {
        Span::from_micros(self.length_us)
    }

    pub fn interval(&self) -> Interval<RunTime> {
        Interval::starting(RunTime::START, self.length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{DAY, HOUR, SECOND};

    #[test]
    fn nights_last_while_the_sun_is_down() {
        // The sun rises at six and sets at eighteen.
        let height = |at: RunTime| -(at.since_zero().ratio(DAY) * std::f64::consts::TAU).cos();
        let is_near = |us: i64, to: Span| (Span::from_micros(us) - to).abs() < 5 * SECOND;
        let near = |(begin, end): (i64, i64), from: Span, to: Span| is_near(begin, from) && is_near(end, to);
        let all = nights(height, 2 * DAY - HOUR);
        assert_eq!(all.len(), 3);
        assert!(near(all[0], Span::ZERO, 6 * HOUR) && near(all[1], 18 * HOUR, 30 * HOUR), "{all:?}");
        assert!(near(all[2], 42 * HOUR, 47 * HOUR), "{all:?}");
        assert_eq!(nights(|_| 1.0, DAY), []);
        assert_eq!(nights(|_| -1.0, DAY), [(0, DAY.micros())]);
    }
}
