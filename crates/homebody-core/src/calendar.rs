//! Local time at the edges: the world itself knows only microseconds since the start.

use crate::nearest::nearest;
use crate::problem::{Advice, readable};
use crate::time::{DAY, HOUR, Interval, MINUTE, RunTime, SECOND, Span, TimeScale, UtcTime};
use jiff::civil::DateTime;
use jiff::tz::{AmbiguousOffset, TimeZone, TimeZoneDatabase};
use jiff::{Timestamp, Zoned};

crate::messages! {
    /// Problems with dates, times and time zones.
    pub enum TimeMessage in "time" {
        /// Time zones have the names of the IANA database, a region and a city. Homebody contains that database, so the names are the same on
        /// each computer.
        UnknownZone { name: String, nearest: Option<String> } error "unknown-zone" ("there is no time zone {name:?}")
            advice (Some(match nearest {
                Some(near) => Advice::meant(near),
                None => "write an IANA name such as \"America/Chicago\"".into(),
            }));
        /// A start is a date and a time of day. The date must exist: February has no day 30.
        InvalidStart { text: String } error "invalid-start" ("{text:?} is not a date and time")
            hint ("write it as \"2009-03-02T00:00:00\"");
        /// A start is local time in the home's time zone, which has a key of its own:
        ///
        /// ```json
        /// { "start": "2009-03-02T00:00:00", "time_zone": "America/Chicago" }
        /// ```
        ZoneInStart { text: String } error "zone-in-start" ("{text:?} must not name a time zone")
            hint ("write local time, and give the zone in the key \"time_zone\"");
        /// The rules of time zones are known for some centuries only.
        Year { year: i64, first: i64, last: i64 }
            error "year" ("the year must be from {first} to {last}, but is {year}")
            hint ("choose another date");
        /// When daylight saving time begins, clocks skip an hour, so no clock shows this time on this day.
        Skipped { date_time: String, zone: String }
            error "skipped" ("{date_time} does not exist in {zone}: daylight saving time begins, and clocks skip it")
            hint ("choose a time an hour later");
        /// The date is near the end of the calendar, and its time in the time zone is beyond.
        BeyondCalendar { text: String, why: String } error "beyond-calendar" ("{text:?} is outside the calendar: {why}")
            hint ("choose another date");
        /// A time of day has two digits for hours, two for minutes and, if needed, two for seconds with a fraction.
        InvalidTimeOfDay { text: String } error "invalid-time-of-day" ("{text:?} is not a time of day")
            hint ("write it as \"07:30\" or \"07:30:15.5\", from \"00:00\" to \"23:59:59.999999\"");
    }
}

/// Ties the time of a run to the clock on the wall of the home.
#[derive(Clone, Debug, PartialEq)]
pub struct Calendar {
    start: Zoned,
}

impl Calendar {
    /// The calendar of a scenario's `start` and `time_zone`.
    ///
    /// # Errors
    ///
    /// A [`TimeMessage`] for an unknown zone, and for a start that is not a time in it.
    pub fn new(start: &str, time_zone: &str) -> Result<Calendar, TimeMessage> {
        let zone = Calendar::zone(time_zone)?;
        let text = start;
        let invalid = |_| TimeMessage::InvalidStart { text: readable(text.to_owned()) };
        let start: DateTime = text.parse().map_err(invalid)?;
        let start = zone.into_ambiguous_zoned(start);
        if matches!(start.offset(), AmbiguousOffset::Gap { .. }) {
            let date_time = start.datetime().to_string();
            return Err(TimeMessage::Skipped { date_time, zone: time_zone.to_owned() });
        }
        let beyond = |error: jiff::Error| TimeMessage::BeyondCalendar {
            text: readable(text.to_owned()),
            why: error.to_string(),
        };
        let start = start.compatible().map_err(beyond)?;
        Ok(Calendar { start })
    }

    /// The name of its time zone, as `America/Chicago`; None where the zone has none.
    pub fn zone_name(&self) -> Option<&str> {
        self.start.time_zone().iana_name()
    }

    /// A time zone of the bundled database.
    ///
    /// # Errors
    ///
    /// [`TimeMessage::UnknownZone`] with the name that was probably meant.
    pub fn zone(name: &str) -> Result<TimeZone, TimeMessage> {
        let unknown = |_| TimeMessage::UnknownZone { nearest: nearest_zone(name), name: readable(name.to_owned()) };
        TimeZoneDatabase::bundled().get(name).map_err(unknown)
    }

    /// The instant on the world's clock, which stands still at the calendar's end.
    pub fn timestamp(&self, at: RunTime) -> Timestamp {
        let start = self.start.timestamp();
        start.saturating_add(at.since_zero().to_signed_duration()).unwrap_or(start)
    }

    /// The instant on the clock on the wall.
    pub fn local(&self, at: RunTime) -> Zoned {
        self.timestamp(at).to_zoned(self.start.time_zone().clone())
    }

    /// Date and time on the wall at an instant, as `2009-03-02 07:12:03`.
    pub fn wall_clock(&self, at: RunTime) -> String {
        self.local(at).strftime("%Y-%m-%d %H:%M:%S").to_string()
    }

    /// The instant that is written so: `2009-03-02T07:12:03`, or a time of day of the run's first 24 hours; it may be before
    /// the run begins.
    pub fn written(&self, text: &str) -> Option<RunTime> {
        if let Some(time) = time_of_day(text) {
            let at = self.instant(0, time);
            return Some(if at < RunTime::START { self.instant(0, time + DAY) } else { at });
        }
        let moment: DateTime = text.parse().ok().filter(|_| text.contains(':'))?;
        let time = moment.duration_since(moment.date().to_datetime(jiff::civil::Time::midnight()));
        let day = (moment.date() - self.start.date()).get_days();
        Some(self.instant(day, Span::from_micros(i64::try_from(time.as_micros()).ok()?)))
    }

    /// The day that an instant lies in, by the clock on the wall; the start's is 0.
    pub fn day(&self, at: RunTime) -> i32 {
        (self.local(at).date() - self.start.date()).get_days()
    }

    /// The length of a number of days of the home's local time from the start of a run. A day on which clocks change
    /// has 23 or 25 hours.
    pub fn span_of_days(&self, days: f64) -> Span {
        let (begin, end) = self.run_day(days as i32);
        begin.since_zero() + (end - begin).scaled(days.fract())
    }

    /// The number of days of a run up to an instant.
    pub fn days_lived(&self, at: RunTime) -> f64 {
        // It began a day early at most, since a run may begin at noon.
        let mut whole = self.day(at);
        while whole > 0 && self.run_day(whole).0 > at {
            whole -= 1;
        }
        let (begin, end) = self.run_day(whole);
        f64::from(whole) + (at - begin).ratio(end - begin)
    }

    /// The interval of a run's day that begins at the hour of the start.
    fn run_day(&self, day: i32) -> (RunTime, RunTime) {
        let begin = |day| if day == 0 { RunTime::START } else { self.instant(day, self.start_of_day()) };
        (begin(day), begin(day.saturating_add(1)))
    }

    /// The instant of a time of day, given since midnight; beyond 24 hours it is of the days after. A time that the clock
    /// skips is as much later as it skips; of a time that comes twice, it is the first.
    pub fn instant(&self, day: i32, time_of_day: Span) -> RunTime {
        let day = i64::from(day) + time_of_day.div_euclid(DAY);
        let time = time_of_day.rem_euclid(DAY);
        // Beyond the calendar's end, days have 24 hours.
        let beyond = || RunTime::START + (DAY.saturating_mul(day).saturating_add(time) - self.start_of_day());
        let Ok(date) = self.start.date().checked_add(jiff::Span::new().days(day.clamp(-4_000_000, 4_000_000))) else {
            return beyond();
        };
        let midnight = date.to_datetime(jiff::civil::Time::midnight());
        let Ok(local) = midnight.checked_add(time.to_signed_duration()) else { return beyond() };
        let zoned = self.start.time_zone().to_ambiguous_zoned(local).compatible();
        zoned.map_or_else(|_| beyond(), |zoned| self.run_time(zoned.timestamp()))
    }

    /// Year, month and day of the month.
    pub fn date(&self, day: i32) -> (i16, u8, u8) {
        let date = self.start.date().saturating_add(jiff::Span::new().days(day.clamp(-4_000_000, 4_000_000)));
        (date.year(), date.month() as u8, date.day() as u8)
    }

    /// The day of the week, Monday being 0.
    pub fn weekday(&self, day: i32) -> u8 {
        let monday = i64::from(self.start.weekday().to_monday_zero_offset());
        (monday + i64::from(day)).rem_euclid(7) as u8
    }

    /// The day of a date, from 0 at the start; `None` if there is no such date.
    pub fn day_of(&self, year: i16, month: u8, day: u8) -> Option<i32> {
        let date = jiff::civil::Date::new(year, i8::try_from(month).ok()?, i8::try_from(day).ok()?).ok()?;
        Some((date - self.start.date()).get_days())
    }

    /// The time of day at the start, since midnight.
    pub fn start_of_day(&self) -> Span {
        let time = self.start.time();
        let minutes = i64::from(time.hour()) * 60 + i64::from(time.minute());
        let micros = i64::from(time.subsec_nanosecond()) / 1000;
        minutes * MINUTE + i64::from(time.second()) * SECOND + Span::from_micros(micros)
    }

    /// The run's time at an instant of the world's clock.
    pub fn run_time(&self, at: Timestamp) -> RunTime {
        RunTime::START + (UtcTime::from(at) - UtcTime::from(self.start.timestamp()))
    }

    /// The scale of a run of this length, with the wall of the home.
    pub fn scale(&self, length: Span) -> TimeScale {
        let start = UtcTime::from(self.start.timestamp());
        let range = Interval::new(start, start.saturating_add(length).saturating_add(DAY));
        TimeScale::new(start, self.start.time_zone(), range)
    }
}

/// The intended zone of a misspelt name, or of a city without its continent.
fn nearest_zone(name: &str) -> Option<String> {
    let known: Vec<String> = TimeZoneDatabase::bundled().available().map(|name| name.to_string()).collect();
    let folded = |name: &str| name.trim().to_lowercase();
    let is_city = |zone: &&String| zone.rsplit('/').next().is_some_and(|city| folded(city) == folded(name));
    let near = nearest(name, known.iter().map(String::as_str));
    near.or(known.iter().find(is_city).map(String::as_str)).map(str::to_owned)
}

/// A time of day as files write it, `07:30`, `07:30:15` or `07:30:15.5`, since midnight.
pub fn time_of_day(text: &str) -> Option<Span> {
    let mut parts = text.split(':');
    let (hours, minutes, seconds) = (parts.next()?, parts.next()?, parts.next().unwrap_or("00"));
    let (seconds, fraction) = seconds.split_once('.').unwrap_or((seconds, "0"));
    let two_digits = |part: &str, most: i64| -> Option<i64> {
        let is_number = part.len() == 2 && part.bytes().all(|byte| byte.is_ascii_digit());
        part.parse().ok().filter(|&number| is_number && number <= most)
    };
    let is_fraction = (1..=6).contains(&fraction.len()) && fraction.bytes().all(|byte| byte.is_ascii_digit());
    if parts.next().is_some() || !is_fraction {
        return None;
    }
    let fraction: i64 = format!("{fraction:0<6}").parse().ok()?;
    let (hours, minutes, seconds) = (two_digits(hours, 23)?, two_digits(minutes, 59)?, two_digits(seconds, 59)?);
    Some(hours * HOUR + minutes * MINUTE + seconds * SECOND + Span::from_micros(fraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_day_are_read_as_written() {
        assert_eq!(time_of_day("00:00"), Some(Span::ZERO));
        assert_eq!(time_of_day("07:30"), Some(450 * MINUTE));
        assert_eq!(time_of_day("07:30:15.5"), Some(450 * MINUTE + Span::from_millis(15_500)));
        assert_eq!(time_of_day("23:59:59.999999"), Some(DAY - Span::MICROSECOND));
    }

    #[test]
    fn at_the_calendars_end_the_clock_stands_still() {
        let calendar = Calendar::new("9999-12-27T18:00:00", "America/Chicago").unwrap();
        assert_eq!(calendar.wall_clock(RunTime::START + DAY), "9999-12-28 18:00:00");
        assert_eq!(calendar.wall_clock(RunTime::START + 40 * DAY), calendar.wall_clock(RunTime::MAX));
    }

    #[test]
    fn days_and_times_are_the_homes_own() {
        let hour = |hours: i64| RunTime::START + hours * HOUR;
        // Clocks go forward on 2009-03-08 at 2:00 in Chicago, back on 2009-11-01.
        let calendar = Calendar::new("2009-03-06T18:00:00", "America/Chicago").unwrap();
        assert_eq!(calendar.instant(0, 20 * HOUR), hour(2));
        assert_eq!(calendar.instant(1, Span::ZERO), hour(6));
        assert_eq!(calendar.instant(0, 30 * HOUR), hour(12), "6:00 on the next day");
        assert_eq!(calendar.instant(2, 3 * HOUR) - calendar.instant(2, HOUR), HOUR, "an hour is skipped");
        assert_eq!(calendar.instant(2, 2 * HOUR + HOUR / 2), calendar.instant(2, 3 * HOUR + HOUR / 2));
        assert_eq!(calendar.instant(3, Span::ZERO) - calendar.instant(2, Span::ZERO), 23 * HOUR);
        assert_eq!(calendar.day(hour(6) - Span::MICROSECOND), 0);
        assert_eq!(calendar.day(hour(6)), 1);
        assert_eq!(calendar.day(calendar.instant(400, Span::ZERO)), 400);
        assert_eq!(calendar.weekday(0), 4);
        assert_eq!(calendar.weekday(-5), 6);
        assert_eq!(calendar.date(26), (2009, 4, 1));
        assert_eq!(calendar.day_of(2009, 4, 1), Some(26));
        assert_eq!(calendar.day_of(2009, 2, 30), None);
    }

    #[test]
    fn moments_are_read_as_they_are_shown() {
        let calendar = Calendar::new("2009-03-06T18:00:00", "America/Chicago").unwrap();
        for at in [Span::ZERO, 7 * HOUR + 15 * SECOND, 60 * HOUR].map(|since| RunTime::START + since) {
            let shown = calendar.wall_clock(at);
            assert_eq!(calendar.written(&shown), Some(at));
            assert_eq!(calendar.written(&shown.replace(' ', "T")), Some(at));
        }
        assert_eq!(calendar.written("2009-03-07T00:30"), Some(RunTime::START + 13 * HOUR / 2));
        assert_eq!(calendar.written("17:00"), Some(RunTime::START + 23 * HOUR), "on the next day");
        assert!(calendar.written("2009-03-05 12:00").is_some_and(|at| at < RunTime::START));
        for wrong in ["", "2009-03-06", "2009-02-30T10:00", "noon", "2009-03-06T25:00", "7:30"] {
            assert_eq!(calendar.written(wrong), None, "{wrong:?}");
        }
    }

    #[test]
    fn rejects_invalid_times_of_day() {
        let wrong = ["", "7:30", "07", "07:3", "24:00", "07:60", "07:30:60", "07:30:15.", "07:30:15.1234567", "+7:30"];
        for text in wrong.into_iter().chain(["07:30:15:00", " 07:30", "07:30 ", "07:30:1٣", "07.30", "07:30:.5"]) {
            assert_eq!(time_of_day(text), None, "{text:?}");
        }
    }
}
