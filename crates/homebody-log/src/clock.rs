//! Writes a run's instants the way the log wants them, fast: a log has a million of them.
//!
//! The calendar's own way asks the time zone for each instant. Here the offset from UTC is kept until the zone
//! next changes it, the date for the day, and the hour and minute for the minute.

use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::Micros;
use jiff::civil::{Date, date};
use jiff::tz::TimeZone;
use jiff::{SignedDuration, Span, Timestamp};
use std::ops::Range;

const SECOND: i64 = 1_000_000;
const MINUTE: i64 = 60 * SECOND;
const DAY: i64 = 24 * 60 * MINUTE;

/// Length of the longest text, `2009-03-02T07:12:03.250000-06:00`: a year has at most four digits.
const LONGEST: usize = 32;

/// The clock on the wall, as text.
#[derive(Clone)]
pub struct Clock {
    format: TimeFormat,
    zone: TimeZone,
    /// The run's start, in microseconds since 1970.
    start: i64,
    /// The instant that `text` shows, since 1970: rows that follow each other often tell of the same.
    last: Option<i64>,
    /// What the zone adds to UTC within `steady`.
    offset: i64,
    /// Microseconds since 1970 for which `offset` holds.
    steady: Range<i64>,
    /// The minute of local time, counted from 1970, that `text` shows.
    minute: i64,
    /// The day of local time, counted from 1970, that `date` is.
    day: i64,
    date: Date,
    text: [u8; LONGEST],
    /// Where the seconds stand in `text`; what is before and after them stays for the minute.
    seconds_at: usize,
    length: usize,
}

/// An instant in the type a database should keep it in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stamp<'a> {
    /// As text.
    Text(&'a str),
    /// Seconds since 1970.
    Seconds(f64),
    /// Milliseconds since 1970.
    Milliseconds(i64),
}

impl Clock {
    /// A clock of a run's calendar that writes instants in this format.
    pub fn new(calendar: &Calendar, format: TimeFormat) -> Clock {
        let zone = match format {
            TimeFormat::Local | TimeFormat::LocalOffset => calendar.local(0).time_zone().clone(),
            TimeFormat::Utc | TimeFormat::EpochS | TimeFormat::EpochMs => TimeZone::UTC,
        };
        Clock {
            format,
            zone,
            start: calendar.timestamp(0).as_microsecond(),
            last: None,
            offset: 0,
            steady: 0..0,
            minute: i64::MIN,
            day: 0,
            date: date(1970, 1, 1),
            text: [0; LONGEST],
            seconds_at: 0,
            length: 0,
        }
    }

    /// The instant for a database.
    pub fn stamp(&mut self, at: Micros) -> Stamp<'_> {
        let epoch = self.start + at;
        match self.format {
            TimeFormat::EpochS => Stamp::Seconds(epoch as f64 / SECOND as f64),
            TimeFormat::EpochMs => Stamp::Milliseconds(epoch.div_euclid(1000)),
            TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => Stamp::Text(self.text(at)),
        }
    }

    /// The instant in microseconds since 1970, for a type of its own: by the clock on the wall where instants are told without
    /// their offset, else by the world's.
    pub fn micros(&mut self, at: Micros) -> i64 {
        let epoch = self.start + at;
        if self.format != TimeFormat::Local {
            return epoch;
        }
        if !self.steady.contains(&epoch) {
            self.ask_zone(epoch);
        }
        epoch + self.offset
    }

    /// The instant for a text file.
    pub fn text(&mut self, at: Micros) -> &str {
        let epoch = self.start + at;
        if self.last.replace(epoch) != Some(epoch) {
            match self.format {
                TimeFormat::EpochS => self.number(epoch, SECOND),
                TimeFormat::EpochMs => self.number(epoch.div_euclid(1000), 1),
                TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => self.civil(epoch),
            }
        }
        str::from_utf8(&self.text[..self.length]).expect("only ASCII is written")
    }

    fn civil(&mut self, epoch: i64) {
        if !self.steady.contains(&epoch) {
            self.ask_zone(epoch);
        }
        let local = epoch + self.offset;
        let minute = local.div_euclid(MINUTE);
        if minute != self.minute {
            self.write_minute(minute);
        }
        let within = (local - minute * MINUTE) as u64;
        digits(&mut self.text[self.seconds_at..][..2], within / SECOND as u64);
        digits(&mut self.text[self.seconds_at + 3..][..6], within % SECOND as u64);
    }

    fn ask_zone(&mut self, epoch: i64) {
        let now = Timestamp::UNIX_EPOCH + SignedDuration::from_micros(epoch);
        self.offset = i64::from(self.zone.to_offset(now).seconds()) * SECOND;
        let change = self.zone.following(now).next();
        self.steady = epoch..change.map_or(i64::MAX, |change| change.timestamp().as_microsecond());
        self.minute = i64::MIN;
    }

    /// Writes all but the seconds: the date, hour and minute before them, the offset after them.
    fn write_minute(&mut self, minute: i64) {
        self.minute = minute;
        self.length = 0;
        let day = minute.div_euclid(DAY / MINUTE);
        let of_day = minute.rem_euclid(DAY / MINUTE) as u64;
        if day != self.day {
            self.day = day;
            self.date = date(1970, 1, 1).saturating_add(Span::new().days(day));
        }
        let date = self.date;
        self.push_number(date.year() as u64, 4);
        self.push(b'-');
        self.push_number(date.month() as u64, 2);
        self.push(b'-');
        self.push_number(date.day() as u64, 2);
        self.push(if self.format == TimeFormat::Local { b' ' } else { b'T' });
        self.push_number(of_day / 60, 2);
        self.push(b':');
        self.push_number(of_day % 60, 2);
        self.push(b':');
        self.seconds_at = self.length;
        self.push_number(0, 2);
        self.push(b'.');
        self.push_number(0, 6);
        match self.format {
            TimeFormat::Utc => self.push(b'Z'),
            TimeFormat::LocalOffset => self.push_offset(),
            _ => {}
        }
    }

    fn push_offset(&mut self) {
        // Before zones were agreed on, offsets had seconds; written dates round them, as RFC 9557 says.
        let minutes = (self.offset.unsigned_abs() + MINUTE as u64 / 2) / MINUTE as u64;
        self.push(if self.offset < 0 { b'-' } else { b'+' });
        self.push_number(minutes / 60, 2);
        self.push(b':');
        self.push_number(minutes % 60, 2);
    }

    /// `value / per`, with as many decimals as `per` has zeros.
    fn number(&mut self, value: i64, per: i64) {
        self.length = 0;
        if value < 0 {
            self.push(b'-');
        }
        let (value, per) = (value.unsigned_abs(), per as u64);
        let width = (value / per).checked_ilog10().unwrap_or(0) as usize + 1;
        self.push_number(value / per, width);
        if per > 1 {
            self.push(b'.');
            self.push_number(value % per, per.ilog10() as usize);
        }
    }

    fn push(&mut self, byte: u8) {
        self.text[self.length] = byte;
        self.length += 1;
    }

    fn push_number(&mut self, value: u64, width: usize) {
        digits(&mut self.text[self.length..][..width], value);
        self.length += width;
    }
}

/// Writes the last digits of `value`, as many as there is room for.
fn digits(room: &mut [u8], mut value: u64) {
    for digit in room.iter_mut().rev() {
        *digit = b'0' + (value % 10) as u8;
        value /= 10;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [TimeFormat; 5] =
        [TimeFormat::Local, TimeFormat::LocalOffset, TimeFormat::Utc, TimeFormat::EpochS, TimeFormat::EpochMs];

    /// What the calendar's own library says.
    fn told(calendar: &Calendar, format: TimeFormat, at: Micros) -> String {
        let local = calendar.local(at);
        let epoch = calendar.timestamp(at).as_microsecond();
        match format {
            TimeFormat::Local => local.strftime("%Y-%m-%d %H:%M:%S.%6f").to_string(),
            TimeFormat::LocalOffset => local.strftime("%Y-%m-%dT%H:%M:%S.%6f%:z").to_string(),
            TimeFormat::Utc => local.with_time_zone(TimeZone::UTC).strftime("%Y-%m-%dT%H:%M:%S.%6fZ").to_string(),
            TimeFormat::EpochS => format!("{}.{:06}", epoch / SECOND, epoch % SECOND),
            TimeFormat::EpochMs => (epoch / 1000).to_string(),
        }
    }

    fn agrees(calendar: &Calendar, instants: impl Iterator<Item = Micros> + Clone) {
        for format in ALL {
            let mut clock = Clock::new(calendar, format);
            for at in instants.clone() {
                assert_eq!(clock.text(at), told(calendar, format, at), "{format:?} at {at}");
            }
        }
    }

    #[test]
    fn the_fast_clock_agrees_across_both_changes_of_daylight_saving() {
        for (start, zone) in [
            ("2009-03-07T23:00:00", "America/Chicago"),
            ("2009-10-31T23:00:00", "America/Chicago"),
            ("2024-04-06T23:00:00", "Australia/Lord_Howe"),
            ("2024-10-05T23:00:00", "Australia/Lord_Howe"),
            ("2024-02-28T23:00:00", "Europe/Berlin"),
            ("2000-12-31T22:00:00", "Asia/Kathmandu"),
        ] {
            let calendar = Calendar::new(start, zone).unwrap();
            agrees(&calendar, (0..2000).map(|step| step * 97 * SECOND / 2 + step * 7919 % SECOND));
        }
    }

    #[test]
    fn the_fast_clock_agrees_at_the_very_instants_of_a_change() {
        let calendar = Calendar::new("2009-03-08T00:00:00", "America/Chicago").unwrap();
        let change = 2 * 60 * MINUTE;
        agrees(&calendar, [change - 1, change, change + 1, change - 1, change].into_iter());
    }

    #[test]
    fn the_fast_clock_agrees_at_random_instants_in_any_order() {
        for zone in ["America/Chicago", "Europe/London", "Pacific/Apia", "Africa/Casablanca", "UTC"] {
            let calendar = Calendar::new("2000-01-01T00:00:00", zone).unwrap();
            let mut state = 1_u64;
            let instants: Vec<Micros> = (0..3000)
                .map(|_| {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    ((state >> 11) % (50 * 365 * DAY as u64)) as Micros
                })
                .collect();
            agrees(&calendar, instants.into_iter());
        }
    }

    #[test]
    fn epoch_formats_are_numbers_for_a_database() {
        let calendar = Calendar::new("2009-03-02T07:12:03.25", "America/Chicago").unwrap();
        assert_eq!(Clock::new(&calendar, TimeFormat::EpochS).stamp(0), Stamp::Seconds(1_235_999_523.25));
        assert_eq!(Clock::new(&calendar, TimeFormat::EpochMs).stamp(1), Stamp::Milliseconds(1_235_999_523_250));
    }
}
