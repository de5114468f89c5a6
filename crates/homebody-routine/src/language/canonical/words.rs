//! The words for times, lengths and numbers.

use crate::language::amounts::{ABOUT_SHARE, DAY_S, PLAIN_SHARE};
use crate::language::times::{ABOUT_TIME_S, PLAIN_TIME_S};
use crate::routine::PartOfDay;
use homebody_core::fuzzy::Fuzzy;

pub fn part_words(part: PartOfDay) -> String {
    match part {
        PartOfDay::Noon => "at noon".to_owned(),
        PartOfDay::Night => "at night".to_owned(),
        PartOfDay::Day => "during the day".to_owned(),
        part => format!("in the {}", part.word()),
    }
}

/// A time of day; one after midnight that belongs to the evening before is "at night".
pub fn clock(at: &Fuzzy, word: &str) -> String {
    let of = |seconds: f64| {
        let minutes = (seconds.rem_euclid(DAY_S) / 60.0).round() as u32;
        format!("{:02}:{:02}", minutes / 60, minutes % 60)
    };
    let mut text = of(at.from);
    if at.from < at.to {
        text += &format!(" and {}", of(at.to));
    }
    let about = match at.from - at.low {
        PLAIN_TIME_S if at.from == at.to => String::new(),
        0.0 if at.from < at.to => String::new(),
        ABOUT_TIME_S if at.from == at.to => {
            text = format!("about {text}");
            String::new()
        }
        give_or_take => format!(", give or take {},", exactly(give_or_take)),
    };
    let of_night = if at.from >= DAY_S && word != "until" { " at night" } else { "" };
    format!("{text}{of_night}{about}")
}

pub fn duration(lasts: &Fuzzy) -> String {
    let (size, unit) = unit(lasts);
    amount(lasts, size, unit, PLAIN_SHARE, ABOUT_SHARE)
}

/// The largest unit that makes all numbers whole.
pub fn unit(lasts: &Fuzzy) -> (f64, &'static str) {
    let is_whole = |size: f64| [lasts.from, lasts.to].iter().all(|value| value % size == 0.0);
    let units = [(86_400.0, "days"), (3600.0, "hours"), (60.0, "minutes")];
    units.into_iter().find(|(size, _)| is_whole(*size)).unwrap_or((1.0, "seconds"))
}

/// A number or a range with its unit. `plain` and `about` are the spreads of a number without and with "about".
pub fn amount(value: &Fuzzy, size: f64, unit: &str, plain: f64, about: f64) -> String {
    let Fuzzy { low, from, to, high } = *value;
    let range = match from == to {
        true => number(from / size),
        false => format!("{} to {}", number(from / size), number(to / size)),
    };
    let spreads = |share: f64| is_near(low, from - from * share) && is_near(high, to + to * share);
    let unit = if range == "1" { unit.trim_end_matches('s') } else { unit };
    match (from == to, low == from && high == to) {
        (true, _) if spreads(plain) => format!("{range} {unit}"),
        (false, true) => format!("{range} {unit}"),
        _ if spreads(about) => format!("about {range} {unit}"),
        _ => format!("{range} {unit}, give or take {},", give_or_take(from - low, unit)),
    }
}

fn give_or_take(spread: f64, unit: &str) -> String {
    match unit {
        "m/s" => format!("{} m/s", number(spread)),
        _ => exactly(spread),
    }
}

/// A duration without a spread.
fn exactly(seconds: f64) -> String {
    let (size, unit) = if seconds == 0.0 { (60.0, "minutes") } else { unit(&Fuzzy::exactly(seconds)) };
    let count = number(seconds / size);
    let unit = if count == "1" { unit.trim_end_matches('s') } else { unit };
    format!("{count} {unit}")
}

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs())
}

pub fn number(value: f64) -> String {
    (value + 0.0).to_string()
}

/// "goes" is "go".
pub fn bare(phrase: &str) -> String {
    let (verb, rest) = phrase.split_once(' ').unwrap_or((phrase, ""));
    let verb = match verb {
        "has" => "have".to_owned(),
        "does" | "goes" => verb.trim_end_matches("es").to_owned(),
        "washes" | "watches" | "dozes" => verb.trim_end_matches('s').trim_end_matches('e').to_owned(),
        verb => verb.strip_suffix('s').unwrap_or(verb).to_owned(),
    };
    join([Some(verb), Some(rest.to_owned()).filter(|rest| !rest.is_empty())], " ")
}

pub fn join<const N: usize>(parts: [Option<String>; N], between: &str) -> String {
    parts.into_iter().flatten().collect::<Vec<_>>().join(between)
}
