//! The scenario as its author wrote it: the JSON files of a scenario folder, as plain data.
//!
//! `scenario.json` links the home, the link, the logger and the residents; a resident links a driver. Except for this
//! file and [`logger`], the forms of files are in the modules of the things that they describe. Reading order: from
//! text to data ([`load`]), places in the text ([`source`]), the shape (`shape`, by the [`schema`]), the meaning
//! (`check`), and remarks on valid files ([`remarks`]). Code makes and changes scenarios by [`edit`].

pub(crate) mod check;
pub mod edit;
pub mod inside;
pub(crate) mod json;
pub mod load;
pub mod logger;
pub mod remarks;
pub mod schema;
pub mod scheme;
pub mod shape;
pub mod source;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `scenario.json`: the run, its home and its residents.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "scenario")]
pub struct ScenarioFile {
    /// Path or URL of this file's JSON Schema, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Name of the scenario.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Purpose of the scenario, in a sentence or two.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    #[schemars(extend("default" = ""))]
    pub about: String,
    /// Local date and time of the start, such as `2009-03-02T00:00:00`.
    pub start: String,
    /// IANA time zone of the home, such as `America/Chicago`.
    #[serde(default = "utc")]
    pub time_zone: String,
    /// Length of a run, unless `--for` gives another.
    #[schemars(range(min = 0.00001, max = 36_525))]
    pub days: f64,
    /// Seed of all random numbers of the run, up to the largest whole number that every JSON reader keeps exactly.
    #[serde(default)]
    #[schemars(range(max = GREATEST_SEED))]
    pub seed: u64,
    /// File that describes the home.
    pub home: String,
    /// File that describes how messages reach the logger and which faults occur. Without it, every message arrives at
    /// once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// File that sets where the log goes and its format. Without it, the defaults apply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub logger: Option<String>,
    /// Files that describe the residents, one each.
    #[schemars(length(max = 1_000))]
    pub residents: Vec<String>,
    /// Parameters of the models with other values in this scenario, by key. `homebody parameters` lists all, with units
    /// and ranges.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    #[schemars(extend("default" = serde_json::json!({}), "maxProperties" = 1_000))]
    pub numbers: BTreeMap<String, f64>,
}

impl ScenarioFile {
    /// A scenario without residents in a home in `home.json`, in UTC: `start` is such as `2009-03-02T00:00:00`.
    pub fn new(name: &str, start: &str, days: f64) -> ScenarioFile {
        ScenarioFile {
            schema: None,
            name: name.into(),
            about: String::new(),
            start: start.into(),
            time_zone: utc(),
            days,
            seed: 0,
            home: "home.json".into(),
            link: None,
            logger: None,
            residents: Vec::new(),
            numbers: BTreeMap::new(),
        }
    }
}

/// Largest whole number that every JSON reader keeps exactly.
pub const GREATEST_SEED: u64 = 9_007_199_254_740_991;

fn utc() -> String {
    "UTC".into()
}
