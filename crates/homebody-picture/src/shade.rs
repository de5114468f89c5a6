//! Cells of a grid as smooth shapes: borders that two shapes share stay shared, so none gaps or overlaps.

use homebody_core::geometry::{self, Point};

use homebody_analysis::coverage::{CellCorner, CoverageGrid, Region};

/// Number of straight cells on both sides of a turn from which it is a corner of the floor, not a stair of a slant.
const STRAIGHT: usize = 4;
/// Rounds of averaging with both neighbours, which takes the stairs off a slanting border.
const ROUNDS: usize = 4;
/// Largest move of a border by the last simplification, in cells.
const TOLERANCE: f64 = 0.25;

/// A region's rings in metres, the outer one first. `class` says which shape a cell belongs to; the
/// points where three shapes meet stay where they are.
pub fn smooth(grid: &CoverageGrid, region: &Region, class: &dyn Fn(usize) -> usize) -> Vec<Vec<Point>> {
    region.rings.iter().map(|ring| smooth_ring(grid, ring, class)).filter(|ring| ring.len() > 2).collect()
}

fn smooth_ring(grid: &CoverageGrid, ring: &[CellCorner], class: &dyn Fn(usize) -> usize) -> Vec<Point> {
    let junction: Vec<bool> = ring.iter().map(|&corner| is_junction(grid, corner, class)).collect();
    let mut pins: Vec<usize> = (0..ring.len()).filter(|&i| junction[i] || is_sharp(ring, &junction, i)).collect();
    if pins.is_empty() {
        pins.extend((0..ring.len()).min_by_key(|&i| ring[i]));
    }
    let mut smooth = Vec::new();
    for (k, &from) in pins.iter().enumerate() {
        let to = pins.get(k + 1).copied().unwrap_or(pins[0] + ring.len());
        let mut arc: Vec<CellCorner> = (from..=to).map(|i| ring[i % ring.len()]).collect();
        // Both shapes at an arc walk it, in opposite directions; it must come out the same.
        let turned = (arc.last(), arc.get(arc.len() - 2)) < (arc.first(), arc.get(1));
        if turned {
            arc.reverse();
        }
        let mut line = smooth_arc(grid, &arc);
        if turned {
            line.reverse();
        }
        line.pop();
        smooth.extend(line);
    }
    smooth
}

/// An arc through the middles of its cell sides, its ends where they were.
fn smooth_arc(grid: &CoverageGrid, arc: &[CellCorner]) -> Vec<Point> {
    let mut line = vec![grid.corner(arc[0])];
    line.extend(arc.windows(2).map(|side| (grid.corner(side[0]) + grid.corner(side[1])) / 2.0));
    line.push(grid.corner(arc[arc.len() - 1]));
    for _ in 0..ROUNDS {
        let inner: Vec<Point> = line.windows(3).map(|near| near[0] * 0.25 + near[1] * 0.5 + near[2] * 0.25).collect();
        line.splice(1..1 + inner.len(), inner);
    }
    let mut kept = vec![line[0]];
    simplify(&line, TOLERANCE * grid.step_m, &mut kept);
    kept
}

/// True if more than two shapes meet at a corner, or two touch there only with their corners.
fn is_junction(grid: &CoverageGrid, corner: CellCorner, class: &dyn Fn(usize) -> usize) -> bool {
    let around = grid.around(corner).map(|cell| cell.map_or(0, class));
    let changes = (0..4).filter(|&i| around[i] != around[(i + 1) % 4]).count();
    changes > 2
}

/// True if the ring turns here after a straight piece and before another. Looks no farther than the
/// next junctions, beyond which the shapes on both sides go different ways.
fn is_sharp(ring: &[CellCorner], junction: &[bool], i: usize) -> bool {
    let n = ring.len();
    let at = |i: usize| ring[i % n];
    let step = |from: CellCorner, to: CellCorner| [to[0] - from[0], to[1] - from[1]];
    let straight = |towards: fn(usize, usize) -> usize| {
        let first = step(at(i), at(towards(i + n, 1)));
        (1..STRAIGHT).all(|k| {
            let (here, next) = (towards(i + n, k), towards(i + n, k + 1));
            !junction[here % n] && step(at(here), at(next)) == first
        })
    };
    let turns = step(at(i + n - 1), at(i)) != step(at(i), at(i + 1));
    n > 2 * STRAIGHT && turns && straight(|i, k| i + k) && straight(|i, k| i - k)
}

/// Douglas and Peucker's simplification: adds the points of a line that matter, but for its first.
fn simplify(line: &[Point], tolerance: f64, kept: &mut Vec<Point>) {
    let (first, last) = (line[0], line[line.len() - 1]);
    let off = |i: usize| geometry::distance_to_segment(line[i], first, last);
    let farthest = (1..line.len() - 1).max_by(|&a, &b| off(a).total_cmp(&off(b)));
    match farthest.filter(|&i| off(i) > tolerance) {
        Some(i) => {
            simplify(&line[..=i], tolerance, kept);
            simplify(&line[i..], tolerance, kept);
        }
        None => kept.push(last),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::ids::SensorId;
    use homebody_core::sensor_set::SensorSet;

    /// The shapes tile the plane: what one gives away at a border, another takes.
    #[test]
    fn smooth_shapes_leave_no_gap_and_no_overlap() {
        let bounds = (Point::ZERO, Point::new(6.0, 4.0));
        let rings = [(2.1, 1.9, 1.6), (3.3, 2.2, 1.4), (4.4, 1.2, 0.7), (1.0, 3.2, 0.4)];
        let near = |p: Point, (x, y, r): (f64, f64, f64)| p.distance(Point::new(x, y)) < r;
        let grid = CoverageGrid::sample(bounds, 0.05, |p| {
            Some((0..).map(SensorId).zip(rings).filter(|&(_, ring)| near(p, ring)).map(|(sensor, _)| sensor).collect())
        });
        let class = |cell: usize| 1 + grid.watchers(cell).unwrap_or(0);
        let mut area = 0.0;
        for number in 1..=5 {
            for region in grid.regions(|cell| class(cell) == number) {
                let own: f64 = smooth(&grid, &region, &class).iter().map(|ring| geometry::signed_area(ring)).sum();
                assert!((own - grid.area_m2(&region)).abs() < 0.1, "smoothing keeps areas");
                area += own;
            }
        }
        assert!((area - 24.0).abs() < 1e-9, "{area}");
    }

    #[test]
    fn corners_of_rooms_stay_sharp() {
        let bounds = (Point::ZERO, Point::new(3.0, 2.0));
        let grid = CoverageGrid::sample(bounds, 0.05, |p| (p.x > 1.0 && p.y > 0.5).then(SensorSet::default));
        let class = |cell: usize| usize::from(grid.cells[cell].is_some());
        let regions = grid.regions(|cell| class(cell) == 1);
        let ring = &smooth(&grid, &regions[0], &class)[0];
        assert_eq!(ring.len(), 4, "{ring:?}");
    }
}
