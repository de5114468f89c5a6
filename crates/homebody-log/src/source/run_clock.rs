//! From the instants that a run's files tell back to the run's own microseconds.

use super::log::Clock;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::{DAY, Micros, SECOND};
use jiff::Timestamp;
use std::cmp::Reverse;
use std::ops::Range;

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
    /// Of the files of a run of a scenario, whose logger says by which clock they tell instants; `length` is in microseconds.
    pub fn of(scenario: &Scenario, length: Micros) -> RunClock {
        let clock = if scenario.logger.time == TimeFormat::Local { Clock::Local } else { Clock::Utc };
        RunClock::new(&scenario.calendar, length, clock)
    }

    /// Of files whose run nobody knows: its instants are what they tell, in microseconds since 1970. An hour that a clock on
    /// the wall tells twice stays one.
    pub fn as_told() -> RunClock {
        RunClock { start: 0, clock: Clock::Utc, offsets: vec![(Micros::MIN, 0)] }
    }

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

    /// The same for files that tell instants by this clock.
    pub fn told_by(self, clock: Clock) -> RunClock {
        RunClock { clock, ..self }
    }

    /// The run's instant that is told as `at`, in microseconds since 1970; `last` is the one before it in the file.
    pub fn instant(&self, at: Micros, last: Micros) -> Micros {
        // Of two, the nearer to what came before: messages overtake each other by less than half an hour.
        let told = self.all(at).min_by_key(|instant| (instant.abs_diff(last), Reverse(*instant)));
        told.unwrap_or_else(|| self.skipped(at))
    }

    /// The same of what is known to be no earlier than `first`, such as the end of a span.
    pub fn instant_from(&self, at: Micros, first: Micros) -> Micros {
        self.all(at).find(|instant| *instant >= first).unwrap_or_else(|| self.instant(at, first))
    }

    /// The run's instants that are told as `at`, in their order: two in an hour that is told twice, none in one that is skipped.
    pub(crate) fn all(&self, at: Micros) -> impl Iterator<Item = Micros> {
        let is_utc = self.clock == Clock::Utc;
        let local = self.offsets.iter().enumerate().filter_map(move |(index, &(from, offset))| {
            let until = self.offsets.get(index + 1).map_or(Micros::MAX, |next| next.0);
            let instant = at - offset - self.start;
            (!is_utc && (from..until).contains(&instant)).then_some(instant)
        });
        is_utc.then_some(at - self.start).into_iter().chain(local)
    }

    /// A time that the clock skips is told by nobody; it is as if it had not skipped.
    fn skipped(&self, at: Micros) -> Micros {
        at - self.offsets[0].1 - self.start
    }

    /// What the files tell of an instant of the run, in microseconds since 1970.
    pub fn told(&self, instant: Micros) -> Micros {
        let next = self.offsets.partition_point(|&(from, _)| from <= instant);
        let offset = self.offsets[..next].last().map_or(0, |&(_, offset)| offset);
        instant + self.start + if self.clock == Clock::Utc { 0 } else { offset }
    }

    /// For each time that the clock goes back, the span of the run in which the files tell every time twice.
    pub(crate) fn told_twice(&self) -> impl Iterator<Item = Range<Micros>> {
        let is_local = self.clock == Clock::Local;
        self.turns().filter(move |turn| is_local && turn.1 < 0).map(|(at, by)| at + by..at - by)
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
        assert!(clock.told_twice().eq(std::iter::once(HOUR..3 * HOUR)));
        // A span from 1:58 to 1:40 lasts 42 minutes, though 1:40 was nearer before.
        let (begin, end) = (midnight + 118 * 60 * SECOND, midnight + 100 * 60 * SECOND);
        let begin = clock.instant(begin, 0);
        assert_eq!(clock.instant_from(end, begin) - begin, 42 * 60 * SECOND);
        assert!(clock.instant(end, begin) < begin, "the control");
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
            assert_eq!(local.instant(local.told(at), at), at);
            assert_eq!(RunClock::as_told().instant(since_1970, at), since_1970);
            assert_eq!(local.instant(since_1970 + Micros::from(zoned.offset().seconds()) * SECOND, 0), at);
        }
    }
}
