//! A passive infrared sensor on the ceiling.
//!
//! The device looks straight down through a narrow lens on one spot: a shower, a drawer, a closet.
//!
//! We assume that it sees every movement of a body any part of which is over the area, and nothing
//! else (Godsey & Skubic 2009, section III.D: a rectangular area that, when intersected, makes the
//! sensor active). A body that keeps still is not seen.
//!
//! The area is a convex outline. A body of radius r touches it while its centre is within r of the
//! area, which begins, from outside, at one of the outline's sides: each side is a beam.
//!
//! Left out: the height of the body (the beam widens downward), furniture above the area, and walls: the checks refuse
//! an area that reaches through one.

use crate::geometry::{self, Point, point};
use crate::scenario::home::CeilingMotionFile;
use crate::stride::Beam;

/// A ceiling sensor's area.
#[derive(Clone, Debug, PartialEq)]
pub struct CeilingMotion {
    /// Convex, corners counter-clockwise.
    pub outline: Vec<Point>,
}

impl CeilingMotion {
    /// The area of a file that has passed its checks, in whichever order it has the corners.
    pub fn new(file: &CeilingMotionFile) -> CeilingMotion {
        let mut outline: Vec<Point> = file.area.iter().map(|&at| point(at)).collect();
        if geometry::signed_area(&outline) < 0.0 {
            outline.reverse();
        }
        CeilingMotion { outline }
    }

    /// The sides of the area as beams.
    pub fn beams(&self) -> Vec<Beam> {
        let sides = geometry::sides(&self.outline).enumerate();
        sides
            .map(|(number, (a, b))| Beam {
                start: a,
                direction: (b - a).normalize_or_zero(),
                length: a.distance(b),
                number: number as u32,
            })
            .collect()
    }
}
