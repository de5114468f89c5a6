//! Cameras: they see bodies as silhouettes.
//!
//! [`lens`] turns points in space into pixels, [`scenery`] is how far off what stands still is in each pixel, [`silhouette`] is a
//! picture of black and white, [`painter`] paints bodies into it, and [`noise`] does what a real background subtraction does to it.

pub mod lens;
pub mod noise;
pub mod outlook;
pub mod painter;
pub mod scenery;
pub mod silhouette;
