//! A camera without distortion: a pinhole.
//!
//! We assume square pixels and an axis through the middle of the picture, as after a calibration.
//!
//! Left out: distortion of wide lenses, focus, motion blur.

use crate::body::figure::Point3;
use crate::geometry::Point;

/// The position, direction and picture size of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// The position, in metres.
    pub at: Point3,
    /// Along its axis, of length one.
    pub forward: Point3,
    /// To the right of the picture.
    pub right: Point3,
    /// To the lower edge of the picture.
    pub down: Point3,
    /// Pixels in a row.
    pub columns: u32,
    /// Rows of the picture.
    pub rows: u32,
    /// The size of a thing of 1 m at 1 m, in pixels.
    pub focal_px: f64,
}

impl Lens {
    /// A camera at a place that looks to where `facing_rad` says (0 is east, a quarter turn north), and down by `tilt_rad`;
    /// `field_rad` is the angle that its rows span.
    pub fn new(at: Point3, facing_rad: f64, tilt_rad: f64, field_rad: f64, [columns, rows]: [u32; 2]) -> Lens {
        let (sine, cosine) = libm::sincos(facing_rad);
        let (sine_down, cosine_down) = libm::sincos(tilt_rad);
        let forward = Point3::new(cosine * cosine_down, sine * cosine_down, -sine_down);
        let right = Point3::new(sine, -cosine, 0.0);
        let down = Point3::new(-cosine * sine_down, -sine * sine_down, -cosine_down);
        let focal_px = f64::from(columns) / 2.0 / libm::tan(field_rad / 2.0);
        Lens { at, forward, right, down, columns, rows, focal_px }
    }

    /// A point as the camera has it: to the right, down, and along the axis, in metres.
    pub fn seen(&self, point: Point3) -> Point3 {
        let from = point - self.at;
        Point3::new(from.dot(self.right), from.dot(self.down), from.dot(self.forward))
    }

    /// The position of a point in the picture, in pixels from its upper left corner; `None` behind the camera.
    pub fn project(&self, point: Point3) -> Option<Point> {
        let seen = self.seen(point);
        (seen.z > 1e-9).then(|| self.middle() + seen.truncate() * (self.focal_px / seen.z))
    }

    /// The way through the middle of a pixel, as the camera has it: it goes 1 m along the axis.
    pub fn ray(&self, column: u32, row: u32) -> Point3 {
        let at = Point::new(f64::from(column) + 0.5, f64::from(row) + 0.5) - self.middle();
        (at / self.focal_px).extend(1.0)
    }

    /// The same way in the home.
    pub fn ray_in_home(&self, column: u32, row: u32) -> Point3 {
        self.ray_through(f64::from(column) + 0.5, f64::from(row) + 0.5)
    }

    /// The way in the home through a point of the picture.
    pub fn ray_through(&self, x: f64, y: f64) -> Point3 {
        let at = (Point::new(x, y) - self.middle()) / self.focal_px;
        self.right * at.x + self.down * at.y + self.forward
    }

    /// Whether a body that reaches so far around a place on the floor, and up, may be in the picture.
    pub fn may_see(&self, at: Point, reach_m: f64) -> bool {
        let ball = self.seen(at.extend(reach_m / 2.0));
        let radius_m = reach_m * 1.2;
        let half = self.middle();
        // Beyond none of the four planes through the lens and the picture's edges.
        let beyond = |off: f64, half_px: f64| {
            (off * self.focal_px - ball.z * half_px) / libm::sqrt(self.focal_px * self.focal_px + half_px * half_px)
        };
        ball.z > -radius_m && beyond(ball.x.abs(), half.x) < radius_m && beyond(ball.y.abs(), half.y) < radius_m
    }

    fn middle(&self) -> Point {
        Point::new(f64::from(self.columns), f64::from(self.rows)) / 2.0
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::disallowed_methods, reason = "what a test holds the lens against is to be another way")]

    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    /// By homogeneous matrices, as textbooks of computer vision have it: K [R | -R c] X.
    fn by_matrices(at: Point3, facing: f64, tilt: f64, field: f64, size: [u32; 2], point: Point3) -> [f64; 2] {
        let (c, s) = (facing.cos(), facing.sin());
        let (ct, st) = (tilt.cos(), tilt.sin());
        let rotation = [[s, -c, 0.0], [-c * st, -s * st, -ct], [c * ct, s * ct, -st]];
        let f = size[0] as f64 / (2.0 * (field / 2.0).tan());
        let intrinsic = [[f, 0.0, size[0] as f64 / 2.0], [0.0, f, size[1] as f64 / 2.0], [0.0, 0.0, 1.0]];
        let d = [point.x - at.x, point.y - at.y, point.z - at.z];
        let turned: Vec<f64> = rotation.iter().map(|row| (0..3).map(|i| row[i] * d[i]).sum()).collect();
        let image: Vec<f64> = intrinsic.iter().map(|row| (0..3).map(|i| row[i] * turned[i]).sum()).collect();
        [image[0] / image[2], image[1] / image[2]]
    }

    #[test]
    fn points_are_where_an_independent_projection_has_them() {
        let (at, size) = (Point3::new(0.5, 1.0, 2.3), [160, 120]);
        for (facing, tilt, field) in [(0.0, 0.0, FRAC_PI_2), (0.7, 0.4, 1.2), (-2.0, 0.9, 1.9), (FRAC_PI_4, 0.2, 1.0)] {
            let lens = Lens::new(at, facing, tilt, field, size);
            for (forward, side, up) in [(2.0, 0.3, -1.0), (4.0, -1.5, 0.2), (1.0, 0.0, 0.0), (7.0, 2.0, -2.0)] {
                let level = Point3::new(facing.cos(), facing.sin(), 0.0);
                let left = Point3::new(-facing.sin(), facing.cos(), 0.0);
                let point = at + level * forward + left * side + Point3::Z * up;
                let Some(found) = lens.project(point) else { continue };
                let [x, y] = by_matrices(at, facing, tilt, field, size, point);
                assert!((found.x - x).abs() < 1e-9 && (found.y - y).abs() < 1e-9, "{found} {x} {y}");
            }
        }
    }

    #[test]
    fn left_is_left_and_the_edge_is_where_the_field_ends() {
        let lens = Lens::new(Point3::ZERO, 0.0, 0.0, FRAC_PI_2, [160, 120]);
        // It looks east: north is to its left, and at 45 degrees the picture ends.
        assert!((lens.project(Point3::new(3.0, 3.0, 0.0)).unwrap().x).abs() < 1e-9);
        assert!((lens.project(Point3::new(3.0, -3.0, 0.0)).unwrap().x - 160.0).abs() < 1e-9);
        // Up is at the top.
        assert!(lens.project(Point3::new(3.0, 0.0, 1.0)).unwrap().y < 60.0);
        assert_eq!(lens.project(Point3::new(-1.0, 0.0, 0.0)), None);
    }

    #[test]
    fn a_ray_through_a_pixel_comes_back_to_it() {
        let lens = Lens::new(Point3::new(1.0, 2.0, 2.0), 1.0, 0.5, 1.3, [160, 120]);
        for (column, row) in [(0, 0), (159, 119), (80, 60), (13, 101)] {
            let back = lens.project(lens.at + lens.ray_in_home(column, row) * 3.0).unwrap();
            assert!((back.x - f64::from(column) - 0.5).abs() < 1e-9 && (back.y - f64::from(row) - 0.5).abs() < 1e-9);
        }
    }
}
