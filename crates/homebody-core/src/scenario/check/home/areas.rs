//! Areas: whether an outline is one, and whether it keeps to the home.

use super::{Report, TOLERANCE_M};
use crate::geometry::{self, Point};
use crate::home::plan::Plan;
use crate::scenario::home::REACH_OUT_M;

/// Smaller areas are none.
const LEAST_AREA_M2: f64 = 1e-6;

/// Whether the outline is a convex area; says what is wrong with it if not.
pub fn check_convex(report: &mut Report, pointer: &str, outline: &[Point], subject: &str) -> bool {
    let what = if is_flat(outline) {
        "has no area"
    } else if geometry::crosses_itself(outline) {
        "crosses itself"
    } else if !geometry::is_convex(outline) {
        "must be convex"
    } else {
        return true;
    };
    let hint = (what == "must be convex").then(|| "make it of several convex pieces".to_string());
    report.problems.push(report.source.problem(pointer, format!("{subject} {what}"), hint));
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
