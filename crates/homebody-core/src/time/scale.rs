//! Converts instants between the scales of a run, of the world and of a clock on a wall.

use super::{Interval, RunTime, SECOND, Span, TimePoint, UtcTime, WallTime};
use jiff::tz::TimeZone;
use std::cmp::Reverse;

/// Ties the three scales of time together: when a run began, and how far a clock on a wall is ahead of UTC, and when.
///
/// The wall is that of a home, or that of UTC for files that tell instants in UTC. It is known over a range of instants; before and
/// after it, the first and the last offset hold.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeScale {
    start: UtcTime,
    /// From when on the wall is so far ahead of UTC. The first one holds from the beginning of time.
    offsets: Vec<(UtcTime, Span)>,
}

/// A change of the clock on a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClockChange<T> {
    /// When it is set.
    pub at: T,
    /// The length of the change; below zero if clocks are set back.
    pub by: Span,
}

impl TimeScale {
    /// The scale of a run that began at `start`, with the wall clock of a zone over a range of instants.
    pub fn new(start: UtcTime, zone: &TimeZone, range: Interval<UtcTime>) -> TimeScale {
        let first = range.begin.timestamp();
        let ahead = |seconds: i32| i64::from(seconds) * SECOND;
        let mut offsets = vec![(UtcTime::MIN, ahead(zone.to_offset(first).seconds()))];
        let changes = zone.following(first).map(|change| (change.timestamp().into(), ahead(change.offset().seconds())));
        for (at, offset) in changes.take_while(|&(at, _)| at <= range.end) {
            if offsets.last().is_some_and(|&(_, last)| last != offset) {
                offsets.push((at, offset));
            }
        }
        TimeScale { start, offsets }
    }

    /// The same, and the run begins in 1970: its wall is that of UTC, so all three scales are one.
    ///
    /// The scale of files of an unknown run. An hour that a clock on the wall shows twice stays one.
    pub fn one() -> TimeScale {
        TimeScale { start: UtcTime::EPOCH, offsets: vec![(UtcTime::MIN, Span::ZERO)] }
    }

    /// Of the same run, with the wall of UTC.
    pub fn with_wall_of_utc(&self) -> TimeScale {
        TimeScale { start: self.start, ..TimeScale::one() }
    }

    /// An instant of the run on the world's clock.
    pub fn to_utc(&self, at: RunTime) -> UtcTime {
        self.start.saturating_add(at.since_zero())
    }

    /// An instant of the world's clock in the run.
    pub fn from_utc(&self, at: UtcTime) -> RunTime {
        RunTime::START + at.saturating_since(self.start)
    }

    /// An instant of the world's clock on the wall.
    pub fn to_wall(&self, at: UtcTime) -> WallTime {
        WallTime::EPOCH.saturating_add(at.since_zero()).saturating_add(self.ahead(at))
    }

    /// An instant of the run on the wall.
    pub fn run_to_wall(&self, at: RunTime) -> WallTime {
        self.to_wall(self.to_utc(at))
    }

    /// The offset of the wall clock from UTC.
    pub fn ahead(&self, at: UtcTime) -> Span {
        let next = self.offsets.partition_point(|&(from, _)| from <= at);
        self.offsets[next.max(1) - 1].1
    }

    /// The instants at which the wall shows a time, in order: two in an hour that it shows twice, none in one that it skips.
    pub fn all_utc(&self, wall: WallTime) -> impl Iterator<Item = UtcTime> {
        self.offsets.iter().enumerate().filter_map(move |(index, &(from, offset))| {
            let until = self.offsets.get(index + 1).map_or(UtcTime::MAX, |next| next.0);
            let at = UtcTime::EPOCH.saturating_add(wall.since_zero()).saturating_sub(offset);
            let holds = from <= at && (at < until || until == UtcTime::MAX);
            holds.then_some(at)
        })
    }

    /// The instant at which the wall shows a time: the first of two; in an hour that it skips, as if it had not yet been set.
    pub fn from_wall(&self, wall: WallTime) -> UtcTime {
        self.all_utc(wall).next().unwrap_or_else(|| self.skipped(wall))
    }

    /// The instant of the run at which the wall shows a time, where it follows `last` in a file: of two the nearer one, as
    /// messages overtake each other by less than half an hour.
    pub fn run_from_wall(&self, wall: WallTime, last: RunTime) -> RunTime {
        let all = self.all_utc(wall).map(|at| self.from_utc(at));
        all.min_by_key(|at| (at.abs_diff(last), Reverse(*at))).unwrap_or_else(|| self.from_utc(self.skipped(wall)))
    }

    /// The same of what is known to be no earlier than `first`, such as the end of an interval.
    pub fn run_from_wall_after(&self, wall: WallTime, first: RunTime) -> RunTime {
        let mut all = self.all_utc(wall).map(|at| self.from_utc(at));
        all.find(|at| *at >= first).unwrap_or_else(|| self.run_from_wall(wall, first))
    }

    /// The instant of a time that the wall skips, by the offset before the change.
    fn skipped(&self, wall: WallTime) -> UtcTime {
        let at = |offset| UtcTime::EPOCH.saturating_add(wall.since_zero()).saturating_sub(offset);
        let change = self.offsets.windows(2).find(|pair| at(pair[0].1) >= pair[1].0 && at(pair[1].1) < pair[1].0);
        at(change.map_or(self.offsets[0].1, |pair| pair[0].1))
    }

    /// When the wall is set, and by how much.
    pub fn changes(&self) -> impl Iterator<Item = ClockChange<UtcTime>> {
        self.offsets.windows(2).map(|pair| ClockChange { at: pair[1].0, by: pair[1].1 - pair[0].1 })
    }

    /// The same within the run.
    pub fn run_changes(&self) -> impl Iterator<Item = ClockChange<RunTime>> {
        self.changes().map(|change| ClockChange { at: self.from_utc(change.at), by: change.by })
    }

    /// For each time that clocks are set back, the interval of the run in which they show every time twice.
    pub fn shown_twice(&self) -> impl Iterator<Item = Interval<RunTime>> {
        let back = self.run_changes().filter(|change| change.by < Span::ZERO);
        back.map(|change| Interval::new(change.at + change.by, change.at - change.by))
    }
}

impl<T: TimePoint> ClockChange<T> {
    /// Whether the wall shows a time again that it has shown before.
    pub fn is_back(self) -> bool {
        self.by < Span::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calendar::Calendar;
    use crate::time::{DAY, HOUR, MINUTE};

    #[test]
    fn an_hour_that_comes_twice_is_known_by_what_came_before() {
        // Clocks go back at 2:00 on 2009-11-01 in Chicago.
        let calendar = Calendar::new("2009-11-01T00:00:00", "America/Chicago").unwrap();
        let scale = calendar.scale(DAY);
        let midnight = scale.run_to_wall(RunTime::START);
        let mut last = RunTime::MIN;
        let mut read = Vec::new();
        for minutes in [0, 60, 90, 119, 61, 60, 90, 119, 120, 180] {
            last = scale.run_from_wall(midnight + minutes * MINUTE, last);
            read.push(last.since_zero() / MINUTE);
        }
        assert_eq!(read, [0, 60, 90, 119, 121, 120, 150, 179, 180, 240]);
        let hour = |hours: i64| RunTime::START + hours * HOUR;
        let changes: Vec<_> = scale.run_changes().collect();
        assert_eq!(changes, [ClockChange { at: hour(2), by: -HOUR }]);
        assert!(changes[0].is_back() && scale.shown_twice().eq([Interval::new(hour(1), hour(3))]));
        let twice: Vec<_> = scale.all_utc(midnight + 90 * MINUTE).collect();
        assert_eq!(twice.iter().map(|&at| scale.to_wall(at) - midnight).collect::<Vec<_>>(), [90 * MINUTE; 2]);
        assert_eq!((twice.len(), twice[1] - twice[0], scale.from_wall(midnight + 90 * MINUTE)), (2, HOUR, twice[0]));
        // An interval from 1:58 to 1:40 lasts 42 minutes, though 1:40 was nearer before.
        let (begin, end) = (midnight + 118 * MINUTE, midnight + 100 * MINUTE);
        let begin = scale.run_from_wall(begin, RunTime::START);
        assert_eq!(scale.run_from_wall_after(end, begin) - begin, 42 * MINUTE);
        assert!(scale.run_from_wall(end, begin) < begin, "the control");
    }

    #[test]
    fn an_hour_that_is_skipped_is_read_as_if_it_were_not() {
        // Clocks go forward at 2:00 on 2009-03-08, the year after they went back on 2008-11-02.
        let calendar = Calendar::new("2008-10-31T00:00:00", "America/Chicago").unwrap();
        let scale = calendar.scale(200 * DAY);
        let by: Vec<Span> = scale.changes().map(|change| change.by).collect();
        assert_eq!(by, [-HOUR, HOUR]);
        let forward = scale.run_changes().last().unwrap().at;
        let half_past_two = scale.run_to_wall(forward) - HOUR / 2;
        assert_eq!(scale.all_utc(half_past_two).count(), 0);
        assert_eq!(scale.run_from_wall(half_past_two, forward), forward + HOUR / 2);
    }

    #[test]
    fn every_instant_that_is_written_is_read_back() {
        let calendar = Calendar::new("2009-03-07T18:00:00", "America/Chicago").unwrap();
        let local = calendar.scale(2 * DAY);
        let utc = local.with_wall_of_utc();
        for at in (0..48).map(|half| RunTime::START + half * HOUR / 2) {
            let zoned = calendar.local(at);
            let told_in_utc = WallTime::EPOCH + UtcTime::from(zoned.timestamp()).since_zero();
            assert_eq!(local.to_utc(at).timestamp(), zoned.timestamp());
            assert_eq!(local.from_utc(local.to_utc(at)), at);
            assert_eq!(local.run_to_wall(at), zoned.datetime().into());
            assert_eq!(local.run_from_wall(zoned.datetime().into(), RunTime::START), at);
            assert_eq!(utc.run_from_wall(told_in_utc, RunTime::START), at);
            let alone = TimeScale::one().run_from_wall(told_in_utc, at);
            assert_eq!(alone.since_zero(), told_in_utc.since_zero());
        }
    }
}
