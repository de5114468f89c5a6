//! Reads instants as logs write them.

use homebody_core::time::{Micros, SECOND};
use jiff::civil::{Date, date};

/// Microseconds since 1970, by a clock on some wall or by the world's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instant {
    /// By the clock on the wall of the home.
    Local(Micros),
    /// By the world's.
    Utc(Micros),
}

/// Reads instants; a day as `2009-03-02` that has been read is known for the lines that follow.
#[derive(Default)]
pub(crate) struct Instants {
    day: [u8; 10],
    midnight: Micros,
}

impl Instants {
    /// A date and time with a fraction of any length or none, with a zone or none; or a number since 1970. The date is
    /// `2009-03-02` or `02-Mar-2009`.
    pub fn read(&mut self, text: &str) -> Option<Instant> {
        self.read_bytes(text.as_bytes())
    }

    /// The same from bytes that may be no text: then they are no instant.
    pub fn read_bytes(&mut self, bytes: &[u8]) -> Option<Instant> {
        let Some((at, rest)) = self.leading(bytes.trim_ascii_start()) else {
            return number(str::from_utf8(bytes).ok()?.trim());
        };
        match rest.trim_ascii() {
            b"" => Some(Instant::Local(at)),
            b"Z" | b"z" => Some(Instant::Utc(at)),
            zone => Some(Instant::Utc(at - offset(zone)?)),
        }
    }

    /// The date and time that bytes begin with, in microseconds since 1970 by the clock that they are told by, and what follows:
    /// a zone or whatever it may be.
    #[inline]
    pub fn leading<'b>(&mut self, bytes: &'b [u8]) -> Option<(Micros, &'b [u8])> {
        let (midnight, rest) = self.midnight(bytes)?;
        let rest = rest.strip_prefix(b"T").unwrap_or_else(|| rest.trim_ascii_start());
        let (time, rest) = time_of_day(rest)?;
        Some((midnight + time, rest))
    }

    /// The beginning of the day that bytes begin with, and what follows.
    #[inline]
    fn midnight<'b>(&mut self, bytes: &'b [u8]) -> Option<(Micros, &'b [u8])> {
        if let [_, _, b'-', ..] = bytes {
            let (day, rest) = bytes.split_at_checked(11)?;
            return Some((midnight(civil(day)?)?, rest));
        }
        let (day, rest) = bytes.split_first_chunk().filter(|(day, _)| day[4] == b'-')?;
        if *day != self.day {
            self.midnight = midnight(civil(day)?)?;
            self.day = *day;
        }
        Some((self.midnight, rest))
    }
}

/// The date of ten or eleven letters, `2009-03-02` or `02-Mar-2009`.
fn civil(day: &[u8]) -> Option<Date> {
    let (year, month, of_month) = match day {
        [year @ .., b'-', _, _, b'-', _, _] => (digits(year)?, digits(&day[5..7])?, digits(&day[8..])?),
        [_, _, b'-', _, _, _, b'-', year @ ..] => {
            let is_named = |name: &&str| name.as_bytes().eq_ignore_ascii_case(&day[3..6]);
            (digits(year)?, MONTHS.iter().position(is_named)? as i64 + 1, digits(&day[..2])?)
        }
        _ => return None,
    };
    Date::new(year as i16, month as i8, of_month as i8).ok()
}

/// How dates name months.
const MONTHS: [&str; 12] = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];

/// The beginning of a day.
pub(super) fn midnight(day: Date) -> Option<Micros> {
    let days = date(1970, 1, 1).until(day).ok()?.get_days();
    Some(i64::from(days) * 24 * 3600 * SECOND)
}

/// A number since 1970, as a database keeps it: in seconds, milliseconds or microseconds.
///
/// Which of them is told by its size, for instants from 1973 to 5138. Smaller numbers are something else.
pub fn since_1970(number: f64) -> Option<Instant> {
    let micros = match number {
        ..1e8 => return None,
        ..1e11 => number * 1e6,
        ..1e14 => number * 1e3,
        ..1e17 => number,
        _ => return None,
    };
    Some(Instant::Utc(micros.round() as Micros))
}

/// A number since 1970 as text: a fraction as floats cannot hold it is read to the digit.
fn number(text: &str) -> Option<Instant> {
    let fits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    if !fits {
        return None;
    }
    match text.split_once('.') {
        Some((seconds, decimals)) if (9..=11).contains(&seconds.len()) => {
            let (micros, rest) = fraction(decimals.as_bytes());
            rest.is_empty().then_some(Instant::Utc(seconds.parse::<i64>().ok()? * SECOND + micros))
        }
        _ => since_1970(text.parse().ok()?),
    }
}

/// `07:12`, `07:12:03`, `07:12:03.25`; what follows is given back.
#[inline]
fn time_of_day(text: &[u8]) -> Option<(Micros, &[u8])> {
    let (digits, rest) = match *text {
        [h, hh, b':', m, mm, b':', s, ss, ref rest @ ..] => ([h, hh, m, mm, s, ss], rest),
        [h, hh, b':', m, mm, ref rest @ ..] => ([h, hh, m, mm, b'0', b'0'], rest),
        _ => return None,
    };
    // Without a branch for each digit: nearly always all of them are fine.
    let [h, hh, m, mm, s, ss] = digits.map(|digit| Micros::from(digit.wrapping_sub(b'0')));
    let (hours, minutes, seconds) = (h * 10 + hh, m * 10 + mm, s * 10 + ss);
    let are_digits = (h <= 9) & (hh <= 9) & (m <= 9) & (mm <= 9) & (s <= 9) & (ss <= 9);
    if !(are_digits & (hours < 24) & (minutes < 60) & (seconds < 60)) {
        return None;
    }
    let whole = ((hours * 60 + minutes) * 60 + seconds) * SECOND;
    match rest {
        [b'.' | b',', decimals @ ..] => {
            let (micros, rest) = fraction(decimals);
            Some((whole + micros, rest))
        }
        rest => Some((whole, rest)),
    }
}

fn two_digits(text: &[u8], below: Micros) -> Option<(Micros, &[u8])> {
    let [tens @ b'0'..=b'9', ones @ b'0'..=b'9', rest @ ..] = text else { return None };
    let number = Micros::from(tens - b'0') * 10 + Micros::from(ones - b'0');
    (number < below).then_some((number, rest))
}

/// The digits that follow a point, as microseconds, and what follows them; further digits are cut off.
#[inline]
fn fraction(text: &[u8]) -> (Micros, &[u8]) {
    /// What a number of so many digits is to be multiplied with.
    const UNITS: [Micros; 7] = [SECOND, 100_000, 10_000, 1000, 100, 10, 1];
    let (mut number, mut length) = (0, 0);
    while let Some(digit) = text.get(length).filter(|byte| byte.is_ascii_digit()) {
        if length < 6 {
            number = number * 10 + Micros::from(digit - b'0');
        }
        length += 1;
    }
    (number * UNITS[length.min(6)], &text[length..])
}

/// `-06:00`, `-0600` or `-06`.
pub(super) fn offset(zone: &[u8]) -> Option<Micros> {
    let (sign, rest) = match zone {
        [b'+', rest @ ..] => (1, rest),
        [b'-', rest @ ..] => (-1, rest),
        _ => return None,
    };
    let (hours, rest) = two_digits(rest, 24)?;
    let (minutes, rest) = match rest.strip_prefix(b":").unwrap_or(rest) {
        b"" => (0, &b""[..]),
        rest => two_digits(rest, 60)?,
    };
    rest.is_empty().then_some(sign * (hours * 60 + minutes) * 60 * SECOND)
}

/// A number of digits alone; too many of them saturate.
fn digits(text: &[u8]) -> Option<Micros> {
    let all = !text.is_empty() && text.iter().all(u8::is_ascii_digit);
    all.then(|| {
        text.iter().fold(0_i64, |number, byte| number.saturating_mul(10).saturating_add(i64::from(byte - b'0')))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: Micros = 1_235_977_923 * SECOND;

    fn read(text: &str) -> Option<Instant> {
        Instants::default().read(text)
    }

    #[test]
    fn all_the_ways_to_write_an_instant() {
        for (text, instant) in [
            ("2009-03-02 07:12:03.250000", Instant::Local(AT + 250_000)),
            ("2009-03-02T07:12:03.25", Instant::Local(AT + 250_000)),
            ("2009-03-02 07:12:03.14962", Instant::Local(AT + 149_620)),
            ("2009-03-02 07:12:03.1234567", Instant::Local(AT + 123_456)),
            ("2009-03-02   07:12:03.", Instant::Local(AT)),
            (" 2009-03-02 07:12:03 ", Instant::Local(AT)),
            ("2009-03-02 07:12", Instant::Local(AT - 3 * SECOND)),
            ("02-Mar-2009 07:12:03", Instant::Local(AT)),
            ("2009-03-02T07:12:03Z", Instant::Utc(AT)),
            ("2009-03-02T07:12:03.5-06:00", Instant::Utc(AT + 6 * 3600 * SECOND + 500_000)),
            ("2009-03-02 07:12:03+0545", Instant::Utc(AT - (5 * 60 + 45) * 60 * SECOND)),
            ("2009-03-02 07:12:03+01", Instant::Utc(AT - 3600 * SECOND)),
            ("1235977923", Instant::Utc(AT)),
            ("1235977923.000001", Instant::Utc(AT + 1)),
            ("1235977923250", Instant::Utc(AT + 250_000)),
            ("1235977923250001", Instant::Utc(AT + 250_001)),
        ] {
            assert_eq!(read(text), Some(instant), "{text}");
        }
    }

    #[test]
    fn what_is_no_instant() {
        let long = "9".repeat(40);
        for text in [
            "",
            "ON",
            "2009-03-02",
            "2009-13-02 07:12:03",
            "02-Mai-2009 07:12:03",
            "02-03-2009 07:12:03",
            "2009-02-29 07:12:03",
            "2009-03-02 24:00:00",
            "2009-03-02 07:60:03",
            "2009-03-02 07:12:03 x",
            "2009-03-02 07:12:03+25:00",
            "2009/03/02 07:12:03",
            "-1-",
            "2009-03-02 07:12:03.2x",
            "é009-03-0é 07:12:03",
            ".",
            "1.2.3",
            ".5",
            "0x12",
            "inf",
            "12345.6e3",
            &long,
        ] {
            assert_eq!(read(text), None, "{text}");
        }
    }

    #[test]
    fn a_day_read_before_is_told_from_the_next() {
        let mut instants = Instants::default();
        for day in ["2009-03-02", "2009-03-02", "2012-02-29", "1969-12-31", "2009-03-02"] {
            let wanted = day.parse::<Date>().unwrap().at(1, 2, 3, 0).to_zoned(jiff::tz::TimeZone::UTC).unwrap();
            let wanted = Instant::Local(wanted.timestamp().as_microsecond());
            assert_eq!(instants.read(&format!("{day} 01:02:03")), Some(wanted));
        }
    }
}
