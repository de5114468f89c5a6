//! The building in `home.json`: rooms, walls, doors, furniture and places.

use crate::geometry::At;
use crate::role::Role;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The parts of `home.json` that a [`Plan`](super::Plan) is made of.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "`HomeFile` says what each list is")]
pub struct BuildingFiles<'a> {
    pub rooms: &'a [RoomFile],
    pub walls: &'a [WallFile],
    pub doors: &'a [DoorFile],
    pub furniture: &'a [FurnitureFile],
    pub places: &'a [PlaceFile],
}

/// A point in metres, or the name of a place in the home.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(title = "spot")]
pub enum Spot {
    /// A point: metres to the east and to the north.
    At(#[schemars(inner(range(min = -10_000, max = 10_000)))] At),
    /// Name of a place, of an enterable piece of furniture, or of a room. A room stands for its centre.
    Place(String),
}

/// A room: a name and an outline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "room")]
pub struct RoomFile {
    /// Name of the room and of its lamp, unique among rooms.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Corners in order. The last is joined to the first.
    #[schemars(length(min = 3, max = 500), inner(inner(range(min = -10_000, max = 10_000))))]
    pub outline: Vec<At>,
    /// Floor of the building that the room is on, such as `first floor`. A plan draws the floors next to each other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1, max = 100))]
    pub floor: Option<String>,
    /// Height of the ceiling above the floor. No resident is taller, and no camera hangs higher.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.5, max = 20))]
    pub ceiling_m: Option<f64>,
}

impl RoomFile {
    /// A room of this name with these corners, in a home of one floor.
    pub fn new(name: impl Into<String>, outline: Vec<At>) -> RoomFile {
        RoomFile { name: name.into(), outline, floor: None, ceiling_m: None }
    }
}

/// A straight wall between two points of its centre line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "wall")]
pub struct WallFile {
    /// One end of the wall's centre line.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub from: At,
    /// The other end of the wall's centre line.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub to: At,
    /// Thickness of the wall. Half of it lies on each side of the centre line.
    #[serde(default = "wall_thickness")]
    #[schemars(range(min = 0.001, max = 2))]
    pub thickness_m: f64,
}

impl WallFile {
    /// A wall of the usual thickness.
    pub fn new(from: At, to: At) -> WallFile {
        WallFile { from, to, thickness_m: wall_thickness() }
    }
}

/// A door or an open passage: an opening in a wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "door")]
pub struct DoorFile {
    /// Name of the door, unique among doors.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// One jamb, on the centre line of a wall.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub from: At,
    /// The other jamb, on the same wall.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub to: At,
    /// Whether the door is open. An open door lets people and beams through; a closed door blocks both.
    #[serde(default = "yes")]
    pub open: bool,
    /// Whether people close the open door each time after they pass. Such a door lets people through, but never beams.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub shut_behind: bool,
    /// Whether the door leads out of the home.
    #[serde(default)]
    pub outside: bool,
}

/// A piece of furniture: a rectangle given by `at` and `size_m`, or any `outline`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "piece of furniture")]
pub struct FurnitureFile {
    /// Name of the piece, such as `armchair`. The name sets its role, unless `role` is given.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Centre of the rectangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub at: Option<At>,
    /// Width and depth of the rectangle before it is turned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0.001, max = 1_000)))]
    pub size_m: Option<[f64; 2]>,
    /// Rotation of the rectangle, counter-clockwise.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = -360, max = 360), extend("default" = 0))]
    pub turn_deg: f64,
    /// Corners, for a shape other than a rectangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 3, max = 64), inner(inner(range(min = -10_000, max = 10_000))))]
    pub outline: Option<Vec<At>>,
    /// Height of the piece. It blocks beams that pass lower than this.
    #[schemars(range(min = 0, max = 10))]
    pub height_m: f64,
    /// Whether a person can be in or on the piece, as on a bed, an armchair or a rug. A piece of at most 5 cm never
    /// blocks anyone.
    #[serde(default)]
    pub enterable: bool,
    /// Role of the piece, whatever its name. Without it, the name sets the role.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub role: Option<Role>,
}

/// A named point that a path can go to, such as `sink` or `armchair`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "place")]
pub struct PlaceFile {
    /// Name of the point. It differs from all rooms, enterable pieces of furniture and other places.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Position of the point on the floor.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub at: At,
}

fn yes() -> bool {
    true
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// Ours.
fn wall_thickness() -> f64 {
    0.1
}
