//! How much two outlines have in common.
//!
//! Between neighbouring heights at which either outline has a corner or the two cross, everything is
//! trapezoids, so their middle line times their height is their area: exact for outlines of any shape.

use crate::geometry::{self, Point};

/// The area inside both outlines; neither crosses itself.
pub fn area(a: &[Point], b: &[Point]) -> f64 {
    let ((a_least, a_most), (b_least, b_most)) =
        (geometry::bounds(a.iter().copied()), geometry::bounds(b.iter().copied()));
    let (least, most) = (a_least.max(b_least), a_most.min(b_most));
    if least.x >= most.x || least.y >= most.y {
        return 0.0;
    }
    let mut heights: Vec<f64> = a.iter().chain(b).map(|corner| corner.y).collect();
    for (p, q) in geometry::sides(a) {
        heights.extend(geometry::sides(b).filter_map(|(r, s)| crossing(p, q, r, s)));
    }
    heights.retain(|&y| y >= least.y && y <= most.y);
    heights.sort_by(f64::total_cmp);
    heights.windows(2).map(|pair| shared_width(a, b, (pair[0] + pair[1]) / 2.0) * (pair[1] - pair[0])).sum()
}

/// The height at which two segments cross.
fn crossing(p: Point, q: Point, r: Point, s: Point) -> Option<f64> {
    let (along, other) = (q - p, s - r);
    let turn = along.perp_dot(other);
    let t = (r - p).perp_dot(other) / turn;
    let u = (r - p).perp_dot(along) / turn;
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)).then_some(p.y + along.y * t)
}

/// The length of the horizontal line at this height that is inside both.
fn shared_width(a: &[Point], b: &[Point], y: f64) -> f64 {
    let (a, b) = (spans(a, y), spans(b, y));
    let shared = |(from, to): &(f64, f64), (start, end): &(f64, f64)| (to.min(*end) - from.max(*start)).max(0.0);
    a.iter().map(|span| b.iter().map(|other| shared(span, other)).sum::<f64>()).sum()
}

/// Where the horizontal line at this height is inside the outline.
fn spans(outline: &[Point], y: f64) -> Vec<(f64, f64)> {
    let mut ends: Vec<f64> = geometry::sides(outline)
        .filter(|(a, b)| (a.y > y) != (b.y > y))
        .map(|(a, b)| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x))
        .collect();
    ends.sort_by(f64::total_cmp);
    ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(corners: &[[f64; 2]]) -> Vec<Point> {
        corners.iter().map(|&at| geometry::point(at)).collect()
    }

    #[test]
    fn outlines_share_what_squares_show() {
        let unit = outline(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let shifted = outline(&[[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]]);
        let beside = outline(&[[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]]);
        let diamond = outline(&[[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]]);
        assert_eq!(area(&unit, &unit), 1.0);
        assert_eq!(area(&unit, &shifted), 0.25);
        assert_eq!(area(&unit, &beside), 0.0);
        assert_eq!(area(&unit, &diamond), 0.5);
        assert_eq!(area(&diamond, &shifted), 0.125);
    }

    #[test]
    fn a_room_around_another_does_not_overlap_it() {
        let corner = outline(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]]);
        let nested = outline(&[[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]);
        assert_eq!(area(&corner, &nested), 0.0);
    }
}
