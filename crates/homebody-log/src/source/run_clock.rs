//! From the instants that a run's files tell back to the run's own microseconds.

use super::log::Clock;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::time::{DAY, Micros, SECOND};
use jiff::Timestamp;
use std::cmp::Reverse;

/// Reads a run's instants. A clock on the wall that went back tells an hour twice: in the order in which a file tells them, the
/// second time is known by the first.
#[derive(Clone, Debug)]
pub struct RunClock {
    /// Microseconds since 1970.
    start: Micros,
    clock: Clock,
    /// From which of the run's instants on, what the wall's clock adds to UTC.
    offsets: Vec<(Micros, Micros)>,
}

impl RunClock {
    /// Of a run of this length, whose files tell instants by this clock.
    pub fn new(calendar: &Calendar, length: Micros, clock: Clock) -> RunClock {
        let first = calendar.local(0);
        let zone = first.time_zone().clone();
        let micros = |seconds: i32| Micros::from(seconds) * SECOND;
        let mut offsets = vec![(Micros::MIN, micros(first.offset().seconds()))];
        let end: Timestamp = calendar.timestamp(length + DAY);
        for turn in zone.following(first.timestamp()).take_while(|turn| turn.timestamp() <= end) {
            offsets.push((calendar.micros(turn.timestamp()), micros(turn.offset().seconds())));
        }
        RunClock { start: calendar.timestamp(0).as_microsecond(), clock, offsets }
    }

    /// The run's instant that is told as `at`, in microseconds since 1970; `last` is the one before it in the file.
    pub fn instant(&self, at: Micros, last: Micros) -> Micros {
        if self.clock == Clock::Utc {
            return at - self.start;
        }
        let told = self.offsets.iter().enumerate().filter_map(|(index, &(from, offset))| {
            let until = self.offsets.get(index + 1).map_or(Micros::MAX, |next| next.0);
            let instant = at - offset - self.start;
            (from..until).contains(&instant).then_some(instant)
        });
        // Of two, the nearer to what came before: messages overtake each other by less than half an hour.
        let told = told.min_by_key(|instant| (instant.abs_diff(last), Reverse(*instant)));
        // A time that the clock skips is told by nobody; it is as if it had not skipped.
        told.unwrap_or_else(|| at - self.offsets[0].1 - self.start)
    }

    /// When within the run the clock on the wall is set, and by how much.
    pub fn turns(&self) -> impl Iterator<Item = (Micros, Micros)> {
        self.offsets.windows(2).map(|pair| (pair[1].0, pair[1].1 - pair[0].1)).filter(|turn| turn.1 != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUR: Micros = 3600 * SECOND;

    #[test]
    fn an_hour_that_comes_twice_is_told_by_what_came_before() {
        // Clocks go back at 2:00 on 2009-11-01 in Chicago.
        let calendar = Calendar::new("2009-11-01T00:00:00", "America/Chicago").unwrap();
        let clock = RunClock::new(&calendar, DAY, Clock::Local);
        let midnight = calendar.timestamp(0).as_microsecond() - 5 * HOUR;
        let mut last = Micros::MIN;
        let mut told = Vec::new();
        for minutes in [0, 60, 90, 119, 61, 60, 90, 119, 120, 180] {
            last = clock.instant(midnight + minutes * 60 * SECOND, last);
            told.push(last / (60 * SECOND));
        }
        assert_eq!(told, [0, 60, 90, 119, 121, 120, 150, 179, 180, 240]);
        assert_eq!(clock.turns().collect::<Vec<_>>(), [(2 * HOUR, -HOUR)]);
    }

    #[test]
    fn every_instant_that_is_written_is_read_back() {
        let calendar = Calendar::new("2009-03-07T18:00:00", "America/Chicago").unwrap();
        let utc = RunClock::new(&calendar, 2 * DAY, Clock::Utc);
        let local = RunClock::new(&calendar, 2 * DAY, Clock::Local);
        for at in (0..48).map(|half| half * HOUR / 2) {
            let zoned = calendar.local(at);
            let since_1970 = zoned.timestamp().as_microsecond();
            assert_eq!(utc.instant(since_1970, 0), at);
            assert_eq!(local.instant(since_1970 + Micros::from(zoned.offset().seconds()) * SECOND, 0), at);
        }
    }
}
