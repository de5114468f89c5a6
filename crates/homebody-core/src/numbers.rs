//! The numbers that the models are made of, each with its unit and its range, and what a scenario sets otherwise.
//!
//! A number stands in the module that uses it, declared by [`numbers!`](crate::numbers!), which lists it, too. It is asked
//! for as `numbers.of(&SLOWEST)`: that is its own value, unless the scenario says otherwise. Whoever does something often
//! asks once, when it is made.

use crate::scenario::nearest::nearest;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A number of a model that a scenario may set otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// What scenarios call it, such as `gait.slowest`.
    pub name: Cow<'static, str>,
    /// Such as `m/s`; `1` for shares, factors and counts.
    pub unit: &'static str,
    /// What it is where nothing else is set.
    pub value: f64,
    /// It can be set to this and to what lies between it and `most`.
    pub least: f64,
    /// The largest value that it can be set to, in its unit.
    pub most: f64,
    /// What it means, in a sentence.
    pub what: Cow<'static, str>,
    /// The source file that it stands in.
    pub file: &'static str,
}

/// Declares the numbers of a module, and lists them as its `NUMBERS`. What a number means is its doc comment.
///
/// ```
/// homebody_core::numbers! {
///     /// Nobody walks slower.
///     static SLOWEST = "gait.slowest": 0.2, "m/s", [0.05, 0.6];
/// }
/// assert_eq!(NUMBERS, [&SLOWEST]);
/// assert_eq!(homebody_core::numbers::Numbers::default().of(&SLOWEST), 0.2);
/// ```
#[macro_export]
macro_rules! numbers {
    ($($(#[doc = $what:literal])+ $vis:vis static $id:ident = $name:literal: $value:expr, $unit:literal, $range:expr;)+) => {
        $(
            $(#[doc = $what])+
            $vis static $id: $crate::numbers::Number =
                $crate::numbers::Number::new($name, $value, $unit, $range, concat!($($what),+), file!());
        )+

        /// The numbers of this module.
        pub(crate) static NUMBERS: &[&$crate::numbers::Number] = &[$(&$id),+];
    };
}

impl Number {
    /// As [`numbers!`](crate::numbers!) declares it; `range` is the least and the most that it can be set to.
    pub const fn new(
        name: &'static str,
        value: f64,
        unit: &'static str,
        range: [f64; 2],
        what: &'static str,
        file: &'static str,
    ) -> Number {
        let [least, most] = range;
        Number { name: Cow::Borrowed(name), unit, value, least, most, what: Cow::Borrowed(what), file }
    }

    /// A number of a table: a column of one of its rows. Its name is `table.row.column`.
    pub fn of_table(
        [table, row, column]: [&str; 3],
        value: f64,
        unit: &'static str,
        [least, most]: [f64; 2],
        what: String,
        file: &'static str,
    ) -> Number {
        Number { name: name_in(table, row, column).into(), unit, value, least, most, what: what.into(), file }
    }

    /// What it means, as one line.
    pub fn meaning(&self) -> String {
        self.what.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// The crate that it is of, and the file below the crate's `src`.
    pub fn place(&self) -> (&'static str, &'static str) {
        let below = self.file.rsplit_once("crates/").map_or(self.file, |(_, below)| below);
        below.split_once("/src/").unwrap_or(("", below))
    }
}

fn name_in(table: &str, row: &str, column: &str) -> String {
    format!("{table}.{row}.{column}")
}

/// What a scenario sets otherwise: mostly nothing. A clone is cheap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Numbers {
    /// By name; `None`: every number has its own value.
    set: Option<Arc<BTreeMap<String, f64>>>,
}

impl Numbers {
    /// These set, all others as they are.
    pub fn new(set: &BTreeMap<String, f64>) -> Numbers {
        Numbers { set: (!set.is_empty()).then(|| Arc::new(set.clone())) }
    }

    /// Whether anything is set.
    pub fn are_set(&self) -> bool {
        self.set.is_some()
    }

    /// What is set for a number, or else its own value.
    pub fn of(&self, number: &Number) -> f64 {
        let set = self.set.as_ref().and_then(|set| set.get(&*number.name));
        set.copied().unwrap_or(number.value)
    }

    /// What is set for a number of a table, or else `value`, which is its own.
    pub fn of_table(&self, [table, row, column]: [&str; 3], value: f64) -> f64 {
        let set = self.set.as_ref().and_then(|set| set.get(&name_in(table, row, column)));
        set.copied().unwrap_or(value)
    }
}

/// What is wrong with setting a number, if anything is, and what to do about it.
pub fn wrong(known: &[Number], name: &str, value: f64) -> Option<(String, String)> {
    let Some(number) = known.iter().find(|number| number.name == name) else {
        let hint = match nearest(name, known.iter().map(|number| &*number.name)) {
            Some(near) => format!("did you mean {near:?}?"),
            None => "`homebody parameters` lists those that can be set".to_owned(),
        };
        return Some((format!("there is no number {name:?}"), hint));
    };
    let Number { unit, least, most, .. } = *number;
    let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
    let what = match value {
        _ if value.is_nan() => format!("{name:?} is set to what is no number"),
        _ if value < least => format!("{name:?} is {value}{unit}, and must be at least {least}"),
        _ if value > most => format!("{name:?} is {value}{unit}, and must be at most {most}"),
        _ => return None,
    };
    Some((what, format!("its own value is {}; set it from {least} to {most}", number.value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    numbers! {
        /// Nobody walks
        /// slower.
        static SLOWEST = "gait.slowest": 0.2, "m/s", [0.05, 0.6];
        /// So many of all.
        static SHARE = "gait.share": 0.5, "1", [0.0, 1.0];
    }

    fn known() -> Vec<Number> {
        NUMBERS.iter().map(|number| (*number).clone()).collect()
    }

    #[test]
    fn what_is_set_counts_and_all_else_is_as_it_is() {
        let set = BTreeMap::from([("gait.share".to_owned(), 0.25), ("stay.reading.gap".to_owned(), 7.0)]);
        let numbers = Numbers::new(&set);
        assert_eq!([&SLOWEST, &SHARE].map(|number| numbers.of(number)), [0.2, 0.25]);
        assert_eq!([&SLOWEST, &SHARE].map(|number| Numbers::default().of(number)), [0.2, 0.5]);
        let reading = |numbers: &Numbers| numbers.of_table(["stay", "reading", "gap"], 150.0);
        assert_eq!([reading(&numbers), reading(&Numbers::default())], [7.0, 150.0]);
    }

    #[test]
    fn a_number_knows_what_it_means_and_where_it_stands() {
        assert_eq!(SLOWEST.meaning(), "Nobody walks slower.");
        assert_eq!(SLOWEST.place(), ("homebody-core", "numbers.rs"));
    }

    #[test]
    fn what_cannot_be_set_is_refused_with_what_can() {
        let wrong = |name, value| wrong(&known(), name, value);
        assert_eq!(wrong("gait.slowest", 0.6), None);
        let (what, hint) = wrong("gait.slowst", 0.1).unwrap();
        assert_eq!(
            (what.as_str(), hint.as_str()),
            ("there is no number \"gait.slowst\"", "did you mean \"gait.slowest\"?")
        );
        assert!(wrong("weather", 1.0).unwrap().1.contains("homebody parameters"));
        let (what, hint) = wrong("gait.slowest", 0.7).unwrap();
        assert_eq!(what, "\"gait.slowest\" is 0.7 m/s, and must be at most 0.6");
        assert_eq!(hint, "its own value is 0.2; set it from 0.05 to 0.6");
        assert!(wrong("gait.share", -0.1).unwrap().0.ends_with("is -0.1, and must be at least 0"));
        assert!(wrong("gait.share", f64::NAN).is_some());
    }
}
