//! The words for changes.

use super::words::{amount, bare, clock, number, part_words, unit};
use crate::language::activities::phrase;
use crate::language::amounts::ABOUT_SHARE;
use crate::routine::{Effect, HabitTime, RoutineChange, Shy, When};
use homebody_core::fuzzy::Fuzzy;

pub(super) fn effect_words(change: &RoutineChange) -> String {
    let part = change.when.part().map(|part| format!(" {}", part_words(part))).unwrap_or_default();
    match &change.effect {
        Effect::Shows { condition, severity } => {
            let severe = severity_words(*severity).map(|word| format!("{word} ")).unwrap_or_default();
            format!("she shows {severe}{}", condition.replace('-', " "))
        }
        Effect::Pace(by) => format!("she walks {}", factor(by, "faster", "slower", "as fast")),
        Effect::PaceEachWeek(by) => {
            let (by, word) = signed(by, "faster", "slower");
            format!("she walks {} {word} every week", amount(&by, 1.0, "m/s", 0.0, ABOUT_SHARE))
        }
        Effect::Later { activity, by } => format!("she {} {}", phrase(activity), shift(by, "later", "earlier")),
        Effect::LongerBy { activity, by } => format!("she {} {}", phrase(activity), shift(by, "longer", "shorter")),
        Effect::Longer { activity, factor: by } => {
            format!("she {} {}", phrase(activity), factor(by, "longer", "shorter", "as long"))
        }
        Effect::Oftener { activity, factor: by } if by.high <= 0.0 => format!("she never {}{part}", phrase(activity)),
        Effect::Oftener { activity, factor: by } => {
            format!("she {} {}{part}", phrase(activity), factor(by, "more often", "less often", "as often"))
        }
        Effect::Skips { activity } => format!("she does not {}", bare(&phrase(activity))),
        Effect::Irregular(by) => format!("her hours vary {}", factor(by, "more", "less", "as much")),
        Effect::Active { factor: by } => {
            format!("she is {}{part}", factor(by, "more active", "less active", "as active"))
        }
        Effect::DaysDiffer(by) => format!("her days differ {}", factor(by, "more", "less", "as much")),
        Effect::DaysAre { kind, very } => {
            format!("she has a {}{} day", if *very { "very " } else { "" }, kind.word())
        }
        Effect::SleepsIn => "she sleeps in after a late night".to_owned(),
        Effect::Restless(by) => {
            format!("she sleeps {}", factor(by, "more restlessly", "less restlessly", "as restlessly"))
        }
        Effect::Forgets { thing } => format!("she forgets the {thing}"),
        Effect::KeepsOn { thing } => format!("she leaves the {thing} on{}", keeping_words(&change.when)),
        Effect::Range { place, inside: true } => format!("she keeps to the {place}"),
        Effect::Range { place, inside: false } => format!("she never enters the {place}"),
        Effect::Spares { thing } => format!("she never uses the {thing}"),
        Effect::Shy { of: Shy::OpenFloor, .. } => "she keeps close to the walls".to_owned(),
        Effect::Shy { of: Shy::People, .. } => "she keeps away from others".to_owned(),
        Effect::Shy { of: Shy::GoingOn, gain } => format!("she stops {} times a minute as she wanders", number(*gain)),
        Effect::Pulse(by) => {
            let (by, word) = signed(by, "faster", "slower");
            format!("her heart beats {} {word}", amount(&by, 1.0, "beats a minute", 0.0, ABOUT_SHARE))
        }
        Effect::Respiration(by) => {
            let (by, word) = signed(by, "faster", "slower");
            format!("she breathes {} {word}", amount(&by, 1.0, "breaths a minute", 0.0, ABOUT_SHARE))
        }
    }
}

/// From when to when a thing is on.
fn keeping_words(when: &When) -> String {
    match (&when.time, &when.until) {
        (HabitTime::At(from), Some(until)) => format!(" at {} until {}", clock(from, "at"), clock(until, "until")),
        _ => " all night".to_owned(),
    }
}

/// The word for a severity; none for a moderate one.
fn severity_words(severity: f64) -> Option<String> {
    match severity {
        0.5 => Some("mild".to_owned()),
        1.0 => None,
        1.5 => Some("severe".to_owned()),
        severity => Some(format!("{} times moderate", number(severity))),
    }
}

/// Amounts above zero, and the word for their sign.
fn signed(by: &Fuzzy, more: &'static str, less: &'static str) -> (Fuzzy, &'static str) {
    match by.high <= 0.0 {
        true => (Fuzzy { low: -by.high, from: -by.to, to: -by.from, high: -by.low }, less),
        false => (*by, more),
    }
}

fn shift(by: &Fuzzy, more: &'static str, less: &'static str) -> String {
    let (by, word) = signed(by, more, less);
    let (size, unit) = unit(&by);
    format!("{} {word}", amount(&by, size, unit, 0.0, ABOUT_SHARE))
}

/// "30 % longer", "10 to 20 % shorter", or "1.5 to 3 times as long".
fn factor(by: &Fuzzy, more: &str, less: &str, times: &str) -> String {
    let percent = |factor: f64| {
        let percent = ((factor - 1.0) * 100.0).round();
        (1.0 + percent / 100.0 == factor).then_some(percent)
    };
    let is_range = by.low == by.from && by.high == by.to;
    match (percent(by.from), percent(by.to)) {
        (Some(from), Some(to)) if is_range && from == to && from != 0.0 => {
            format!("{} % {}", number(from.abs()), if from > 0.0 { more } else { less })
        }
        (Some(from), Some(to)) if is_range && from > 0.0 => format!("{} to {} % {more}", number(from), number(to)),
        (Some(from), Some(to)) if is_range && to < 0.0 => format!("{} to {} % {less}", number(-to), number(-from)),
        _ => about_percent(by, more, less)
            .unwrap_or_else(|| format!("{} {times}", amount(by, 1.0, "times", 0.0, ABOUT_SHARE))),
    }
}

/// "about 10 % slower": the spread is a share of the percentage.
fn about_percent(by: &Fuzzy, more: &str, less: &str) -> Option<String> {
    let (by, word) = signed(&by.map(|factor| (factor - 1.0) * 100.0), "", "-");
    let spread = by.from * ABOUT_SHARE;
    let is_about = by.from > 0.0
        && (by.from - by.low - spread).abs() < 1e-6
        && (by.high - by.to - by.to * ABOUT_SHARE).abs() < 1e-6;
    let range = match (by.from.round(), by.to.round()) {
        (from, to) if from == to => number(from),
        (from, to) => format!("{} to {}", number(from), number(to)),
    };
    is_about.then(|| format!("about {range} % {}", if word == "-" { less } else { more }))
}
