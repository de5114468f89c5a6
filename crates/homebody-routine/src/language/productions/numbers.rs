//! Numbers, lengths of time, shares, counts.

use super::arguments::{Arguments, Production};
use crate::language::amounts::{ABOUT_SHARE, PLAIN_SHARE};
use crate::language::messages::TimeSentenceMessage;
use crate::language::value::{PhraseValue, Range};
use homebody_core::fuzzy::Fuzzy;

/// Numbers above this are slips (our choice).
const LARGEST: f64 = 1e9;

pub fn named(name: &str) -> Option<Production> {
    Some(match name {
        "number" => |a| Some(PhraseValue::Number(a.constant(0).parse().ok()?)),
        "sum" => |a| Some(PhraseValue::Number(a.numbers().iter().sum())),
        "product" => |a| Some(PhraseValue::Number(a.numbers().iter().chain(&a.number_constants()).product())),
        "minus" => |a| Some(PhraseValue::Number(-a.numbers().iter().product::<f64>())),
        "and_a_half" => |a| match a.numbers()[..] {
            [number, unit] => Some(PhraseValue::Number((number + 0.5) * unit)),
            _ => None,
        },
        "hours_and_minutes" => |a| match a.numbers()[..] {
            [hours, hour, minutes, minute] => Some(PhraseValue::Number(hours * hour + minutes * minute)),
            _ => None,
        },
        "range" => |a| range(a, 1.0),
        "range_in" => range_in,
        "several_lengths" => |a| {
            a.fault(a.span, TimeSentenceMessage::OneLength);
            Some(PhraseValue::Number(a.numbers()[0]))
        },
        "about" => |a| {
            let range = a.one(as_range)?;
            Some(PhraseValue::Range(Range { about: true, ..range }))
        },
        "times" => |a| {
            let numbers = [a.numbers(), a.number_constants()].concat();
            ranged(a, *numbers.first()?, *numbers.last()?)
        },
        "times_from" => |a| ranged(a, a.number_constants()[0], a.numbers()[0]),
        _ => return None,
    })
}

pub fn as_range(value: &PhraseValue) -> Option<Range> {
    match value {
        PhraseValue::Range(range) => Some(*range),
        _ => None,
    }
}

fn range(a: &mut Arguments, unit: f64) -> Option<PhraseValue> {
    let numbers = a.numbers();
    ranged(a, numbers.first()? * unit, numbers.last()? * unit)
}

/// "2 to 3 hours", "a few minutes".
fn range_in(a: &mut Arguments) -> Option<PhraseValue> {
    let mut numbers = [a.number_constants(), a.numbers()].concat();
    let unit = numbers.pop()?;
    ranged(a, numbers.first()? * unit, numbers.last()? * unit)
}

fn ranged(a: &mut Arguments, from: f64, to: f64) -> Option<PhraseValue> {
    if !from.is_finite() || !to.is_finite() || to > LARGEST || from > LARGEST {
        a.fault(a.span, TimeSentenceMessage::NumberTooLarge { text: a.said(a.span) });
        return Some(PhraseValue::Range(Range { from: 1.0, to: 1.0, about: false }));
    }
    if to < from {
        a.fault(a.span, TimeSentenceMessage::ReversedNumbers { text: a.said(a.span) });
    }
    Some(PhraseValue::Range(Range { from: from.min(to), to: from.max(to), about: false }))
}

/// How long something lasts.
pub fn duration(range: Range) -> Fuzzy {
    let share = if range.about { ABOUT_SHARE } else { PLAIN_SHARE };
    if range.from != range.to && !range.about {
        return Fuzzy::between(range.from, range.to);
    }
    Fuzzy { low: range.from * (1.0 - share), from: range.from, to: range.to, high: range.to * (1.0 + share) }
}
