use jiff::civil::Date;
use std::borrow::Borrow;
use std::fmt;

/// Smallest count without decimals.
const LARGE_COUNT: f64 = 20.0;

pub(crate) fn joined(headline: String, numbers: &str) -> String {
    if numbers.is_empty() { headline } else { format!("{headline}: {numbers}") }
}

/// Things in a list: `sleep, kitchen meals and getting up`.
pub(crate) fn listed(things: &[impl Borrow<str>]) -> String {
    let things: Vec<&str> = things.iter().map(Borrow::borrow).collect();
    match &things[..] {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => things.concat(),
    }
}

/// A date such as `20 April 2009`.
pub(crate) fn in_full(date: Date) -> String {
    date.strftime("%-d %B %Y").to_string()
}

pub(crate) fn write_remarks(f: &mut fmt::Formatter, remarks: &[String]) -> fmt::Result {
    if !remarks.is_empty() {
        writeln!(f)?;
    }
    remarks.iter().try_for_each(|remark| writeln!(f, "{remark}."))
}

pub(crate) fn hours(hours: f64) -> String {
    if (hours - 1.0).abs() < 0.05 { "1 hour".to_owned() } else { format!("{hours:.1} hours") }
}

pub(crate) fn often(times: f64) -> String {
    match times {
        0.0 => "none".to_owned(),
        1.0 => "once".to_owned(),
        2.0 => "twice".to_owned(),
        times => format!("{} times", count(times)),
    }
}

pub(crate) fn count(value: f64) -> String {
    let decimals = usize::from(value < LARGE_COUNT && value.fract() != 0.0);
    format!("{value:.decimals$}")
}

pub(crate) fn number(count: usize) -> String {
    const WORDS: [&str; 8] = ["two", "three", "four", "five", "six", "seven", "eight", "nine"];
    count.checked_sub(2).and_then(|place| WORDS.get(place)).map_or_else(|| count.to_string(), ToString::to_string)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_end_with_and() {
        assert_eq!(listed(&["sleep", "kitchen meals", "getting up"]), "sleep, kitchen meals and getting up");
    }
}
