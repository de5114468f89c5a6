//! Live input from a file: which keys are held, how the body is, which things are used, and when that changes.

use super::path::Posture;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A file of the keys held over time to drive a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "live input")]
pub struct InputFile {
    /// Path or URL of this file's JSON Schema, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Changes of the keys, in order of time.
    #[schemars(length(max = 200_000))]
    pub keys: Vec<KeysFile>,
}

/// The keys and the posture from `at_s` on. Each change replaces all of the one before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "change of keys")]
pub struct KeysFile {
    /// Time of the change, since the scenario's start.
    #[schemars(range(min = 0, max = 3_200_000_000_i64))]
    pub at_s: f64,
    /// Keys that are held down from then on.
    #[schemars(length(max = 6))]
    pub held: Vec<Key>,
    /// Posture from then on. Without it, the body stands. A body that sits or lies does not walk.
    #[serde(default, skip_serializing_if = "is_standing")]
    #[schemars(extend("default" = "standing"))]
    pub posture: Posture,
    /// Things that are used at that instant.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 100), extend("default" = []))]
    pub uses: Vec<UseFile>,
}

fn is_standing(posture: &Posture) -> bool {
    *posture == Posture::Standing
}

/// A use of a thing: turned on or opened, or turned off or closed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "use of a thing")]
pub struct UseFile {
    /// Name of a door, of a piece of furniture, or of a room, which stands for its lamp.
    pub thing: String,
    /// State of the thing afterwards: on or open (`true`), off or closed (`false`).
    pub on: bool,
}

/// A key that drives the body. North is up on the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "key")]
pub enum Key {
    /// Walk north.
    Up,
    /// Walk south.
    Down,
    /// Walk west.
    Left,
    /// Walk east.
    Right,
    /// Walk faster, at twice the pace.
    Fast,
    /// Walk slower, at half the pace.
    Slow,
}
