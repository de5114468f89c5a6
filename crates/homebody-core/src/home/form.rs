//! `home.json`: the building and its sensors, in metres and degrees.

use crate::plan::form::{BuildingFiles, DoorFile, FurnitureFile, PlaceFile, RoomFile, WallFile};
use crate::plan::sun::COLUMBIA_DEG;
use crate::sensors::kinds::SensorFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Largest distance of any part of a home from its first room (our choice). Larger homes are an error of units: the
/// smallest flat in centimetres is larger.
pub const GREATEST_SIZE_M: f64 = 100.0;

/// The largest reach of furniture and areas beyond the rooms: into the thickness of a wall.
pub const REACH_OUT_M: f64 = 0.3;

/// `home.json`: the building, its furniture and its sensors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "home")]
pub struct HomeFile {
    /// Path or URL of this file's JSON Schema, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Name of the home.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Notes on the home: which lengths are measured, and which are assumed.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    #[schemars(extend("default" = ""))]
    pub about: String,
    /// Latitude, negative in the south. It sets the length of the days in each season. The default is that of
    /// TigerPlace in Missouri.
    #[serde(default = "latitude", skip_serializing_if = "is_missouri")]
    #[schemars(range(min = -65, max = 65), extend("default" = COLUMBIA_DEG))]
    pub latitude_deg: f64,
    /// Rooms. Their outlines do not overlap.
    #[schemars(length(min = 1, max = 1_000))]
    pub rooms: Vec<RoomFile>,
    /// Walls. Doors cut openings into them.
    #[schemars(length(max = 5_000))]
    pub walls: Vec<WallFile>,
    /// Doors and open passages. Without any, the walls have no openings.
    #[serde(default)]
    #[schemars(length(max = 1_000))]
    pub doors: Vec<DoorFile>,
    /// Furniture. It blocks bodies and beams, and residents use it, sit on it and lie on it.
    #[serde(default)]
    #[schemars(length(max = 1_000))]
    pub furniture: Vec<FurnitureFile>,
    /// Named points that paths can go to.
    #[serde(default)]
    #[schemars(length(max = 1_000))]
    pub places: Vec<PlaceFile>,
    /// Sensors. When several send an event at the same instant, the log has them in this order.
    #[serde(default)]
    #[schemars(length(max = 1_024))]
    pub sensors: Vec<SensorFile>,
}

impl HomeFile {
    /// A home with nothing in it.
    pub fn new(name: &str) -> HomeFile {
        HomeFile {
            schema: None,
            name: name.into(),
            about: String::new(),
            latitude_deg: latitude(),
            rooms: Vec::new(),
            walls: Vec::new(),
            doors: Vec::new(),
            furniture: Vec::new(),
            places: Vec::new(),
            sensors: Vec::new(),
        }
    }
}

impl<'a> From<&'a HomeFile> for BuildingFiles<'a> {
    fn from(home: &'a HomeFile) -> BuildingFiles<'a> {
        let HomeFile { rooms, walls, doors, furniture, places, .. } = home;
        BuildingFiles { rooms, walls, doors, furniture, places }
    }
}

/// The latitude of TigerPlace.
pub fn latitude() -> f64 {
    COLUMBIA_DEG
}

fn is_missouri(value: &f64) -> bool {
    *value == latitude()
}
