//! Rays of the physics engine.
//!
//! They give the distance from a lens to the first wall, closed door or piece of furniture.
//!
//! We assume that each solid stops rays over its whole outline.
//!
//! A ray is cast against each side within reach of the lens, in single precision.
//!
//! Left out: solids lower than the lens, whose shadows the fan computes.

use crate::geometry::{self, Point};
use crate::plan::Solid;
use parry2d::math::Vector;
use parry2d::query::{Ray, RayCast};
use parry2d::shape::Segment;

/// Bound of the error of the physics engine, which computes in single precision.
const ENGINE_TOLERANCE_M: f64 = 0.01;

/// The sides of walls, closed doors and furniture within reach of a lens.
pub(super) struct SightObstacles {
    lens: Point,
    sides: Vec<Segment>,
}

impl SightObstacles {
    pub(super) fn around<'a>(lens: Point, reach_m: f64, solids: impl Iterator<Item = &'a Solid>) -> SightObstacles {
        let reached =
            |&(a, b): &(Point, Point)| geometry::distance_to_segment(lens, a, b) <= reach_m + ENGINE_TOLERANCE_M;
        let sides = solids.flat_map(|solid| geometry::sides(&solid.outline)).filter(reached);
        SightObstacles { lens, sides: sides.map(|(a, b)| Segment::new(vector(a), vector(b))).collect() }
    }

    /// The length of a ray from the lens up to the first side, at most `reach_m`.
    pub(super) fn cast(&self, direction: Point, reach_m: f64) -> f64 {
        let ray = Ray::new(vector(self.lens), vector(direction));
        let hits = self.sides.iter().filter_map(|side| side.cast_local_ray(&ray, reach_m as f32, true));
        hits.fold(reach_m, |nearest, hit| nearest.min(f64::from(hit)))
    }
}

/// A point as the physics engine's.
pub fn vector(p: Point) -> Vector {
    Vector::new(p.x as f32, p.y as f32)
}
