//! What measures come to: plain data.

use super::kinds::{MEASURES, Measure};
use jiff::civil::Date;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// The measures of all days of a log.
#[derive(Clone, Debug, Serialize)]
pub struct Measures {
    /// What the log is called.
    pub name: String,
    /// What is measured, in the order of the values.
    pub measures: &'static [Measure],
    /// What it cannot tell, or only roughly, in sentences.
    pub remarks: Vec<String>,
    /// The names of measures that are guessed, as no sensor tells of them: see the remarks.
    pub guesses: Vec<&'static str>,
    /// Sensors that fell silent: what needs them has no value meanwhile.
    pub silent: Vec<Silent>,
    /// Day by day.
    pub days: Vec<Day>,
}

/// What the measures come to on a day.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Day {
    /// Which day it is.
    pub date: Date,
    /// Whether less than an hour of it is unknown.
    pub is_whole: bool,
    /// By measure; those that are not known have none.
    #[serde(serialize_with = "by_name")]
    pub values: Vec<Option<f64>>,
}

impl Day {
    /// What a measure comes to.
    pub fn value(&self, name: &str) -> Option<f64> {
        *self.values.get(MEASURES.iter().position(|measure| measure.name == name)?)?
    }
}

fn by_name<S: Serializer>(values: &[Option<f64>], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(None)?;
    for (measure, value) in MEASURES.iter().zip(values) {
        if let Some(value) = value {
            map.serialize_entry(measure.name, value)?;
        }
    }
    map.end()
}

/// A sensor that has fallen silent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Silent {
    /// Its id in the log.
    pub sensor: String,
    /// The day of its last word.
    pub since: Date,
    /// The day on which that can be said.
    pub told: Date,
}
