//! Postures of the limbs.
//!
//! Limbs bend in the plane of the facing, and are spread to the side out of it. A body on its side has all of that
//! rolled over. A stance is a fixed set of angles with the height of the hips; walking moves legs and arms on top of
//! it.
//!
//! We assume that a body moves from one stance to another along straight lines of these numbers, which looks right for what
//! takes seconds.
//!
//! Left out: turning the head, crossing the legs.

use super::shares::{share, thick};
use crate::geometry::Point;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A posture as a silhouette shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stance {
    /// Upright.
    Standing,
    /// On a seat.
    Sitting,
    /// On the back.
    Lying,
    /// On the belly, with the hands next to the chest, as after a fall to the front.
    Prone,
    /// On the left side, with bent hips and knees.
    OnLeftSide,
    /// On the right side, with bent hips and knees.
    OnRightSide,
    /// Upright on both knees.
    Kneeling,
    /// Bent forward from the hips, with hands that reach down.
    Bending,
    /// On hands and knees.
    Crawling,
}

/// The hips: the middle between both hip joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hips {
    /// Seen from above, in metres.
    pub at: Point,
    /// Above the floor, in metres.
    pub up_m: f64,
}

/// The limbs of one side, as angles in the plane of the facing: 0 hangs down, a quarter turn points to the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Of the thigh.
    pub thigh_rad: f64,
    /// Of the shank.
    pub shank_rad: f64,
    /// Of the upper arm.
    pub arm_rad: f64,
    /// Of the forearm with the hand.
    pub forearm_rad: f64,
    /// The angle of the leg to its side, out of the plane.
    pub leg_out_rad: f64,
    /// The angle of the arm to its side, out of the plane.
    pub arm_out_rad: f64,
}

/// All joints of a person.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints {
    /// The position of the body.
    pub hips: Hips,
    /// The facing: 0 is east, a quarter turn north.
    pub facing_rad: f64,
    /// The lean of the trunk to the front; 0 is upright, below 0 to the back.
    pub trunk_rad: f64,
    /// The roll of the body about the trunk's length: below 0, the front of a body that leans forward comes to the
    /// right.
    pub roll_rad: f64,
    /// Its left limbs.
    pub left: Side,
    /// Its right limbs.
    pub right: Side,
}

/// Angle between hanging arms and the sides (our choice).
const ARM_OUT_RAD: f64 = 0.12;

/// A chair's seat where no piece of furniture says how high it is, in metres.
pub const SEAT_M: f64 = 0.45;

impl Joints {
    /// The joints of a stance at the origin, facing east, of a person of this height above a support, which is the floor at 0,
    /// a seat or a mattress.
    pub fn new(stance: Stance, height_m: f64, support_m: f64) -> Joints {
        let side = |thigh: f64, shank: f64, arm: f64, forearm: f64| Side {
            thigh_rad: thigh,
            shank_rad: shank,
            arm_rad: arm,
            forearm_rad: forearm,
            leg_out_rad: 0.0,
            arm_out_rad: 0.0,
        };
        let (up_m, trunk_rad, both) = match stance {
            Stance::Standing => (share::HIP * height_m + support_m, 0.0, side(0.0, 0.0, 0.05, 0.15)),
            Stance::Sitting => {
                let seat_m = if support_m > 0.2 { support_m } else { SEAT_M };
                let up_m = seat_m + thick::THIGH * height_m;
                // With a seat lower than the length of the shank, the knees are higher than the hips.
                let rise = (share::HIP - share::THIGH) * height_m - up_m;
                let lift = libm::asin((rise / (share::THIGH * height_m)).clamp(-0.4, 0.4));
                (up_m, -0.12, side(FRAC_PI_2 + lift, 0.0, 0.3, 1.1))
            }
            Stance::Lying => {
                let up_m = support_m + thick::TRUNK * height_m;
                (up_m, -FRAC_PI_2, side(FRAC_PI_2 - 0.06, FRAC_PI_2 - 0.1, FRAC_PI_2 - 0.05, FRAC_PI_2))
            }
            Stance::Prone => {
                let up_m = support_m + thick::TRUNK * height_m;
                (up_m, FRAC_PI_2, side(-FRAC_PI_2 + 0.05, -FRAC_PI_2 + 0.08, 0.3 - FRAC_PI_2, FRAC_PI_2))
            }
            Stance::OnLeftSide | Stance::OnRightSide => {
                let up_m = support_m + share::SHOULDER_HALF_WIDTH * height_m;
                (up_m, FRAC_PI_2, side(0.5 - FRAC_PI_2, -0.2 - FRAC_PI_2, 0.8 - FRAC_PI_2, 0.1))
            }
            Stance::Kneeling => {
                let up_m = share::THIGH * height_m + thick::SHANK * height_m + support_m;
                (up_m, 0.05, side(0.0, -FRAC_PI_2, 0.1, 0.6))
            }
            Stance::Bending => (share::HIP * 0.97 * height_m + support_m, 1.75, side(-0.12, 0.1, 0.5, 0.4)),
            Stance::Crawling => {
                let up_m = share::THIGH * height_m + thick::SHANK * height_m + support_m;
                (up_m, FRAC_PI_2 + 0.06, side(0.0, -FRAC_PI_2, 0.15, -0.15))
            }
        };
        // A body on its side lies on that arm.
        let (roll_rad, arm_out_rad) = match stance {
            Stance::OnLeftSide => (-FRAC_PI_2, 0.0),
            Stance::OnRightSide => (FRAC_PI_2, 0.0),
            _ => (0.0, ARM_OUT_RAD),
        };
        let both = Side { arm_out_rad, ..both };
        Joints { hips: Hips { at: Point::ZERO, up_m }, facing_rad: 0.0, trunk_rad, roll_rad, left: both, right: both }
    }

    /// The same after a fall: from 0 to 1, the distance of the left and the right arm, the left and the right leg from
    /// their usual places. A body on the belly or the back spreads them; one on its side bends them.
    pub fn sprawled(mut self, far: [f64; 4]) -> Joints {
        let is_on_side = self.roll_rad != 0.0;
        for (side, [arm, leg]) in [(&mut self.left, [far[0], far[2]]), (&mut self.right, [far[1], far[3]])] {
            if is_on_side {
                side.thigh_rad += 1.0 * leg;
                side.shank_rad -= 0.3 * leg;
                side.arm_rad += 0.6 * arm;
                side.forearm_rad += 0.8 * arm;
            } else {
                side.arm_out_rad += 1.3 * arm;
                side.leg_out_rad += 0.4 * leg;
            }
        }
        self
    }

    /// The same at a place, facing this way.
    pub fn at(self, at: Point, facing_rad: f64) -> Joints {
        Joints { hips: Hips { at, ..self.hips }, facing_rad, ..self }
    }

    /// The same in the course of a step: `phase` goes through a circle with two steps, `swing` is from 0, standing, to 1, a full
    /// stride. Angles of hips and knees are those of gait laboratories, rounded: thighs swing 25 degrees to either side, a knee
    /// bends 55 in its swing (Winter, Biomechanics).
    pub fn walking(mut self, phase: f64, swing: f64) -> Joints {
        for (side, phase) in [(&mut self.left, phase), (&mut self.right, phase + PI)] {
            let forward = libm::sin(phase);
            // The knee bends while the thigh comes forward.
            let bend = libm::cos(phase).max(0.0);
            side.thigh_rad += swing * (0.40 * forward + 0.08 * bend);
            side.shank_rad += swing * (0.40 * forward - 0.80 * bend);
            side.arm_rad -= swing * 0.35 * forward;
            side.forearm_rad -= swing * 0.25 * forward;
        }
        self
    }

    /// Between these joints (0) and others (1). Facings go the shorter way around.
    pub fn towards(&self, other: &Joints, share: f64) -> Joints {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let side = |a: &Side, b: &Side| Side {
            thigh_rad: mix(a.thigh_rad, b.thigh_rad),
            shank_rad: mix(a.shank_rad, b.shank_rad),
            arm_rad: mix(a.arm_rad, b.arm_rad),
            forearm_rad: mix(a.forearm_rad, b.forearm_rad),
            leg_out_rad: mix(a.leg_out_rad, b.leg_out_rad),
            arm_out_rad: mix(a.arm_out_rad, b.arm_out_rad),
        };
        Joints {
            hips: Hips { at: self.hips.at.lerp(other.hips.at, share), up_m: mix(self.hips.up_m, other.hips.up_m) },
            facing_rad: self.facing_rad + turn(self.facing_rad, other.facing_rad) * share,
            trunk_rad: mix(self.trunk_rad, other.trunk_rad),
            roll_rad: mix(self.roll_rad, other.roll_rad),
            left: side(&self.left, &other.left),
            right: side(&self.right, &other.right),
        }
    }
}

/// The shorter turn from one direction to another, from minus half a turn to half a turn.
pub fn turn(from_rad: f64, to_rad: f64) -> f64 {
    let turn = (to_rad - from_rad) % TAU;
    if turn > PI {
        turn - TAU
    } else if turn < -PI {
        turn + TAU
    } else {
        turn
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_go_the_shorter_way() {
        assert!((turn(0.1, TAU - 0.1) + 0.2).abs() < 1e-12);
        assert!((turn(TAU - 0.1, 0.1) - 0.2).abs() < 1e-12);
        assert!((turn(0.0, 3.0) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn both_legs_take_turns_and_after_two_steps_all_is_as_before() {
        let still = Joints::new(Stance::Standing, 1.65, 0.0);
        let (begin, half, whole) =
            (still.walking(1.0, 1.0), still.walking(1.0 + PI, 1.0), still.walking(1.0 + TAU, 1.0));
        assert!((begin.left.thigh_rad - half.right.thigh_rad).abs() < 1e-12);
        assert!((begin.left.shank_rad - whole.left.shank_rad).abs() < 1e-12);
        assert_eq!(still.walking(1.0, 0.0), still);
    }
}
