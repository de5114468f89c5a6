//! The numbers that the models are made of, each with its unit and its range, and what a scenario sets otherwise.
//!
//! A number is declared by [`numbers!`](crate::numbers!) in the module that uses it. `numbers.of(&SLOWEST)` is its
//! default, unless the scenario sets it. Code that runs often asks once, on construction.

use crate::nearest::nearest;
use crate::problem::Advice;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

crate::messages! {
    /// Problems with parameters of models that a scenario sets.
    pub enum ParameterMessage in "parameter" {
        /// The models have no parameter with this name. A name has an area and a word, such as `gait.slowest`.
        Unknown { name: String, nearest: Option<String> } error "unknown" ("there is no parameter {name:?}")
            advice (Some(match nearest {
                Some(near) => Advice::meant(near),
                None => "list the parameters with: homebody parameters".into(),
            }));
        /// A parameter is a finite number.
        NotANumber {
            name: String,
            /// The value that the model has without a setting.
            usual: f64,
            least: f64,
            most: f64,
        } error "not-a-number" ("{name:?} is set to a value that is not a number")
            hint ("give a value from {least} to {most}; the usual value is {usual}");
        /// The models give sensible results for a range of values only. `homebody parameters NAME` explains the parameter and its range.
        OutOfRange {
            name: String,
            value: f64,
            /// The unit, such as `m/s`; `1` for shares, factors and counts.
            unit: &'static str,
            /// The value that the model has without a setting.
            usual: f64,
            least: f64,
            most: f64,
        } error "out-of-range" ("{name:?} must be from {least} to {most}, but is {value}{of_unit}", of_unit = shown(unit))
            hint ("give a value from {least} to {most}; the usual value is {usual}");
    }
}

fn shown(unit: &str) -> String {
    if unit == "1" { String::new() } else { format!(" {unit}") }
}

/// A number of a model that a scenario may set otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// The name in scenarios, such as `gait.slowest`.
    pub name: Cow<'static, str>,
    /// Such as `m/s`; `1` for shares, factors and counts.
    pub unit: &'static str,
    /// The default.
    pub value: f64,
    /// It can be set to this and to what lies between it and `most`.
    pub least: f64,
    /// The largest value that it can be set to, in its unit.
    pub most: f64,
    /// The meaning, in a sentence.
    pub what: Cow<'static, str>,
    /// The source file that it stands in.
    pub file: &'static str,
}

/// Declares the numbers of a module, and lists them as its `NUMBERS`. The doc comment of a number is its meaning.
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

    /// The meaning on one line.
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

/// The numbers that a scenario sets, mostly none. A clone is cheap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Numbers {
    /// By name; `None`: every number has its own value.
    set: Option<Arc<BTreeMap<String, f64>>>,
}

impl Numbers {
    /// These numbers; all others have their defaults.
    pub fn new(set: &BTreeMap<String, f64>) -> Numbers {
        Numbers { set: (!set.is_empty()).then(|| Arc::new(set.clone())) }
    }

    /// Whether anything is set.
    pub fn are_set(&self) -> bool {
        self.set.is_some()
    }

    /// The value of a number: as set, or the default.
    pub fn of(&self, number: &Number) -> f64 {
        let set = self.set.as_ref().and_then(|set| set.get(&*number.name));
        set.copied().unwrap_or(number.value)
    }

    /// The value of a number of a table: as set, or the default `value`.
    pub fn of_table(&self, [table, row, column]: [&str; 3], value: f64) -> f64 {
        let set = self.set.as_ref().and_then(|set| set.get(&name_in(table, row, column)));
        set.copied().unwrap_or(value)
    }
}

/// The problem with setting a number to a value; `None` for a valid setting.
pub fn wrong(known: &[Number], name: &str, value: f64) -> Option<ParameterMessage> {
    let Some(number) = known.iter().find(|number| number.name == name) else {
        let nearest = nearest(name, known.iter().map(|number| &*number.name)).map(str::to_owned);
        return Some(ParameterMessage::Unknown { name: name.to_owned(), nearest });
    };
    let Number { value: usual, unit, least, most, .. } = *number;
    let name = name.to_owned();
    if value.is_nan() {
        return Some(ParameterMessage::NotANumber { name, usual, least, most });
    }
    let is_within = (least..=most).contains(&value);
    (!is_within).then_some(ParameterMessage::OutOfRange { name, value, unit, usual, least, most })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Diagnose;

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
    fn set_numbers_count_and_others_have_their_defaults() {
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
    fn refuses_unknown_parameters_and_values_out_of_range() {
        let wrong = |name, value| wrong(&known(), name, value).map(|message| message.diagnostic());
        assert_eq!(wrong("gait.slowest", 0.6), None);
        let unknown = wrong("gait.slowst", 0.1).unwrap();
        assert_eq!((unknown.code, &unknown.data["nearest"]), ("parameter::unknown", &"gait.slowest".into()));
        assert!(wrong("weather", 1.0).unwrap().hint.unwrap().contains("homebody parameters"));
        let large = wrong("gait.slowest", 0.7).unwrap();
        assert_eq!((large.code, &large.data["most"]), ("parameter::out-of-range", &0.6.into()));
        assert!(large.what.ends_with("0.7 m/s"), "{}", large.what);
        assert_eq!(wrong("gait.share", -0.1).unwrap().code, "parameter::out-of-range");
        assert_eq!(wrong("gait.share", f64::NAN).unwrap().code, "parameter::not-a-number");
    }
}
