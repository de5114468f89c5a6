//! Live input from a file: which keys are held, and when that changes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A file of key states over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "live input")]
pub struct InputFile {
    /// Where the JSON Schema of this file is, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Every change of the held keys, in order of time.
    pub keys: Vec<KeysFile>,
}

/// From `at_s` on, exactly these keys are held.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "change of keys")]
pub struct KeysFile {
    /// Seconds since the scenario's start.
    #[schemars(range(min = 0, max = 3_200_000_000_i64))]
    pub at_s: f64,
    /// The keys that are held down from then on.
    pub held: Vec<Key>,
}

/// A key that drives the body. North is up on the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "key")]
pub enum Key {
    Up,
    Down,
    Left,
    Right,
    /// Walk faster: twice the pace.
    Fast,
    /// Walk slower: half the pace.
    Slow,
}
