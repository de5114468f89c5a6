//! Rooms, and their outlines in order: without repeated corners, corners within a side, and crossing sides.

use homebody_core::geometry::{self, Point};

#[derive(Clone, Debug)]
pub struct NamedRoom {
    pub name: String,
    pub outline: Vec<Point>,
    /// The floor in a home with several.
    pub floor: Option<String>,
}

impl NamedRoom {
    pub fn new(name: String, outline: Vec<Point>) -> NamedRoom {
        NamedRoom { name, outline, floor: None }
    }
}

/// Distance from each other, or from the line of their neighbours, below which corners are dropped (our choice): files
/// round to millimetres.
pub const SAME_M: f64 = 0.0015;

/// Largest number of holes in the outline of a room (our choice).
const MOST_HOLES: usize = 20;

/// Area below which a room is a slip of the mouse (our choice).
const LEAST_AREA_M2: f64 = 0.05;

/// The outline without superfluous corners; empty if it encloses nothing.
pub fn tidy(outline: &[Point]) -> Vec<Point> {
    let mut outline: Vec<Point> = outline.iter().map(|&corner| rounded(corner)).collect();
    let mut at = 0;
    // Each step forward is one of at most `len`, each step back follows a removal.
    while outline.len() > 2 && at < outline.len() {
        let n = outline.len();
        let (before, corner, next) = (outline[(at + n - 1) % n], outline[at], outline[(at + 1) % n]);
        let is_spike = (corner - before).dot(next - corner) < 0.0
            && geometry::distance_to_segment(next, before, corner)
                .min(geometry::distance_to_segment(before, corner, next))
                < SAME_M;
        if is_spike || geometry::distance_to_segment(corner, before, next) < SAME_M {
            outline.remove(at);
            at = at.saturating_sub(2);
        } else {
            at += 1;
        }
    }
    if outline.len() > 2 { outline } else { Vec::new() }
}

pub fn is_sound(outline: &[Point]) -> bool {
    outline.len() > 2 && !geometry::crosses_itself(outline) && geometry::signed_area(outline).abs() >= LEAST_AREA_M2
}

/// The outline in an order without crossing sides, if one is nearby.
///
/// The part between two crossing sides is reversed: that makes the outline shorter, so the loop ends.
pub fn untangled(outline: &[Point]) -> Option<Vec<Point>> {
    let mut outline = tidy(outline);
    for _ in 0..=outline.len() {
        let n = outline.len();
        let sides: Vec<(Point, Point)> = geometry::sides(&outline).collect();
        let crossed = (0..n).find_map(|i| {
            let meets = |&j: &usize| {
                !(i == 0 && j == n - 1) && geometry::segments_meet(sides[i].0, sides[i].1, sides[j].0, sides[j].1)
            };
            (i + 2..n).find(meets).map(|j| (i, j))
        });
        match crossed {
            Some((i, j)) => outline[i + 1..=j].reverse(),
            None => return Some(outline).filter(|outline| is_sound(outline)),
        }
        outline = tidy(&outline);
    }
    None
}

/// The outline without the holes in it, and their number.
///
/// Plans draw a hole, such as one for stairs, by a way to it, around it and back by the same way. A hole is filled.
pub fn filled(mut outline: Vec<Point>) -> (Vec<Point>, usize) {
    let mut holes = 0;
    while holes < MOST_HOLES
        && let Some((out, back)) = bridge(&outline)
    {
        let around = |from: usize, to: usize| outline[from..to].to_vec();
        let (inner, outer) =
            (around(out + 1, back + 1), [around(0, out + 1), around(back + 1, outline.len())].concat());
        let area = |ring: &[Point]| geometry::signed_area(ring).abs();
        outline = tidy(if area(&inner) > area(&outer) { &inner } else { &outer });
        holes += 1;
    }
    (outline, holes)
}

/// Two sides along the same line, in opposite directions.
fn bridge(outline: &[Point]) -> Option<(usize, usize)> {
    /// Length below which a side is a spike (our choice).
    const LEAST_M: f64 = 0.02;
    let sides: Vec<(Point, Point)> = geometry::sides(outline).collect();
    let is_bridge = |(a, b): (Point, Point), (c, d): (Point, Point)| {
        let along = (b - a).normalize_or_zero();
        let off_m = |p: Point| (p - a).perp_dot(along).abs();
        let (begin, end) = ((d - a).dot(along), (c - a).dot(along));
        let shared_m = end.min(a.distance(b)) - begin.max(0.0);
        off_m(c).max(off_m(d)) < SAME_M && end > begin && shared_m > LEAST_M
    };
    (0..sides.len()).find_map(|i| (i + 1..sides.len()).find(|&j| is_bridge(sides[i], sides[j])).map(|j| (i, j)))
}

/// The corners of a rectangle that is turned counter-clockwise.
pub fn rectangle(middle: Point, [width_m, depth_m]: [f64; 2], turn_deg: f64) -> [Point; 4] {
    let along = geometry::direction(turn_deg);
    let (x, y) = (along * (width_m / 2.0), along.perp() * (depth_m / 2.0));
    [x + y, y - x, -x - y, x - y].map(|corner| middle + corner)
}

/// The point in whole millimetres, as in the file.
pub fn rounded(p: Point) -> Point {
    // Adding zero turns a negative zero into a positive one.
    (p * 1e3).round() / 1e3 + Point::ZERO
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(corners: &[(f64, f64)]) -> Vec<Point> {
        corners.iter().map(|&corner| Point::from(corner)).collect()
    }

    #[test]
    fn superfluous_corners_are_removed() {
        let square = outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)]);
        let rich = [(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 0.0), (4.0, 3.0), (6.0, 3.0), (0.0, 3.0), (0.0, 1.0)];
        assert_eq!(tidy(&outline(&rich)), square);
        // There and back again, with a spike on the spike.
        let spiky = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (5.0, 3.0), (5.0, 4.0), (5.0, 3.0), (4.0, 3.0), (0.0, 3.0)];
        assert_eq!(tidy(&outline(&spiky)), square);
        assert!(tidy(&outline(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)])).is_empty());
        assert!(tidy(&outline(&[(1.0, 1.0); 5])).is_empty());
    }

    #[test]
    fn a_bow_tie_is_untangled() {
        let tie = outline(&[(0.0, 0.0), (4.0, 3.0), (4.0, 0.0), (0.0, 3.0)]);
        let square = untangled(&tie).unwrap();
        assert_eq!(geometry::signed_area(&square).abs(), 12.0);
        assert_eq!(untangled(&outline(&[(0.0, 0.0), (4.0, 0.0), (8.0, 0.0)])), None);
    }
}
