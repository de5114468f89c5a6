//! A body as a set of capsules.
//!
//! A person is a head on a neck, a trunk of two capsules side by side, and arms and legs of two limbs each, with feet.
//!
//! We assume that lengths are fixed shares of the height, by Drillis and Contini (1966) as Winter's Biomechanics prints them,
//! and that thickness goes with the radius of the body.
//!
//! Joints become points in space from the hips outward: the trunk upward, each leg and each arm downward. A body on its
//! side is then rolled about the trunk's length.
//!
//! Left out: hands, clothes, carried things, and the give of soft tissue.

use super::joints::{Joints, Side};
use super::shares::{share, thick};
use crate::geometry::Point;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// A point in space, in metres: x to the east, y to the north, z up from the floor.
pub type Point3 = glam::DVec3;

/// All points within a radius of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// One end of the segment.
    pub from: Point3,
    /// The other end.
    pub to: Point3,
    /// The distance of the surface from the segment, in metres.
    pub radius_m: f64,
}

/// The size of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stature {
    /// The radius of the body seen from above, in metres.
    pub radius_m: f64,
    /// Its height when it stands, in metres.
    pub height_m: f64,
}

/// A body at an instant.
pub type Figure = Vec<Capsule>;

/// The radius of a body of usual girth, as a share of the height: half the width of the shoulders.
const USUAL_RADIUS: f64 = share::SHOULDER_HALF_WIDTH;

/// Share of the excess of a resident's radius over the usual one that counts (our choice): the radius leaves room for
/// swaying.
const GIRTH_SHARE: f64 = 0.5;

fn girth(stature: &Stature) -> f64 {
    let times = stature.radius_m / (USUAL_RADIUS * stature.height_m);
    (1.0 + (times - 1.0) * GIRTH_SHARE).clamp(0.7, 1.6)
}

/// The capsules of a person of this size who holds the limbs so.
pub fn person(stature: &Stature, joints: &Joints) -> Figure {
    let height = stature.height_m;
    let girth = girth(stature);
    let facing = Point::new(libm::cos(joints.facing_rad), libm::sin(joints.facing_rad)).extend(0.0);
    let left = Point3::new(-facing.y, facing.x, 0.0);
    let hips = joints.hips.at.extend(joints.hips.up_m);
    let up = facing * libm::sin(joints.trunk_rad) + Point3::Z * libm::cos(joints.trunk_rad);
    // 0 hangs down, a quarter turn points to the front; what is out of this plane is so to a side.
    let limb = |angle: f64, out: Point3| {
        let spread = out.length();
        out + (facing * libm::sin(angle) - Point3::Z * libm::cos(angle)) * (1.0 - spread * spread).max(0.0).sqrt()
    };
    let capsule = |from: Point3, to: Point3, share: f64| Capsule { from, to, radius_m: share * height * girth };

    let shoulders = hips + up * (share::TRUNK * height);
    let head_radius_m = thick::HEAD * height;
    let crown = shoulders + up * (share::ABOVE_SHOULDERS * height);
    let head = crown - up * head_radius_m;
    let chin = crown - up * (1.6 * head_radius_m);
    let mut figure = Vec::with_capacity(15);
    figure.push(Capsule { from: chin, to: head, radius_m: head_radius_m });
    figure.push(capsule(shoulders, chin, thick::NECK));
    for side in [left, -left] {
        let beside = |half_width: f64| side * ((half_width - thick::TRUNK) * height);
        let top = shoulders + beside(share::CHEST_HALF_WIDTH) - up * (0.75 * thick::TRUNK * height);
        figure.push(capsule(hips + beside(share::HIP_HALF_WIDTH), top, thick::TRUNK));
    }
    for (side, limbs) in [(left, joints.left), (-left, joints.right)] {
        let Side { thigh_rad, shank_rad, arm_rad, forearm_rad, leg_out_rad, arm_out_rad } = limbs;
        let leg = |angle: f64| limb(angle, side * libm::sin(leg_out_rad));
        let arm = |angle: f64| limb(angle, side * libm::sin(arm_out_rad));
        let hip = hips + side * ((share::HIP_HALF_WIDTH - thick::THIGH) * height);
        let knee = hip + leg(thigh_rad) * (share::THIGH * height);
        let ankle = knee + leg(shank_rad) * (share::SHANK * height);
        // A foot is at a right angle to its shank, and stretched where the shank points backward, as in kneeling.
        let stretched = (1.0 + shank_rad / FRAC_PI_4).clamp(0.0, 1.0);
        let toes = ankle + leg(shank_rad + FRAC_PI_2 * stretched) * (share::FOOT * height * 0.75);
        figure.push(capsule(hip, knee, thick::THIGH));
        figure.push(capsule(knee, ankle, thick::SHANK));
        figure.push(capsule(ankle, toes, thick::FOOT));
        // The joint is as far inside as its arm is thick, and as far below the shoulder.
        let joint = side * (share::SHOULDER_HALF_WIDTH - thick::UPPER_ARM) - up * thick::UPPER_ARM;
        let shoulder = shoulders + joint * height;
        let elbow = shoulder + arm(arm_rad) * (share::UPPER_ARM * height);
        let hand = elbow + arm(forearm_rad) * ((share::FOREARM + 0.5 * share::HAND) * height);
        figure.push(capsule(shoulder, elbow, thick::UPPER_ARM));
        figure.push(capsule(elbow, hand, thick::FOREARM));
    }
    if joints.roll_rad != 0.0 {
        let roll =
            Roll { about: hips, along: up, sine: libm::sin(joints.roll_rad), cosine: libm::cos(joints.roll_rad) };
        for capsule in &mut figure {
            (capsule.from, capsule.to) = (roll.of(capsule.from), roll.of(capsule.to));
        }
    }
    figure
}

/// A turn about a line, by Rodrigues' formula.
struct Roll {
    about: Point3,
    along: Point3,
    sine: f64,
    cosine: f64,
}

impl Roll {
    fn of(&self, point: Point3) -> Point3 {
        let from = point - self.about;
        let across = self.along.cross(from);
        let stays = self.along * self.along.dot(from);
        self.about + stays + (from - stays) * self.cosine + across * self.sine
    }
}

/// The least and the greatest corner of a figure.
pub fn bounds(figure: &[Capsule]) -> (Point3, Point3) {
    let none = (Point3::INFINITY, Point3::NEG_INFINITY);
    figure.iter().fold(none, |(least, most), capsule| {
        let ends = (capsule.from.min(capsule.to), capsule.from.max(capsule.to));
        (least.min(ends.0 - capsule.radius_m), most.max(ends.1 + capsule.radius_m))
    })
}

#[cfg(test)]
mod tests {
    use super::super::joints::Stance;
    use super::*;

    #[test]
    fn a_standing_body_has_its_height_and_both_feet_on_the_floor() {
        for height_m in [1.5, 1.65, 1.9] {
            let stature = Stature { radius_m: 0.2, height_m };
            let joints = Joints::new(Stance::Standing, height_m, 0.0).at(Point::new(2.0, 1.0), 0.7);
            let (least, most) = bounds(&person(&stature, &joints));
            assert!((most.z - height_m).abs() < 1e-9, "{most}");
            assert!(least.z > -0.02 && least.z < 0.03, "{least}");
            // As wide as shoulders with arms, around where the body is.
            assert!((most - least).truncate().max_element() < 0.36 * height_m);
            assert!(((most + least) / 2.0).truncate().distance(Point::new(2.0, 1.0)) < 0.1 * height_m);
        }
    }

    #[test]
    fn on_the_left_side_the_left_arm_is_below_and_the_knees_are_in_front() {
        let stature = Stature { radius_m: 0.2, height_m: 1.65 };
        // Head to the east: who lies on the left side looks south, on the right side north.
        for (stance, is_left_below, south) in [(Stance::OnLeftSide, true, -1.0), (Stance::OnRightSide, false, 1.0)] {
            let figure = person(&stature, &Joints::new(stance, stature.height_m, 0.0));
            let (left_knee, right_knee) = (figure[4].to, figure[9].to);
            assert_eq!(left_knee.z < right_knee.z, is_left_below, "{left_knee} {right_knee}");
            assert!(left_knee.y * south > 0.1 && right_knee.y * south > 0.1, "{left_knee} {right_knee}");
            assert!(figure[0].to.x > 0.5, "the head is not to the east: {}", figure[0].to);
        }
    }

    #[test]
    fn after_a_fall_a_body_is_not_higher_and_not_in_the_floor() {
        let stature = Stature { radius_m: 0.2, height_m: 1.65 };
        for stance in [Stance::Prone, Stance::Lying, Stance::OnLeftSide, Stance::OnRightSide] {
            for far in [[1.0; 4], [1.0, 0.0, 0.5, 1.0], [0.0; 4]] {
                let (least, most) = bounds(&person(&stature, &Joints::new(stance, 1.65, 0.0).sprawled(far)));
                assert!(least.z > -0.03 && most.z < 0.6, "{stance:?} {far:?}: {least} {most}");
            }
        }
    }

    #[test]
    fn each_stance_has_the_height_of_real_ones() {
        let stature = Stature { radius_m: 0.2, height_m: 1.65 };
        let height = stature.height_m;
        let top = |stance: Stance, support_m: f64| {
            let figure = person(&stature, &Joints::new(stance, height, support_m));
            let (least, most) = bounds(&figure);
            assert!(least.z >= support_m.min(0.0) - 0.03, "{stance:?} is in the floor: {least}");
            most.z / height
        };
        // Sitting height is 0.52 of the stature, above a seat of 0.45 m.
        assert!((0.72..0.84).contains(&top(Stance::Sitting, 0.45)), "{}", top(Stance::Sitting, 0.45));
        assert!((0.12..0.25).contains(&top(Stance::Lying, 0.0)), "{}", top(Stance::Lying, 0.0));
        assert!((0.12..0.25).contains(&top(Stance::Prone, 0.0)));
        for side in [Stance::OnLeftSide, Stance::OnRightSide] {
            assert!((0.2..0.35).contains(&top(side, 0.0)), "{}", top(side, 0.0));
        }
        assert!((0.70..0.82).contains(&top(Stance::Kneeling, 0.0)), "{}", top(Stance::Kneeling, 0.0));
        assert!((0.45..0.68).contains(&top(Stance::Bending, 0.0)), "{}", top(Stance::Bending, 0.0));
    }
}
