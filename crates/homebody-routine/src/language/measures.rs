//! The amount of a change: "45 to 90 minutes later", "twice as often", "30 % slower".

use super::amounts::{Amount, AmountUnit, DAY_S, amount};
use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use super::words::TextSpan;
use homebody_core::fuzzy::Fuzzy;

/// Factor, or number of heartbeats or breaths a minute, above which a change is a slip of the pen (our choice).
const MOST_TIMES: f64 = 100.0;
const MOST_A_MINUTE: f64 = 100.0;

/// Highest walking speed (our choice).
pub const FASTEST_MPS: f64 = 3.0;

#[derive(Clone, Debug, PartialEq)]
pub struct AmountPhrase {
    pub of: Of,
    pub by: Fuzzy,
    pub span: TextSpan,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    Later,
    LongerBy,
    Longer,
    Oftener,
    Much,
    Faster,
    FasterBy { each_week: bool },
    Active,
    Restless,
    Beats,
    Breaths,
    Some,
}

pub fn measure(reader: &mut SentenceReader) -> Option<AmountPhrase> {
    let start = reader.at;
    reader.attempt(|reader| {
        if let Some((of, by)) = reader.attempt(later_by) {
            return Some(AmountPhrase { of, by, span: reader.span(start) });
        }
        if let Some((of, by)) = reader.attempt(unnumbered) {
            return Some(AmountPhrase { of, by, span: reader.span(start) });
        }
        reader.eat("by");
        let amount = amount(reader)?;
        let (of, by) = match amount.unit {
            AmountUnit::Second => time(reader, &amount)?,
            AmountUnit::Percent => percent(reader, &amount)?,
            AmountUnit::Times => factor(reader, &amount)?,
            AmountUnit::Speed => speed(reader, &amount)?,
            AmountUnit::Beats => (Of::Beats, rate(reader, &amount)?),
            AmountUnit::Breaths => (Of::Breaths, rate(reader, &amount)?),
            AmountUnit::Day | AmountUnit::Years | AmountUnit::None => return None,
        };
        Some(AmountPhrase { of, by, span: reader.span(start) })
    })
}

/// Range of a change that a sentence gives without a number (our choice). Each person has a value from it.
pub const UNSAID_LATER_S: (f64, f64) = (1_800.0, 5_400.0);
pub const UNSAID_MORE: (f64, f64) = (1.3, 1.7);
pub const UNSAID_LESS: (f64, f64) = (0.5, 0.8);
/// Change of the walking speed without a number (our choice).
pub const UNSAID_PACE: f64 = 0.1;
/// Factor of "a little", and of "much" (our choice).
pub const LITTLE: f64 = 0.5;
pub const MUCH: f64 = 2.0;

/// "later than usual", "much less often": a change without a number.
fn unnumbered(reader: &mut SentenceReader) -> Option<(Of, Fuzzy)> {
    let how_far = reader.attempt(|reader| {
        if reader.eat("a little|bit") || reader.eat("slightly|somewhat") {
            return Some(LITTLE);
        }
        (reader.eat("much|far|considerably|significantly") || reader.eat("a lot")).then_some(MUCH)
    });
    let (of, is_more) = reader.eat_any(&[
        ("later", (Of::Later, true)),
        ("earlier", (Of::Later, false)),
        ("longer", (Of::Longer, true)),
        ("shorter", (Of::Longer, false)),
        ("more often|frequently", (Of::Oftener, true)),
        ("less often|frequently", (Of::Oftener, false)),
        ("more rarely", (Of::Oftener, false)),
        ("slower", (Of::Faster, false)),
        ("more slowly", (Of::Faster, false)),
        ("faster|quicker", (Of::Faster, true)),
        ("more quickly", (Of::Faster, true)),
        ("more restless|restlessly", (Of::Restless, true)),
        ("less restless|restlessly", (Of::Restless, false)),
        ("more active", (Of::Active, true)),
        ("less active", (Of::Active, false)),
        ("more", (Of::Some, true)),
        ("less", (Of::Some, false)),
    ])?;
    let compared = [
        "than usual|before|normal",
        "than she|he|they used to",
        "than she|he|they usually does|do",
        "than in the past",
    ];
    let _ = compared.iter().any(|compared| reader.eat(compared));
    // "More than", "more water", "later by": nothing that is said without a number.
    let goes_on = reader.token(0) == Some(super::words::Token::Word) && !super::reader::begins_adverb(reader);
    if goes_on || ["by", "to"].contains(&reader.peek(0)) && of != Of::Some {
        return None;
    }
    let far = how_far.unwrap_or(1.0);
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
    Some((of, by))
}

/// "later by 30 minutes".
fn later_by(reader: &mut SentenceReader) -> Option<(Of, Fuzzy)> {
    let (of, is_less) = reader.eat_any(&[
        ("later by", (Of::Later, false)),
        ("earlier by", (Of::Later, true)),
        ("longer by", (Of::LongerBy, false)),
        ("shorter by", (Of::LongerBy, true)),
    ])?;
    let amount = amount(reader).filter(|amount| amount.unit == AmountUnit::Second)?;
    at_most(reader, &amount, amount.to, DAY_S, "a day");
    Some((of, signed(&amount, is_less)))
}

fn signed(amount: &Amount, is_less: bool) -> Fuzzy {
    let by = amount.as_change();
    if is_less { Fuzzy { low: -by.high, from: -by.to, to: -by.from, high: -by.low } } else { by }
}

fn at_most(reader: &mut SentenceReader, amount: &Amount, value: f64, most: f64, in_words: &str) {
    if value > most {
        let (text, most) = (reader.said(amount.span), in_words.to_owned());
        reader.fault(amount.span, TimeSentenceMessage::TooGreat { text, most });
    }
}

fn time(reader: &mut SentenceReader, amount: &Amount) -> Option<(Of, Fuzzy)> {
    let (of, is_less) = reader.eat_any(&[
        ("later", (Of::Later, false)),
        ("earlier", (Of::Later, true)),
        ("longer|more", (Of::LongerBy, false)),
        ("shorter|less", (Of::LongerBy, true)),
    ])?;
    reader.eat("a|each|every|per day|night");
    at_most(reader, amount, amount.to, DAY_S, "a day");
    Some((of, signed(amount, is_less)))
}

fn percent(reader: &mut SentenceReader, amount: &Amount) -> Option<(Of, Fuzzy)> {
    let (of, is_less) = reader.eat_any(&[
        ("more often", (Of::Oftener, false)),
        ("less often", (Of::Oftener, true)),
        ("more active", (Of::Active, false)),
        ("less active", (Of::Active, true)),
        ("more restlessly|restless", (Of::Restless, false)),
        ("less restlessly|restless", (Of::Restless, true)),
        ("more slowly", (Of::Faster, true)),
        ("more quickly", (Of::Faster, false)),
        ("slower", (Of::Faster, true)),
        ("faster|quicker", (Of::Faster, false)),
        ("longer", (Of::Longer, false)),
        ("shorter", (Of::Longer, true)),
        ("more irregular|irregularly|widely", (Of::Much, false)),
        ("less regular|regularly", (Of::Much, false)),
        ("more", (Of::Much, false)),
        ("less", (Of::Much, true)),
    ])?;
    if is_less && amount.to > 100.0 {
        let text = reader.said(amount.span.to(reader.span(reader.at - 1)));
        reader.fault(amount.span, TimeSentenceMessage::LessThanNothing { text });
    }
    let by = signed(amount, is_less).map(|percent| (1.0 + percent / 100.0).max(0.0));
    at_most(reader, amount, by.to, MOST_TIMES, "100 times as much");
    Some((of, by))
}

fn factor(reader: &mut SentenceReader, amount: &Amount) -> Option<(Of, Fuzzy)> {
    let of = reader.eat_any(&[
        ("as often", Of::Oftener),
        ("as long", Of::Longer),
        ("as much|irregular|irregularly|widely", Of::Much),
        ("as active", Of::Active),
        ("as restlessly|restless", Of::Restless),
        ("as fast|quickly", Of::Faster),
    ])?;
    at_most(reader, amount, amount.to, MOST_TIMES, "100 times as much");
    Some((of, amount.as_change()))
}

fn speed(reader: &mut SentenceReader, amount: &Amount) -> Option<(Of, Fuzzy)> {
    let is_less = reader.eat_any(&[("slower", true), ("faster|quicker", false)])?;
    let each_week = reader.eat("every|each|a|per week");
    at_most(reader, amount, amount.to, FASTEST_MPS, "3 m/s");
    Some((Of::FasterBy { each_week }, signed(amount, is_less)))
}

fn rate(reader: &mut SentenceReader, amount: &Amount) -> Option<Fuzzy> {
    let is_less = reader.eat_any(&[("faster|higher|more|quicker", false), ("slower|lower|less", true)])?;
    per_minute(reader, amount);
    Some(signed(amount, is_less))
}

fn per_minute(reader: &mut SentenceReader, amount: &Amount) {
    at_most(reader, amount, amount.to, MOST_A_MINUTE, "100 a minute");
}

/// "rises by 20 beats", after "pulse" or "breathing".
pub fn rises_by(reader: &mut SentenceReader, of: Of) -> Option<AmountPhrase> {
    let start = reader.at;
    reader.attempt(|reader| {
        let is_less = reader.eat_any(&[
            ("rises|increases|rise|increase", false),
            ("goes|go up", false),
            ("falls|drops|decreases|sinks|fall|drop", true),
            ("goes|go down", true),
            ("is", false),
        ])?;
        reader.eat("by");
        let amount = amount(reader)?;
        let unit = if of == Of::Beats { AmountUnit::Beats } else { AmountUnit::Breaths };
        if amount.unit != unit && amount.unit != AmountUnit::None {
            return None;
        }
        reader.eat("a|per minute");
        let lower = reader.eat_any(&[("higher|faster", false), ("lower|slower", true)]);
        per_minute(reader, &amount);
        Some(AmountPhrase { of, by: signed(&amount, is_less || lower == Some(true)), span: reader.span(start) })
    })
}
