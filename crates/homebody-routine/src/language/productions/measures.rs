//! How something changes: "45 to 90 minutes later", "twice as often", "30 % slower".

use super::arguments::{Arguments, Production, parts};
use super::numbers::{as_range, duration};
use crate::language::amounts::DAY_S;
use crate::language::messages::TimeSentenceMessage;
use crate::language::parts::{Measure, Of, Parts};
use crate::language::value::{PhraseValue, Range, Verb};
use homebody_core::fuzzy::Fuzzy;

/// Factor, or number of heartbeats or breaths a minute, above which a change is a slip of the pen (our choice).
const MOST_TIMES: f64 = 100.0;
const MOST_A_MINUTE: f64 = 100.0;

/// Highest walking speed (our choice).
pub const FASTEST_MPS: f64 = 3.0;

/// Range of a change that a sentence gives without a number (our choice). Each person has a value from it.
const UNSAID_LATER_S: (f64, f64) = (1_800.0, 5_400.0);
const UNSAID_MORE: (f64, f64) = (1.3, 1.7);
const UNSAID_LESS: (f64, f64) = (0.5, 0.8);
/// Change of the walking speed without a number (our choice).
const UNSAID_PACE: f64 = 0.1;

pub fn named(name: &str) -> Option<Production> {
    Some(match name {
        "change" => |a| {
            let (of, range) = (of_name(a.constant(0))?, a.one(as_range)?);
            let (most, in_words) = match of {
                Of::Beats | Of::Breaths => (MOST_A_MINUTE, "100 a minute"),
                _ => (DAY_S, "a day"),
            };
            at_most(a, range.to, most, in_words);
            measure(of, signed(range, a.has("less")))
        },
        "percent" => |a| {
            let (of, range, is_less) = (of_name(a.constant(0))?, a.one(as_range)?, a.has("less"));
            if is_less && range.to > 100.0 {
                let span = a.kids[0].span;
                a.fault(span, TimeSentenceMessage::LessThanNothing { text: a.said(a.span) });
            }
            let by = signed(range, is_less).map(|percent| (1.0 + percent / 100.0).max(0.0));
            at_most(a, by.to, MOST_TIMES, "100 times as much");
            measure(of, by)
        },
        "factor" => |a| {
            let numbers = [a.numbers(), a.number_constants()].concat();
            let of_numbers = || Some(Range { from: *numbers.first()?, to: *numbers.last()?, about: false });
            let range = a.one(as_range).or_else(of_numbers)?;
            Some(PhraseValue::Range(range))
        },
        "times_as" => |a| {
            let (of, range) = (of_name(a.constant(0))?, a.one(as_range)?);
            at_most(a, range.to, MOST_TIMES, "100 times as much");
            measure(of, as_change(range))
        },
        "speed" => |a| {
            let range = a.one(as_range)?;
            at_most(a, range.to, FASTEST_MPS, "3 m/s");
            measure(Of::FasterBy { each_week: a.numbers().len() == 1 }, signed(range, a.has("less")))
        },
        "unnumbered" => unnumbered,
        "measure" => |a| {
            let measure = a.one(as_measure)?;
            parts(Parts { measure: a.slot(measure), ..Parts::default() })
        },
        "rises" => |a| {
            let (of, range) = (of_name(a.constant(0))?, a.one(as_range)?);
            at_most(a, range.to, MOST_A_MINUTE, "100 a minute");
            Some(PhraseValue::Verb(Verb::Rises(Measure { of, by: signed(range, a.has("less")) })))
        },
        _ => return None,
    })
}

pub fn as_measure(value: &PhraseValue) -> Option<Measure> {
    match value {
        PhraseValue::Measure(measure) => Some(*measure),
        _ => None,
    }
}

fn of_name(name: &str) -> Option<Of> {
    Some(match name {
        "Later" => Of::Later,
        "LongerBy" => Of::LongerBy,
        "Longer" => Of::Longer,
        "Oftener" => Of::Oftener,
        "Much" => Of::Much,
        "Faster" => Of::Faster,
        "Active" => Of::Active,
        "Restless" => Of::Restless,
        "Beats" => Of::Beats,
        "Breaths" => Of::Breaths,
        "Some" => Of::Some,
        _ => return None,
    })
}

fn measure(of: Of, by: Fuzzy) -> Option<PhraseValue> {
    Some(PhraseValue::Measure(Measure { of, by }))
}

fn as_change(range: Range) -> Fuzzy {
    if range.about { duration(range) } else { Fuzzy::between(range.from, range.to) }
}

fn signed(range: Range, is_less: bool) -> Fuzzy {
    let by = as_change(range);
    if is_less { Fuzzy { low: -by.high, from: -by.to, to: -by.from, high: -by.low } } else { by }
}

fn at_most(a: &mut Arguments, value: f64, most: f64, in_words: &str) {
    if value > most {
        let span = a.kids[0].span;
        a.fault(span, TimeSentenceMessage::TooGreat { text: a.said(span), most: in_words.to_owned() });
    }
}

/// "Later than usual", "much less often".
fn unnumbered(a: &mut Arguments) -> Option<PhraseValue> {
    let (of, is_more) = (of_name(a.constant(0))?, a.has("more"));
    let far = a.numbers().first().copied().unwrap_or(1.0);
    let (low, high) = if is_more { UNSAID_MORE } else { UNSAID_LESS };
    let from_one = |factor: f64| (1.0 + (factor - 1.0) * far).max(0.0);
    let by = match of {
        Of::Later => {
            let (least, most) = (UNSAID_LATER_S.0 * far, UNSAID_LATER_S.1 * far);
            if is_more { Fuzzy::between(least, most) } else { Fuzzy::between(-most, -least) }
        }
        Of::Faster => Fuzzy::exactly(from_one(1.0 + if is_more { UNSAID_PACE } else { -UNSAID_PACE })),
        _ => Fuzzy::between(from_one(low).min(from_one(high)), from_one(low).max(from_one(high))),
    };
    measure(of, by)
}
