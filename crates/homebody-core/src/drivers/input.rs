//! The input of a user at the keys.

use crate::event::ThingUse;
use crate::geometry::Point;
use crate::ids::ThingId;
use crate::plan::Plan;
use crate::posture::Posture;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The input of a user at the keys from an instant on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input {
    /// The keys that are held down from then on.
    pub held: HeldKeys,
    /// The posture from then on. A body that sits or lies does not walk.
    pub posture: Posture,
    /// The things that are used at that instant.
    pub uses: Vec<ThingUse>,
}

impl Input {
    /// The input that a line of a file describes, which has passed its checks.
    pub fn written(line: &KeysFile, plan: &Plan) -> Input {
        let act = |used: &UseFile| Some(ThingUse { thing: ThingId::new(plan.thing(&used.thing)?), on: used.on });
        Input {
            held: line.held.iter().copied().collect(),
            posture: line.posture,
            uses: line.uses.iter().filter_map(act).collect(),
        }
    }
}

/// A set of keys that are held down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HeldKeys(u8);

impl FromIterator<DriveKey> for HeldKeys {
    fn from_iter<T: IntoIterator<Item = DriveKey>>(keys: T) -> HeldKeys {
        HeldKeys(keys.into_iter().fold(0, |held, key| held | 1 << key as u8))
    }
}

impl HeldKeys {
    fn has(self, key: DriveKey) -> bool {
        self.0 & 1 << key as u8 != 0
    }

    /// The direction of the keys, of length 1; opposite keys cancel out.
    pub fn direction(self) -> Point {
        let axis = |towards, away| f64::from(self.has(towards)) - f64::from(self.has(away));
        Point::new(axis(DriveKey::Right, DriveKey::Left), axis(DriveKey::Up, DriveKey::Down)).normalize_or_zero()
    }

    /// The factor on the pace.
    pub fn haste(self) -> f64 {
        (if self.has(DriveKey::Fast) { 2.0 } else { 1.0 }) * (if self.has(DriveKey::Slow) { 0.5 } else { 1.0 })
    }
}

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
    pub held: Vec<DriveKey>,
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
#[schemars(rename = "Key", title = "key")]
pub enum DriveKey {
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
