//! Searches in a stored run.

use homebody_query::search::SearchSubject;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A search.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Find {
    pub what: SearchSubject,
    /// The room, sensor or activity; for lost messages the sensor, for alerts and falls that cameras see the rule; null for all.
    pub name: Option<String>,
    /// Minutes of the day, over midnight if the first is later; null for any time.
    pub between_min: Option<(u32, u32)>,
    /// The shortest duration, in seconds.
    pub least_s: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FoundView {
    /// The first in the order of time.
    pub hits: Vec<HitView>,
    /// The total.
    #[ts(type = "number")]
    pub all: u64,
    /// Unusual conditions of the search.
    pub remarks: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct HitView {
    #[ts(type = "number")]
    pub begin_us: i64,
    #[ts(type = "number")]
    pub end_us: i64,
    /// True for a fall of the ground truth.
    pub is_fall: bool,
    /// The person and the match, if known.
    pub words: String,
}
