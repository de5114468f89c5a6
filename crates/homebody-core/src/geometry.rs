//! Plane geometry on `f64`: what walls, beams and bodies share.

pub mod overlap;

/// A point or a direction on the floor plan, in metres.
pub type Point = glam::DVec2;

/// A point on the floor plan: x to the east, y to the north, in metres.
pub type At = [f64; 2];

/// A point as files write it.
pub fn point(at: At) -> Point {
    Point::new(at[0], at[1])
}

/// The corners of a file as points.
pub fn points(corners: &[At]) -> Vec<Point> {
    corners.iter().map(|&at| point(at)).collect()
}

/// A length rounded to a millimetre.
pub fn whole_millimetres(length_m: f64) -> f64 {
    (length_m * 1000.0).round() / 1000.0
}

/// The direction of an angle: 0 degrees is east, 90 north.
pub fn direction(angle_deg: f64) -> Point {
    let angle = angle_deg.to_radians();
    Point::new(libm::cos(angle), libm::sin(angle))
}

/// The direction of a vector in one of eight words, such as `north-east`.
pub fn compass(towards: Point) -> &'static str {
    /// From east against the clock.
    const WORDS: [&str; 8] = ["east", "north-east", "north", "north-west", "west", "south-west", "south", "south-east"];
    let turn = libm::atan2(towards.y, towards.x).to_degrees().rem_euclid(360.0);
    WORDS[libm::round(turn / 45.0) as usize % WORDS.len()]
}

/// The point of segment `a b` nearest to `p`.
pub fn nearest_on_segment(p: Point, a: Point, b: Point) -> Point {
    let along = b - a;
    let length_squared = along.length_squared();
    if length_squared == 0.0 {
        return a;
    }
    a + along * ((p - a).dot(along) / length_squared).clamp(0.0, 1.0)
}

/// Distance from `p` to segment `a b`.
pub fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    p.distance(nearest_on_segment(p, a, b))
}

/// The distance between two segments.
pub fn distance_between_segments((a, b): (Point, Point), (c, d): (Point, Point)) -> f64 {
    if segments_meet(a, b, c, d) {
        return 0.0;
    }
    let ends = [
        distance_to_segment(a, c, d),
        distance_to_segment(b, c, d),
        distance_to_segment(c, a, b),
        distance_to_segment(d, a, b),
    ];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

/// Whether the segments have a point in common.
pub fn segments_meet(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).perp_dot(r - p);
    let (abc, abd) = (side(a, b, c), side(a, b, d));
    let (cda, cdb) = (side(c, d, a), side(c, d, b));
    if ((abc > 0.0 && abd < 0.0) || (abc < 0.0 && abd > 0.0)) && ((cda > 0.0 && cdb < 0.0) || (cda < 0.0 && cdb > 0.0))
    {
        return true;
    }
    let on = |p: Point, q: Point, r: Point, turn: f64| {
        turn == 0.0 && r.x >= p.x.min(q.x) && r.x <= p.x.max(q.x) && r.y >= p.y.min(q.y) && r.y <= p.y.max(q.y)
    };
    on(a, b, c, abc) || on(a, b, d, abd) || on(c, d, a, cda) || on(c, d, b, cdb)
}

/// The sides of a closed outline, each as its two ends.
pub fn sides(outline: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    (0..outline.len()).map(|i| (outline[i], outline[(i + 1) % outline.len()]))
}

/// Whether `p` lies inside the outline. Of the border, up to rounding, the sides with the inside to their east or north
/// belong to it, so that of areas side by side one contains each point.
#[inline]
pub fn contains(outline: &[Point], p: Point) -> bool {
    let mut inside = false;
    for (a, b) in sides(outline) {
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    inside
}

/// Distance from `p` to the area of the outline: zero inside.
pub fn distance_to_area(outline: &[Point], p: Point) -> f64 {
    if contains(outline, p) { 0.0 } else { distance_to_border(outline, p) }
}

/// The depth of `p` inside the outline: the distance to its border, below 0 outside.
pub fn depth_in_area(outline: &[Point], p: Point) -> f64 {
    let distance = distance_to_border(outline, p);
    if contains(outline, p) { distance } else { -distance }
}

/// Distance from `p` to the outline's border.
pub fn distance_to_border(outline: &[Point], p: Point) -> f64 {
    sides(outline).map(|(a, b)| distance_to_segment(p, a, b)).fold(f64::INFINITY, f64::min)
}

/// Area with its sign: positive where the corners run counter-clockwise.
pub fn signed_area(outline: &[Point]) -> f64 {
    sides(outline).map(|(a, b)| a.perp_dot(b)).sum::<f64>() / 2.0
}

/// Whether the outline is convex and its corners turn one way only.
pub fn is_convex(outline: &[Point]) -> bool {
    let turns = (0..outline.len()).map(|i| {
        let (a, b, c) = (outline[i], outline[(i + 1) % outline.len()], outline[(i + 2) % outline.len()]);
        (b - a).perp_dot(c - b)
    });
    let (mut left, mut right) = (false, false);
    for turn in turns {
        left |= turn > 0.0;
        right |= turn < 0.0;
    }
    left != right
}

/// Whether two sides of the outline cross or touch where they should not.
pub fn crosses_itself(outline: &[Point]) -> bool {
    let sides: Vec<_> = sides(outline).collect();
    let n = sides.len();
    (0..n).any(|i| {
        (i + 2..n).any(|j| !(i == 0 && j == n - 1) && segments_meet(sides[i].0, sides[i].1, sides[j].0, sides[j].1))
    })
}

/// The rectangle around a segment, half of `thickness` to each side, corners counter-clockwise.
pub fn thick_segment(a: Point, b: Point, thickness: f64) -> Vec<Point> {
    let side = (b - a).normalize_or_zero().perp() * (thickness / 2.0);
    vec![a - side, b - side, b + side, a + side]
}

/// The part of segment `a b` inside a convex outline, as fractions of the segment's length.
pub fn segment_inside_convex(outline: &[Point], a: Point, b: Point) -> Option<(f64, f64)> {
    let turn = signed_area(outline).signum();
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (p, q) in sides(outline) {
        let inward = (q - p).perp() * turn;
        let (start, change) = ((a - p).dot(inward), (b - a).dot(inward));
        if change == 0.0 {
            if start < 0.0 {
                return None;
            }
        } else if change > 0.0 {
            enter = enter.max(-start / change);
        } else {
            leave = leave.min(-start / change);
        }
    }
    (enter <= leave).then_some((enter, leave))
}

/// Whether `p` is in a convex outline or on its border.
pub fn covers(outline: &[Point], p: Point) -> bool {
    !outline.is_empty() && segment_inside_convex(outline, p, p).is_some()
}

/// The smallest rectangle with sides along the axes that holds all points: its least and greatest corner.
pub fn bounds(points: impl IntoIterator<Item = Point>) -> (Point, Point) {
    points.into_iter().fold((Point::INFINITY, Point::NEG_INFINITY), |(least, most), p| (least.min(p), most.max(p)))
}

/// A point well inside the outline, for a label or as a goal: the centroid where that is inside,
/// else the middle of the widest horizontal chord through the outline's middle.
pub fn inner_point(outline: &[Point]) -> Point {
    let area = signed_area(outline);
    let centroid =
        sides(outline).map(|(a, b)| (a + b) * a.perp_dot(b)).fold(Point::ZERO, |sum, part| sum + part) / (6.0 * area);
    if contains(outline, centroid) {
        return centroid;
    }
    let (least, most) = bounds(outline.iter().copied());
    let y = (least.y + most.y) / 2.0;
    let mut crossings: Vec<f64> = sides(outline)
        .filter(|(a, b)| (a.y > y) != (b.y > y))
        .map(|(a, b)| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x))
        .collect();
    crossings.sort_by(f64::total_cmp);
    let widest = crossings.chunks_exact(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    widest.map_or(outline[0], |chord| Point::new((chord[0] + chord[1]) / 2.0, y))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(corners: &[(f64, f64)]) -> Vec<Point> {
        corners.iter().map(|&corner| Point::from(corner)).collect()
    }

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    /// 4 by 3, counter-clockwise from the origin.
    fn rectangle() -> Vec<Point> {
        outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)])
    }

    /// A U open to the north: 6 wide, 4 high, with arms 1 and 2 wide and a floor 1 high.
    fn u() -> Vec<Point> {
        outline(&[(0.0, 0.0), (6.0, 0.0), (6.0, 4.0), (4.0, 4.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)])
    }

    #[test]
    fn directions_turn_from_east_to_north() {
        assert_eq!(direction(0.0), Point::X);
        assert!(direction(90.0).distance(Point::Y) < 1e-15);
        // cos 120 = -1/2, sin 120 = sqrt(3) / 2.
        assert!(direction(120.0).distance(p(-0.5, 0.866_025_403_784_438_6)) < 1e-15);
    }

    #[test]
    fn the_nearest_point_of_a_segment_is_a_foot_or_an_end() {
        // Of (3, 1) along (4, 3): (12 + 3) / 25 = 0.6 of the way.
        let (a, b) = (p(0.0, 0.0), p(4.0, 3.0));
        assert!(nearest_on_segment(p(3.0, 1.0), a, b).distance(p(2.4, 1.8)) < 1e-15);
        assert_eq!(nearest_on_segment(p(-2.0, 0.0), a, b), a);
        assert_eq!(nearest_on_segment(p(5.0, 5.0), a, b), b);
        assert_eq!(nearest_on_segment(p(5.0, 5.0), a, a), a);
        // (3, 1) to (2.4, 1.8): 0.6 and 0.8.
        assert!((distance_to_segment(p(3.0, 1.0), a, b) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn segments_meet_where_they_cross_touch_or_lie_on_each_other() {
        let (a, b) = (p(0.0, 0.0), p(4.0, 0.0));
        assert!(segments_meet(a, b, p(2.0, -1.0), p(2.0, 1.0)));
        assert!(segments_meet(a, b, p(2.0, 0.0), p(2.0, 1.0)));
        assert!(segments_meet(a, b, p(4.0, 0.0), p(6.0, 0.0)));
        assert!(segments_meet(a, b, p(1.0, 0.0), p(2.0, 0.0)));
        assert!(!segments_meet(a, b, p(2.0, 0.1), p(2.0, 1.0)));
        assert!(!segments_meet(a, b, p(5.0, -1.0), p(5.0, 1.0)));
        assert!(!segments_meet(a, b, p(4.1, 0.0), p(6.0, 0.0)));
        assert!(!segments_meet(a, b, p(0.0, 1.0), p(4.0, 1.0)));
    }

    #[test]
    fn the_sides_close_the_outline() {
        let triangle = outline(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
        let expected = [(0, 1), (1, 2), (2, 0)].map(|(a, b): (usize, usize)| (triangle[a], triangle[b]));
        assert!(sides(&triangle).eq(expected));
    }

    #[test]
    fn an_outline_contains_its_inside_and_its_west_and_south_border() {
        assert!(contains(&rectangle(), p(3.9, 2.9)));
        assert!(contains(&rectangle(), p(0.0, 1.0)) && contains(&rectangle(), p(1.0, 0.0)));
        assert!(!contains(&rectangle(), p(4.0, 1.0)) && !contains(&rectangle(), p(1.0, 3.0)));
        assert!(!contains(&rectangle(), p(-0.1, 1.0)));
        assert!(contains(&u(), p(0.5, 3.0)) && contains(&u(), p(5.0, 3.0)) && !contains(&u(), p(2.0, 3.0)));
    }

    #[test]
    fn distance_to_an_area_is_zero_inside_and_to_its_border_is_not() {
        assert_eq!(distance_to_area(&rectangle(), p(1.0, 2.0)), 0.0);
        assert_eq!(distance_to_border(&rectangle(), p(1.0, 2.5)), 0.5);
        // 3 beyond the east, 4 beyond the north.
        assert_eq!(distance_to_area(&rectangle(), p(7.0, 7.0)), 5.0);
        // Between the arms of the U, 1 from the western, 2 from the eastern.
        assert_eq!(distance_to_area(&u(), p(2.0, 3.0)), 1.0);
    }

    #[test]
    fn an_area_is_positive_counter_clockwise() {
        assert_eq!(signed_area(&rectangle()), 12.0);
        let mut turned = rectangle();
        turned.reverse();
        assert_eq!(signed_area(&turned), -12.0);
        // 6 by 4 less 3 by 3.
        assert_eq!(signed_area(&u()), 15.0);
    }

    #[test]
    fn convex_outlines_turn_one_way() {
        assert!(is_convex(&rectangle()));
        assert!(is_convex(&rectangle().into_iter().rev().collect::<Vec<_>>()));
        // A corner in the middle of a side.
        assert!(is_convex(&outline(&[(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)])));
        assert!(!is_convex(&u()));
        assert!(!is_convex(&outline(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)])));
    }

    #[test]
    fn a_bow_tie_crosses_itself() {
        assert!(crosses_itself(&outline(&[(0.0, 0.0), (4.0, 3.0), (4.0, 0.0), (0.0, 3.0)])));
        assert!(!crosses_itself(&rectangle()));
        assert!(!crosses_itself(&u()));
        // One corner on the opposite side.
        assert!(crosses_itself(&outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (2.0, 0.0), (0.0, 3.0)])));
    }

    #[test]
    fn a_thick_segment_lies_half_to_each_side() {
        let expected = outline(&[(1.0, 0.9), (3.0, 0.9), (3.0, 1.1), (1.0, 1.1)]);
        let found = thick_segment(p(1.0, 1.0), p(3.0, 1.0), 0.2);
        assert!(found.iter().zip(&expected).all(|(a, b)| a.distance(*b) < 1e-15), "{found:?}");
        assert!((signed_area(&found) - 0.4).abs() < 1e-15);
    }

    #[test]
    fn a_segment_is_inside_a_convex_outline_between_two_shares() {
        // From x = -4 to 12: in from 4 / 16 to 8 / 16, whichever way the corners run.
        let turned: Vec<Point> = rectangle().into_iter().rev().collect();
        for area in [rectangle(), turned] {
            assert_eq!(segment_inside_convex(&area, p(-4.0, 1.0), p(12.0, 1.0)), Some((0.25, 0.5)));
            assert_eq!(segment_inside_convex(&area, p(1.0, 1.0), p(1.0, 5.0)), Some((0.0, 0.5)));
            assert_eq!(segment_inside_convex(&area, p(1.0, 1.0), p(2.0, 2.0)), Some((0.0, 1.0)));
            assert_eq!(segment_inside_convex(&area, p(-4.0, 4.0), p(12.0, 4.0)), None);
            assert_eq!(segment_inside_convex(&area, p(5.0, 1.0), p(12.0, 1.0)), None);
            // Past the corner (4, 3): at x = 4 the line is at 3.5.
            assert_eq!(segment_inside_convex(&area, p(3.0, 4.5), p(5.0, 2.5)), None);
        }
    }

    #[test]
    fn bounds_hold_all_points() {
        assert_eq!(bounds(outline(&[(1.0, 5.0), (-2.0, 3.0), (0.0, 7.0)])), (p(-2.0, 3.0), p(1.0, 7.0)));
    }

    #[test]
    fn an_inner_point_is_the_centroid_where_that_is_inside() {
        assert!(inner_point(&rectangle()).distance(p(2.0, 1.5)) < 1e-12);
        // Of the U: floor 6 at (3, 0.5), arms 3 at (0.5, 2.5) and 6 at (5, 2.5): (49.5, 25.5) / 15 = (3.3, 1.7), in its
        // opening. At half its height the arms are 1 and 2 wide, and the wider reaches from 4 to 6.
        assert_eq!(inner_point(&u()), p(5.0, 2.0));
    }
}
