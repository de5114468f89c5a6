//! Frequencies: quantifiers, shares of days, times a week.

use super::amounts::{ABOUT, Amount, AmountUnit, MONTH_DAYS, amount, happens, number, share};
use super::calendar;
use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use super::times;
use crate::routine::{HabitChance, PartOfDay};
use homebody_core::fuzzy::Quantifier;

const QUANTIFIERS: [(&str, Quantifier); 20] = [
    ("almost never", Quantifier::AlmostNever),
    ("hardly ever", Quantifier::AlmostNever),
    ("nearly never", Quantifier::AlmostNever),
    ("rarely", Quantifier::Rarely),
    ("seldom", Quantifier::Rarely),
    ("sometimes", Quantifier::Sometimes),
    ("occasionally", Quantifier::Sometimes),
    ("now and then", Quantifier::Sometimes),
    ("half of the time", Quantifier::AboutHalf),
    ("half the time", Quantifier::AboutHalf),
    ("often", Quantifier::Often),
    ("frequently", Quantifier::Often),
    ("most of the time", Quantifier::Most),
    ("usually", Quantifier::Most),
    ("mostly", Quantifier::Most),
    ("normally", Quantifier::Most),
    ("almost always", Quantifier::AlmostAlways),
    ("nearly always", Quantifier::AlmostAlways),
    ("always", Quantifier::Every),
    ("daily", Quantifier::Every),
];

const OF_DAYS: [(&str, Quantifier); 12] = [
    ("few", Quantifier::Rarely),
    ("some", Quantifier::Sometimes),
    ("half of the", Quantifier::AboutHalf),
    ("half the", Quantifier::AboutHalf),
    ("half of", Quantifier::AboutHalf),
    ("many", Quantifier::Often),
    ("most of the", Quantifier::Most),
    ("most", Quantifier::Most),
    ("almost every|all", Quantifier::AlmostAlways),
    ("nearly every|all", Quantifier::AlmostAlways),
    ("every|each", Quantifier::Every),
    ("all", Quantifier::Every),
];

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Often {
    pub chance: Option<HabitChance>,
    pub weekdays: Option<u8>,
    pub part: Option<PartOfDay>,
    pub every: Option<u32>,
    pub times: Option<(u32, u32)>,
}

impl Often {
    const NOTHING: Often = Often { chance: None, weekdays: None, part: None, every: None, times: None };
}

pub fn often(reader: &mut SentenceReader) -> Option<Often> {
    let found = reader.attempt(every_so_many).or_else(|| reader.attempt(about_every));
    let found = found.or_else(|| reader.attempt(quantified))?;
    let is_chance = found.chance.is_some() && found.every.is_none();
    if is_chance && reader.eat("at first") {
        return changing(reader, found);
    }
    Some(found)
}

/// Every so many days.
const EVERY_OTHER_WEEK: u32 = 14;

/// "every other day", "every 3 days", "every week".
fn every_so_many(reader: &mut SentenceReader) -> Option<Often> {
    if !reader.eat("every|each") {
        return None;
    }
    if reader.eat("other|second day|night") {
        return Some(Often { every: Some(2), ..Often::NOTHING });
    }
    if reader.eat("other|second week") {
        return Some(Often { every: Some(EVERY_OTHER_WEEK), ..Often::NOTHING });
    }
    let part = reader.attempt(|reader| {
        reader.eat("other|second").then_some(())?;
        reader.eat_any(&times::PARTS)
    });
    if part.is_some() {
        return Some(Often { every: Some(2), part, ..Often::NOTHING });
    }
    if reader.eat("third day|night") {
        return Some(Often { every: Some(3), ..Often::NOTHING });
    }
    // A weekday comes round on days that lie seven apart, so every other one is on every other day.
    let nth_weekday = |reader: &mut SentenceReader| {
        let every = reader.eat_any(&[("other|second", 2), ("third", 3), ("fourth", 4)])?;
        Some((every, calendar::weekdays(reader)?))
    };
    let from = reader.at;
    if let Some((every, weekdays)) = reader.attempt(nth_weekday) {
        if weekdays.count_ones() > 1 {
            let (span, text) = (reader.span(from - 1), reader.said(reader.span(from - 1)));
            reader.fault(span, TimeSentenceMessage::SeveralWeekdays { text });
        }
        let part = reader.eat_any(&times::PARTS);
        return Some(Often { every: Some(every), weekdays: Some(weekdays), part, ..Often::NOTHING });
    }
    if let Some(days) = reader.eat_any(&PERIODS) {
        let days_a_week = (days == 7.0).then_some(1);
        let chance = HabitChance { days_a_week, ..with_probability(1.0 / days) };
        return Some(Often { chance: Some(chance), ..Often::NOTHING });
    }
    let from = reader.at;
    let days = if reader.ahead(|reader| reader.eat("hour")) { 1.0 } else { number(reader)? };
    if reader.eat("hour|hours") {
        const AWAKE_H: f64 = 16.0;
        let times_a_day = (AWAKE_H / days.max(1.0)).round().max(1.0);
        let (span, text) = (reader.span(from - 1), reader.said(reader.span(from - 1)));
        reader.fault(span, TimeSentenceMessage::EveryHours { text, times_a_day });
        return Some(Often::NOTHING);
    }
    let days = match reader.eat_any(&[("weeks", 7.0), ("months", MONTH_DAYS)]) {
        Some(unit) => days * unit,
        None => days,
    };
    let weeks = days >= 7.0 && ["weeks", "months"].iter().any(|unit| reader.passed(from).ends_with(unit));
    if !weeks && !reader.eat("days|nights") {
        return None;
    }
    let span = reader.span(from);
    if days.fract() != 0.0 || !(1.0..=365.0).contains(&days) {
        reader.fault(span, TimeSentenceMessage::EveryDays { text: reader.said(span) });
    }
    Some(Often { every: Some(days.clamp(1.0, 365.0) as u32), ..Often::NOTHING })
}

/// "about every two weeks": as often, on any days.
fn about_every(reader: &mut SentenceReader) -> Option<Often> {
    reader.eat_any(&ABOUT[..4])?;
    let often = every_so_many(reader)?;
    let Some(every) = often.every.filter(|_| often.weekdays.is_none()) else { return often.chance.map(|_| often) };
    Some(Often { every: None, chance: Some(with_probability(1.0 / f64::from(every))), ..often })
}

fn quantified(reader: &mut SentenceReader) -> Option<Often> {
    if let Some(quantifier) = reader.eat_any(&QUANTIFIERS) {
        return Some(of(quantifier));
    }
    reader.eat("on");
    let from = reader.at;
    if let Some(amount) = reader.attempt(|reader| amount(reader).filter(|amount| amount.unit == AmountUnit::Percent)) {
        if !reader.eat("of") {
            return None;
        }
        let probability = share(reader, &amount);
        reader.eat("the|all");
        let (weekdays, part) = kind_of_day(reader)?;
        return Some(Often { chance: Some(with_probability(probability)), weekdays, part, ..Often::NOTHING });
    }
    if let Some(days) = reader.attempt(one_in_so_many) {
        return Some(days);
    }
    if let Some(days) = reader.attempt(days_a_week).or_else(|| reader.attempt(parts_a_week)) {
        return Some(days);
    }
    reader.at = from;
    reader.eat_any(&ABOUT[..4]);
    if let Some(quantifier) = reader.eat_any(&QUANTIFIERS) {
        return Some(of(quantifier));
    }
    let quantifier = reader.eat_any(&OF_DAYS)?;
    let is_share = ["all", "of", "the"].iter().any(|end| reader.passed(from).ends_with(end));
    if is_share && reader.eat("day|night|morning|afternoon|evening") {
        let span = reader.span(from);
        reader.fault(span, TimeSentenceMessage::PartOfEachDay { text: reader.said(span) });
        return Some(Often::NOTHING);
    }
    let (weekdays, part) = kind_of_day(reader)?;
    Some(Often { weekdays, part, ..of(quantifier) })
}

/// "one day in three", "two Sundays out of five", "one in three days".
fn one_in_so_many(reader: &mut SentenceReader) -> Option<Often> {
    let from = reader.at;
    let some = number(reader)?;
    let mut days = reader.attempt(kind_of_day);
    (reader.eat("in|of") || reader.eat("out of")).then_some(())?;
    let of = number(reader)?;
    days = days.or_else(|| kind_of_day(reader));
    let (weekdays, part) = days?;
    if !(some > 0.0 && some <= of) {
        let span = reader.span(from);
        reader.fault(span, TimeSentenceMessage::NotAShare { text: reader.said(span) });
    }
    let chance = Some(with_probability((some / of).clamp(0.0, 1.0)));
    Some(Often { chance, weekdays, part, ..Often::NOTHING })
}

/// "3 days a week".
fn days_a_week(reader: &mut SentenceReader) -> Option<Often> {
    let amount = amount(reader).filter(|amount| amount.unit == AmountUnit::Day)?;
    if !(reader.eat("a|per|each|every week") || reader.eat("of the week")) {
        return None;
    }
    let too_often = TimeSentenceMessage::DaysAWeek { text: reader.said(amount.span) };
    Some(once_in_a_while(reader, &amount, 7.0, too_often))
}

/// "two afternoons a week".
fn parts_a_week(reader: &mut SentenceReader) -> Option<Often> {
    let amount = amount(reader).filter(|amount| amount.unit == AmountUnit::None)?;
    let part = reader.eat_any(&times::PARTS)?;
    reader.eat("a|per|each|every week").then_some(())?;
    let too_often = TimeSentenceMessage::DaysAWeek { text: reader.said(amount.span) };
    Some(Often { part: Some(part), ..once_in_a_while(reader, &amount, 7.0, too_often) })
}

fn once_in_a_while(reader: &mut SentenceReader, amount: &Amount, days: f64, too_often: TimeSentenceMessage) -> Often {
    let probability = (amount.from + amount.to) / 2.0 / days;
    if probability > 1.0 {
        reader.fault(amount.span, too_often);
    } else {
        happens(reader, amount);
    }
    let days_a_week = days_a_week_of(amount).filter(|_| days == 7.0);
    let chance = HabitChance { days_a_week, ..with_probability(probability.min(1.0)) };
    Often { chance: Some(chance), ..Often::NOTHING }
}

fn kind_of_day(reader: &mut SentenceReader) -> Option<(Option<u8>, Option<PartOfDay>)> {
    if reader.eat("day|days|time|occasions|occasion|cases|times") {
        return Some((None, None));
    }
    if let Some(weekdays) = calendar::weekdays(reader) {
        return Some((Some(weekdays), reader.eat_any(&times::PARTS)));
    }
    reader.eat_any(&times::PARTS).map(|part| (None, Some(part)))
}

pub fn becoming(reader: &mut SentenceReader, first: HabitChance) -> HabitChance {
    let often = changing(reader, Often { chance: Some(first), ..Often::NOTHING });
    often.and_then(|often| often.chance).unwrap_or(first)
}

/// "rarely at first, often by day 160".
fn changing(reader: &mut SentenceReader, first: Often) -> Option<Often> {
    reader.skip_commas();
    reader.eat("and");
    reader.eat("then|later");
    let from = reader.at;
    let Some(then) = reader.attempt(quantified) else {
        reader.fault(reader.here(), TimeSentenceMessage::AtFirst);
        return Some(first);
    };
    reader.skip_commas();
    let moment = if reader.eat("by") { calendar::moment(reader) } else { None };
    let Some((moment, _)) = moment else {
        reader.fault(reader.span(from), TimeSentenceMessage::ByWhen);
        return Some(first);
    };
    let becomes = then.chance.map(|chance| (chance.probability, moment));
    Some(Often { chance: first.chance.map(|chance| HabitChance { becomes, ..chance }), ..first })
}

/// "at first rarely, later often by day 160".
pub fn at_first(reader: &mut SentenceReader) -> Option<Often> {
    reader.attempt(|reader| {
        if !reader.eat("at first") {
            return None;
        }
        reader.skip_commas();
        let first = quantified(reader)?;
        changing(reader, first)
    })
}

const PERIODS: [(&str, f64); 3] = [("week", 7.0), ("month", 30.4375), ("year", 365.25)];

const ADVERBS_OF_PERIODS: [(&str, f64); 3] =
    [("weekly", PERIODS[0].1), ("monthly", PERIODS[1].1), ("yearly", PERIODS[2].1)];

pub fn times_in(reader: &mut SentenceReader, amount: &Amount) -> Option<Often> {
    let from = reader.at;
    let period = reader.eat_any(&ADVERBS_OF_PERIODS);
    if period.is_none() && !reader.eat("a|per|each|every") {
        return None;
    }
    // Once every two weeks is every 14 days; about once, or twice, is on any days of them.
    let on_any_days = amount.about || amount.to > 1.0;
    let days = period.or_else(|| reader.eat_any(&PERIODS));
    let days = days.or_else(|| if on_any_days { reader.attempt(several_periods) } else { None });
    if let Some(days) = days {
        let too_often = TimeSentenceMessage::OftenerThanDaily { text: reader.said(amount.span) };
        return Some(once_in_a_while(reader, amount, days, too_often));
    }
    let part = reader.eat_any(&times::PARTS);
    let Some(part) = part else {
        reader.at = from;
        return None;
    };
    Some(Often { part: (part != PartOfDay::Day).then_some(part), times: Some(count(reader, amount)), ..Often::NOTHING })
}

/// "two weeks", "other month", as days.
fn several_periods(reader: &mut SentenceReader) -> Option<f64> {
    const SEVERAL: [(&str, f64); 3] = [("weeks", PERIODS[0].1), ("months", PERIODS[1].1), ("years", PERIODS[2].1)];
    if reader.eat("other|second") {
        return reader.eat_any(&PERIODS).map(|days| 2.0 * days);
    }
    let count = number(reader).filter(|count| *count >= 1.0)?;
    reader.eat_any(&SEVERAL).map(|days| count * days)
}

pub fn count(reader: &mut SentenceReader, amount: &Amount) -> (u32, u32) {
    amount.as_count().unwrap_or_else(|| {
        reader.fault(amount.span, TimeSentenceMessage::Count { text: reader.said(amount.span) });
        (1, 1)
    })
}

fn of(quantifier: Quantifier) -> Often {
    Often { chance: Some(HabitChance::from_quantifier(quantifier)), ..Often::NOTHING }
}

fn with_probability(probability: f64) -> HabitChance {
    HabitChance { quantifier: None, probability, becomes: None, days_a_week: None }
}

fn days_a_week_of(amount: &Amount) -> Option<u8> {
    let days = amount.from;
    (amount.from == amount.to && (1.0..=7.0).contains(&days) && libm::floor(days) == days).then_some(days as u8)
}
