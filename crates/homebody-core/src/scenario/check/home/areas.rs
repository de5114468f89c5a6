//! Areas: whether an outline is one, and whether it keeps to the home.

use super::messages::HomeMessage;
use super::{ProblemReport, TOLERANCE_M};
use crate::geometry::{self, Point};
use crate::home::form::REACH_OUT_M;
use crate::plan::Plan;

/// Largest size of an area that counts as empty.
const LEAST_AREA_M2: f64 = 1e-6;

/// Whether the outline is a convex area; says what is wrong with it if not.
pub fn check_convex(report: &mut ProblemReport, pointer: &str, outline: &[Point], subject: &str) -> bool {
    let what = subject.to_owned();
    let message = if is_flat(outline) {
        HomeMessage::NoArea { what }
    } else if geometry::crosses_itself(outline) {
        HomeMessage::CrossesItself { what }
    } else if !geometry::is_convex(outline) {
        HomeMessage::NotConvex { what }
    } else {
        return true;
    };
    report.add(pointer, message);
    false
}

/// Whether all corners lie on one line.
pub fn is_flat(outline: &[Point]) -> bool {
    let from_first = |corner: Point| corner - outline[0];
    let fan = geometry::sides(outline).map(|(a, b)| from_first(a).perp_dot(from_first(b)).abs());
    fan.sum::<f64>() / 2.0 < LEAST_AREA_M2
}

/// Whether an area keeps to the home, up to the thickness of its walls.
pub fn keeps_within(plan: &Plan, outline: &[Point]) -> bool {
    let corners = outline.iter().all(|&corner| plan.distance_outside(corner) <= REACH_OUT_M);
    corners && plan.distance_outside(geometry::inner_point(outline)) <= TOLERANCE_M
}
