//! Live input from a file: which keys are held, how the body is, which things are used, and when that changes.

use super::path::Posture;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A file of what somebody did at the keys over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "live input")]
pub struct InputFile {
    /// Where the JSON Schema of this file is, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Every change, in order of time.
    #[schemars(length(max = 200_000))]
    pub keys: Vec<KeysFile>,
}

/// From `at_s` on, exactly these keys are held, and the body is so: what a change does not repeat is over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "change of keys")]
pub struct KeysFile {
    /// Seconds since the scenario's start.
    #[schemars(range(min = 0, max = 3_200_000_000_i64))]
    pub at_s: f64,
    /// The keys that are held down from then on.
    #[schemars(length(max = 6))]
    pub held: Vec<Key>,
    /// How the body is from then on; without it, it stands, whatever it was before. Who sits or lies does not walk.
    #[serde(default, skip_serializing_if = "is_standing")]
    #[schemars(extend("default" = "standing"))]
    pub posture: Posture,
    /// The things that are used then.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 100), extend("default" = []))]
    pub uses: Vec<UseFile>,
}

fn is_standing(posture: &Posture) -> bool {
    *posture == Posture::Standing
}

/// A thing that is turned on or opened, or turned off or closed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "use of a thing")]
pub struct UseFile {
    /// A door, a piece of furniture, or a room, whose lamp is meant.
    pub thing: String,
    /// How the thing is afterwards: on or open (`true`), or off or closed.
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
    /// Walk faster: twice the pace.
    Fast,
    /// Walk slower: half the pace.
    Slow,
}
