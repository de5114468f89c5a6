//! Numbers with their units: durations, percent, how many times, speeds.

use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use super::words::{TextSpan, Token};
use homebody_core::fuzzy::Fuzzy;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AmountUnit {
    Second,
    Day,
    Percent,
    Times,
    Speed,
    Beats,
    Breaths,
    Years,
    None,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amount {
    pub from: f64,
    pub to: f64,
    pub about: bool,
    pub unit: AmountUnit,
    pub span: TextSpan,
}

/// How far "about" reaches, as a share of the number.
pub const ABOUT_SHARE: f64 = 0.25;
/// How far a duration said without "about" reaches.
pub const PLAIN_SHARE: f64 = 0.1;
/// How far "about" reaches for a walking speed, which hardly varies from day to day.
pub const ABOUT_PACE_SHARE: f64 = 0.1;

pub const DAY_S: f64 = 86_400.0;
/// What a month is worth where days are counted.
pub const MONTH_DAYS: f64 = 30.0;
pub const YEAR_DAYS: f64 = 365.0;

const NUMBERS: [(&str, f64); 19] = [
    ("one", 1.0),
    ("two", 2.0),
    ("three", 3.0),
    ("four", 4.0),
    ("five", 5.0),
    ("six", 6.0),
    ("seven", 7.0),
    ("eight", 8.0),
    ("nine", 9.0),
    ("ten", 10.0),
    ("eleven", 11.0),
    ("twelve", 12.0),
    ("thirteen", 13.0),
    ("fourteen", 14.0),
    ("fifteen", 15.0),
    ("sixteen", 16.0),
    ("seventeen", 17.0),
    ("eighteen", 18.0),
    ("nineteen", 19.0),
];

const TENS: [(&str, f64); 8] = [
    ("twenty", 20.0),
    ("thirty", 30.0),
    ("forty", 40.0),
    ("fifty", 50.0),
    ("sixty", 60.0),
    ("seventy", 70.0),
    ("eighty", 80.0),
    ("ninety", 90.0),
];

const UNITS: [(&str, (AmountUnit, f64)); 20] = [
    ("m/s", (AmountUnit::Speed, 1.0)),
    ("metres|meters|metre|meter|m per|a second", (AmountUnit::Speed, 1.0)),
    ("beats|beat per|a minute", (AmountUnit::Beats, 1.0)),
    ("beats|beat|bpm", (AmountUnit::Beats, 1.0)),
    ("breaths|breath per|a minute", (AmountUnit::Breaths, 1.0)),
    ("breaths|breath", (AmountUnit::Breaths, 1.0)),
    ("s|sec|secs|second|seconds", (AmountUnit::Second, 1.0)),
    ("min|mins|minute|minutes", (AmountUnit::Second, 60.0)),
    ("h|hr|hrs|hour|hours", (AmountUnit::Second, 3600.0)),
    ("day|days|night|nights", (AmountUnit::Day, 1.0)),
    ("week|weeks", (AmountUnit::Day, 7.0)),
    ("fortnight|fortnights", (AmountUnit::Day, 14.0)),
    ("month|months", (AmountUnit::Day, MONTH_DAYS)),
    ("year|years old", (AmountUnit::Years, 1.0)),
    ("year|years of age", (AmountUnit::Years, 1.0)),
    ("year|years", (AmountUnit::Day, YEAR_DAYS)),
    ("%", (AmountUnit::Percent, 1.0)),
    ("percent", (AmountUnit::Percent, 1.0)),
    ("per cent", (AmountUnit::Percent, 1.0)),
    ("times", (AmountUnit::Times, 1.0)),
];

pub const ABOUT: [(&str, ()); 6] =
    [("about", ()), ("around", ()), ("roughly", ()), ("approximately", ()), ("some", ()), ("nearly|almost", ())];

pub fn amount(reader: &mut SentenceReader) -> Option<Amount> {
    reader.attempt(|reader| {
        let start = reader.at;
        let about = reader.eat_any(&ABOUT).is_some() || reader.eat("at least|most") || reader.eat("up to");
        let (from, to, unit) = if reader.eat("between") { pair(reader, "and")? } else { one_or_two(reader)? };
        let span = reader.span(start);
        if !from.is_finite() || !to.is_finite() || to > 1e9 {
            reader.fault(span, TimeSentenceMessage::NumberTooLarge { text: reader.said(span) });
        } else if to < from {
            reader.fault(span, TimeSentenceMessage::ReversedNumbers { text: reader.said(span) });
        }
        let (from, to) = if to.is_finite() && to <= 1e9 { (from.min(to), from.max(to)) } else { (1.0, 1.0) };
        Some(Amount { from, to, about, unit, span })
    })
}

fn pair(reader: &mut SentenceReader, between: &str) -> Option<(f64, f64, AmountUnit)> {
    let (from, factor, unit) = scalar(reader)?;
    if !reader.eat(between) {
        return None;
    }
    let (to, to_factor, to_unit) = scalar(reader)?;
    match unit {
        AmountUnit::None => Some((from * to_factor, to * to_factor, to_unit)),
        _ if unit == to_unit => Some((from * factor, to * to_factor, unit)),
        _ => None,
    }
}

fn one_or_two(reader: &mut SentenceReader) -> Option<(f64, f64, AmountUnit)> {
    for (phrase, from, to) in [
        ("once or twice", 1.0, 2.0),
        ("once to twice", 1.0, 2.0),
        ("once", 1.0, 1.0),
        ("twice", 2.0, 2.0),
        ("thrice", 3.0, 3.0),
    ] {
        if reader.eat(phrase) {
            return Some((from, to, AmountUnit::Times));
        }
    }
    if reader.peek(0) == "half" && reader.peek(1) == "as" {
        reader.at += 1;
        return Some((0.5, 0.5, AmountUnit::Times));
    }
    for (phrase, from, to) in [("several", 3.0, 5.0), ("a few", 3.0, 5.0), ("a couple of", 2.0, 2.0)] {
        if reader.eat(phrase) {
            let (unit, factor) = reader.eat_any(&UNITS)?;
            return Some((from * factor, to * factor, unit));
        }
    }
    // "an hour or two"
    let one_or_two = reader.attempt(|reader| {
        reader.eat("a|an|one").then_some(())?;
        let (unit, factor) = reader.eat_any(&UNITS)?;
        reader.eat("or two|so").then_some((factor, unit, reader.passed(reader.at - 1) == "two"))
    });
    if let Some((factor, unit, is_two)) = one_or_two {
        return Some((factor, if is_two { 2.0 * factor } else { factor }, unit));
    }
    if let Some(pair) = reader.attempt(|reader| pair(reader, "to|or")) {
        return Some(pair);
    }
    let (value, factor, unit) = scalar(reader)?;
    Some((value * factor, value * factor, unit))
}

/// A number, what its unit is worth, and the unit; `1 hour and 30 minutes` is one number.
fn scalar(reader: &mut SentenceReader) -> Option<(f64, f64, AmountUnit)> {
    for (phrase, minutes) in [("half an hour", 30.0), ("a quarter of an hour", 15.0), ("half a minute", 0.5)] {
        if reader.eat(phrase) {
            return Some((minutes * 60.0, 1.0, AmountUnit::Second));
        }
    }
    let start = reader.at;
    let article = reader.eat("a|an");
    let mut value = if article { 1.0 } else { number(reader)? };
    if reader.eat("and a half") {
        value += 0.5;
    }
    let Some((unit, factor)) = reader.eat_any(&UNITS) else {
        if article {
            reader.at = start;
            return None;
        }
        return Some((value, 1.0, AmountUnit::None));
    };
    if reader.eat("and a half") {
        value += 0.5;
    }
    let more = (unit == AmountUnit::Second).then(|| reader.attempt(|reader| smaller(reader, factor))).flatten();
    Some((value + more.unwrap_or(0.0) / factor, factor, unit))
}

/// The minutes after the hours.
fn smaller(reader: &mut SentenceReader, than: f64) -> Option<f64> {
    reader.eat("and");
    let value = number(reader)?;
    let (unit, factor) = reader.eat_any(&UNITS)?;
    (unit == AmountUnit::Second && factor < than).then_some(value * factor)
}

pub fn number(reader: &mut SentenceReader) -> Option<f64> {
    if let Some(Token::Number(value)) = reader.token(0) {
        reader.at += 1;
        return Some(value);
    }
    if let Some(tens) = reader.eat_any(&TENS) {
        return Some(tens + reader.eat_any(&NUMBERS[..9]).unwrap_or(0.0));
    }
    reader.eat_any(&NUMBERS)
}

pub fn is_unit(reader: &mut SentenceReader) -> bool {
    reader.ahead(|reader| reader.eat_any(&UNITS).is_some())
}

impl Amount {
    pub fn as_duration(&self) -> Fuzzy {
        let share = if self.about { ABOUT_SHARE } else { PLAIN_SHARE };
        if self.is_range() && !self.about {
            return Fuzzy::between(self.from, self.to);
        }
        Fuzzy { low: self.from * (1.0 - share), from: self.from, to: self.to, high: self.to * (1.0 + share) }
    }

    pub fn as_change(&self) -> Fuzzy {
        if self.about { self.as_duration() } else { Fuzzy::between(self.from, self.to) }
    }

    pub fn as_pace(&self) -> Fuzzy {
        let share = if self.about { ABOUT_PACE_SHARE } else { 0.0 };
        Fuzzy { low: self.from * (1.0 - share), from: self.from, to: self.to, high: self.to * (1.0 + share) }
    }

    pub fn is_range(&self) -> bool {
        self.from != self.to
    }

    pub fn as_count(&self) -> Option<(u32, u32)> {
        let whole = |value: f64| (value.fract() == 0.0 && (1.0..=100.0).contains(&value)).then_some(value as u32);
        Some((whole(self.from)?, whole(self.to)?))
    }
}

/// Longest duration, in days (our choice).
const MOST_DAYS: f64 = 400.0;

pub fn duration(reader: &mut SentenceReader, amount: &Amount) -> Fuzzy {
    if amount.to > DAY_S {
        reader.fault(amount.span, TimeSentenceMessage::LongerThanADay { text: reader.said(amount.span) });
    }
    length(reader, amount)
}

pub fn length(reader: &mut SentenceReader, amount: &Amount) -> Fuzzy {
    if amount.from <= 0.0 {
        reader.fault(amount.span, TimeSentenceMessage::NoDuration { text: reader.said(amount.span) });
    } else if amount.to > MOST_DAYS * DAY_S {
        reader.fault(amount.span, TimeSentenceMessage::LongerThanAYear { text: reader.said(amount.span) });
    }
    amount.as_duration()
}

pub fn share(reader: &mut SentenceReader, amount: &Amount) -> f64 {
    if amount.to > 100.0 {
        reader.fault(amount.span, TimeSentenceMessage::MoreThanAll { text: reader.said(amount.span) });
    } else {
        happens(reader, amount);
    }
    (amount.from + amount.to) / 200.0
}

pub fn happens(reader: &mut SentenceReader, amount: &Amount) {
    if amount.to <= 0.0 {
        reader.fault(amount.span, TimeSentenceMessage::Never { text: reader.said(amount.span) });
    }
}
