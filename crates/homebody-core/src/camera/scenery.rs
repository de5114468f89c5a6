//! The distances of things that do not move: one depth a pixel, computed once.
//!
//! We assume that walls and closed doors reach up to wherever the camera looks, that furniture is a prism as high as the home
//! says, and that people sit on a piece that they can be in, so that it hides them no higher than its seat.
//!
//! Left out: what lies on tables, windows and mirrors, doors that are opened or closed in the course of a run.

use super::lens::Lens;
use crate::body::figure::Point3;
use crate::geometry::{self, Point};

/// The view of a camera without bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenery {
    columns: usize,
    /// By pixel, row by row: the distance of the nearest thing along the axis, in metres.
    depths_m: Vec<f32>,
}

/// An upright prism on the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    /// Convex, corners counter-clockwise.
    pub outline: Vec<Point>,
    /// Infinite for walls.
    pub height_m: f64,
}

impl Scenery {
    /// The view of these prisms and of the floor.
    pub fn new(lens: &Lens, prisms: &[Prism]) -> Scenery {
        let (columns, rows) = (lens.columns as usize, lens.rows as usize);
        let mut depths_m = Vec::with_capacity(columns * rows);
        for row in 0..lens.rows {
            for column in 0..lens.columns {
                let ray = lens.ray_in_home(column, row);
                let floor = if ray.z < 0.0 { -lens.at.z / ray.z } else { f64::INFINITY };
                let nearest = prisms.iter().filter_map(|prism| prism.first_hit(lens.at, ray)).fold(floor, f64::min);
                depths_m.push(nearest as f32);
            }
        }
        Scenery { columns, depths_m }
    }

    /// The distance of the nearest thing along the axis in a pixel, in metres; infinite without one.
    pub fn depth_m(&self, column: usize, row: usize) -> f32 {
        self.depths_m[row * self.columns + column]
    }

    /// The depths of a row.
    pub fn row(&self, row: usize) -> &[f32] {
        &self.depths_m[row * self.columns..(row + 1) * self.columns]
    }
}

impl Prism {
    /// The multiple of `way` from a point at which a ray first meets the prism; `None` if it does not, or if the point
    /// is in it.
    pub fn first_hit(&self, from: Point3, way: Point3) -> Option<f64> {
        let (at, level) = (from.truncate(), way.truncate());
        let (mut enters, mut leaves) = (0.0_f64, f64::INFINITY);
        for (a, b) in geometry::sides(&self.outline) {
            // Inside is to the left of each side.
            let side = b - a;
            let (distance, approach) = (side.perp_dot(at - a), side.perp_dot(level));
            if approach > 0.0 {
                enters = enters.max(-distance / approach);
            } else if approach < 0.0 {
                leaves = leaves.min(-distance / approach);
            } else if distance < 0.0 {
                return None;
            }
        }
        if enters >= leaves {
            return None;
        }
        let height_at = |times: f64| from.z + way.z * times;
        if height_at(enters) <= self.height_m {
            return (enters > 0.0).then_some(enters);
        }
        // From above it comes down to the top before it has passed.
        let down = (self.height_m - from.z) / way.z;
        (way.z < 0.0 && down < leaves).then_some(down)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn block(height_m: f64) -> Prism {
        let corner = |x: f64, y: f64| Point::new(x, y);
        Prism { outline: vec![corner(3.0, -1.0), corner(4.0, -1.0), corner(4.0, 1.0), corner(3.0, 1.0)], height_m }
    }

    #[test]
    fn a_block_is_met_at_its_side_its_top_or_not_at_all() {
        let from = Point3::new(0.0, 0.0, 2.0);
        // Level ways pass above 1 m and meet 2.5 m at its side.
        assert_eq!(block(1.0).first_hit(from, Point3::X), None);
        assert_eq!(block(2.5).first_hit(from, Point3::X), Some(3.0));
        // Down by 2 m in 7: at 3.5 m it is 1 m high, which is the top of the block.
        let way = Point3::new(1.0, 0.0, -2.0 / 7.0);
        assert!((block(1.0).first_hit(from, way).unwrap() - 3.5).abs() < 1e-12);
        // Steeper, it meets the side; next to the block, and away from it, nothing.
        assert_eq!(block(1.0).first_hit(from, Point3::new(1.0, 0.0, -0.5)), Some(3.0));
        assert_eq!(block(1.0).first_hit(from, Point3::new(1.0, 1.0, -0.5)), None);
        assert_eq!(block(1.0).first_hit(from, Point3::new(-1.0, 0.0, -0.1)), None);
    }

    #[test]
    fn as_many_pixels_are_of_a_block_as_a_closed_formula_says() {
        // From 1 m above the floor, level, 90 degrees wide: at its face, 3 m off, a pixel is 3 / 80 m.
        let lens = Lens::new(Point3::new(0.0, 0.0, 1.0), 0.0, 0.0, FRAC_PI_2, [160, 120]);
        let scenery = Scenery::new(&lens, &[block(1.6)]);
        let of_block = (0..120).flat_map(|row| scenery.row(row).to_vec()).filter(|depth| (3.0..3.01).contains(depth));
        // 2 m wide and 1.6 m high.
        let expected = (2.0 / (3.0 / 80.0)) * (1.6 / (3.0 / 80.0));
        let found = of_block.count() as f64;
        assert!((found - expected).abs() / expected < 0.03, "{found} of {expected}");
        // The floor: 20 rows below the axis it is 1 m * 80 / 20.5 off.
        assert!((scenery.depth_m(3, 80) - 80.0 / 20.5).abs() < 1e-3);
        assert_eq!(scenery.depth_m(3, 3), f32::INFINITY);
    }
}
