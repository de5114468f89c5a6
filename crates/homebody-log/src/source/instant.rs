//! Reads instants as logs write them.

pub(crate) mod date_parts;
pub(crate) mod dateless;

use super::options::DateOrder;
use crate::files::database::text;
use crate::log::{Clock, OffsetSpan};
use date_parts::{digits, in_words, leading_number, month, of_century};
use homebody_core::time::{DAY, HOUR, MINUTE, SECOND, Span, UtcTime, WallTime};
use jiff::civil::{Date, ISOWeekDate, Weekday};
use rusqlite::Row;
use rusqlite::types::ValueRef;

/// An instant as a log tells it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogInstant {
    /// By the clock on the wall of the home.
    Local(WallTime),
    /// By the world's.
    Utc(UtcTime),
}

impl LogInstant {
    /// The instant at which the wall of a clock shows a time.
    pub fn told_by(clock: Clock, at: WallTime) -> LogInstant {
        match clock {
            Clock::Local => LogInstant::Local(at),
            Clock::Utc => LogInstant::Utc(at.to_utc(Span::ZERO)),
        }
    }

    /// Its clock.
    pub fn clock(self) -> Clock {
        match self {
            LogInstant::Local(_) => Clock::Local,
            LogInstant::Utc(_) => Clock::Utc,
        }
    }

    pub(crate) fn after(self, length: Span) -> LogInstant {
        match self {
            LogInstant::Local(at) => LogInstant::Local(at.saturating_add(length)),
            LogInstant::Utc(at) => LogInstant::Utc(at.saturating_add(length)),
        }
    }

    /// Its time on its clock: local time, or UTC.
    pub fn on_wall(self) -> WallTime {
        match self {
            LogInstant::Local(at) => at,
            LogInstant::Utc(at) => at.on_wall_of_utc(),
        }
    }
}

/// Largest number of spans with one offset: a zone has two a year.
const MOST_OFFSETS: usize = 400;

/// Reads instants; a day as `2009-03-02` that has been read is known for the lines that follow.
#[derive(Default)]
pub(crate) struct InstantReader {
    day: [u8; 10],
    midnight: WallTime,
    /// Which number is the day in `02/03/2009`; `None`: such a date is not known.
    pub order: Option<DateOrder>,
    /// Whether an instant without a zone is one of the world's clock.
    pub is_utc: bool,
    /// Whether numbers count days as spreadsheets do.
    pub has_day_numbers: bool,
    /// The offsets of the instants so far, in the order of the rows.
    pub offsets: Vec<OffsetSpan>,
}

impl InstantReader {
    pub fn with_order(order: Option<DateOrder>) -> InstantReader {
        InstantReader { order, ..InstantReader::default() }
    }

    /// A date and time with a fraction of any length or none, with a zone or none; or a number since 1970. The date is
    /// `2009-03-02`, `2009/03/02`, `20090302`, `2009-W10-1`, `02-Mar-2009` or `Mar 2, 2009`, and in the order that is known
    /// `02/03/2009`.
    pub fn read(&mut self, text: &str) -> Option<LogInstant> {
        self.read_bytes(text.as_bytes())
    }

    /// The same from bytes; invalid UTF-8 is not an instant.
    pub fn read_bytes(&mut self, bytes: &[u8]) -> Option<LogInstant> {
        let Some((at, rest)) = self.leading(bytes.trim_ascii_start()) else {
            let text = str::from_utf8(bytes).ok()?.trim();
            return if self.has_day_numbers { day_number(text) } else { number(text) };
        };
        match without_place(rest.trim_ascii()) {
            b"" if self.is_utc => Some(LogInstant::told_by(Clock::Utc, at)),
            b"" => Some(LogInstant::Local(at)),
            b"Z" | b"z" => Some(LogInstant::told_by(Clock::Utc, at)),
            zone => {
                let ahead = offset(zone).or_else(|| abbreviated(zone))?;
                // These say that the clock is UTC's, and nothing of the wall.
                if zone != b"UTC" && zone != b"GMT" {
                    self.keep_offset(at.to_utc(ahead), ahead);
                }
                Some(LogInstant::Utc(at.to_utc(ahead)))
            }
        }
    }

    fn keep_offset(&mut self, at: UtcTime, ahead: Span) {
        let is_full = self.offsets.len() >= MOST_OFFSETS;
        match self.offsets.last_mut() {
            Some(span) if span.ahead == ahead => (span.from, span.to) = (span.from.min(at), span.to.max(at)),
            _ if is_full => {}
            _ => self.offsets.push(OffsetSpan { from: at, to: at, ahead }),
        }
    }

    /// The date and time at the beginning of bytes, on their own clock, and the rest: a zone or anything else.
    #[inline]
    pub fn leading<'b>(&mut self, bytes: &'b [u8]) -> Option<(WallTime, &'b [u8])> {
        let (midnight, rest) = self.midnight(bytes)?;
        let rest = rest.strip_prefix(b"T").unwrap_or_else(|| rest.trim_ascii_start());
        let (time, rest) = time_of_day(rest).or_else(|| short_time(rest))?;
        match rest {
            [b' ' | b'A' | b'a' | b'P' | b'p' | 0xe2, _, ..] => half_day(midnight + time, rest),
            _ => Some((midnight + time, rest)),
        }
    }

    /// The beginning of the day that bytes begin with, and what follows.
    #[inline]
    fn midnight<'b>(&mut self, bytes: &'b [u8]) -> Option<(WallTime, &'b [u8])> {
        match bytes.split_first_chunk().filter(|(day, _)| day[4] == b'-') {
            Some((day, rest)) if *day == self.day => Some((self.midnight, rest)),
            Some((day, rest)) => match civil(day).map(WallTime::midnight) {
                Some(at) => {
                    (self.day, self.midnight) = (*day, at);
                    Some((at, rest))
                }
                None => self.other_date(bytes),
            },
            None => self.other_date(bytes),
        }
    }

    /// The same of a date that is not written as `2009-03-02`.
    #[cold]
    fn other_date<'b>(&self, bytes: &'b [u8]) -> Option<(WallTime, &'b [u8])> {
        if let Some((day, rest)) = bytes.split_at_checked(11)
            && let Some(day) = civil(day)
        {
            return Some((WallTime::midnight(day), rest));
        }
        let found = basic(bytes).or_else(|| iso_week(bytes)).or_else(|| in_numbers(bytes, self.order));
        let (day, rest) = found.or_else(|| in_words(bytes))?;
        Some((WallTime::midnight(day), rest.strip_prefix(b",").unwrap_or(rest)))
    }
}

/// `20090302`.
fn basic(bytes: &[u8]) -> Option<(Date, &[u8])> {
    let (day, rest) = bytes.split_at_checked(8).filter(|(_, rest)| matches!(rest, [b'T' | b' ' | b'\t', ..]))?;
    let day = Date::new(digits(&day[..4])? as i16, digits(&day[4..6])? as i8, digits(&day[6..])? as i8).ok()?;
    Some((day, rest))
}

/// `2009-W10-1`.
fn iso_week(bytes: &[u8]) -> Option<(Date, &[u8])> {
    let (day, rest) = bytes.split_at_checked(10)?;
    let [year @ .., b'-', b'W', tens, ones, b'-', of_week] = day else { return None };
    let of_week = Weekday::from_monday_one_offset(digits(&[*of_week])? as i8).ok()?;
    let week = ISOWeekDate::new(digits(year)? as i16, digits(&[*tens, *ones])? as i8, of_week).ok()?;
    Some((week.date(), rest))
}

/// Three numbers parted by one of `/`, `.` and `-`: the year first, or day and month in the order that is known.
fn in_numbers(bytes: &[u8], order: Option<DateOrder>) -> Option<(Date, &[u8])> {
    let (first, mark, rest) = leading_number(bytes)?;
    let (second, same, rest) = leading_number(rest)?;
    let length = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let third = &rest[..length];
    if mark != same || !b"/.-".contains(&mark) {
        return None;
    }
    let (year, month, day) = match (first.len(), third.len(), order) {
        (4, 1 | 2, _) => (digits(first)?, second, third),
        (1 | 2, 4, Some(DateOrder::DayFirst)) => (digits(third)?, second, first),
        (1 | 2, 4, Some(DateOrder::MonthFirst)) => (digits(third)?, first, second),
        (1 | 2, 2, Some(DateOrder::DayFirst)) => (of_century(digits(third)?), second, first),
        (1 | 2, 2, Some(DateOrder::MonthFirst)) => (of_century(digits(third)?), first, second),
        _ => return None,
    };
    let (month, day) = (digits(month).filter(|_| month.len() <= 2)?, digits(day).filter(|_| day.len() <= 2)?);
    Some((Date::new(year as i16, month as i8, day as i8).ok()?, &rest[length..]))
}

/// A zone without the name of a place behind it, as in `-05:00 New_York` and `+01:00[Europe/Paris]`.
fn without_place(zone: &[u8]) -> &[u8] {
    let is_offset = zone.starts_with(b"+") || zone.starts_with(b"-") || zone.starts_with(b"Z");
    match zone.iter().position(|byte| b" [".contains(byte)).filter(|_| is_offset) {
        Some(end) if zone[end + 1..].iter().all(|byte| byte.is_ascii_alphabetic() || b"_/]".contains(byte)) => {
            &zone[..end]
        }
        _ => zone,
    }
}

/// An instant by a clock of twelve hours, where `AM` or `PM` follows in any case, with points or without; else as it stands.
fn half_day(at: WallTime, bytes: &[u8]) -> Option<(WallTime, &[u8])> {
    let text = bytes.strip_prefix(b" ").unwrap_or(bytes);
    // Browsers write a narrow blank before it.
    let text = text.strip_prefix("\u{202f}".as_bytes()).unwrap_or(text);
    let word = |word: &[u8]| {
        let (begin, rest) = text.split_at_checked(word.len())?;
        let ends = rest.first().is_none_or(|byte| !byte.is_ascii_alphanumeric());
        (ends && begin.eq_ignore_ascii_case(word)).then_some(rest)
    };
    let (is_afternoon, rest) = match text.first() {
        Some(b'A' | b'a') => (false, word(b"a.m.").or_else(|| word(b"am"))),
        Some(b'P' | b'p') => (true, word(b"p.m.").or_else(|| word(b"pm"))),
        _ => (false, None),
    };
    let Some(rest) = rest else { return Some((at, bytes)) };
    match at.time_of_day() / HOUR {
        12 if is_afternoon => Some((at, rest)),
        12 => Some((at - 12 * HOUR, rest)),
        1..=11 if is_afternoon => Some((at + 12 * HOUR, rest)),
        1..=11 => Some((at, rest)),
        _ => None,
    }
}

/// The offsets of zones that have abbreviations: those of Europe and North America.
fn abbreviated(zone: &[u8]) -> Option<Span> {
    const HOURS: [(&[u8], i64); 18] = [
        (b"UTC", 0),
        (b"GMT", 0),
        (b"WET", 0),
        (b"WEST", 1),
        (b"BST", 1),
        (b"CET", 1),
        (b"CEST", 2),
        (b"EET", 2),
        (b"EEST", 3),
        (b"EST", -5),
        (b"EDT", -4),
        (b"CST", -6),
        (b"CDT", -5),
        (b"MST", -7),
        (b"MDT", -6),
        (b"PST", -8),
        (b"PDT", -7),
        (b"AKST", -9),
    ];
    HOURS.iter().find(|(name, _)| *name == zone).map(|&(_, hours)| hours * HOUR)
}

/// The date of ten or eleven letters, `2009-03-02` or `02-Mar-2009`.
fn civil(day: &[u8]) -> Option<Date> {
    let (year, month, of_month) = match day {
        [year @ .., b'-', _, _, b'-', _, _] => (digits(year)?, digits(&day[5..7])?, digits(&day[8..])?),
        [_, _, b'-', _, _, _, b'-', year @ ..] => (digits(year)?, month(&day[3..6])?.into(), digits(&day[..2])?),
        _ => return None,
    };
    Date::new(year as i16, month as i8, of_month as i8).ok()
}

/// A number since 1970, as a database keeps it: in seconds, milliseconds, microseconds or nanoseconds.
///
/// Its size says the unit, for instants from 1973 to 5138. Smaller numbers are something else.
pub fn since_1970(number: f64) -> Option<LogInstant> {
    let micros = match number {
        ..1e8 => return None,
        ..1e11 => number * 1e6,
        ..1e14 => number * 1e3,
        ..1e17 => number,
        ..1e20 => number / 1e3,
        _ => return None,
    };
    Some(LogInstant::Utc(UtcTime::from_micros(micros.round() as i64)))
}

/// Days since the end of 1899, as spreadsheets count them: a number from 1954 to 2119, to the millisecond.
fn day_number(text: &str) -> Option<LogInstant> {
    /// The day number of 1 January 1970.
    const OF_1970: f64 = 25_569.0;
    const MILLISECOND: Span = Span::from_millis(1);
    let days = text.replace(',', ".").parse::<f64>().ok().filter(|days| is_day_number(*days))?;
    let milliseconds = ((days - OF_1970) * DAY.ratio(MILLISECOND)).round();
    Some(LogInstant::Local(WallTime::EPOCH + milliseconds as i64 * MILLISECOND))
}

pub(crate) fn is_day_number(number: f64) -> bool {
    (20_000.0..80_000.0).contains(&number)
}

/// The same of a whole number, to the digit.
pub(crate) fn since_1970_whole(number: i64) -> Option<LogInstant> {
    let micros = match number {
        ..=99_999_999 => return None,
        100_000_000..=99_999_999_999 => number * SECOND.micros(),
        100_000_000_000..=99_999_999_999_999 => number * 1000,
        100_000_000_000_000..=99_999_999_999_999_999 => number,
        100_000_000_000_000_000.. => number / 1000,
    };
    Some(LogInstant::Utc(UtcTime::from_micros(micros)))
}

/// A number since 1970 as text: a fraction as floats cannot hold it is read to the digit.
fn number(text: &str) -> Option<LogInstant> {
    let fits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    if !fits {
        return None;
    }
    match text.split_once('.') {
        Some((seconds, decimals)) if (9..=11).contains(&seconds.len()) => {
            let (part, rest) = fraction(decimals.as_bytes());
            rest.is_empty().then_some(LogInstant::Utc(UtcTime::EPOCH + (seconds.parse::<i64>().ok()? * SECOND + part)))
        }
        None => since_1970_whole(text.parse().ok()?),
        Some(_) => since_1970(text.parse().ok()?),
    }
}

/// `07:12`, `07:12:03`, `07:12:03.25`; what follows is given back.
#[inline]
fn time_of_day(text: &[u8]) -> Option<(Span, &[u8])> {
    let (digits, rest) = match *text {
        [h, hh, b':', m, mm, b':', s, ss, ref rest @ ..] => ([h, hh, m, mm, s, ss], rest),
        [h, hh, b':', m, mm, ref rest @ ..] => ([h, hh, m, mm, b'0', b'0'], rest),
        _ => return None,
    };
    // Without a branch for each digit: nearly always all of them are fine.
    let [h, hh, m, mm, s, ss] = digits.map(|digit| i64::from(digit.wrapping_sub(b'0')));
    let (hours, minutes, seconds) = (h * 10 + hh, m * 10 + mm, s * 10 + ss);
    let are_digits = (h <= 9) & (hh <= 9) & (m <= 9) & (mm <= 9) & (s <= 9) & (ss <= 9);
    // 24:00 is the next midnight.
    let is_midnight = (hours == 24) & (minutes == 0) & (seconds == 0);
    if !(are_digits & ((hours < 24) | is_midnight) & (minutes < 60) & (seconds < 60)) {
        return None;
    }
    let whole = ((hours * 60 + minutes) * 60 + seconds) * SECOND;
    match rest {
        [b'.' | b',', decimals @ ..] => {
            let (part, rest) = fraction(decimals);
            Some((whole + part, rest))
        }
        rest => Some((whole, rest)),
    }
}

/// A time of day whose parts have one digit each, such as `9:05`, `9:5:3`, or no marks, such as `071203`.
#[cold]
fn short_time(text: &[u8]) -> Option<(Span, &[u8])> {
    if let Some((time, rest)) = text.split_first_chunk::<6>().filter(|(time, _)| time.iter().all(u8::is_ascii_digit)) {
        let [h, hh, m, mm, s, ss] = *time;
        let (time, _) = time_of_day(&[h, hh, b':', m, mm, b':', s, ss])?;
        return Some((time, rest));
    }
    let (hours, mark, rest) = leading_number(text)?;
    let length = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let (minutes, rest) = rest.split_at(length);
    let seconds =
        rest.strip_prefix(b":").map_or(0, |rest| rest.iter().take_while(|byte| byte.is_ascii_digit()).count());
    let (seconds, rest) = if seconds > 0 { rest[1..].split_at(seconds) } else { (&b"0"[..], rest) };
    let (hours, minutes, seconds) = (digits(hours)?, digits(minutes)?, digits(seconds)?);
    let fits = mark == b':' && hours < 24 && minutes < 60 && seconds < 60;
    let whole = fits.then(|| ((hours * 60 + minutes) * 60 + seconds) * SECOND)?;
    Some(match rest {
        [b'.', decimals @ ..] => {
            let (part, rest) = fraction(decimals);
            (whole + part, rest)
        }
        rest => (whole, rest),
    })
}

fn two_digits(text: &[u8], below: i64) -> Option<(i64, &[u8])> {
    let [tens @ b'0'..=b'9', ones @ b'0'..=b'9', rest @ ..] = text else { return None };
    let number = i64::from(tens - b'0') * 10 + i64::from(ones - b'0');
    (number < below).then_some((number, rest))
}

/// The digits that follow a point, as a part of a second, and what follows them; further digits are cut off.
#[inline]
fn fraction(text: &[u8]) -> (Span, &[u8]) {
    /// The factors of numbers by their count of digits.
    const UNITS: [i64; 7] = [1_000_000, 100_000, 10_000, 1000, 100, 10, 1];
    let (mut number, mut length) = (0, 0);
    while let Some(digit) = text.get(length).filter(|byte| byte.is_ascii_digit()) {
        if length < 6 {
            number = number * 10 + i64::from(digit - b'0');
        }
        length += 1;
    }
    (Span::from_micros(number * UNITS[length.min(6)]), &text[length..])
}

/// `-06:00`, `-0600` or `-06`.
pub(crate) fn offset(zone: &[u8]) -> Option<Span> {
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
    rest.is_empty().then_some(sign * (hours * 60 + minutes) * MINUTE)
}

/// The instant of a cell, on any clock.
pub(crate) fn instant_of_cell(
    row: &Row,
    column: usize,
    instants: &mut InstantReader,
) -> rusqlite::Result<Option<WallTime>> {
    let instant = match row.get_ref(column)? {
        ValueRef::Integer(number) => since_1970_whole(number),
        ValueRef::Real(number) => since_1970(number),
        other => instants.read(&text(other)),
    };
    Ok(instant.map(LogInstant::on_wall))
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: WallTime = WallTime::from_micros(1_235_977_923_000_000);

    fn local(later: Span) -> LogInstant {
        LogInstant::Local(AT + later)
    }

    fn utc(later: Span) -> LogInstant {
        LogInstant::told_by(Clock::Utc, AT + later)
    }

    fn read(text: &str) -> Option<LogInstant> {
        InstantReader::default().read(text)
    }

    #[test]
    fn reads_all_forms_of_instants() {
        for (text, instant) in [
            ("2009-03-02 07:12:03.250000", local(Span::from_millis(250))),
            ("2009-03-02T07:12:03.25", local(Span::from_millis(250))),
            ("2009-03-02 07:12:03.14962", local(Span::from_micros(149_620))),
            ("2009-03-02 07:12:03.1234567", local(Span::from_micros(123_456))),
            ("2009-03-02   07:12:03.", local(Span::ZERO)),
            (" 2009-03-02 07:12:03 ", local(Span::ZERO)),
            ("2009-03-02 07:12", local(-3 * SECOND)),
            ("02-Mar-2009 07:12:03", local(Span::ZERO)),
            ("2009-03-02T07:12:03Z", utc(Span::ZERO)),
            ("2009-03-02T07:12:03.5-06:00", utc(6 * HOUR + Span::from_millis(500))),
            ("2009-03-02 07:12:03+0545", utc(-5 * HOUR - 45 * MINUTE)),
            ("2009-03-02 07:12:03+01", utc(-HOUR)),
            ("1235977923", utc(Span::ZERO)),
            ("1235977923.000001", utc(Span::MICROSECOND)),
            ("1235977923250", utc(Span::from_millis(250))),
            ("1235977923250001", utc(Span::from_micros(250_001))),
            ("1235977923250001999", utc(Span::from_micros(250_001))),
            ("2009/03/02 07:12:03", local(Span::ZERO)),
            ("2009/3/2 7:12:03", local(Span::ZERO)),
            ("20090302T071203", local(Span::ZERO)),
            ("20090302 07:12:03Z", utc(Span::ZERO)),
            ("2009-W10-1T07:12:03", local(Span::ZERO)),
            ("2009-03-02 7:12:03 AM", local(Span::ZERO)),
            ("2009-03-02 07:12:03 UTC", utc(Span::ZERO)),
            ("2009-03-02 1:12:03 AM CST", utc(Span::ZERO)),
            ("2009-03-01 24:00:00", local(-7 * HOUR - 12 * MINUTE - 3 * SECOND)),
            ("Mar 2 2009 07:12:03", local(Span::ZERO)),
            ("March 2, 2009, 7:12:03 AM", local(Span::ZERO)),
            ("Mon, 02 Mar 2009 07:12:03 GMT", utc(Span::ZERO)),
            ("2 March 2009 07:12:03", local(Span::ZERO)),
            ("2-Mar-09 3:12:03 AM EDT", utc(Span::ZERO)),
            ("2009-03-02T02:12:03-05:00 New_York", utc(Span::ZERO)),
            ("2009-03-02T08:12:03+01:00[Europe/Paris]", utc(Span::ZERO)),
        ] {
            assert_eq!(read(text), Some(instant), "{text}");
        }
    }

    #[test]
    fn refuses_other_texts_as_instants() {
        let long = "9".repeat(40);
        for text in [
            "",
            "ON",
            "2009-03-02",
            "2009-13-02 07:12:03",
            "02-Mai-2009 07:12:03",
            "02-03-2009 07:12:03",
            "2009-02-29 07:12:03",
            "2009-03-02 24:00:01",
            "Mar 2 07:12:03",
            "Mar 2 09 07:12:03",
            "Mond 2 Mar 07:12:03",
            "2009-03-02 07:12:03-05:00 x1",
            "2009-03-02 07:60:03",
            "2009-03-02 07:12:03 x",
            "2009-03-02 07:12:03+25:00",
            "2009/13/02 07:12:03",
            "2009-03-02 13:12:03 PM",
            "2009-03-02 0:12:03 PM",
            "2009-W54-1T07:12:03",
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
    fn dates_in_numbers_are_read_in_the_order_that_is_known() {
        let (day, month) = (Some(DateOrder::DayFirst), Some(DateOrder::MonthFirst));
        let wanted = Some(local(Span::ZERO));
        for (text, order, instant) in [
            ("02.03.2009 07:12:03", day, wanted),
            ("2.3.2009, 07:12:03", day, wanted),
            ("02-03-2009 07:12:03.0", day, wanted),
            ("02/03/09 7:12:03 am", day, wanted),
            ("3/2/2009 7:12:03 AM", month, wanted),
            ("03/02/2009, 7:12:03\u{202f}AM", month, wanted),
            ("3/2/2009 7:12:03 a.m.", month, wanted),
            ("3/1/2009 7:12:03 PM", month, Some(local(-12 * HOUR))),
            ("31.02.2009 07:12:03", day, None),
            ("03/28/2009 07:12:03", day, None),
            ("03/28-2009 07:12:03", month, None),
            ("3/2/2009 7:12:03 AM", None, None),
            ("02.03.009 07:12:03", day, None),
        ] {
            assert_eq!(InstantReader::with_order(order).read(text), instant, "{text} in {order:?}");
        }
    }

    #[test]
    fn reads_day_numbers_and_utc_only_on_request() {
        let mut days = InstantReader { has_day_numbers: true, ..InstantReader::default() };
        assert_eq!(days.read("39874.3"), Some(local(-3 * SECOND)));
        assert_eq!((days.read("1000.5"), read("39874.3")), (None, None));
        let mut of_utc = InstantReader { is_utc: true, ..InstantReader::default() };
        assert_eq!(of_utc.read("2009-03-02 07:12:03"), Some(utc(Span::ZERO)));
    }

    #[test]
    fn offsets_are_kept_from_their_first_instant_to_their_last() {
        let mut instants = InstantReader::default();
        for text in
            ["2009-03-02T07:12:03+01:00", "2009-03-02T07:12:04+0100", "2009-03-02T07:12:05Z", "2009-03-02T08:12:05+02"]
        {
            assert!(instants.read(text).is_some(), "{text}");
        }
        let span = |from, to, hours| {
            let at = |second: i64| (AT + second * SECOND).to_utc(HOUR);
            OffsetSpan { from: at(from), to: at(to), ahead: hours * HOUR }
        };
        assert_eq!(instants.offsets, [span(0, 1, 1), span(2, 2, 2)]);
    }

    #[test]
    fn distinguishes_a_day_from_the_next() {
        let mut instants = InstantReader::default();
        for day in ["2009-03-02", "2009-03-02", "2012-02-29", "1969-12-31", "2009-03-02"] {
            let wanted = WallTime::from(day.parse::<Date>().unwrap().at(1, 2, 3, 0));
            assert_eq!(instants.read(&format!("{day} 01:02:03")), Some(LogInstant::Local(wanted)));
        }
    }
}
