//! The options of a run, each declared once. The command line, the page and Python take names, explanations and ranges from here, and
//! [`RunOptions::plan`] turns options into a run for all of them.
//!
//! A new option is a field here, and its effect in [`RunOptions::plan`]. Its `title` is its label in the form of the page, which does
//! not offer an option without one. `expected` describes the values in errors. The page checks `pattern`.

use crate::run_length::RunLength;
use crate::run_start::RunStart;
use schemars::{JsonSchema, Schema, schema_for};
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;

/// The options of all that simulates a scenario: `homebody run`, `live`, `fleet` and `routine day`, the page, and Python.
///
/// In JSON, an option that is missing or null is as the scenario says.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct VariantOptions {
    /// Seed of all random numbers (default: that of the scenario)
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    #[cfg_attr(feature = "wire", ts(type = "number | null"))]
    #[schemars(title = "Seed", extend("maximum" = u64::MAX))]
    pub seed: Option<u64>,
    /// Leave out a condition of the routine; repeatable
    ///
    /// Homebody uses the same random numbers with and without the condition, except where the condition has an effect.
    #[cfg_attr(feature = "clap", arg(long, value_name = "CONDITION"))]
    // The page offers the conditions of the run on display.
    #[schemars(extend("expected" = "a list of conditions"))]
    pub without: Vec<String>,
}

/// The options of a run that ends: `homebody run`, its cohorts, the page, and Python.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct RunOptions {
    /// Duration of the run: 90s, 15m, 2h, 7d or 52w (default: that of the scenario)
    ///
    /// Days and weeks follow the calendar: a run of 7d ends at the hour at which it started, even if clocks change in between.
    #[cfg_attr(feature = "clap", arg(long = "for", value_name = "DURATION"))]
    #[cfg_attr(feature = "wire", ts(type = "number | null"))]
    #[serde(rename = "days")]
    #[schemars(
        with = "Option<f64>",
        title = "Length in days",
        description = "Duration of the run in days (default: that of the scenario)",
        extend("exclusiveMinimum" = 0, "maximum" = 36_525, "expected" = "more than 0 and at most 36,525 (a hundred years)")
    )]
    pub length: Option<RunLength>,
    /// Start of the run in the home's local time: now, today, 2026-11-01 or 2026-11-01T08:00 (default: the start in the scenario)
    #[cfg_attr(feature = "clap", arg(long, value_name = "TIME"))]
    #[cfg_attr(feature = "wire", ts(type = "string | null"))]
    #[schemars(
        with = "Option<String>",
        title = "Start",
        extend(
            "pattern" = r"^(now|today|\d{4}-\d\d-\d\d([T ]\d\d:\d\d(:\d\d)?)?)$",
            "expected" = "now, today, a date, or a date and time, such as '2009-03-02T00:00:00'"
        )
    )]
    pub start: Option<RunStart>,
    /// The options that runs without an end have, too.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[serde(flatten)]
    pub variant: VariantOptions,
    /// Set a parameter of the models; repeatable
    ///
    /// `homebody parameters` lists all parameters with units and ranges. The recording stores the values.
    #[cfg_attr(feature = "clap", arg(long = "set", value_name = "NAME=VALUE", value_parser = parameter))]
    #[cfg_attr(feature = "wire", ts(type = "Record<string, number>"))]
    #[serde(deserialize_with = "parameters")]
    #[schemars(
        with = "BTreeMap<String, f64>",
        title = "Parameters",
        description = "Parameters of the models by name, such as gait.slowest=0.25; the command homebody parameters lists all",
        extend("expected" = "a mapping of parameters of the models, such as {'life.day_spread': 0.3}")
    )]
    pub numbers: Vec<(String, f64)>,
    /// Let the residents differ from their routines as people differ, each seed in its own way
    // The command has cohorts instead.
    #[cfg_attr(feature = "clap", arg(skip))]
    #[schemars(title = "Residents differ from their routines")]
    pub one_of_many: bool,
}

impl RunOptions {
    /// The JSON Schema of the options, with a name, an explanation, a type and a range for each. `expected` describes the values of an
    /// option in a sentence.
    pub fn schema() -> Schema {
        schema_for!(RunOptions)
    }
}

impl From<VariantOptions> for RunOptions {
    fn from(variant: VariantOptions) -> RunOptions {
        RunOptions { variant, ..RunOptions::default() }
    }
}

fn parameters<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<(String, f64)>, D::Error> {
    Ok(BTreeMap::deserialize(from)?.into_iter().collect())
}

/// The name and the value of a parameter.
#[cfg(feature = "clap")]
fn parameter(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE, such as gait.slowest=0.25")?;
    let number: f64 = value.trim().parse().map_err(|_| format!("{value:?} is not a number"))?;
    if number.is_finite() { Ok((name.trim().to_owned(), number)) } else { Err(format!("{value:?} is not a number")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn reads_options_from_json_and_refuses_unknown_ones() {
        let read = |options| serde_json::from_value::<RunOptions>(options);
        let options = json!({ "days": 2, "seed": u64::MAX, "without": ["flu"], "numbers": { "b": 2.0, "a": 1 }, "start": "today" });
        let variant = VariantOptions { seed: Some(u64::MAX), without: vec!["flu".into()] };
        let (length, start) = (Some(RunLength::Days(2.0)), Some(RunStart::Today));
        let numbers = vec![("a".into(), 1.0), ("b".into(), 2.0)];
        assert_eq!(read(options).unwrap(), RunOptions { length, start, variant, numbers, one_of_many: false });
        assert_eq!(read(json!({ "seed": null, "days": null })).unwrap(), RunOptions::default());
        assert!(read(json!({ "sed": 1 })).is_err() && read(json!({ "seed": -1 })).is_err());
    }

    #[test]
    fn the_schema_explains_each_option() {
        let schema = RunOptions::schema().to_value();
        let options = schema["properties"].as_object().unwrap();
        for (name, option) in options {
            assert!(option["description"].as_str().is_some_and(|text| !text.is_empty()), "{name}: {option}");
        }
        assert!(options.contains_key("days") && options.contains_key("seed") && !options.contains_key("variant"));
        assert_eq!((&options["days"]["maximum"], &options["seed"]["minimum"]), (&json!(36_525), &json!(0)));
    }
}
