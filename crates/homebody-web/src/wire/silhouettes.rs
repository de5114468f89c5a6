//! Cameras, and what they keep: silhouettes, and who is told by them.

use super::At;
use serde::Serialize;
use ts_rs::TS;

/// A camera of the home.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CameraView {
    /// Columns and rows of its pictures.
    pub pixels: [u32; 2],
    /// From one picture to the next.
    #[ts(type = "number")]
    pub period_us: i64,
    /// Whether it never sleeps.
    pub always: bool,
    /// The floor, beds and seats that it sees, as rectangles: left, lower, right and upper edge.
    pub seen: Vec<[f64; 4]>,
    /// The same of what it would see if furniture did not hide it.
    pub hidden: Vec<[f64; 4]>,
}

/// A camera at an instant of the run that is being lived.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LookView {
    /// Its number among the home's sensors.
    pub sensor: u32,
    pub awake: bool,
    /// Its silhouette, packed: lengths of runs of pixels that are off and on in turns; empty where it sees nobody.
    #[serde(with = "serde_bytes")]
    #[ts(type = "Uint8Array")]
    pub packed: Vec<u8>,
}

/// Silhouettes of a part of a stored run.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FilmView {
    /// Up to here all is told; where that is not the end that was asked for, the rest is asked for next.
    #[ts(type = "number")]
    pub until_us: i64,
    /// The corner from which the cubes of voxel persons are counted.
    pub corner: At,
    /// The side of a cube.
    pub edge_m: f64,
    /// In the order of time.
    pub moments: Vec<MomentView>,
}

/// What cameras kept of an instant.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct MomentView {
    #[ts(type = "number")]
    pub at_us: i64,
    pub pictures: Vec<PictureView>,
    /// Who is told by them, one in each room at most.
    pub persons: Vec<PersonView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PictureView {
    /// The camera's number among the home's sensors.
    pub sensor: u32,
    /// As of a camera in the run that is being lived.
    #[serde(with = "serde_bytes")]
    #[ts(type = "Uint8Array")]
    pub packed: Vec<u8>,
}

/// Somebody, by the silhouettes of one instant.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PersonView {
    /// The cubes at the surface of what two cameras or more agree on: three numbers each, counted from the corner to the east, to the
    /// north and up. None where one camera alone tells of somebody.
    pub cubes: Vec<u16>,
    /// How high the top is above the floor.
    pub height_m: f64,
    /// How high the middle is.
    pub centroid_up_m: f64,
    /// The angle of the longest extent to the vertical.
    pub tilt_deg: f64,
    /// Where, seen from above.
    pub at: At,
    /// How far somebody is on the feet, from 0 to 1.
    pub upright: f64,
    pub in_between: f64,
    pub on_the_ground: f64,
}
