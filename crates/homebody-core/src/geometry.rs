//! Plane geometry on `f64`: what walls, beams and bodies share.

/// A point or a direction on the floor plan, in metres.
pub type Point = glam::DVec2;

/// A point as files write it.
pub fn point(at: [f64; 2]) -> Point {
    Point::new(at[0], at[1])
}

/// The direction of an angle: 0 degrees is east, 90 north.
pub fn direction(angle_deg: f64) -> Point {
    let angle = angle_deg.to_radians();
    Point::new(libm::cos(angle), libm::sin(angle))
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
