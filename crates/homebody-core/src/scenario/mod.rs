//! The scenario as its author wrote it: the JSON files of a scenario folder, as plain data.
//!
//! `scenario.json` links the home, the link, the logger and the residents; a resident links a driver.
//! Reading order: this file, [`home`], [`resident`], [`path`], [`input`], [`link`], [`logger`], then how the
//! text becomes data ([`load`]): places in the text ([`source`]), the right shape (`shape`, by the
//! [`schema`]), the right meaning (`check`), and what is right but hardly
//! meant ([`remarks`]). What code makes or changes of it is in [`edit`].

pub mod calendar;
pub(crate) mod check;
pub mod device;
pub mod edit;
pub mod home;
pub mod input;
pub mod inside;
pub(crate) mod json;
pub mod link;
pub mod load;
pub mod logger;
pub mod nearest;
pub mod notice;
pub mod path;
pub mod preset;
pub mod remarks;
pub mod resident;
pub mod schema;
pub mod scheme;
pub(crate) mod shape;
pub mod source;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `scenario.json`: what to run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "scenario")]
pub struct ScenarioFile {
    /// Where the JSON Schema of this file is, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// What people call this scenario.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// What it shows, in a sentence or two.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    #[schemars(extend("default" = ""))]
    pub about: String,
    /// Local date and time at which the run begins, such as `2009-03-02T00:00:00`.
    pub start: String,
    /// IANA time zone of the home, such as `America/Chicago`.
    #[serde(default = "utc")]
    pub time_zone: String,
    /// How many days a run lasts unless `--for` says otherwise.
    #[schemars(range(min = 0.00001, max = 36_525))]
    pub days: f64,
    /// The number all randomness of the run comes from; at most what every JSON reader keeps exactly.
    #[serde(default)]
    #[schemars(range(max = GREATEST_SEED))]
    pub seed: u64,
    /// The file that describes the home.
    pub home: String,
    /// The file that says how messages come to the logger and what goes wrong; without it, all of them do, at once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// The file that says where the log goes and how it looks; without it, the defaults apply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub logger: Option<String>,
    /// The files that describe who lives there.
    #[schemars(length(max = 1_000))]
    pub residents: Vec<String>,
    /// Numbers of the models that are otherwise in this scenario, by name: `homebody numbers` lists them, with units and
    /// ranges.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    #[schemars(extend("default" = serde_json::json!({}), "maxProperties" = 1_000))]
    pub numbers: BTreeMap<String, f64>,
}

impl ScenarioFile {
    /// A scenario of nobody in a home in `home.json`, in UTC: `start` is such as `2009-03-02T00:00:00`.
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

/// Whole numbers up to this are kept exactly by every JSON reader.
pub const GREATEST_SEED: u64 = 9_007_199_254_740_991;

fn utc() -> String {
    "UTC".into()
}
