//! The parts of dates: numbers, and names of months and days.

use crate::limits::beginning;
use homebody_core::names::capitalised;
use jiff::civil::Date;

/// The names of months and days, which are often cut.
const MONTH_NAMES: [&str; 12] = [
    "january", "february", "march", "april", "may", "june", "july", "august", "september", "october", "november",
    "december",
];
const DAYS: [&str; 7] = ["monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday"];

/// A date whose month is a word: `Mar 2 2009`, `Mon, 2 March 2009` or `2-Mar-09`.
pub(crate) fn in_words(bytes: &[u8]) -> Option<(Date, &[u8])> {
    let first = word(bytes);
    let is_day = first.len() >= 3 && DAYS.iter().any(|day| starts(day, first));
    let bytes = if is_day { past(&bytes[first.len()..], b", ") } else { bytes };
    let name = word(bytes);
    let number = |bytes: &[u8]| bytes.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let (month, day, mark, rest) = match name.len() {
        0 => {
            let (day, mark, rest) = leading_number(bytes)?;
            let name = word(rest);
            let rest = &rest[name.len()..];
            let is_parted = rest.first().is_some_and(|next| *next == mark || b". ,".contains(next));
            (month(name)?, day, mark, past(rest, if is_parted { b".,- " } else { b"" }))
        }
        length => {
            let rest = past(&bytes[length..], b". ");
            let (day, rest) = rest.split_at(number(rest));
            (month(name)?, day, b' ', past(rest, b", "))
        }
    };
    let (year, rest) = rest.split_at(number(rest));
    let year = match year.len() {
        4 => digits(year)?,
        2 if mark == b'-' => of_century(digits(year)?),
        _ => return None,
    };
    let day = digits(day).filter(|_| day.len() <= 2 && b"- .".contains(&mark))?;
    Some((Date::new(year as i16, month, day as i8).ok()?, rest))
}

/// The letters that bytes begin with.
fn word(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.iter().take_while(|byte| byte.is_ascii_alphabetic()).count()]
}

/// Bytes without these marks at their beginning.
fn past<'b>(bytes: &'b [u8], marks: &[u8]) -> &'b [u8] {
    &bytes[bytes.iter().take_while(|byte| marks.contains(byte)).count()..]
}

fn starts(name: &str, word: &[u8]) -> bool {
    name.as_bytes().get(..word.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(word))
}

/// The number of a month by its name, or by three of its letters and more.
pub(crate) fn month(word: &[u8]) -> Option<i8> {
    let place = MONTH_NAMES.iter().position(|name| word.len() >= 3 && starts(name, word))?;
    Some(place as i8 + 1)
}

/// Whether a text may begin with a date: with a digit, or with the name of a day or a month.
pub(crate) fn may_be_date(text: &str) -> bool {
    let first = word(text.as_bytes());
    let is_name = || month(first).is_some() || first.len() >= 3 && DAYS.iter().any(|day| starts(day, first));
    text.starts_with(|first: char| first.is_ascii_digit()) || is_name()
}

/// The day of a month by its number, or a sentence that this month has no such day.
pub(crate) fn day_of([year, month, day]: [i64; 3]) -> Result<Date, String> {
    let name = usize::try_from(month).ok().and_then(|month| MONTH_NAMES.get(month.checked_sub(1)?));
    let Some(name) = name else { return Err(format!("there is no month {month}")) };
    let date = i8::try_from(day).ok().zip(i16::try_from(year).ok());
    let date = date.and_then(|(day, year)| Date::new(year, month as i8, day).ok());
    date.filter(|_| (1..=9999).contains(&year)).ok_or_else(|| format!("there is no {day} {} {year}", capitalised(name)))
}

/// The objection to a text that begins with a day which its month lacks, such as `2025-06-31` and `30.02.2025`.
pub(crate) fn no_such_day(text: &str) -> Option<String> {
    let (first, mark, rest) = leading_number(text.trim_start().as_bytes())?;
    let (second, same, rest) = leading_number(rest)?;
    let third = &rest[..rest.iter().take_while(|byte| byte.is_ascii_digit()).count()];
    let (year, month, day) = match (first.len(), third.len()) {
        (4, 2) => (first, second, third),
        (1 | 2, 4) => (third, second, first),
        _ => return None,
    };
    let ends = rest.get(third.len()).is_none_or(|next| b" T".contains(next));
    let [year, month, day] = [digits(year)?, digits(month)?, digits(day)?];
    // A month has a day 31 at most.
    let may_be = mark == same && b"-/.".contains(&mark) && ends && (1..=12).contains(&month) && (1..=31).contains(&day);
    may_be.then(|| day_of([year, month, day]).err()).flatten()
}

/// The objection to a text in the place of an instant.
pub(crate) fn no_instant(text: &str) -> String {
    let why = no_such_day(text).map_or(String::new(), |why| format!(": {why}"));
    format!("{} is no date and time{why}", beginning(text.trim()))
}

/// Two digits of a year: `09` is 2009, `98` is 1998.
pub(crate) fn of_century(year: i64) -> i64 {
    if year < 70 { 2000 + year } else { 1900 + year }
}

/// The digits that bytes begin with, the byte behind them, and what follows.
pub(crate) fn leading_number(bytes: &[u8]) -> Option<(&[u8], u8, &[u8])> {
    let length = bytes.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let (number, rest) = bytes.split_at(length);
    let (mark, rest) = rest.split_first().filter(|_| (1..=4).contains(&length))?;
    Some((number, *mark, rest))
}

/// A number of digits alone; too many of them saturate.
pub(crate) fn digits(text: &[u8]) -> Option<i64> {
    let all = !text.is_empty() && text.iter().all(u8::is_ascii_digit);
    all.then(|| {
        text.iter().fold(0_i64, |number, byte| number.saturating_mul(10).saturating_add(i64::from(byte - b'0')))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recognises_a_date_outside_its_month() {
        for (text, wanted) in [
            ("2025-06-31 07:00:00", Some("there is no 31 June 2025")),
            ("2025-02-30T07:00:00Z", Some("there is no 30 February 2025")),
            ("2025/04/31", Some("there is no 31 April 2025")),
            ("30.02.2025 07:00", Some("there is no 30 February 2025")),
            ("2025-02-28 07:00:00", None),
            ("2024-02-29", None),
            ("2025-13-01", None),
            ("2025-06-32", None),
            ("1.2.3", None),
            ("2025-06-31-2", None),
            ("June", None),
        ] {
            assert_eq!(no_such_day(text).as_deref(), wanted, "{text}");
        }
    }
}
