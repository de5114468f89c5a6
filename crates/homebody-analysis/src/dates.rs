//! Dates and hours on the clock on the wall, for what is told by the day.
//!
//! A log in local time is taken as it is; one in UTC is first put on the wall of a zone. A day has 24 hours: where a clock
//! changes for daylight saving time, an hour of that day is empty or holds two.

use homebody_core::problem::readable;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_log::source::Clock;
use homebody_log::source::OffsetSpan;
use homebody_log::{Activity, Log};
use jiff::civil::{Date, date};
use jiff::tz::TimeZone;
use jiff::{SignedDuration, Span, Timestamp};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// Largest number of days of an analysis that stores figures of each day: ten years.
pub const MOST_DAYS: usize = 3_660;

/// Midnight at the beginning of a date, in microseconds since 1970.
pub fn midnight(day: Date) -> Micros {
    let days = date(1970, 1, 1).until(day).map_or(0, |span| span.get_days());
    i64::from(days) * DAY
}

/// The date of an instant.
pub fn date_of(at: Micros) -> Date {
    date(1970, 1, 1).saturating_add(Span::new().days(at.div_euclid(DAY)))
}

/// The time of day, as `07:12`; of the end of a day `24:00`.
pub fn clock(since_midnight: Micros) -> String {
    let minutes = since_midnight.div_euclid(60 * SECOND);
    format!("{:02}:{:02}", minutes / 60, minutes % 60)
}

/// A time of day from hours since midnight, as `07:12`: 24.5 is half past midnight.
pub fn clock_of_hours(hours: f64) -> String {
    let minutes = (hours * 60.0).round() as i64;
    format!("{:02}:{:02}", minutes.div_euclid(60).rem_euclid(24), minutes.rem_euclid(60))
}

/// The time of day to the second, as `07:12:03`.
pub fn clock_s(at: Micros) -> String {
    format!("{}:{:02}", clock(at.rem_euclid(DAY)), at.div_euclid(SECOND).rem_euclid(60))
}

/// An instant as logs write it: date, time of day, and microseconds.
pub fn written(at: Micros) -> String {
    let wall = date(1970, 1, 1).at(0, 0, 0, 0) + SignedDuration::from_micros(at);
    wall.strftime("%Y-%m-%d %H:%M:%S%.6f").to_string()
}

/// The first and the last date of a log; none of one without rows.
pub fn dates(log: &Log) -> Option<(Date, Date)> {
    let times = || log.events.iter().map(|event| event.at);
    Some((date_of(times().min()?), date_of(times().max()?)))
}

/// Puts an instant of the world's clock on the wall of a zone.
pub fn on_wall(at: Micros, zone: &TimeZone) -> Micros {
    at + ahead(instant(at), zone)
}

/// An instant of the world's clock; the first or the last there is where it is beyond these.
pub(crate) fn instant(at: Micros) -> Timestamp {
    Timestamp::from_microsecond(at).unwrap_or(if at < 0 { Timestamp::MIN } else { Timestamp::MAX })
}

/// How far the clocks of a zone are ahead of UTC.
pub(crate) fn ahead(at: Timestamp, zone: &TimeZone) -> Micros {
    i64::from(zone.to_offset(at).seconds()) * SECOND
}

/// What the clock on the wall leaves out as it is set on, or shows again after it was set back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClockSet {
    /// From when to when, on the wall.
    pub wall: Range<Micros>,
    /// Whether it comes twice; otherwise it does not come.
    pub is_again: bool,
}

/// Where the clocks of a zone are set during a span on its wall.
pub fn clocks_set(span: &Range<Micros>, zone: &TimeZone) -> Vec<ClockSet> {
    // The wall is never further than a day from UTC.
    let first = instant(span.start.saturating_sub(DAY));
    let (mut all, mut before) = (Vec::new(), ahead(first, zone));
    for set in zone.following(first) {
        let at = set.timestamp().as_microsecond();
        if at > span.end.saturating_add(DAY) {
            break;
        }
        let after = i64::from(set.offset().seconds()) * SECOND;
        let wall = at + before.min(after)..at + before.max(after);
        if wall.start < span.end && wall.end > span.start {
            all.push(ClockSet { wall, is_again: after < before });
        }
        before = after;
    }
    all.retain(|set| !set.wall.is_empty());
    all
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
    if offsets.iter().all(|span| span.ahead == 0) {
        return None;
    }
    let fixed = |ahead: Micros| {
        let seconds = i32::try_from(ahead / SECOND).ok()?;
        jiff::tz::Offset::from_seconds(seconds).ok().map(TimeZone::fixed)
    };
    if offsets.iter().all(|span| span.ahead == first.ahead) {
        return fixed(first.ahead);
    }
    let has_all = |zone: &TimeZone| {
        let has = |at: Micros, span: &OffsetSpan| ahead(instant(at), zone) == span.ahead;
        offsets.iter().all(|span| has(span.from, span) && has(span.to, span))
    };
    let changing = CHANGING.iter().filter_map(|name| TimeZone::get(name).ok()).find(has_all);
    changing.or_else(|| fixed(offsets.iter().max_by_key(|span| span.to - span.from)?.ahead))
}

/// Puts a log that is told in UTC on the wall of a zone; one in local time stays as it is.
pub fn put_on_wall(log: &mut Log, zone: &TimeZone) {
    if log.clock == Clock::Local {
        return;
    }
    log.clock = Clock::Local;
    log.events.iter_mut().for_each(|event| event.at = on_wall(event.at, zone));
    for Activity { begin, end, .. } in &mut log.activities {
        (*begin, *end) = (on_wall(*begin, zone), on_wall(*end, zone));
    }
    for (begin, end) in &mut log.gaps {
        (*begin, *end) = (on_wall(*begin, zone), on_wall(*end, zone));
    }
}

homebody_core::messages! {
    /// Problems with the date of a day.
    #[derive(Clone, PartialEq, Eq)]
    pub enum DateMessage in "date" {
        /// A day of a log is a date of the calendar, or the word `first` or `last`. The date must exist: February has no day 30.
        Invalid {
            /// The text.
            text: String,
        } error "invalid" ("{text:?} is not a date")
            hint ("write a date such as 2009-03-02, or the word first or last");
    }
}

/// A day as somebody asks for it: `2009-03-02`, `first`, `last`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// The first day of the log.
    First,
    /// The last day of the log.
    Last,
    /// The day of this date.
    On(Date),
}

impl Asked {
    /// The date, if it is one of those from `first` to `last`.
    pub fn within(self, (first, last): (Date, Date)) -> Option<Date> {
        match self {
            Asked::First => Some(first),
            Asked::Last => Some(last),
            Asked::On(date) => (first..=last).contains(&date).then_some(date),
        }
    }
}

impl FromStr for Asked {
    type Err = DateMessage;

    fn from_str(text: &str) -> Result<Asked, DateMessage> {
        let invalid = || DateMessage::Invalid { text: readable(text.to_owned()) };
        match text {
            "first" => Ok(Asked::First),
            "last" => Ok(Asked::Last),
            // Nothing but a whole date: the parser takes times, too.
            text if text.len() == 10 => text.parse().map(Asked::On).map_err(|_| invalid()),
            _ => Err(invalid()),
        }
    }
}

impl fmt::Display for Asked {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Asked::First => f.write_str("first"),
            Asked::Last => f.write_str("last"),
            Asked::On(date) => date.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_found_and_told() {
        let day = date(2009, 3, 2);
        assert_eq!(midnight(day), 1_235_952_000 * SECOND);
        assert_eq!([-1, 0, DAY - 1, DAY].map(|off| date_of(midnight(day) + off).day()), [1, 2, 2, 3]);
        assert_eq!((clock(0), clock(DAY), clock_s(DAY - SECOND)), ("00:00".into(), "24:00".into(), "23:59:59".into()));
        assert_eq!(date_of(midnight(date(1969, 12, 31)) + 1), date(1969, 12, 31));
    }

    #[test]
    fn offsets_show_the_zone_on_whose_wall_they_are() {
        let hour = 3600 * SECOND;
        // Clocks in Europe were set on at one in the night of 29 March 2009, in UTC.
        let change = midnight(date(2009, 3, 29)) + hour;
        let span = |from, to, hours| OffsetSpan { from, to, ahead: hours * hour };
        let zone = |offsets: &[OffsetSpan]| zone_of_offsets(offsets);
        let one = zone(&[span(0, change, -6)]).unwrap();
        assert_eq!(on_wall(change, &one), change - 6 * hour);
        let two = zone(&[span(change - DAY, change - SECOND, 1), span(change, change + DAY, 2)]).unwrap();
        assert_eq!([change - SECOND, change].map(|at| on_wall(at, &two) - at), [hour, 2 * hour]);
        assert_eq!((zone(&[]), zone(&[span(0, change, 0)])), (None, None));
    }

    #[test]
    fn a_day_is_asked_for_as_people_write_it() {
        assert_eq!("2009-03-02".parse(), Ok(Asked::On(date(2009, 3, 2))));
        assert_eq!(("first".parse(), "last".parse()), (Ok(Asked::First), Ok(Asked::Last)));
        for wrong in ["", "2009-02-29", "20090302", "2009-03-02T07:00", "yesterday", "2009/03/02", "2009-3-2"] {
            assert!(wrong.parse::<Asked>().is_err(), "{wrong}");
        }
        let days = (date(2009, 3, 2), date(2009, 3, 4));
        assert_eq!(Asked::Last.within(days), Some(days.1));
        assert_eq!(Asked::On(date(2009, 3, 5)).within(days), None);
    }

    #[test]
    fn clocks_leave_an_hour_out_and_show_one_again() {
        let zone = TimeZone::get("America/Chicago").unwrap();
        let (hour, year) = (3600 * SECOND, midnight(date(2009, 1, 1))..midnight(date(2010, 1, 1)));
        let [on, back] = [date(2009, 3, 8), date(2009, 11, 1)].map(midnight);
        let wanted = [
            ClockSet { wall: on + 2 * hour..on + 3 * hour, is_again: false },
            ClockSet { wall: back + hour..back + 2 * hour, is_again: true },
        ];
        assert_eq!(clocks_set(&year, &zone), wanted);
        assert_eq!(clocks_set(&(on + 3 * hour..back), &zone), []);
        assert_eq!(clocks_set(&year, &TimeZone::UTC), []);
    }

    #[test]
    fn a_log_in_utc_goes_on_the_wall_of_its_zone() {
        let zone = homebody_core::scenario::calendar::Calendar::zone("America/Chicago").unwrap();
        let hour = 3600 * SECOND;
        // Daylight saving time began on 8 March 2009, at 08:00 UTC.
        let change = midnight(date(2009, 3, 8)) + 8 * hour;
        assert_eq!(on_wall(change - 1, &zone), change - 1 - 6 * hour);
        assert_eq!(on_wall(change, &zone), change - 5 * hour);
        let mut log = crate::sample::log(&[(0, "M1", "ON")]);
        let local = log.clone();
        put_on_wall(&mut log, &zone);
        assert_eq!(log, local);
        log.clock = Clock::Utc;
        put_on_wall(&mut log, &zone);
        assert_eq!((log.events[0].at, log.clock), (-6 * hour, Clock::Local));
    }
}
