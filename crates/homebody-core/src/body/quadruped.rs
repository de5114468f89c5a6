//! A cat or a small dog as capsules: a trunk along the facing, a head in front, four legs and a tail.
//!
//! We assume that bodies lower than 60 cm walk on four legs, and that the height of a body is that of the head.
//!
//! Left out: breeds, sitting animals, jumps onto furniture.

use super::figure::{Capsule, Figure, Point3, Stature};
use crate::geometry::Point;

/// Height below which a resident walks on four legs, in metres (our choice).
pub const LOWEST_PERSON_M: f64 = 0.6;

/// An animal of this size, at a place and facing this way. `phase` is that of its steps, `swing` how far they go; who lies
/// keeps its legs below the trunk.
pub fn animal(stature: &Stature, at: Point, facing_rad: f64, up_m: f64, lies: bool, phase: f64, swing: f64) -> Figure {
    let height = stature.height_m;
    let facing = Point3::new(libm::cos(facing_rad), libm::sin(facing_rad), 0.0);
    let left = Point3::new(-facing.y, facing.x, 0.0);
    // A cat of 0.3 m at the head has a trunk of 0.3 m, and a back at 0.25 m.
    let (trunk_m, thick_m) = (1.0 * height, 0.2 * height);
    let belly_m = if lies { thick_m } else { 0.62 * height };
    let middle = at.extend(up_m + belly_m);
    let (front, back) = (middle + facing * (trunk_m / 2.0), middle - facing * (trunk_m / 2.0));
    let head = front + facing * (0.2 * height) + Point3::Z * (0.2 * height);
    let tail = back - facing * (0.5 * height) + Point3::Z * (0.1 * height);
    let mut figure = vec![
        Capsule { from: back, to: front, radius_m: thick_m },
        Capsule { from: head, to: head, radius_m: 0.17 * height },
        Capsule { from: back, to: tail, radius_m: 0.05 * height },
    ];
    if lies {
        return figure;
    }
    for (end, turn) in [(front, 0.0), (back, std::f64::consts::FRAC_PI_2)] {
        for (side, turn) in [(left, turn), (-left, turn + std::f64::consts::PI)] {
            let hip = end + side * (0.12 * height);
            let reach = facing * (swing * 0.25 * height * libm::sin(phase + turn));
            let paw = Point3::new(hip.x, hip.y, up_m + 0.04 * height) + reach;
            figure.push(Capsule { from: hip, to: paw, radius_m: 0.06 * height });
        }
    }
    figure
}

#[cfg(test)]
mod tests {
    use super::super::figure::bounds;
    use super::*;

    #[test]
    fn a_cat_is_as_high_as_its_build_and_longer_than_high() {
        let stature = Stature { radius_m: 0.1, height_m: 0.3 };
        let (least, most) = bounds(&animal(&stature, Point::new(1.0, 1.0), 0.0, 0.0, false, 0.3, 1.0));
        assert!((0.27..0.32).contains(&most.z), "{most}");
        assert!(least.z.abs() < 0.02 && most.x - least.x > 1.4 * 0.3);
    }
}
