//! A resident's file: body, pace and who decides what the resident does.

use crate::geometry::At;
use crate::numbers::Numbers;
use crate::posture::Posture;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A person, a visitor or a pet, with a body, a pace and a driver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "resident")]
pub struct ResidentFile {
    /// Path or URL of this file's JSON Schema, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Name of the resident in the truth and in messages, unique in the scenario.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Radius of the body, seen from above.
    #[serde(default = "radius")]
    #[schemars(range(min = 0.05, max = 1))]
    pub radius_m: f64,
    /// Height of the standing body.
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
    /// Driver of the resident. It decides their movements and acts.
    pub driver: DriverFile,
}

/// How a resident wanders: the strength of each motor schema, and the number of stops.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "wandering gains")]
pub struct WanderingFile {
    /// Strength of the pull toward the goal, as a factor on the usual one.
    #[schemars(range(min = 0.1, max = 10))]
    pub goal: f64,
    /// Strength of the push away from walls and furniture, as a factor on the usual one.
    #[schemars(range(min = 0, max = 10))]
    pub walls: f64,
    /// Strength of the random direction, as a factor on the usual one.
    #[schemars(range(min = 0, max = 10))]
    pub noise: f64,
    /// Strength of the push away from other people, where the goal has 1. The usual value is 0.
    #[schemars(range(min = 0, max = 10))]
    pub people: f64,
    /// Strength of the pull back from open floor to the nearest wall, where the goal has 1. The usual value is 0.
    #[schemars(range(min = 0, max = 10))]
    pub open_floor: f64,
    /// Number of times a minute that the resident stands still. The usual value is 0.
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
    /// A resident with the default values and this driver.
    pub fn with_driver(driver: DriverFile) -> ResidentFile {
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

/// How the resident's movements and acts are decided.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "driver")]
pub enum DriverFile {
    /// A path file, which the resident follows.
    Path(String),
    /// A routine in plain language, which the resident follows.
    Routine(String),
    /// A script that decides, for behaviour that a routine cannot describe.
    Script(String),
    /// A file of key states over time that drives the body through the physics.
    Live(LiveFile),
}

/// Key states read from a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "live driver")]
pub struct LiveFile {
    /// File of key states over time.
    pub keys: String,
    /// Position of the body at the start.
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

crate::numbers! {
    /// Height of a person on a common chair, as a share of the standing height.
    static SITTING = "posture.sitting": 0.8, "1", [0.5, 1.0];
    /// Height of a person on a bed, as a share of the standing height.
    static LYING = "posture.lying": 0.4, "1", [0.1, 0.8];
}

/// The build of a resident's body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Build {
    /// The radius of the body seen from above, in metres.
    pub radius_m: f64,
    /// The height of the body when it stands, in metres.
    pub height_m: f64,
}

impl Build {
    /// The body that a resident's file describes.
    pub fn new(file: &ResidentFile) -> Build {
        Build { radius_m: file.radius_m, height_m: file.height_m }
    }

    /// An adult: the body of a resident's file that says nothing of it.
    pub fn adult() -> Build {
        Build { radius_m: radius(), height_m: height() }
    }

    /// The body as sensors see it in a posture.
    pub fn size(&self, posture: Posture, numbers: &Numbers) -> BodySize {
        let share = match posture {
            Posture::Standing => 1.0,
            Posture::Sitting | Posture::Bending | Posture::Kneeling => numbers.of(&SITTING),
            Posture::Lying | Posture::Down => numbers.of(&LYING),
        };
        BodySize { radius_m: self.radius_m, top_m: self.height_m * share }
    }
}

/// A body as sensors see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodySize {
    /// The radius of the body seen from above, in metres.
    pub radius_m: f64,
    /// The height of the body in its posture.
    pub top_m: f64,
}
