//! Logs whose lines tell a time of day without a date: the day comes from the file's name or from a line that tells it, and each
//! midnight that is passed adds one.
//!
//! Left out: that nothing was written for a day or more, which such a log does not show.

use super::instant::{Instant, Instants};
use homebody_core::time::{DAY, Micros, SECOND};
use std::path::Path;

/// A clock that is earlier than before by more than this has passed midnight: it is never set back so far.
const MIDNIGHT: Micros = 2 * 3600 * SECOND;

/// Two clocks that differ by more than this are on the two sides of midnight.
const HALF: Micros = DAY / 2;

/// Which day it is.
pub(super) struct Days {
    /// The beginning of the day of the last line, once it is known.
    midnight: Option<Micros>,
    /// The time of day of the last line.
    last: Option<Micros>,
    /// Midnights that were passed while the day was not known.
    passed: i64,
}

impl Days {
    /// Of a file whose name may tell the day of its first line, such as `hall-2026-02-02.log`.
    pub fn of(path: &Path) -> Days {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Days { midnight: day_in(&name), last: None, passed: 0 }
    }

    pub fn is_known(&self) -> bool {
        self.midnight.is_some()
    }

    /// The instant of a time of day; None while the day is not known.
    pub fn at(&mut self, time: Micros) -> Option<Instant> {
        if self.last.is_some_and(|last| time < last - MIDNIGHT) {
            self.passed += 1;
            self.midnight = self.midnight.map(|midnight| midnight + DAY);
        }
        self.last = Some(time);
        self.midnight.map(|midnight| Instant::Local(midnight + time))
    }

    /// Takes what a line with a time of day tells as the instant at which it was made, which may be on the other side of midnight.
    pub fn tell(&mut self, time: Micros, told: Micros) {
        let midnight = told - told.rem_euclid(DAY);
        self.midnight = Some(match told - (midnight + time) {
            later if later > HALF => midnight + DAY,
            later if later < -HALF => midnight - DAY,
            _ => midnight,
        });
    }

    /// The day of the first line, by that of the last.
    pub fn first(&self) -> Option<Micros> {
        self.midnight.map(|midnight| midnight - self.passed * DAY)
    }

    /// Days that begin on this one.
    pub fn from(midnight: Option<Micros>) -> Days {
        Days { midnight, last: None, passed: 0 }
    }
}

/// A time of day, such as `06:00:00.123`.
pub(super) fn time_of_day(text: &str, instants: &mut Instants) -> Option<Micros> {
    match instants.read(&format!("1970-01-01 {text}"))? {
        Instant::Local(at) => Some(at),
        Instant::Utc(_) => None,
    }
}

/// The beginning of the day that a name has in it, as `2026-02-02`, `2026_02_02` or `20260202`.
fn day_in(name: &str) -> Option<Micros> {
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
        match Instants::default().read(&text)? {
            Instant::Local(at) if is_alone => Some(at),
            _ => None,
        }
    };
    (0..letters.len()).find_map(day)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DAY_2: Micros = 1_769_990_400 * SECOND;

    #[test]
    fn names_tell_a_day_or_none() {
        for name in ["hall-2026-02-02.log", "20260202.log", "esphome_2026_02_02_hall.txt", "2026.02.02"] {
            assert_eq!(day_in(name), Some(DAY_2), "{name}");
        }
        for name in ["hall.log", "120260202.log", "2026-02-30.log", "2026-0202.log", "é2026-02", ""] {
            assert_eq!(day_in(name), None, "{name}");
        }
    }

    #[test]
    fn each_midnight_adds_a_day_and_a_clock_that_is_set_does_not() {
        let hour = 3600 * SECOND;
        let mut days = Days::of(Path::new("a-2026-02-02.log"));
        let at: Vec<_> = [23 * hour, 22 * hour, hour, 2 * hour, 0].map(|time| days.at(time)).into();
        let wanted = [23, 22, 25, 26, 24].map(|hours| Some(Instant::Local(DAY_2 + hours * hour)));
        assert_eq!(at, wanted);
        assert_eq!(Days::of(Path::new("a.log")).at(hour), None);
    }

    #[test]
    fn the_day_of_the_first_line_follows_from_a_later_one() {
        let hour = 3600 * SECOND;
        let mut days = Days::of(Path::new("a.log"));
        days.at(23 * hour);
        days.at(hour);
        days.tell(hour, DAY_2 + hour);
        assert_eq!(days.first(), Some(DAY_2 - DAY));
        days.tell(0, DAY_2 - SECOND);
        assert_eq!(days.at(hour), Some(Instant::Local(DAY_2 + hour)));
    }
}
