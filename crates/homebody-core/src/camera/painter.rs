//! Paints capsules into a silhouette.
//!
//! A pixel is of a capsule if the way through its middle comes within the capsule's radius of its axis, and if the axis is nearer
//! there than what stands still.
//!
//! We assume that nothing is nearer to the lens than 5 cm.
//!
//! A capsule is convex, so each row of its picture is one span. A circle around each end that is surely large enough bounds it;
//! from there both ends of the span are found pixel by pixel, by the exact test.
//!
//! Left out: half-covered pixels, which are of the body or not.

use super::lens::Lens;
use super::scenery::Scenery;
use super::silhouette::Silhouette;
use crate::body::figure::{Capsule, Point3};
use crate::geometry::Point;

/// Nearer parts are not painted, in metres.
const NEAREST_M: f64 = 0.05;

/// Paints what a camera sees of a figure.
pub fn paint(figure: &[Capsule], lens: &Lens, scenery: &Scenery, onto: &mut Silhouette) {
    figure.iter().for_each(|capsule| Projected::new(capsule, lens).paint(lens, scenery, onto));
}

/// A capsule as the camera has it.
struct Projected {
    ends: [Point3; 2],
    radius_m: f64,
    /// Its ends in the picture, each with a radius in pixels that covers all of it; `None` if it is too near.
    discs: Option<[(Point, f64); 2]>,
}

impl Projected {
    fn new(capsule: &Capsule, lens: &Lens) -> Projected {
        let ends = [lens.seen(capsule.from), lens.seen(capsule.to)];
        let disc = |end: Point3| {
            let center = Point::new(f64::from(lens.columns), f64::from(lens.rows)) / 2.0;
            let (off, away) = (end.truncate().length() / end.z, end.length());
            let sine = capsule.radius_m / away;
            if end.z < NEAREST_M || sine >= 1.0 {
                return None;
            }
            let tangent = sine / libm::sqrt(1.0 - sine * sine);
            let rest = 1.0 - off * tangent;
            if rest <= 0.0 {
                return None;
            }
            // The far edge of a ball's picture lies at the sum of both angles.
            let radius_px = lens.focal_px * ((off + tangent) / rest - off);
            Some((center + end.truncate() * (lens.focal_px / end.z), radius_px))
        };
        let discs = disc(ends[0]).zip(disc(ends[1])).map(|(a, b)| [a, b]);
        Projected { ends, radius_m: capsule.radius_m, discs }
    }

    fn paint(&self, lens: &Lens, scenery: &Scenery, onto: &mut Silhouette) {
        if self.ends.iter().all(|end| end.z + self.radius_m < NEAREST_M) {
            return;
        }
        let test = Test::new(self.ends, self.radius_m, lens);
        let (rows, columns) = (lens.rows as usize, lens.columns as usize);
        let (first, last) = match self.discs {
            None => (0.0, rows as f64),
            Some([(a, radius_a), (b, radius_b)]) => {
                ((a.y - radius_a).min(b.y - radius_b), (a.y + radius_a).max(b.y + radius_b))
            }
        };
        if last < 0.0 || first >= rows as f64 {
            return;
        }
        for row in first.max(0.0) as usize..=(last.min(rows as f64 - 1.0) as usize) {
            let Some((from, to)) = self.may_reach(row as f64 + 0.5, columns) else { continue };
            let Some((left, depth_left)) = (from..=to).find_map(|column| Some((column, test.depth_m(column, row)?)))
            else {
                continue;
            };
            let right = (left..=to).rev().find_map(|column| Some((column, test.depth_m(column, row)?)));
            let (right, depth_right) = right.unwrap_or((left, depth_left));
            let slope = (depth_right - depth_left) / (right - left).max(1) as f64;
            for (column, &before_m) in (left..=right).zip(&scenery.row(row)[left..=right]) {
                let depth_m = depth_left + slope * (column - left) as f64;
                if (depth_m as f32) < before_m {
                    onto.set(column, row, true);
                }
            }
        }
    }

    /// The columns of a row that may show the capsule.
    fn may_reach(&self, y: f64, columns: usize) -> Option<(usize, usize)> {
        let Some([(a, radius_a), (b, radius_b)]) = self.discs else { return Some((0, columns - 1)) };
        let radius = radius_a.max(radius_b);
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut reach = |x: f64, half: f64| (least, most) = (least.min(x - half), most.max(x + half));
        for disc in [a, b] {
            let half_squared = radius * radius - (y - disc.y) * (y - disc.y);
            if half_squared >= 0.0 {
                reach(disc.x, half_squared.sqrt());
            }
        }
        let along = b - a;
        let across = along.perp().normalize_or_zero() * radius;
        for (from, to) in [(a + across, b + across), (a - across, b - across)] {
            if from.y != to.y && y >= from.y.min(to.y) && y <= from.y.max(to.y) {
                reach(from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y), 0.0);
            }
        }
        if most < 0.0 || least >= columns as f64 {
            return None;
        }
        Some(((least - 0.5).floor().max(0.0) as usize, ((most + 0.5).ceil().min(columns as f64 - 1.0)) as usize))
    }
}

/// A test whether pixels show a capsule, prepared for all pixels.
struct Test<'l> {
    lens: &'l Lens,
    ends: [Point3; 2],
    /// Products of the ends with themselves and each other.
    products: [f64; 3],
    radius_squared: f64,
}

impl<'l> Test<'l> {
    fn new(ends: [Point3; 2], radius_m: f64, lens: &'l Lens) -> Test<'l> {
        let [a, b] = ends;
        Test { lens, ends, products: [a.dot(a), a.dot(b), b.dot(b)], radius_squared: radius_m * radius_m }
    }

    /// The distance of the capsule's axis along the camera's axis in a pixel of it; `None` in others.
    fn depth_m(&self, column: usize, row: usize) -> Option<f64> {
        let way = self.lens.ray(column as u32, row as u32);
        let [a, b] = self.ends;
        let length_squared = way.dot(way);
        let (along_a, along_b) = (a.dot(way), b.dot(way));
        // Seen along the way, the axis is a segment between two points; these are their products.
        let [aa, ab, bb] = [
            self.products[0] - along_a * along_a / length_squared,
            self.products[1] - along_a * along_b / length_squared,
            self.products[2] - along_b * along_b / length_squared,
        ];
        let squared = aa - 2.0 * ab + bb;
        let share = if squared > 1e-12 { ((aa - ab) / squared).clamp(0.0, 1.0) } else { 0.0 };
        let rest = 1.0 - share;
        let distance_squared = aa * rest * rest + 2.0 * ab * share * rest + bb * share * share;
        let depth_m = a.z * rest + b.z * share;
        (distance_squared <= self.radius_squared && depth_m > NEAREST_M).then_some(depth_m)
    }
}

#[cfg(test)]
mod tests {
    use super::super::scenery::Prism;
    use super::*;
    use std::f64::consts::PI;

    fn lens() -> Lens {
        Lens::new(Point3::new(0.0, 0.0, 1.0), 0.0, 0.0, 1.2, [160, 120])
    }

    fn painted(figure: &[Capsule], lens: &Lens, prisms: &[Prism]) -> Silhouette {
        let mut picture = Silhouette::new(160, 120);
        paint(figure, lens, &Scenery::new(lens, prisms), &mut picture);
        picture
    }

    #[test]
    fn a_ball_on_the_axis_is_as_large_as_a_closed_formula_says() {
        let ball = Capsule { from: Point3::new(4.0, 0.0, 1.0), to: Point3::new(4.0, 0.0, 1.0), radius_m: 0.5 };
        let lens = lens();
        let sine: f64 = 0.5 / 4.0;
        let radius_px = lens.focal_px * sine / (1.0 - sine * sine).sqrt();
        let features = painted(&[ball], &lens, &[]).features().unwrap();
        let expected = PI * radius_px * radius_px;
        assert!((f64::from(features.area_px) - expected).abs() / expected < 0.03, "{features:?} {expected}");
        assert!((features.centroid_px[0] - 80.0).abs() < 0.01 && (features.centroid_px[1] - 60.0).abs() < 0.01);
    }

    #[test]
    fn spans_are_what_testing_every_pixel_finds() {
        let lens = Lens::new(Point3::new(0.2, -0.3, 2.2), 0.3, 0.5, 1.3, [160, 120]);
        let far = Scenery::new(&lens, &[]);
        let mut number = 1u64;
        let mut unit = || {
            number = number.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (number >> 33) as f64 / (1u64 << 31) as f64
        };
        for _ in 0..300 {
            let mut end = || Point3::new(0.3 + 5.0 * unit(), 4.0 * unit() - 1.5, 2.0 * unit());
            let capsule = Capsule { from: end(), to: end(), radius_m: 0.02 + 0.2 * unit() };
            let test = Test::new([lens.seen(capsule.from), lens.seen(capsule.to)], capsule.radius_m, &lens);
            let picture = painted(&[capsule], &lens, &[]);
            let mut wrong = 0;
            for (row, column) in (0..120).flat_map(|row| (0..160).map(move |column| (row, column))) {
                let depth = test.depth_m(column, row).filter(|&depth| (depth as f32) < far.depth_m(column, row));
                wrong += u32::from(depth.is_some() != picture.is_set(column, row));
            }
            // At the point of a limb in the floor, its depth along a row is not quite straight.
            assert!(wrong <= 8, "{wrong} pixels of {capsule:?}");
        }
    }

    #[test]
    fn things_in_front_of_a_body_hide_it() {
        let pole = Capsule { from: Point3::new(4.0, 0.0, 0.2), to: Point3::new(4.0, 0.0, 1.6), radius_m: 0.1 };
        let corner = |x: f64, y: f64| Point::new(x, y);
        let wall = |height_m| Prism {
            outline: vec![corner(2.0, -1.0), corner(2.1, -1.0), corner(2.1, 1.0), corner(2.0, 1.0)],
            height_m,
        };
        let lens = lens();
        let all = painted(&[pole], &lens, &[]).area_px();
        assert!(all > 200);
        assert_eq!(painted(&[pole], &lens, &[wall(f64::INFINITY)]).area_px(), 0);
        // A wall of 1 m at eye height hides what is below 1 m: 0.6 + 0.1 of 1.4 + 0.2 m are left.
        let half = painted(&[pole], &lens, &[wall(1.0)]).area_px();
        assert!((f64::from(half) / f64::from(all) - 0.7 / 1.6).abs() < 0.04, "{half} of {all}");
        // One behind it hides nothing, and who is behind the camera is not seen.
        let behind = Capsule { from: -pole.from, to: -pole.to, ..pole };
        assert_eq!(painted(&[behind], &lens, &[]).area_px(), 0);
    }
}
