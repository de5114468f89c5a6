//! Sentences about measures: alerts, changes, levels and days. The commands and the page print the same.

use crate::alerts::Method;
use crate::dates::clock_of_hours;
use crate::measures::{Measure, Unit};
use crate::summaries::{About, Set};
use homebody_core::fuzzy::Quantifier;
use homebody_core::names::capitalised;
use jiff::civil::Date;
use std::borrow::Borrow;

/// Difference of the pace, in percent, below which it is unchanged (our choice).
const SAME_PACE_PERCENT: f64 = 5.0;
/// Counts from here on are written without decimals.
const LARGE_COUNT: f64 = 20.0;

/// The value that another is compared with.
#[derive(Clone, Copy)]
pub(crate) enum Earlier {
    /// The usual value, of an alert.
    Usual(f64),
    /// The mean before, of a change in a summary.
    Before(f64),
}

impl Measure {
    /// Its name in the middle of a sentence.
    pub fn noun(&self) -> String {
        self.title.to_lowercase()
    }

    /// More of it, or less.
    fn changed(&self, is_more: bool) -> &'static str {
        if is_more { self.more } else { self.less }
    }

    /// The headline of an alert, and the values behind it.
    pub(crate) fn alert(&self, method: Method, (value, usual): (f64, f64), days: &[Date]) -> (String, String) {
        let what = capitalised(self.changed(value > usual));
        let headline = match (method, days) {
            (Method::Ewma, _) => format!("{what}, building up over several days"),
            (Method::Cusum, [first, ..]) => format!("{what} since {}", in_full(*first)),
            (_, [] | [_]) => format!("{what} than usual"),
            (_, days) => format!("{what} than usual, {} {}s in a row", number(days.len()), self.occasion),
        };
        (headline, self.compared(value, Earlier::Usual(usual), method != Method::Deviation))
    }

    /// The values of a comparison, such as `2.8 a day on average, usually 3.6`; empty if no words fit.
    pub(crate) fn compared(&self, value: f64, earlier: Earlier, is_average: bool) -> String {
        let (other, word, than) = match earlier {
            Earlier::Usual(other) => (other, "usually", "usual"),
            Earlier::Before(other) => (other, "previously", "before"),
        };
        let said = if is_average { self.on_average(value) } else { self.said(value) };
        match (said, self.short(other)) {
            (Some(said), Some(other)) => format!("{said}, {word} {other}"),
            _ if other <= 0.0 => String::new(),
            _ => {
                format!("{:.0} % {} than {than}", (value / other - 1.0).abs() * 100.0, self.comparative(value > other))
            }
        }
    }

    /// A sentence of a summary without its full stop: how the measure was on so many days, or how it changed.
    pub(crate) fn summary(&self, quantifier: Quantifier, set: Set, about: About, days: usize) -> String {
        let on = on(quantifier, self.occasion, days);
        let how = match set {
            Set::Beyond { is_more, .. } => return format!("{} than before {on}", capitalised(self.changed(is_more))),
            Set::Exactly(0) => self.did_not.to_owned(),
            Set::Exactly(times) => self.did.replace("{}", &often(times.into())),
            Set::AtLeast(times) => self.did.replace("{}", &format!("at least {}", often(times.into()))),
            Set::Between(from, to) if self.is_clock() => {
                self.did.replace("{}", &format!("between {} and {}", clock_of_hours(from), clock_of_hours(to)))
            }
            Set::Between(from, to) => {
                let from = if from == 0.0 { "at most".to_owned() } else { format!("{from} to") };
                self.did.replace("{}", &format!("for {from} {to} hour{}", if to == 1.0 { "" } else { "s" }))
            }
        };
        format!("{} {how} {on}", capitalised(about.subject))
    }

    /// A day in words, compared with the usual value, if that is known: its mean, and whether the day is more.
    pub(crate) fn day(&self, value: f64, usual: Option<(f64, Option<bool>)>) -> String {
        let is_walk = matches!(self.kind(), Unit::OfUsual | Unit::MetresASecond);
        match usual {
            Some((_, None)) if is_walk => "Walked at the usual pace".to_owned(),
            Some((mean, Some(is_more))) if is_walk => {
                format!("Walked {:.0} % {} than usual", (value / mean - 1.0).abs() * 100.0, self.comparative(is_more))
            }
            // It is relative to the whole log, so it has words before there is a usual value.
            None if self.kind() == Unit::OfUsual => match ((value - 1.0).abs() * 100.0).round() {
                percent if percent < SAME_PACE_PERCENT => "Walked as fast as on most days".to_owned(),
                percent => format!("Walked {percent:.0} % {} than on most days", self.comparative(value > 1.0)),
            },
            None => self.this_day(value),
            Some((_, None)) => format!("{}, as usual", self.this_day(value)),
            Some((mean, Some(is_more))) => {
                let usual = self.short(mean).unwrap_or_default();
                format!("{}, {} than usual ({usual})", self.this_day(value), self.comparative(is_more))
            }
        }
    }

    /// A value of a day as a clause.
    fn this_day(&self, value: f64) -> String {
        let said = match self.kind() {
            Unit::Hours => format!("for {}", hours(value)),
            Unit::MetresASecond => format!("at {value:.2} m/s"),
            _ => self.said(value).unwrap_or_default(),
        };
        let is_none = value < 0.05 && !self.did_not.is_empty();
        capitalised(&if is_none { self.did_not.to_owned() } else { self.did.replace("{}", &said) })
    }

    /// A value of one day on its own.
    fn said(&self, value: f64) -> Option<String> {
        match self.kind() {
            Unit::Hours => Some(hours(value)),
            Unit::Clock => Some(format!("at {}", clock_of_hours(value))),
            Unit::Times => Some(often(value)),
            Unit::MetresASecond => Some(format!("{value:.2} m/s")),
            Unit::OfUsual | Unit::Amount => None,
        }
    }

    /// An average on its own, such as `2.8 a day on average`.
    pub(crate) fn on_average(&self, value: f64) -> Option<String> {
        let said = match self.kind() {
            Unit::Times => format!("{} a {}", count(value), self.occasion),
            _ => self.said(value)?,
        };
        Some(format!("{said} on average"))
    }

    /// A value without its unit, after another that has it.
    fn short(&self, value: f64) -> Option<String> {
        match self.kind() {
            Unit::Hours => Some(format!("{value:.1}")),
            Unit::Clock => Some(clock_of_hours(value)),
            Unit::Times => Some(count(value)),
            Unit::MetresASecond => Some(format!("{value:.2}")),
            Unit::OfUsual | Unit::Amount => None,
        }
    }

    /// The word between a value and a lower one, or a higher.
    fn comparative(&self, is_more: bool) -> &'static str {
        match (self.kind(), is_more) {
            (Unit::Clock, true) => "later",
            (Unit::Clock, false) => "earlier",
            (Unit::Times, true) => "more often",
            (Unit::Times, false) => "less often",
            (Unit::Hours, true) => "longer",
            (Unit::Hours, false) => "less",
            (Unit::OfUsual | Unit::MetresASecond, true) => "faster",
            (Unit::OfUsual | Unit::MetresASecond, false) => "more slowly",
            (Unit::Amount, true) => "higher",
            (Unit::Amount, false) => "lower",
        }
    }
}

/// The days, or nights, of a sentence.
fn on(quantifier: Quantifier, occasion: &str, days: usize) -> String {
    let many = match quantifier {
        Quantifier::Every => "every",
        Quantifier::AlmostAlways => "nearly all",
        Quantifier::Most => "most",
        Quantifier::Often => "many",
        Quantifier::AboutHalf => "about half of the",
        Quantifier::Sometimes => "some",
        Quantifier::Rarely => "few",
        Quantifier::AlmostNever => "hardly any",
    };
    let plural = if quantifier == Quantifier::Every { "" } else { "s" };
    let span = if days == 14 { "two weeks".to_owned() } else { format!("{days} days") };
    format!("on {many} {occasion}{plural} of the last {span}")
}

/// A headline and the values behind it, if it has any.
pub(crate) fn joined(headline: String, numbers: &str) -> String {
    if numbers.is_empty() { headline } else { format!("{headline}: {numbers}") }
}

/// Things in a row: `sleep, kitchen meals and getting up`.
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

fn hours(hours: f64) -> String {
    if (hours - 1.0).abs() < 0.05 { "1 hour".to_owned() } else { format!("{hours:.1} hours") }
}

fn often(times: f64) -> String {
    match times {
        0.0 => "none".to_owned(),
        1.0 => "once".to_owned(),
        2.0 => "twice".to_owned(),
        times => format!("{} times", count(times)),
    }
}

fn count(value: f64) -> String {
    let decimals = usize::from(value < LARGE_COUNT && value.fract() != 0.0);
    format!("{value:.decimals$}")
}

fn number(count: usize) -> String {
    const WORDS: [&str; 8] = ["two", "three", "four", "five", "six", "seven", "eight", "nine"];
    count.checked_sub(2).and_then(|place| WORDS.get(place)).map_or_else(|| count.to_string(), ToString::to_string)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alerts::{Rules, USUAL};
    use crate::measures::MEASURES;

    fn alert(name: &str, method: Method, values: (f64, f64), days: i8) -> String {
        let days: Vec<Date> = (1..=days).map(|day| jiff::civil::date(2024, 1, day)).collect();
        let (headline, numbers) = Measure::named(name).unwrap().alert(method, values, &days);
        format!("{headline}: {numbers}")
    }

    #[test]
    fn an_alert_has_its_values_and_the_usual_ones() {
        for (name, method, values, days, words) in [
            (
                "meals",
                Method::Ewma,
                (2.8, 3.6),
                1,
                "Fewer kitchen meals, building up over several days: 2.8 a day on average, usually 3.6",
            ),
            (
                "rising",
                Method::Deviation,
                (9.0, 7.25),
                3,
                "Getting up later than usual, three days in a row: at 09:00, usually 07:15",
            ),
            (
                "density_morning",
                Method::Ewma,
                (276.0, 451.0),
                1,
                "Less movement in the morning, building up over several days: 39 % lower than usual",
            ),
            (
                "sleep",
                Method::Deviation,
                (6.0, 7.25),
                2,
                "Less sleep than usual, two nights in a row: 6.0 hours, usually 7.2",
            ),
            (
                "bathroom_night",
                Method::Deviation,
                (6.0, 1.5),
                1,
                "More bathroom visits at night than usual: 6 times, usually 1.5",
            ),
            (
                "pace",
                Method::Cusum,
                (0.88, 1.0),
                4,
                "Walking more slowly since 1 January 2024: 12 % more slowly than usual",
            ),
        ] {
            assert_eq!(alert(name, method, values, days), words);
        }
    }

    #[test]
    fn no_rule_is_worded_with_terms_of_sensors_or_statistics() {
        let rules = Rules::read(USUAL).unwrap();
        for (rule, values) in rules.rules.iter().flat_map(|rule| [(rule, (1.0, 2.0)), (rule, (2.0, 1.0))]) {
            let (_, measure) = rule.measure().unwrap();
            let words = alert(measure.name, rule.method, values, 1);
            for jargon in ["ensity", "firing", "sensor", "average of", "_", "bouts", "sd"] {
                assert!(!words.contains(jargon), "{words}");
            }
        }
    }

    #[test]
    fn days_are_worded_by_their_unit() {
        let day = |name: &str, value, usual| Measure::named(name).unwrap().day(value, usual);
        assert_eq!(day("time_out", 0.0, None), "Did not go out");
        assert_eq!(
            day("meals", 1.0, Some((2.8, Some(false)))),
            "Had a meal in the kitchen once, less often than usual (2.8)"
        );
        assert_eq!(day("rising", 9.0, Some((7.25, Some(true)))), "Got up at 09:00, later than usual (07:15)");
        assert_eq!(day("pace", 0.8, None), "Walked 20 % more slowly than on most days");
        assert_eq!(day("pace", 0.8, Some((1.0, None))), "Walked at the usual pace");
    }

    #[test]
    fn every_measure_has_words_for_more_and_less() {
        for measure in MEASURES {
            assert!(!measure.more.is_empty() && measure.more != measure.less, "{}", measure.name);
            assert_eq!(measure.did.is_empty(), !measure.did.contains("{}"), "{}", measure.name);
        }
        assert_eq!(listed(&["sleep", "kitchen meals", "getting up"]), "sleep, kitchen meals and getting up");
    }
}
