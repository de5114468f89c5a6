//! A resident's file: body, pace and who decides what the resident does.

use crate::geometry::At;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A person (or visitor, or pet) with a body, a pace and a driver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "resident")]
pub struct ResidentFile {
    /// Where the JSON Schema of this file is, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// What the truth and messages call the resident; nobody else of the scenario has this name.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Radius of the body seen from above.
    #[serde(default = "radius")]
    #[schemars(range(min = 0.05, max = 1))]
    pub radius_m: f64,
    /// Height of the body when it stands.
    #[serde(default = "height")]
    #[schemars(range(min = 0.1, max = 2.5))]
    pub height_m: f64,
    /// Usual walking speed.
    #[serde(default = "pace")]
    #[schemars(range(min = 0.01, max = 5))]
    pub pace_mps: f64,
    /// How the resident wanders: the gains of motor schemas.
    #[serde(default, skip_serializing_if = "WanderingFile::is_usual")]
    pub wandering: WanderingFile,
    /// What decides where the resident goes and what they do.
    pub driver: DriverFile,
}

/// How somebody wanders: how strongly each schema steers, and how often they stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "how somebody wanders")]
pub struct WanderingFile {
    /// Toward the goal, times what is usual.
    #[schemars(range(min = 0.1, max = 10))]
    pub goal: f64,
    /// Away from walls and furniture, times what is usual.
    #[schemars(range(min = 0, max = 10))]
    pub walls: f64,
    /// Into random directions, times what is usual.
    #[schemars(range(min = 0, max = 10))]
    pub noise: f64,
    /// Away from other people, beside a goal of 1; usually nothing.
    #[schemars(range(min = 0, max = 10))]
    pub people: f64,
    /// Back toward the nearest wall over open floor, beside a goal of 1; usually nothing.
    #[schemars(range(min = 0, max = 10))]
    pub open_floor: f64,
    /// How many times a minute they stand still; usually never.
    #[schemars(range(min = 0, max = 30))]
    pub pauses_pm: f64,
}

impl Default for WanderingFile {
    fn default() -> WanderingFile {
        WanderingFile { goal: 1.0, walls: 1.0, noise: 1.0, people: 0.0, open_floor: 0.0, pauses_pm: 0.0 }
    }
}

impl WanderingFile {
    fn is_usual(&self) -> bool {
        *self == WanderingFile::default()
    }
}

impl ResidentFile {
    /// Somebody of whom only the driver is known.
    pub fn somebody(driver: DriverFile) -> ResidentFile {
        let name = "somebody".into();
        ResidentFile {
            schema: None,
            name,
            radius_m: radius(),
            height_m: height(),
            pace_mps: pace(),
            wandering: WanderingFile::default(),
            driver,
        }
    }
}

/// Who decides what a resident does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "driver")]
pub enum DriverFile {
    /// A path description file to act out.
    Path(String),
    /// A routine in plain language to live by.
    Routine(String),
    /// A script that decides, for what a routine cannot say.
    Script(String),
    /// A file of key states over time that drives the body through the physics.
    Live(LiveFile),
}

/// Live input read from a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "live driver")]
pub struct LiveFile {
    /// The file of key states over time.
    pub keys: String,
    /// Where the body stands at the start.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub start: At,
}

/// Ours: half the shoulder breadth of an adult, arms at the sides.
pub(crate) fn radius() -> f64 {
    0.22
}
pub(crate) fn height() -> f64 {
    1.65
}
/// In-home walking speed of people aged 86 on average: 0.61 m/s (SD 0.17), Kaye 2012.
fn pace() -> f64 {
    0.65
}
