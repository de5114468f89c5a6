//! Dates and hours on the clock on the wall, for figures of a day.
//!
//! A log in local time stays in it; one in UTC is first put on the wall of a zone. A day has 24 hours: if a clock changes for daylight
//! saving time, an hour of that day is empty or holds two.

use homebody_core::problem::readable;
use homebody_core::time::{Interval, MINUTE, SECOND, Span, TimeScale, UtcTime, WallTime};
use homebody_log::Log;
use homebody_log::log::Clock;
use homebody_log::log::OffsetSpan;
use jiff::civil::Date;
use jiff::tz::TimeZone;
use std::fmt;
use std::str::FromStr;

/// Largest number of days of an analysis that stores figures of each day: ten years.
pub const MOST_DAYS: usize = 3_660;

/// The time of day, as `07:12`; of the end of a day `24:00`.
pub fn clock(since_midnight: Span) -> String {
    let minutes = since_midnight.div_euclid(MINUTE);
    format!("{:02}:{:02}", minutes / 60, minutes % 60)
}

/// A time of day from hours since midnight, as `07:12`: 24.5 is half past midnight.
pub fn clock_of_hours(hours: f64) -> String {
    let minutes = (hours * 60.0).round() as i64;
    format!("{:02}:{:02}", minutes.div_euclid(60).rem_euclid(24), minutes.rem_euclid(60))
}

/// The time of day to the second, as `07:12:03`.
pub fn clock_s(at: WallTime) -> String {
    let since_midnight = at.time_of_day();
    format!("{}:{:02}", clock(since_midnight), since_midnight.div_euclid(SECOND) % 60)
}

/// An instant as logs write it: date, time of day, and microseconds.
pub fn written(at: WallTime) -> String {
    at.datetime().strftime("%Y-%m-%d %H:%M:%S%.6f").to_string()
}

pub fn dates(log: &Log) -> Option<(Date, Date)> {
    let times = || log.events.iter().map(|event| event.at);
    Some((times().min()?.date(), times().max()?.date()))
}

/// The time on the wall of a zone, when a clock in UTC shows `at`.
pub fn on_wall(at: WallTime, zone: &TimeZone) -> WallTime {
    at + ahead(at.as_of_utc(), zone)
}

pub(crate) fn ahead(at: UtcTime, zone: &TimeZone) -> Span {
    i64::from(zone.to_offset(at.timestamp()).seconds()) * SECOND
}

/// Zones whose clocks change in ways of their own: where offsets change, one of them shows how.
const CHANGING: [&str; 18] = [
    "Europe/Berlin",
    "Europe/London",
    "Europe/Helsinki",
    "Atlantic/Azores",
    "America/New_York",
    "America/Chicago",
    "America/Denver",
    "America/Los_Angeles",
    "America/Anchorage",
    "America/Halifax",
    "America/St_Johns",
    "America/Santiago",
    "Australia/Sydney",
    "Australia/Adelaide",
    "Australia/Lord_Howe",
    "Pacific/Auckland",
    "Asia/Jerusalem",
    "Africa/Cairo",
];

/// The zone of a log's home, as its place names it or its offsets show it.
pub fn zone_of(log: &Log) -> Option<TimeZone> {
    log.zone.clone().or_else(|| zone_of_offsets(&log.offsets))
}

/// A zone that has these offsets from UTC when they were written: the clock on the wall of the home, whatever it is called. If
/// no known zone changes as they do, it is the offset that the most time has. `None` without offsets, and of those of UTC.
fn zone_of_offsets(offsets: &[OffsetSpan]) -> Option<TimeZone> {
    let first = offsets.first()?;
    if offsets.iter().all(|span| span.ahead == Span::ZERO) {
        return None;
    }
    let fixed = |ahead: Span| {
        let seconds = i32::try_from(ahead / SECOND).ok()?;
        jiff::tz::Offset::from_seconds(seconds).ok().map(TimeZone::fixed)
    };
    if offsets.iter().all(|span| span.ahead == first.ahead) {
        return fixed(first.ahead);
    }
    let has_all = |zone: &TimeZone| {
        offsets.iter().all(|span| [span.from, span.to].iter().all(|&at| ahead(at, zone) == span.ahead))
    };
    let changing = CHANGING.iter().filter_map(|name| TimeZone::get(name).ok()).find(has_all);
    changing.or_else(|| fixed(offsets.iter().max_by_key(|span| span.to - span.from)?.ahead))
}

/// Puts a log in UTC on the wall of a zone; a log in local time stays.
pub fn put_on_wall(log: &mut Log, zone: &TimeZone) {
    if log.clock == Clock::Local {
        return;
    }
    log.clock = Clock::Local;
    let noted = log.activities.iter().map(|activity| activity.time);
    let all = log.events.iter().map(|event| Interval::instant(event.at)).chain(noted).chain(log.gaps.iter().copied());
    let Some(range) = all.reduce(Interval::hull) else { return };
    let scale = TimeScale::new(UtcTime::EPOCH, zone, range.map(WallTime::as_of_utc));
    let put = |at: &mut WallTime| *at = scale.to_wall(at.as_of_utc());
    log.events.iter_mut().for_each(|event| put(&mut event.at));
    log.activities.iter_mut().flat_map(|activity| [&mut activity.time.begin, &mut activity.time.end]).for_each(put);
    log.gaps.iter_mut().flat_map(|Interval { begin, end }| [begin, end]).for_each(put);
}

homebody_core::messages! {
    /// Problems with the date of a day.
    #[derive(Clone, PartialEq, Eq)]
    pub enum DateMessage in "date" {
        /// A day of a log is a date of the calendar, or the word `first` or `last`. The date must exist: February has no day 30.
        Invalid { text: String } error "invalid" ("{text:?} is not a date")
            hint ("write a date such as 2009-03-02, or the word first or last");
    }
}

/// A chosen day: `2009-03-02`, `first`, `last`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DayChoice {
    First,
    Last,
    On(Date),
}

impl DayChoice {
    /// The date, if it is one of those from `first` to `last`.
    pub fn within(self, (first, last): (Date, Date)) -> Option<Date> {
        match self {
            DayChoice::First => Some(first),
            DayChoice::Last => Some(last),
            DayChoice::On(date) => (first..=last).contains(&date).then_some(date),
        }
    }
}

impl FromStr for DayChoice {
    type Err = DateMessage;

    fn from_str(text: &str) -> Result<DayChoice, DateMessage> {
        let invalid = || DateMessage::Invalid { text: readable(text.to_owned()) };
        match text {
            "first" => Ok(DayChoice::First),
            "last" => Ok(DayChoice::Last),
            // Nothing but a whole date: the parser takes times, too.
            text if text.len() == 10 => text.parse().map(DayChoice::On).map_err(|_| invalid()),
            _ => Err(invalid()),
        }
    }
}

impl fmt::Display for DayChoice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            DayChoice::First => f.write_str("first"),
            DayChoice::Last => f.write_str("last"),
            DayChoice::On(date) => date.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{DAY, HOUR};
    use jiff::civil::date;

    #[test]
    fn formats_times_of_day() {
        let last = WallTime::midnight(date(2009, 3, 2)) - SECOND;
        assert_eq!((clock(Span::ZERO), clock(DAY), clock_s(last)), ("00:00".into(), "24:00".into(), "23:59:59".into()));
        assert_eq!(written(last), "2009-03-01 23:59:59.000000");
    }

    #[test]
    fn offsets_show_the_zone_on_whose_wall_they_are() {
        // Clocks in Europe were set on at one in the night of 29 March 2009, in UTC.
        let change = (WallTime::midnight(date(2009, 3, 29)) + HOUR).as_of_utc();
        let span = |from, to, hours: i64| OffsetSpan { from, to, ahead: hours * HOUR };
        let zone = |offsets: &[OffsetSpan]| zone_of_offsets(offsets);
        let one = zone(&[span(UtcTime::EPOCH, change, -6)]).unwrap();
        assert_eq!(ahead(change, &one), -6 * HOUR);
        let two = zone(&[span(change - DAY, change - SECOND, 1), span(change, change + DAY, 2)]).unwrap();
        assert_eq!([change - SECOND, change].map(|at| ahead(at, &two)), [HOUR, 2 * HOUR]);
        assert_eq!((zone(&[]), zone(&[span(UtcTime::EPOCH, change, 0)])), (None, None));
    }

    #[test]
    fn a_day_is_asked_for_as_people_write_it() {
        assert_eq!("2009-03-02".parse(), Ok(DayChoice::On(date(2009, 3, 2))));
        assert_eq!(("first".parse(), "last".parse()), (Ok(DayChoice::First), Ok(DayChoice::Last)));
        for wrong in ["", "2009-02-29", "20090302", "2009-03-02T07:00", "yesterday", "2009/03/02", "2009-3-2"] {
            assert!(wrong.parse::<DayChoice>().is_err(), "{wrong}");
        }
        let days = (date(2009, 3, 2), date(2009, 3, 4));
        assert_eq!(DayChoice::Last.within(days), Some(days.1));
        assert_eq!(DayChoice::On(date(2009, 3, 5)).within(days), None);
    }

    #[test]
    fn puts_log_in_utc_on_the_wall_of_its_zone() {
        let zone = homebody_core::calendar::Calendar::zone("America/Chicago").unwrap();
        // Daylight saving time began on 8 March 2009, at 08:00 UTC.
        let change = WallTime::midnight(date(2009, 3, 8)) + 8 * HOUR;
        let around = [change - Span::MICROSECOND, change];
        let wanted = [around[0] - 6 * HOUR, change - 5 * HOUR];
        assert_eq!(around.map(|at| on_wall(at, &zone)), wanted);
        let mut log = crate::sample::log(&[(0, "M1", "ON")]);
        log.gaps = vec![Interval::new(around[0], around[1])];
        let local = log.clone();
        put_on_wall(&mut log, &zone);
        assert_eq!(log, local);
        log.clock = Clock::Utc;
        put_on_wall(&mut log, &zone);
        assert_eq!((log.events[0].at, log.clock), (WallTime::EPOCH - 6 * HOUR, Clock::Local));
        assert_eq!(log.gaps, [Interval::new(wanted[0], wanted[1])]);
    }
}
