//! Falls in silhouettes: the state of a person, upright or on the ground, and their falls.
//!
//! After Anderson et al. 2009: where two cameras or more see a person, the volume that all agree on is the voxel person ([`voxels`]); with
//! one camera, the form of its silhouette and its foot on the floor have to do ([`single`]). Fuzzy rules ([`rules`]) turn the shape of each
//! instant into degrees of upright, in between and on the ground, and a second level of rules ([`watch`]) looks at these over time.
//!
//! Passive sensors ([`passive`]) report a person who keeps still for too long ([`long_lie`]), and both together more ([`fused`]).
//!
//! We assume that one person is in view at a time.
//!
//! Left out: telling people apart, and learning rules from examples. A rule keeps cats out.

pub mod fused;
pub mod passive;
pub mod long_lie;
pub mod rules;
pub mod scenes;
pub mod single;
pub mod voxels;
pub mod watch;

use homebody_core::time::RunTime;
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BodyShape {
    pub centroid_up_m: f64,
    pub height_m: f64,
    /// The angle between its longest extent and the vertical, in degrees: 0 upright, 90 level.
    pub tilt_deg: f64,
    /// Its volume, in litres; with one camera, that of a body with its outline.
    pub volume_l: f64,
    pub at_m: [f64; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ShapeAt {
    pub at: RunTime,
    pub shape: BodyShape,
}
