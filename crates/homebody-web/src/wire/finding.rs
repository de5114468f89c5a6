//! What is looked for over a whole stored run.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// What is asked.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Find {
    pub what: FindWhat,
    /// Which room, sensor or activity; of lost messages a sensor, of alerts and falls that cameras see a rule, or null for all.
    pub name: Option<String>,
    /// Between which minutes of the day, over midnight where the first is later; null at any time.
    pub between_min: Option<(u32, u32)>,
    /// For how many seconds at least.
    pub least_s: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum FindWhat {
    /// Somebody is in a room.
    Room,
    /// A sensor has said that something goes on, and not yet that it ends.
    On,
    /// No sensor says anything but readings, while somebody is at home.
    Still,
    /// Somebody does something.
    Doing,
    Fall,
    /// Cameras take something for a fall.
    SeenFall,
    /// A message never reached the logger.
    Lost,
    Alert,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FoundView {
    /// In the order of time; of too many the first.
    pub hits: Vec<HitView>,
    /// How many there are.
    #[ts(type = "number")]
    pub all: u64,
    /// How it was looked for, where that is not what one would think.
    pub remarks: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct HitView {
    #[ts(type = "number")]
    pub begin_us: i64,
    #[ts(type = "number")]
    pub end_us: i64,
    /// Whether the truth tells of it as a fall.
    pub is_fall: bool,
    /// Whose it was, and what, as far as it is known.
    pub words: String,
}
