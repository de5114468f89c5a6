//! Cameras, their silhouettes, and the persons in them.

use super::At;
use serde::Serialize;
use ts_rs::TS;

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CameraView {
    /// Columns and rows of a picture.
    pub pixels: [u32; 2],
    /// The time between two pictures.
    #[ts(type = "number")]
    pub period_us: i64,
    /// True for a camera that never sleeps.
    pub always: bool,
    /// The floor, beds and seats in its view, as rectangles: left, lower, right and upper edge.
    pub seen: Vec<[f64; 4]>,
    /// The parts of its view that furniture hides, as rectangles.
    pub hidden: Vec<[f64; 4]>,
}

/// The state of a camera in the run on the stage.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CameraStateView {
    /// Its number among the home's sensors.
    pub sensor: u32,
    pub awake: bool,
    /// Its packed silhouette: lengths of runs of pixels that are off and on in turns; empty without a body.
    #[serde(with = "serde_bytes")]
    #[ts(type = "Uint8Array")]
    pub packed: Vec<u8>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SilhouettesView {
    /// The end of the silhouettes here; if it is before the requested end, the page requests the rest.
    #[ts(type = "number")]
    pub until_us: i64,
    /// The origin of the cubes.
    pub corner: At,
    /// The side of a cube.
    pub edge_m: f64,
    /// In the order of time.
    pub moments: Vec<MomentView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct MomentView {
    #[ts(type = "number")]
    pub at_us: i64,
    pub pictures: Vec<PictureView>,
    /// One in each room at most.
    pub persons: Vec<PersonView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PictureView {
    /// The camera's number among the home's sensors.
    pub sensor: u32,
    /// As in [`CameraStateView`].
    #[serde(with = "serde_bytes")]
    #[ts(type = "Uint8Array")]
    pub packed: Vec<u8>,
}

/// A person in the silhouettes of one instant.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PersonView {
    /// The surface cubes of the body that two cameras or more agree on: three numbers each, from the corner to the east, to the north
    /// and up. Empty if only one camera sees the person.
    pub cubes: Vec<u16>,
    /// Of the top above the floor.
    pub height_m: f64,
    pub centroid_up_m: f64,
    /// The angle of the longest extent to the vertical.
    pub tilt_deg: f64,
    /// Seen from above.
    pub at: At,
    /// Membership from 0 to 1.
    pub upright: f64,
    pub in_between: f64,
    pub on_the_ground: f64,
}
