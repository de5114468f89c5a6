//! Days of the run and of the calendar: weekdays, months, dates, and how many days lie between.

use super::amounts::{Amount, AmountUnit, MONTH_DAYS, YEAR_DAYS, amount, number};
use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use super::words::Token;
use crate::routine::PhaseDay;

const WEEKDAYS: [(&str, u8); 7] = [
    ("monday|mondays|mon", 0),
    ("tuesday|tuesdays|tue|tues", 1),
    ("wednesday|wednesdays|wed", 2),
    ("thursday|thursdays|thu|thurs", 3),
    ("friday|fridays|fri", 4),
    ("saturday|saturdays|sat", 5),
    ("sunday|sundays|sun", 6),
];

const MONTHS: [(&str, u32); 12] = [
    ("january|jan", 0),
    ("february|feb", 1),
    ("march|mar", 2),
    ("april|apr", 3),
    ("may", 4),
    ("june|jun", 5),
    ("july|jul", 6),
    ("august|aug", 7),
    ("september|sep|sept", 8),
    ("october|oct", 9),
    ("november|nov", 10),
    ("december|dec", 11),
];

pub const SEASONS: [(&str, u16); 5] =
    [("spring", 0b11_100), ("summer", 0b11_100_000), ("autumn", 0x700), ("fall", 0x700), ("winter", 0x803)];

pub fn moment(reader: &mut SentenceReader) -> Option<(PhaseDay, CalendarLength)> {
    reader.attempt(|reader| {
        reader.eat("the");
        if let Some(Token::Date(year, month, day)) = reader.token(0) {
            reader.at += 1;
            return Some((date(reader, year, month, day), CalendarLength::DAY));
        }
        let by_month = |reader: &mut SentenceReader| {
            let month_first = reader.eat_any(&MONTHS);
            let day = whole(reader)?;
            reader.eat("st|nd|rd|th");
            reader.eat("of");
            let month = month_first.or_else(|| reader.eat_any(&MONTHS))?;
            reader.skip_commas();
            let year = whole(reader)?;
            Some(date(reader, year, month + 1, day))
        };
        let start = reader.at;
        if let Some(date) = reader.attempt(by_month) {
            return Some((date, CalendarLength::DAY));
        }
        if let Some(first) = reader.attempt(ordinal) {
            let count = reader.attempt(number).filter(|count| count.fract() == 0.0 && (1.0..=1000.0).contains(count));
            let unit = reader.eat_any(&LENGTHS)?;
            let begin = (first - 1) * unit.days;
            // "The first two weeks" are one stretch; "the second two weeks" are none that anybody means.
            let length = CalendarLength { days: unit.days * count.filter(|_| first == 1).unwrap_or(1.0) as i32 };
            return ((count.is_none() || first == 1) && reader.peek(0) != "of")
                .then_some((PhaseDay::Day(begin), length));
        }
        let length = reader.eat_any(&LENGTHS)?;
        let number = number(reader)?;
        let span = reader.span(start);
        if number.fract() != 0.0 || !(1.0..=36_525.0).contains(&number) {
            reader.fault(span, TimeSentenceMessage::NoDay { text: reader.said(span) });
            return Some((PhaseDay::Day(0), length));
        }
        Some((PhaseDay::Day((number as i32 - 1) * length.days), length))
    })
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CalendarLength {
    pub days: i32,
}

impl CalendarLength {
    const DAY: CalendarLength = CalendarLength { days: 1 };
}

const LENGTHS: [(&str, CalendarLength); 4] = [
    ("day|days|night|nights", CalendarLength::DAY),
    ("week|weeks", CalendarLength { days: 7 }),
    ("month|months", CalendarLength { days: MONTH_DAYS as i32 }),
    ("year|years", CalendarLength { days: YEAR_DAYS as i32 }),
];

const ORDINALS: [&str; 12] = [
    "first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth", "eleventh",
    "twelfth",
];

/// "third", or "3rd".
fn ordinal(reader: &mut SentenceReader) -> Option<i32> {
    if let Some(before) = ORDINALS.iter().position(|ordinal| reader.eat(ordinal)) {
        return Some(before as i32 + 1);
    }
    let number = whole(reader).filter(|number| (1..=1000).contains(number))?;
    reader.eat("st|nd|rd|th").then_some(number as i32)
}

pub fn end_of(moment: PhaseDay, length: CalendarLength) -> PhaseDay {
    later(moment, length.days)
}

pub fn later(moment: PhaseDay, days: i32) -> PhaseDay {
    match moment {
        PhaseDay::Day(day) => PhaseDay::Day(day.saturating_add(days)),
        PhaseDay::Date(year, month, day) => of_number(number_of(year, month, day) + i64::from(days)),
    }
}

pub fn days_between(from: PhaseDay, to: PhaseDay, first: Option<(i16, u8, u8)>) -> Option<i64> {
    let number = |moment| match (moment, first) {
        (PhaseDay::Day(day), Some((y, m, d))) => Some(number_of(y, m, d) + i64::from(day)),
        (PhaseDay::Date(y, m, d), _) => Some(number_of(y, m, d)),
        (PhaseDay::Day(_), None) => None,
    };
    match (from, to) {
        (PhaseDay::Day(from), PhaseDay::Day(to)) => Some(i64::from(to) - i64::from(from)),
        _ => Some(number(to)? - number(from)?),
    }
}

fn date(reader: &mut SentenceReader, year: u32, month: u32, day: u32) -> PhaseDay {
    let is_date = (1900..=2200).contains(&year) && (1..=12).contains(&month) && day >= 1;
    if is_date && day <= days_of(year as i16, month as u8) {
        return PhaseDay::Date(year as i16, month as u8, day as u8);
    }
    let span = reader.span(reader.at.saturating_sub(1));
    reader.fault(span, TimeSentenceMessage::NoDate);
    PhaseDay::Day(0)
}

fn days_of(year: i16, month: u8) -> u32 {
    match month {
        2 if year % 4 == 0 && (year % 100 != 0 || year % 400 == 0) => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

fn number_of(year: i16, month: u8, day: u8) -> i64 {
    let years = (1900..year).map(|year| if days_of(year, 2) == 29 { 366 } else { 365 }).sum::<i64>();
    years + (1..month).map(|month| i64::from(days_of(year, month))).sum::<i64>() + i64::from(day) - 1
}

fn of_number(mut days: i64) -> PhaseDay {
    let (mut year, mut month) = (1900, 1);
    while days >= i64::from(days_of(year, month)) && year < 9999 {
        days -= i64::from(days_of(year, month));
        (year, month) = if month == 12 { (year + 1, 1) } else { (year, month + 1) };
    }
    PhaseDay::Date(year, month, days.clamp(0, 30) as u8 + 1)
}

fn whole(reader: &mut SentenceReader) -> Option<u32> {
    match reader.token(0) {
        Some(Token::Number(value)) if value.fract() == 0.0 && (0.0..10_000.0).contains(&value) => {
            reader.at += 1;
            Some(value as u32)
        }
        _ => None,
    }
}

pub fn is_month(word: &str) -> bool {
    MONTHS.iter().any(|(names, _)| names.split('|').any(|name| name == word))
}

pub fn is_weekday(word: &str) -> bool {
    WEEKDAYS.iter().any(|(names, _)| names.split('|').any(|name| name == word))
}

pub fn weekdays(reader: &mut SentenceReader) -> Option<u8> {
    if reader.eat("weekday|weekdays") {
        return Some(0b001_1111);
    }
    if reader.eat("weekend|weekends") {
        return Some(0b110_0000);
    }
    let first = reader.eat_any(&WEEKDAYS)?;
    let mut days = 1_u8 << first;
    if let Some(last) = reader.attempt(|reader| if reader.eat("to|until") { reader.eat_any(&WEEKDAYS) } else { None }) {
        let length = (last + 7 - first) % 7;
        return Some((0..=length).fold(0, |days, ahead| days | 1 << ((first + ahead) % 7)));
    }
    let next = |reader: &mut SentenceReader| {
        reader.skip_commas();
        reader.eat("and|or");
        reader.eat("on");
        reader.eat_any(&WEEKDAYS)
    };
    while let Some(day) = reader.attempt(next) {
        days |= 1 << day;
    }
    Some(days)
}

pub fn months(reader: &mut SentenceReader) -> Option<u16> {
    let one = |reader: &mut SentenceReader| {
        reader.eat("the");
        reader.eat_any(&MONTHS).map(|month| 1_u16 << month).or_else(|| reader.eat_any(&SEASONS))
    };
    let mut months = reader.attempt(one)?;
    let next = |reader: &mut SentenceReader| {
        reader.skip_commas();
        reader.eat("and|or");
        reader.eat("in");
        one(reader)
    };
    while let Some(more) = reader.attempt(next) {
        months |= more;
    }
    Some(months)
}

/// Days of a year without the year, as months and the first and last day: "25 December", "24 to 26 December".
pub fn days_of_year(reader: &mut SentenceReader) -> Option<(u16, (u8, u8))> {
    reader.attempt(|reader| {
        let month_first = reader.eat_any(&MONTHS);
        let day = |reader: &mut SentenceReader| {
            let day = whole(reader).filter(|day| (1..=31).contains(day))?;
            reader.eat("st|nd|rd|th");
            Some(day as u8)
        };
        let first = day(reader)?;
        let last = reader.attempt(|reader| if reader.eat("to") { day(reader) } else { None }).unwrap_or(first);
        reader.eat("of");
        let month = month_first.or_else(|| reader.eat_any(&MONTHS))?;
        let has_year = reader.ahead(|reader| {
            reader.skip_commas();
            whole(reader).is_some_and(|year| year >= 1900)
        });
        (!has_year && first <= last).then_some((1 << month, (first, last)))
    })
}

pub const LAST_WEEK: (u8, u8) = (0, 7);

/// A day of each month: a weekday, which of its days that is, and the months: "the first Monday of the month".
pub fn day_of_month(reader: &mut SentenceReader) -> Option<(Option<u8>, (u8, u8), u16)> {
    const ALL_MONTHS: u16 = 0xfff;
    reader.attempt(|reader| {
        reader.eat("the");
        let is_last = reader.eat("last");
        let number = if is_last { 0 } else { ordinal(reader)? };
        let weekday = reader.eat_any(&WEEKDAYS);
        reader.eat("day");
        if !reader.eat("of|in") {
            return None;
        }
        let each = reader.eat("the|each|every|a month");
        let months = if each { ALL_MONTHS } else { reader.eat_any(&MONTHS).map(|month| 1_u16 << month)? };
        let days = match (weekday, is_last, number) {
            (Some(_), true, _) => LAST_WEEK,
            (Some(_), _, 1..=4) => (number as u8 * 7 - 6, number as u8 * 7),
            (None, false, 1..=31) => (number as u8, number as u8),
            _ => return None,
        };
        Some((weekday.map(|day| 1 << day), days, months))
    })
}

pub fn month_range(reader: &mut SentenceReader) -> Option<u16> {
    reader.attempt(|reader| {
        let first = reader.eat_any(&MONTHS)?;
        if !reader.eat("to|until|through|and") {
            return None;
        }
        let last = reader.eat_any(&MONTHS)?;
        let length = (last + 12 - first) % 12;
        Some((0..=length).fold(0, |months, ahead| months | 1 << ((first + ahead) % 12)))
    })
}

pub fn days(reader: &mut SentenceReader) -> Option<Amount> {
    reader.attempt(|reader| amount(reader).filter(|amount| amount.unit == AmountUnit::Day))
}
