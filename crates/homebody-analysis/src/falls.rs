//! Falls in silhouettes: whether somebody is upright or on the ground, and whether they fell.
//!
//! After Anderson et al. 2009: where two cameras or more see somebody, the volume that all agree on is the voxel person
//! ([`voxels`]); with one camera, what its silhouette is like and where it meets the floor has to do ([`single`]). Fuzzy rules
//! ([`rules`]) turn the shape of each instant into how far somebody is upright, in between or on the ground, and a second level of
//! rules ([`watch`]) looks at these over time.
//!
//! Passive sensors ([`passive`]) tell of somebody who has kept still too long ([`long_lie`]), and both together of more ([`fused`]).
//!
//! We assume that one person is in view at a time.
//!
//! Left out: telling people apart, and learning rules from examples. That a cat is no person is a rule.

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

/// What somebody's body is like at an instant, as cameras tell it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BodyShape {
    /// How high its middle is above the floor, in metres.
    pub centroid_up_m: f64,
    /// How high its top is above the floor, in metres.
    pub height_m: f64,
    /// The angle between its longest extent and the vertical, in degrees: 0 upright, 90 level.
    pub tilt_deg: f64,
    /// How large it is, in litres; of one camera, what a body of its outline would have.
    pub volume_l: f64,
    /// Where it is, seen from above, in metres.
    pub at_m: [f64; 2],
}

/// A shape and when it was so.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ShapeAt {
    /// When it was so.
    pub at: RunTime,
    /// What the body was like.
    pub shape: BodyShape,
}
