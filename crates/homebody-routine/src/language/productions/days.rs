//! Weekdays, months, dates, and the days of the run from which and until which something holds.

use super::arguments::{Arguments, Production, parts};
use super::times::as_part;
use crate::language::calendar;
use crate::language::messages::TimeSentenceMessage;
use crate::language::parts::Parts;
use crate::language::value::PhraseValue;
use crate::routine::{DayKind, DaySelection, PartOfDay, PhaseDay, Weather};

pub fn named(name: &str) -> Option<Production> {
    Some(match name {
        "weekdays" => |a| {
            let days =
                [a.numbers(), a.number_constants()].concat().iter().fold(0, |days, day| days | 1_u8 << *day as u8);
            Some(PhraseValue::Weekdays(days | a.one(as_weekdays).unwrap_or(0)))
        },
        "weekday_range" => |a| Some(PhraseValue::Weekdays(weekday_range(&a.numbers()))),
        "on_days" => |a| {
            let days = a.one(as_weekdays)?;
            on_days(a, days, a.one(as_part))
        },
        "on_nights" => |a| {
            let days = a.one(as_weekdays)?;
            on_days(a, days, Some(vec![PartOfDay::Night]))
        },
        "on_days_from" => |a| {
            let days = weekday_range(&a.numbers());
            on_days(a, days, None)
        },
        "except" => |a| {
            let months = a.one(as_months);
            let except_days = a.one(as_weekdays).and_then(|days| a.slot(days));
            parts(Parts { except_days, except_months: months.and_then(|months| a.slot(months)), ..Parts::default() })
        },
        "months" => |a| {
            let months = a.number_constants().iter().fold(0, |months, month| months | 1_u16 << (*month as u16 - 1));
            let months = a.numbers().iter().fold(months, |months, month| months | 1_u16 << (*month as u16 - 1));
            Some(PhraseValue::Months(a.all(as_months).iter().fold(months, |months, more| months | more)))
        },
        "in_months" => |a| {
            let months = a.one(as_months)?;
            parts(Parts { months: a.slot(months), ..Parts::default() })
        },
        "month_range" => |a| {
            let (first, last) = (a.numbers()[0] as u16 - 1, a.numbers()[1] as u16 - 1);
            let months =
                (0..=(last + 12 - first) % 12).fold(0, |months, ahead| months | 1_u16 << ((first + ahead) % 12));
            parts(Parts { months: a.slot(months), ..Parts::default() })
        },
        "day_of_year" => day_of_year,
        "nth_of_month" => nth_of_month,
        "day_of_months" | "days_of_months" => |a| {
            let days = a.numbers();
            let (first, last) = (*days.first()?, *days.last()?);
            let is_day = |day: f64| day.fract() == 0.0 && (0.0..=31.0).contains(&day);
            let months = a.one(as_months).and_then(|months| a.slot(months));
            let of_month = a.slot((first as u8, last as u8)).filter(|_| is_day(first) && is_day(last) && first <= last);
            of_month.as_ref()?;
            parts(Parts { of_month, months, ..Parts::default() })
        },
        "nth_of_months" => |a| {
            let (numbers, months) = (a.numbers(), a.one(as_months)?);
            let of_month = of_weekday(numbers[0])?;
            let weekdays = a.slot(1_u8 << numbers[1] as u8);
            parts(Parts { of_month: a.slot(of_month), weekdays, months: a.slot(months), ..Parts::default() })
        },
        "of_kind" => |a| {
            let kind = a.one(as_kind)?;
            parts(Parts { kind: a.slot(kind), ..Parts::default() })
        },
        "of_weather" => |a| {
            let weather = a.one(|value| match value {
                PhraseValue::Weather(weather) => Some(*weather),
                _ => None,
            })?;
            parts(Parts { weather: a.slot(weather), ..Parts::default() })
        },
        "weather" => |a| {
            let all = [Weather::Dry, Weather::Rainy, Weather::Hot, Weather::Frosty];
            all.into_iter().find(|one| format!("{one:?}") == a.constant(0)).map(PhraseValue::Weather)
        },
        "poor_nights" => |a| {
            let nights = a.numbers().first().map_or(1, |nights| *nights as u32);
            parts(Parts { poor_nights: a.slot(nights), ..Parts::default() }).filter(|_| nights > 0)
        },
        "kind" => |a| Some(PhraseValue::DayKind(if a.constant(0) == "Quiet" { DayKind::Quiet } else { DayKind::Busy })),
        "date" => |a| match a.kids[0].value.as_ref() {
            PhraseValue::Moment(PhaseDay::Date(year, month, day), _) => {
                Some(date(a, f64::from(*year), f64::from(*month), f64::from(*day)))
            }
            _ => None,
        },
        "date_in_words" => |a| match a.numbers()[..] {
            [month, day, year] if a.has("month") => Some(date(a, year, month, day)),
            [day, month, year] => Some(date(a, year, month, day)),
            _ => None,
        },
        "moment" => |a| {
            let (unit, number) = (a.numbers()[0], a.numbers()[1]);
            if number.fract() != 0.0 || !(1.0..=36_525.0).contains(&number) {
                a.fault(a.span, TimeSentenceMessage::NoDay { text: a.said(a.span) });
                return Some(PhraseValue::Moment(PhaseDay::Day(0), 1));
            }
            Some(PhraseValue::Moment(PhaseDay::Day((number as i32 - 1).saturating_mul(unit as i32)), unit as i32))
        },
        "nth" => |a| {
            let (nth, unit) = (a.numbers()[0], a.numbers()[1]);
            let is_day = nth.fract() == 0.0 && (1.0..=1000.0).contains(&nth);
            is_day.then(|| PhraseValue::Moment(PhaseDay::Day((nth as i32 - 1) * unit as i32), unit as i32))
        },
        "first_days" => |a| {
            let number = a.numbers();
            let (number, unit) = (number[number.len() - 2], number[number.len() - 1]);
            let is_count = number.fract() == 0.0 && (1.0..=1000.0).contains(&number);
            is_count.then_some(PhraseValue::Moment(PhaseDay::Day(0), (number * unit) as i32))
        },
        "in_moment" => |a| {
            let numbers = a.numbers();
            let moment = a.one(as_moment).or(match numbers[..] {
                [first, unit] if a.words[1].text == "the" && a.words[2].text != "first" => {
                    Some((PhaseDay::Day((first as i32 - 1) * unit as i32), unit as i32))
                }
                [number, unit] => Some((PhaseDay::Day(0), (number * unit) as i32)),
                _ => None,
            });
            let (moment, length) = moment?;
            let until_day = a.slot(calendar::later(moment, length));
            parts(Parts { from: a.slot(moment), until_day, ..Parts::default() })
        },
        "from" => |a| {
            let (moment, _) = a.one(as_moment)?;
            parts(Parts { from: a.slot(moment), ..Parts::default() })
        },
        "from_moment_to" => |a| {
            let moments = a.all(as_moment);
            let ((from, _), (to, length)) = (*moments.first()?, *moments.get(1)?);
            let until_day = a.slot(calendar::later(to, length));
            parts(Parts { from: a.slot(from), until_day, ..Parts::default() })
        },
        "until" => |a| {
            let (moment, _) = a.one(as_moment)?;
            parts(Parts { until_day: a.slot(moment), ..Parts::default() })
        },
        "until_end" => |a| {
            let (moment, length) = a.one(as_moment)?;
            parts(Parts { until_day: a.slot(calendar::later(moment, length)), ..Parts::default() })
        },
        "after_moment" => |a| {
            let (moment, length) = a.one(as_moment)?;
            parts(Parts { from: a.slot(calendar::later(moment, length)), ..Parts::default() })
        },
        "after_days" => |a| {
            let days = whole_days(a)?;
            parts(Parts { from: a.slot(PhaseDay::Day(days as i32)), ..Parts::default() })
        },
        "follows" => |a| parts(Parts { follows: a.slot(()), ..Parts::default() }),
        "which_day" => |a| {
            let span = a.kids[0].span;
            a.fault(span, TimeSentenceMessage::WhichDay { text: a.said(span) });
            Some(PhraseValue::Parts(Box::default()))
        },
        "over" => |a| {
            let days = *a.numbers().last()?;
            parts(Parts { over: a.slot(days), ..Parts::default() })
        },
        "fading" => |a| {
            let days = *a.numbers().last()?;
            parts(Parts { fading: a.slot(days), ..Parts::default() })
        },
        "for_days" => |a| {
            let days = whole_days(a)?;
            let is_nights =
                a.has("nights") || a.words.last().is_some_and(|word| ["night", "nights"].contains(&word.text.as_str()));
            parts(match is_nights {
                true => Parts { nights: a.slot(days as u32), ..Parts::default() },
                false => Parts { for_days: a.slot(days), ..Parts::default() },
            })
        },
        "nothing" => |_| Some(PhraseValue::Parts(Box::default())),
        _ => return None,
    })
}

pub fn as_weekdays(value: &PhraseValue) -> Option<u8> {
    match value {
        PhraseValue::Weekdays(days) => Some(*days),
        _ => None,
    }
}

fn as_months(value: &PhraseValue) -> Option<u16> {
    match value {
        PhraseValue::Months(months) => Some(*months),
        _ => None,
    }
}

pub fn as_kind(value: &PhraseValue) -> Option<DayKind> {
    match value {
        PhraseValue::DayKind(kind) => Some(*kind),
        _ => None,
    }
}

pub fn as_moment(value: &PhraseValue) -> Option<(PhaseDay, i32)> {
    match value {
        PhraseValue::Moment(day, length) => Some((*day, *length)),
        _ => None,
    }
}

fn weekday_range(days: &[f64]) -> u8 {
    let (first, last) = (days[0] as u8, days[1] as u8);
    (0..=(last + 7 - first) % 7).fold(0, |days, ahead| days | 1 << ((first + ahead) % 7))
}

fn on_days(a: &mut Arguments, days: u8, part: Option<Vec<PartOfDay>>) -> Option<PhraseValue> {
    let part = part.and_then(|part| a.slot(part));
    parts(Parts { weekdays: a.slot(days), part, ..Parts::default() })
}

fn whole_days(a: &mut Arguments) -> Option<f64> {
    let days = *a.numbers().last()?;
    if days.fract() != 0.0 || days < 1.0 {
        let span = a.kids[0].span;
        a.fault(span, TimeSentenceMessage::WholeDays);
    }
    Some(days.max(1.0).round())
}

fn date(a: &mut Arguments, year: f64, month: f64, day: f64) -> PhraseValue {
    let moment = calendar::date(year as u32, month as u32, day as u32);
    if moment.is_none() {
        a.fault(a.span, TimeSentenceMessage::NoDate);
    }
    PhraseValue::Moment(moment.unwrap_or(PhaseDay::Day(0)), 1)
}

/// "on 25 December", "on 24 to 26 December".
fn day_of_year(a: &mut Arguments) -> Option<PhraseValue> {
    let mut numbers = a.numbers();
    if a.has("month") {
        numbers.reverse();
    }
    let (first, last, month) = match numbers[..] {
        [first, month] => (first, first, month),
        [first, last, month] => (first, last, month),
        _ => return None,
    };
    let is_day = |day: f64| day.fract() == 0.0 && (1.0..=31.0).contains(&day);
    if !is_day(first) || !is_day(last) || last < first {
        return None;
    }
    let months = a.slot(1_u16 << (month as u16 - 1));
    parts(Parts { of_month: a.slot((first as u8, last as u8)), months, ..Parts::default() })
}

/// "on the first Monday of the month", "on the 3rd of each month": a last one is number 0.
fn nth_of_month(a: &mut Arguments) -> Option<PhraseValue> {
    let numbers = a.numbers();
    // An ordinal, a weekday and a month.
    let (has_weekday, is_month) = (numbers.len() > 1, numbers.len() > 2);
    let nth = numbers[0];
    let of_month = match (has_weekday, nth as u8) {
        (true, _) => of_weekday(nth)?,
        (false, 1..=31) => (nth as u8, nth as u8),
        _ => return None,
    };
    let months = if is_month { 1_u16 << (*numbers.last()? as u16 - 1) } else { DaySelection::ALL.months };
    let months = if months == DaySelection::ALL.months { None } else { a.slot(months) };
    let weekdays = if has_weekday { a.slot(1_u8 << numbers[1] as u8) } else { None };
    parts(Parts { of_month: a.slot(of_month), weekdays, months, ..Parts::default() })
}

/// The days of a month among which its first, second or last Monday is.
fn of_weekday(nth: f64) -> Option<(u8, u8)> {
    match nth as u8 {
        0 => Some(DaySelection::LAST_WEEK),
        nth @ 1..=4 => Some((nth * 7 - 6, nth * 7)),
        _ => None,
    }
}
