//! Days by the clock on the wall, as the page counts them.

use crate::wire::DateView;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::time::Micros;
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
