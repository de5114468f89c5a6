//! A path description: where to walk, how fast, where to wait, and what to repeat.

use crate::geometry::At;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A path description file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "path")]
pub struct PathFile {
    /// Where the JSON Schema of this file is, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Where the resident is at the start.
    pub start: Spot,
    /// The posture at the start.
    #[serde(default)]
    pub posture: Posture,
    /// What the resident does, in this order.
    #[schemars(length(max = 10_000))]
    pub steps: Vec<Step>,
}

/// A point in metres, or the name of a place of the home.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(title = "spot")]
pub enum Spot {
    /// A point: metres to the east and to the north.
    At(#[schemars(inner(range(min = -10_000, max = 10_000)))] At),
    /// The name of a place, of an enterable piece of furniture or of a room, whose middle is meant.
    Place(String),
}

/// One step of a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "step")]
pub enum Step {
    /// Walk in straight lines through one or more waypoints.
    Go(Go),
    /// Stay where you are, for a time or until a time of day.
    Wait(Wait),
    /// Do the steps several times, or for ever.
    Repeat(Repeat),
    /// Give what follows a name in the ground truth, such as `breakfast`; an empty name ends it.
    Activity(String),
    /// Be out of the home, for a time or until a time of day; the resident comes back where they left.
    Away(Span),
}

/// Walking through waypoints: at the resident's pace unless `pace_mps`, `in_s` or `arrive_at` says otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "walk")]
pub struct Go {
    /// The waypoints, in order.
    #[schemars(length(min = 1, max = 1_000))]
    pub to: Vec<Spot>,
    /// Walking speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.01, max = 5))]
    pub pace_mps: Option<f64>,
    /// How long the whole walk takes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.000001, max = 3_200_000_000_i64))]
    pub in_s: Option<f64>,
    /// The time of day at which the walk ends, such as `07:30` or `07:30:15.5`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrive_at: Option<String>,
}

/// Staying in one place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "wait")]
pub struct Wait {
    /// How long.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.000001, max = 3_200_000_000_i64))]
    pub for_s: Option<f64>,
    /// Until when: the next such time of day, `07:30` or `07:30:15.5`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<String>,
    /// How the body is meanwhile.
    #[serde(default)]
    pub posture: Posture,
    /// Small movements meanwhile; without it, the resident keeps still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stir: Option<StirFile>,
}

/// Small movements on the spot: reading, cooking, turning in bed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "stir")]
pub struct StirFile {
    /// From the start of one movement to the start of the next.
    #[schemars(range(min = 0.1, max = 86_400))]
    pub every_s: f64,
    /// How long each movement lasts.
    #[schemars(range(min = 0.001, max = 86_400))]
    pub for_s: f64,
    /// How far what moves moves.
    #[serde(default = "amplitude")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 2))]
    pub amplitude_m: f64,
}

/// A stretch of time: `for_s` or `until`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "span of time")]
pub struct Span {
    /// How long.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.000001, max = 3_200_000_000_i64))]
    pub for_s: Option<f64>,
    /// Until when: the next such time of day, `07:30` or `07:30:15.5`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<String>,
}

/// Steps that are done more than once.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "repeat")]
pub struct Repeat {
    /// How many times; without it, for ever.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1_000_000_000))]
    pub times: Option<u32>,
    /// What is done each time, in this order.
    #[schemars(length(min = 1, max = 10_000))]
    pub steps: Vec<Step>,
}

/// How a body holds itself: it decides how high the body reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema, Default)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "posture")]
pub enum Posture {
    /// On its feet: the body has its whole height.
    #[default]
    Standing,
    /// On a seat: the body reaches less high, by the number `posture.sitting`.
    Sitting,
    /// On a bed or on the floor: the body is lowest, by the number `posture.lying`.
    Lying,
    /// Bent forward, as to an oven: as high as when sitting.
    Bending,
    /// On both knees, or on hands and knees where the body moves: as high as when sitting.
    Kneeling,
    /// On the floor after a fall: as low as when lying.
    Down,
}

impl Posture {
    /// All of them, from the highest to the lowest.
    pub const ALL: [Posture; 6] =
        [Posture::Standing, Posture::Bending, Posture::Sitting, Posture::Kneeling, Posture::Lying, Posture::Down];

    /// What files call it.
    pub fn name(self) -> &'static str {
        match self {
            Posture::Standing => "standing",
            Posture::Sitting => "sitting",
            Posture::Lying => "lying",
            Posture::Bending => "bending",
            Posture::Kneeling => "kneeling",
            Posture::Down => "down",
        }
    }

    /// The posture of a name.
    pub fn named(name: &str) -> Option<Posture> {
        Posture::ALL.into_iter().find(|posture| posture.name() == name)
    }
}

/// A path has at most this many steps and waypoints: some two months of a person whose ways a log tells.
pub const MOST_STEPS: usize = 120_000;

impl PathFile {
    /// How many steps there are, the repeated ones once, and waypoints with them: no more than [`MOST_STEPS`].
    pub fn steps_and_waypoints(&self) -> usize {
        count(&self.steps)
    }
}

/// How many steps there are, the repeated ones once, and waypoints with them.
pub fn count(steps: &[Step]) -> usize {
    let of = |step: &Step| match step {
        Step::Go(go) => go.to.len(),
        Step::Repeat(repeat) => count(&repeat.steps),
        Step::Wait(_) | Step::Activity(_) | Step::Away(_) => 0,
    };
    steps.iter().map(|step| 1 + of(step)).sum()
}

/// Ours: the reach of a hand that turns a page or stirs a pot.
fn amplitude() -> f64 {
    0.2
}
