//! Logs whose lines tell a time of day without a date: the day comes from the file's name or from a line that tells it, and each
//! midnight that is passed adds one.
//!
//! Left out: that nothing was written for a day or more, which such a log does not show.

use super::{InstantReader, LogInstant};
use homebody_core::time::{DAY, HOUR, Span, WallTime};
use std::path::Path;

/// A clock that is earlier than before by more than this has passed midnight: it is never set back so far.
const MIDNIGHT: Span = HOUR.saturating_mul(2);

/// Two clocks that differ by more than this are on the two sides of midnight.
const HALF: Span = HOUR.saturating_mul(12);

pub(crate) struct DayCounter {
    /// The beginning of the day of the last line, once it is known.
    midnight: Option<WallTime>,
    /// The time of day of the last line.
    last: Option<Span>,
    /// Midnights that were passed while the day was not known.
    passed: i64,
}

impl DayCounter {
    /// Of a file whose name may tell the day of its first line, such as `hall-2026-02-02.log`.
    pub fn from_path(path: &Path) -> DayCounter {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        DayCounter { midnight: day_in(&name), last: None, passed: 0 }
    }

    pub fn is_known(&self) -> bool {
        self.midnight.is_some()
    }

    /// The instant of a time of day; None while the day is not known.
    pub fn at(&mut self, time: Span) -> Option<LogInstant> {
        if self.last.is_some_and(|last| time < last - MIDNIGHT) {
            self.passed += 1;
            self.midnight = self.midnight.map(|midnight| midnight + DAY);
        }
        self.last = Some(time);
        self.midnight.map(|midnight| LogInstant::Local(midnight + time))
    }

    /// Takes what a line with a time of day tells as the instant at which it was made, which may be on the other side of midnight.
    pub fn tell(&mut self, time: Span, told: WallTime) {
        let midnight = told - told.time_of_day();
        self.midnight = Some(match told - (midnight + time) {
            later if later > HALF => midnight + DAY,
            later if later < -HALF => midnight - DAY,
            _ => midnight,
        });
    }

    /// The day of the first line, by that of the last.
    pub fn first(&self) -> Option<WallTime> {
        self.midnight.map(|midnight| midnight - self.passed * DAY)
    }

    /// Days that begin on this one.
    pub fn from(midnight: Option<WallTime>) -> DayCounter {
        DayCounter { midnight, last: None, passed: 0 }
    }
}

/// A time of day, such as `06:00:00.123`.
pub(crate) fn time_of_day(text: &str, instants: &mut InstantReader) -> Option<Span> {
    match instants.read(&format!("1970-01-01 {text}"))? {
        LogInstant::Local(at) => Some(at.since_zero()),
        LogInstant::Utc(_) => None,
    }
}

/// The beginning of the day that a name has in it, as `2026-02-02`, `2026_02_02` or `20260202`.
fn day_in(name: &str) -> Option<WallTime> {
    let letters = name.as_bytes();
    let is_digit = |at: usize| letters.get(at).is_some_and(u8::is_ascii_digit);
    let day = |begin: usize| {
        let number = |from: usize, length: usize| {
            let digits = letters.get(begin + from..begin + from + length)?;
            digits.iter().all(u8::is_ascii_digit).then(|| String::from_utf8_lossy(digits).into_owned())
        };
        let (month, of_month, length) = match letters.get(begin + 4)? {
            b'-' | b'_' | b'.' if letters.get(begin + 7) == letters.get(begin + 4) => (5, 8, 10),
            _ => (4, 6, 8),
        };
        let is_alone = (begin == 0 || !is_digit(begin - 1)) && !is_digit(begin + length);
        let text = format!("{}-{}-{} 00:00:00", number(0, 4)?, number(month, 2)?, number(of_month, 2)?);
        match InstantReader::default().read(&text)? {
            LogInstant::Local(at) if is_alone => Some(at),
            _ => None,
        }
    };
    (0..letters.len()).find_map(day)
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;

    const DAY_2: WallTime = WallTime::from_micros(1_769_990_400_000_000);

    #[test]
    fn a_name_has_one_day_or_none() {
        for name in ["hall-2026-02-02.log", "20260202.log", "esphome_2026_02_02_hall.txt", "2026.02.02"] {
            assert_eq!(day_in(name), Some(DAY_2), "{name}");
        }
        for name in ["hall.log", "120260202.log", "2026-02-30.log", "2026-0202.log", "é2026-02", ""] {
            assert_eq!(day_in(name), None, "{name}");
        }
    }

    #[test]
    fn each_midnight_adds_a_day_and_a_clock_that_is_set_does_not() {
        let mut days = DayCounter::from_path(Path::new("a-2026-02-02.log"));
        let at = [23, 22, 1, 2, 0].map(|hours| days.at(hours * HOUR));
        let wanted = [23, 22, 25, 26, 24].map(|hours| Some(LogInstant::Local(DAY_2 + hours * HOUR)));
        assert_eq!(at, wanted);
        assert_eq!(DayCounter::from_path(Path::new("a.log")).at(HOUR), None);
    }

    #[test]
    fn the_day_of_the_first_line_follows_from_a_later_one() {
        let mut days = DayCounter::from_path(Path::new("a.log"));
        days.at(23 * HOUR);
        days.at(HOUR);
        days.tell(HOUR, DAY_2 + HOUR);
        assert_eq!(days.first(), Some(DAY_2 - DAY));
        days.tell(Span::ZERO, DAY_2 - SECOND);
        assert_eq!(days.at(HOUR), Some(LogInstant::Local(DAY_2 + HOUR)));
    }
}
