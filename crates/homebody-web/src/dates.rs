//! Days by the clock on the wall, as the page counts them, and the nights between them.

use crate::wire::DateView;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::time::{Micros, SECOND};
use homebody_log::RunClock;
use homebody_log::source::Clock;
use std::ops::Range;

/// All days of a run of this length.
pub fn all(calendar: &Calendar, length: Micros) -> Vec<DateView> {
    some(calendar, length, 0..last(calendar, length) + 1)
}

/// Some days of a run of this length, counted from 0.
pub fn some(calendar: &Calendar, length: Micros, days: Range<u32>) -> Vec<DateView> {
    let turns = turns(calendar, length);
    let day = |day: u32| {
        let number = day as i32;
        let begin = calendar.instant(number, 0).max(0);
        let end = calendar.instant(number + 1, 0).min(length);
        DateView {
            date: date(calendar, day),
            begin_us: begin,
            end_us: end,
            clock_us: if day == 0 { calendar.start_of_day() } else { 0 },
            turn: turns.iter().copied().find(|turn| (begin..end).contains(&turn.0)),
        }
    };
    days.map(day).collect()
}

/// The date of a day, such as `2009-03-02`.
pub fn date(calendar: &Calendar, day: u32) -> String {
    let (year, month, of_month) = calendar.date(day as i32);
    format!("{year:04}-{month:02}-{of_month:02}")
}

/// The number of a run's last day.
pub fn last(calendar: &Calendar, length: Micros) -> u32 {
    u32::try_from(calendar.day((length - 1).max(0))).unwrap_or(0)
}

/// When clocks are set within a run, and by how much.
pub fn turns(calendar: &Calendar, length: Micros) -> Vec<(Micros, Micros)> {
    RunClock::new(calendar, length, Clock::Utc).turns().collect()
}

/// The hour on the clock on the wall.
pub fn hour(calendar: &Calendar, at: Micros) -> usize {
    usize::try_from(calendar.local(at).hour()).unwrap_or(0)
}

/// Interval of the computed positions of the sun (our choice). Sunrise and sunset are interpolated between them.
const STEP: Micros = 600 * SECOND;

/// From when to when the sun is down, in order, over a run of this length, by the sine of its height.
pub fn nights(height: impl Fn(Micros) -> f64, length: Micros) -> Vec<(i64, i64)> {
    let mut nights: Vec<(i64, i64)> = Vec::new();
    let mut before = height(0);
    let mut since = (before < 0.0).then_some(0);
    let mut at = 0;
    while at < length {
        let next = (at + STEP).min(length);
        let now = height(next);
        let turn = || at + ((next - at) as f64 * before / (before - now)) as Micros;
        match (since, now < 0.0) {
            (None, true) => since = Some(turn()),
            (Some(begin), false) => {
                nights.push((begin, turn()));
                since = None;
            }
            _ => {}
        }
        (at, before) = (next, now);
    }
    nights.extend(since.map(|begin| (begin, length)));
    nights
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::DAY;

    const HOUR: Micros = 3600 * SECOND;

    #[test]
    fn nights_are_while_the_sun_is_down_and_end_with_the_run() {
        // It rises at six and sets at eighteen.
        let height = |at: Micros| -(at as f64 / DAY as f64 * std::f64::consts::TAU).cos();
        let near = |(begin, end): (i64, i64), from: Micros, to: Micros| {
            (begin - from).abs() < 5 * SECOND && (end - to).abs() < 5 * SECOND
        };
        let all = nights(height, 2 * DAY - HOUR);
        assert_eq!(all.len(), 3);
        assert!(near(all[0], 0, 6 * HOUR) && near(all[1], 18 * HOUR, 30 * HOUR), "{all:?}");
        assert!(near(all[2], 42 * HOUR, 47 * HOUR), "{all:?}");
        assert_eq!(nights(|_| 1.0, DAY), []);
        assert_eq!(nights(|_| -1.0, DAY), [(0, DAY)]);
    }
}
