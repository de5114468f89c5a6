//! Writes a run's instants the way the log wants them, fast: a log has a million of them.
//!
//! The calendar's own way asks the time zone for each instant. Here the offset from UTC is kept until the zone
//! next changes it, the date for the day, and the hour and minute for the minute.

use homebody_core::calendar::Calendar;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::{DAY, Interval, MINUTE, RunTime, SECOND, Span, UtcTime, WallTime};
use jiff::Timestamp;
use jiff::civil::Date;
use jiff::tz::TimeZone;

/// Length of the longest text, `2009-03-02T07:12:03.250000-06:00`: a year has at most four digits.
const LONGEST: usize = 32;

/// Writes the instants of a run in one format.
#[derive(Clone)]
pub struct InstantWriter {
    format: TimeFormat,
    zone: TimeZone,
    start: UtcTime,
    /// The instant that `text` shows: rows that follow each other often tell of the same.
    last: Option<UtcTime>,
    /// The offset of the zone within `steady`.
    offset: Span,
    /// The instants with this `offset`.
    steady: Interval<UtcTime>,
    /// The minute of local time, counted from 1970, that `text` shows.
    minute: i64,
    /// The day of local time, counted from 1970, that `date` is.
    day: i64,
    date: Date,
    text: [u8; LONGEST],
    /// The position of the seconds in `text`; the text around them stays for the minute.
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

impl InstantWriter {
    /// A clock of a run's calendar that writes instants in this format.
    pub fn new(calendar: &Calendar, format: TimeFormat) -> InstantWriter {
        let zone = match format {
            TimeFormat::Local | TimeFormat::LocalOffset => calendar.local(RunTime::START).time_zone().clone(),
            TimeFormat::Utc | TimeFormat::EpochS | TimeFormat::EpochMs => TimeZone::UTC,
        };
        InstantWriter {
            format,
            zone,
            start: calendar.timestamp(RunTime::START).into(),
            last: None,
            offset: Span::ZERO,
            steady: Interval::instant(UtcTime::EPOCH),
            minute: i64::MIN,
            day: 0,
            date: WallTime::EPOCH.date(),
            text: [0; LONGEST],
            seconds_at: 0,
            length: 0,
        }
    }

    pub(crate) fn writes_numbers(&self) -> bool {
        matches!(self.format, TimeFormat::EpochS | TimeFormat::EpochMs)
    }

    /// The instant for a database.
    pub fn stamp(&mut self, at: RunTime) -> Stamp<'_> {
        let epoch = self.epoch(at);
        match self.format {
            TimeFormat::EpochS => Stamp::Seconds(epoch.since_zero().seconds()),
            TimeFormat::EpochMs => Stamp::Milliseconds(epoch.micros().div_euclid(1000)),
            TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => Stamp::Text(self.text(at)),
        }
    }

    /// The instant in microseconds since 1970, for a type of its own: local time if instants are written without their offset, else UTC.
    pub fn micros(&mut self, at: RunTime) -> i64 {
        if self.format == TimeFormat::Local { self.wall(at).micros() } else { self.epoch(at).micros() }
    }

    /// The instant by the clock on the wall, which is that of UTC for the formats that tell instants in UTC.
    pub fn wall(&mut self, at: RunTime) -> WallTime {
        let epoch = self.epoch(at);
        self.on_wall(epoch)
    }

    /// The instant for a text file.
    pub fn text(&mut self, at: RunTime) -> &str {
        let epoch = self.epoch(at);
        if self.last.replace(epoch) != Some(epoch) {
            match self.format {
                TimeFormat::EpochS => self.number(epoch.micros(), SECOND.micros()),
                TimeFormat::EpochMs => self.number(epoch.micros().div_euclid(1000), 1),
                TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => self.civil(epoch),
            }
        }
        str::from_utf8(&self.text[..self.length]).expect("only ASCII is written")
    }

    fn epoch(&self, at: RunTime) -> UtcTime {
        self.start + at.since_zero()
    }

    fn on_wall(&mut self, epoch: UtcTime) -> WallTime {
        if !self.steady.contains(epoch) {
            self.ask_zone(epoch);
        }
        WallTime::EPOCH + (epoch.since_zero() + self.offset)
    }

    fn civil(&mut self, epoch: UtcTime) {
        let local = self.on_wall(epoch).since_zero();
        let minute = local.div_euclid(MINUTE);
        if minute != self.minute {
            self.write_minute(minute);
        }
        let within = local.rem_euclid(MINUTE);
        digits(&mut self.text[self.seconds_at..][..2], (within / SECOND) as u64);
        digits(&mut self.text[self.seconds_at + 3..][..6], (within % SECOND).micros() as u64);
    }

    fn ask_zone(&mut self, epoch: UtcTime) {
        let now = Timestamp::UNIX_EPOCH + epoch.since_zero().to_signed_duration();
        self.offset = i64::from(self.zone.to_offset(now).seconds()) * SECOND;
        let change = self.zone.following(now).next();
        self.steady = Interval::new(epoch, change.map_or(UtcTime::MAX, |change| change.timestamp().into()));
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
            self.date = (WallTime::EPOCH + day * DAY).date();
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
        let minutes = ((self.offset.abs() + MINUTE / 2) / MINUTE) as u64;
        self.push(if self.offset < Span::ZERO { b'-' } else { b'+' });
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
    use homebody_core::time::HOUR;

    const ALL: [TimeFormat; 5] =
        [TimeFormat::Local, TimeFormat::LocalOffset, TimeFormat::Utc, TimeFormat::EpochS, TimeFormat::EpochMs];

    /// The text by the calendar's own library.
    fn told(calendar: &Calendar, format: TimeFormat, at: RunTime) -> String {
        let local = calendar.local(at);
        let epoch = UtcTime::from(calendar.timestamp(at)).since_zero();
        match format {
            TimeFormat::Local => local.strftime("%Y-%m-%d %H:%M:%S.%6f").to_string(),
            TimeFormat::LocalOffset => local.strftime("%Y-%m-%dT%H:%M:%S.%6f%:z").to_string(),
            TimeFormat::Utc => local.with_time_zone(TimeZone::UTC).strftime("%Y-%m-%dT%H:%M:%S.%6fZ").to_string(),
            TimeFormat::EpochS => format!("{}.{:06}", epoch / SECOND, epoch % SECOND),
            TimeFormat::EpochMs => (epoch.micros() / 1000).to_string(),
        }
    }

    fn agrees(calendar: &Calendar, instants: impl Iterator<Item = RunTime> + Clone) {
        for format in ALL {
            let mut clock = InstantWriter::new(calendar, format);
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
            let within = |step: i64| step * 97 * SECOND / 2 + step * 7919 * Span::MICROSECOND % SECOND;
            agrees(&calendar, (0..2000).map(|step| RunTime::START + within(step)));
        }
    }

    #[test]
    fn the_fast_clock_agrees_at_the_very_instants_of_a_change() {
        let calendar = Calendar::new("2009-03-08T00:00:00", "America/Chicago").unwrap();
        let change = RunTime::START + 2 * HOUR;
        agrees(&calendar, [-1, 0, 1, -1, 0].into_iter().map(|off| change + Span::from_micros(off)));
    }

    #[test]
    fn the_fast_clock_agrees_at_random_instants_in_any_order() {
        for zone in ["America/Chicago", "Europe/London", "Pacific/Apia", "Africa/Casablanca", "UTC"] {
            let calendar = Calendar::new("2000-01-01T00:00:00", zone).unwrap();
            let mut state = 1_u64;
            let instants: Vec<RunTime> = (0..3000)
                .map(|_| {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    RunTime::from_micros(((state >> 11) % (50 * 365 * DAY).micros() as u64) as i64)
                })
                .collect();
            agrees(&calendar, instants.into_iter());
        }
    }

    #[test]
    fn epoch_formats_are_numbers_for_a_database() {
        let calendar = Calendar::new("2009-03-02T07:12:03.25", "America/Chicago").unwrap();
        assert_eq!(
            InstantWriter::new(&calendar, TimeFormat::EpochS).stamp(RunTime::START),
            Stamp::Seconds(1_235_999_523.25)
        );
        assert_eq!(
            InstantWriter::new(&calendar, TimeFormat::EpochMs).stamp(RunTime::from_micros(1)),
            Stamp::Milliseconds(1_235_999_523_250)
        );
    }
}
