//! A path description: where to walk, how fast, where to wait, and what to repeat.

use crate::plan::form::Spot;
use crate::posture::Posture;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A path: the steps that a resident follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "path")]
pub struct PathFile {
    /// Path or URL of this file's JSON Schema, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Position of the resident at the start.
    pub start: Spot,
    /// Posture at the start.
    #[serde(default)]
    pub posture: Posture,
    /// Steps of the path, in order.
    #[schemars(length(max = 10_000))]
    pub steps: Vec<PathStep>,
}

/// One step of a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Step", title = "step")]
pub enum PathStep {
    /// Walk in straight lines through one or more waypoints.
    Go(Go),
    /// Stay in place, for a time or until a time of day.
    Wait(Wait),
    /// Repeat steps several times, or without end.
    Repeat(Repeat),
    /// Name the steps that follow in the ground truth, such as `breakfast`. An empty name ends the activity.
    Activity(String),
    /// Be out of the home, for a time or until a time of day. The resident comes back to where they left.
    Away(PathSpan),
}

/// A walk through waypoints, at the resident's pace unless `pace_mps`, `in_s` or `arrive_at` is given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "walk")]
pub struct Go {
    /// Waypoints, in order.
    #[schemars(length(min = 1, max = 1_000))]
    pub to: Vec<Spot>,
    /// Walking speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.01, max = 5))]
    pub pace_mps: Option<f64>,
    /// Duration of the whole walk.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.000001, max = 3_200_000_000_i64))]
    pub in_s: Option<f64>,
    /// Time of day at which the walk ends, such as `07:30` or `07:30:15.5`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrive_at: Option<String>,
}

/// A stay in one place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "wait")]
pub struct Wait {
    /// Duration of the stay.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.000001, max = 3_200_000_000_i64))]
    pub for_s: Option<f64>,
    /// Time of day at which the stay ends, `07:30` or `07:30:15.5`: the next such time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<String>,
    /// Posture during the stay.
    #[serde(default)]
    pub posture: Posture,
    /// Small movements during the stay. Without it, the resident keeps still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stir: Option<StirFile>,
}

/// Small movements on the spot, as when reading, cooking or turning in bed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "stir")]
pub struct StirFile {
    /// Time from the start of one movement to the start of the next.
    #[schemars(range(min = 0.1, max = 86_400))]
    pub every_s: f64,
    /// Duration of each movement.
    #[schemars(range(min = 0.001, max = 86_400))]
    pub for_s: f64,
    /// Distance that the moving part of the body covers.
    #[serde(default = "amplitude")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 2))]
    pub amplitude_m: f64,
}

/// A span of time: `for_s` or `until`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Span", title = "span of time")]
pub struct PathSpan {
    /// Duration of the span.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.000001, max = 3_200_000_000_i64))]
    pub for_s: Option<f64>,
    /// Time of day at which the span ends, `07:30` or `07:30:15.5`: the next such time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<String>,
}

/// Steps that are repeated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "repeat")]
pub struct Repeat {
    /// Number of repetitions. Without it, the steps repeat without end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1_000_000_000))]
    pub times: Option<u32>,
    /// Steps of each repetition, in order.
    #[schemars(length(min = 1, max = 10_000))]
    pub steps: Vec<PathStep>,
}

/// Largest number of steps and waypoints of a path: some two months of a person's ways from a log.
pub const MOST_STEPS: usize = 120_000;

impl PathFile {
    /// The number of steps, the repeated ones once, and of waypoints with them: no more than [`MOST_STEPS`].
    pub fn steps_and_waypoints(&self) -> usize {
        count(&self.steps)
    }
}

/// The number of steps, the repeated ones once, and of waypoints with them.
pub fn count(steps: &[PathStep]) -> usize {
    let of = |step: &PathStep| match step {
        PathStep::Go(go) => go.to.len(),
        PathStep::Repeat(repeat) => count(&repeat.steps),
        PathStep::Wait(_) | PathStep::Activity(_) | PathStep::Away(_) => 0,
    };
    steps.iter().map(|step| 1 + of(step)).sum()
}

/// Ours: the reach of a hand that turns a page or stirs a pot.
fn amplitude() -> f64 {
    0.2
}
