//! Local time at the edges: the world itself knows only microseconds since the start.

use crate::time::{Micros, SECOND};
use jiff::civil::DateTime;
use jiff::tz::{AmbiguousOffset, TimeZone, TimeZoneDatabase};
use jiff::{SignedDuration, Timestamp, Zoned};

/// Ties a run's microseconds to the clock on the wall of the home.
#[derive(Clone, Debug, PartialEq)]
pub struct Calendar {
    start: Zoned,
}

impl Calendar {
    /// The calendar of a scenario's `start` and `time_zone`, or the reason why there is none.
    pub fn new(start: &str, time_zone: &str) -> Result<Calendar, String> {
        let zone = Calendar::zone(time_zone)?;
        let start: DateTime =
            start.parse().map_err(|_| format!("{start:?} is no date and time; write it as 2009-03-02T00:00:00"))?;
        let start = zone.into_ambiguous_zoned(start);
        if matches!(start.offset(), AmbiguousOffset::Gap { .. }) {
            return Err(format!(
                "there is no {} in {time_zone}: clocks skip it as daylight saving time begins",
                start.datetime()
            ));
        }
        let start = start.compatible().map_err(|error| error.to_string())?;
        Ok(Calendar { start })
    }

    /// A time zone of the bundled database.
    pub fn zone(name: &str) -> Result<TimeZone, String> {
        TimeZoneDatabase::bundled()
            .get(name)
            .map_err(|_| format!("there is no time zone {name:?}; write an IANA name such as America/Chicago"))
    }

    /// The instant on the world's clock.
    pub fn timestamp(&self, at: Micros) -> Timestamp {
        self.start.timestamp() + SignedDuration::from_micros(at)
    }

    /// The instant on the clock on the wall.
    pub fn local(&self, at: Micros) -> Zoned {
        self.timestamp(at).to_zoned(self.start.time_zone().clone())
    }

    /// The time of day at the start, since midnight.
    pub fn start_of_day(&self) -> Micros {
        let time = self.start.time();
        let seconds = (i64::from(time.hour()) * 60 + i64::from(time.minute())) * 60 + i64::from(time.second());
        seconds * SECOND + i64::from(time.subsec_nanosecond()) / 1000
    }

    /// The run's microseconds at an instant of the world's clock.
    pub fn micros(&self, at: Timestamp) -> Micros {
        at.as_microsecond() - self.start.timestamp().as_microsecond()
    }
}

/// A time of day as files write it, `07:30`, `07:30:15` or `07:30:15.5`, since midnight.
pub fn time_of_day(text: &str) -> Option<Micros> {
    let mut parts = text.split(':');
    let (hours, minutes, seconds) = (parts.next()?, parts.next()?, parts.next().unwrap_or("00"));
    let (seconds, fraction) = seconds.split_once('.').unwrap_or((seconds, "0"));
    let two_digits = |part: &str, most: Micros| -> Option<Micros> {
        let is_number = part.len() == 2 && part.bytes().all(|byte| byte.is_ascii_digit());
        part.parse().ok().filter(|&number| is_number && number <= most)
    };
    let is_fraction = (1..=6).contains(&fraction.len()) && fraction.bytes().all(|byte| byte.is_ascii_digit());
    if parts.next().is_some() || !is_fraction {
        return None;
    }
    let fraction: Micros = format!("{fraction:0<6}").parse().ok()?;
    let minutes = two_digits(hours, 23)? * 60 + two_digits(minutes, 59)?;
    Some((minutes * 60 + two_digits(seconds, 59)?) * SECOND + fraction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_day_are_read_as_written() {
        let minute = 60 * SECOND;
        assert_eq!(time_of_day("00:00"), Some(0));
        assert_eq!(time_of_day("07:30"), Some(450 * minute));
        assert_eq!(time_of_day("07:30:15.5"), Some(450 * minute + 15_500_000));
        assert_eq!(time_of_day("23:59:59.999999"), Some(24 * 60 * minute - 1));
    }

    #[test]
    fn what_is_no_time_of_day_is_refused() {
        let wrong = ["", "7:30", "07", "07:3", "24:00", "07:60", "07:30:60", "07:30:15.", "07:30:15.1234567", "+7:30"];
        for text in wrong.into_iter().chain(["07:30:15:00", " 07:30", "07:30 ", "07:30:1٣", "07.30", "07:30:.5"]) {
            assert_eq!(time_of_day(text), None, "{text:?}");
        }
    }
}
