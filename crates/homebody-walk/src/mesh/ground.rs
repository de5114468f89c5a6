//! The ground for the middle of a body of one radius, as convex pieces, and the shortest routes over it.

use super::floor;
use homebody_core::geometry::{self, Point};
use std::collections::BTreeMap;

/// Distance beyond its radius that a body keeps, so that rounding takes nothing of the radius (our choice).
const MARGIN_M: f64 = 5e-4;

/// Distance beyond which a home is shifted near the origin, by whole multiples of it (our choice): the search computes
/// in single precision.
const NEAR_ZERO_M: f64 = 256.0;

/// Cosine, slightly rounded down, of the largest turn of the straight sides that round a corner, 45 degrees (our
/// choice). They keep up to 8 % of the radius more than needed, and a way around a corner has few corners itself.
const TURN_COS: f64 = 0.707;

/// Largest distance of a point outside of its piece due to rounding.
const ON_PIECE_M: f64 = 1e-4;

#[derive(Clone, Debug)]
pub(super) struct WalkableGround {
    pub(super) clearance_m: f64,
    pieces: Vec<GroundPiece>,
    /// In square metres, by connected area.
    areas: Vec<f64>,
    /// The origin of the search's coordinates.
    origin: Point,
    ways: polyanya::Mesh,
}

#[derive(Clone, Debug, PartialEq)]
struct GroundPiece {
    /// Convex, corners counter-clockwise.
    corners: Vec<Point>,
    least: Point,
    most: Point,
    area: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GroundPoint {
    pub(super) at: Point,
    /// Its connected area.
    pub(super) area: usize,
    /// Distance from the point asked for.
    pub(super) away_m: f64,
}

impl WalkableGround {
    /// The ground within `bounds` that is `clearance_m` away from the obstacles, which are convex with corners
    /// counter-clockwise, and on the inner side of the borders.
    pub(super) fn new(
        (least, most): (Point, Point),
        obstacles: &[&[Point]],
        borders: &[(Point, Point)],
        clearance_m: f64,
        is_inside: impl Fn(Point) -> bool,
    ) -> WalkableGround {
        let (least, most) = (least - Point::splat(1.0), most + Point::splat(1.0));
        let grown: Vec<Vec<Point>> = obstacles.iter().map(|outline| grown(outline, clearance_m + MARGIN_M)).collect();
        let is_covered = |&&(a, b): &&(Point, Point)| {
            grown.iter().any(|outline| geometry::contains(outline, a) && geometry::contains(outline, b))
        };
        let fences: Vec<Vec<Point>> =
            borders.iter().filter(|border| !is_covered(border)).map(|&(a, b)| fence(a, b)).collect();
        let origin = (least / NEAR_ZERO_M).trunc() * NEAR_ZERO_M;
        let outlines =
            grown.into_iter().chain(fences).map(|outline| outline.iter().map(|corner| corner - origin).collect());
        let mut ways = floor::free((least - origin, most - origin), outlines);
        ways.search_delta = ON_PIECE_M as f32;
        let (pieces, areas) = pieces(&ways, origin, is_inside);
        WalkableGround { clearance_m, pieces, areas, origin, ways }
    }

    pub(super) fn area_at(&self, p: Point) -> Option<usize> {
        let reaches = |piece: &&GroundPiece| {
            p.cmpge(piece.least - ON_PIECE_M).all()
                && p.cmple(piece.most + ON_PIECE_M).all()
                && geometry::distance_to_area(&piece.corners, p) <= ON_PIECE_M
        };
        self.pieces.iter().find(reaches).map(|piece| piece.area)
    }

    pub(super) fn size(&self, area: usize) -> f64 {
        self.areas[area]
    }

    /// The nearest point of each piece within reach, and some along its sides; nearest first.
    pub(super) fn around(&self, p: Point, reach_m: f64) -> Vec<GroundPoint> {
        let mut found = Vec::new();
        for piece in &self.pieces {
            if p.clamp(piece.least, piece.most).distance(p) > reach_m {
                continue;
            }
            let mut add = |at: Point| {
                let away_m = at.distance(p);
                if away_m <= reach_m {
                    found.push(GroundPoint { at, area: piece.area, away_m });
                }
            };
            if geometry::contains(&piece.corners, p) {
                add(p);
            }
            for (a, b) in geometry::sides(&piece.corners) {
                add(geometry::nearest_on_segment(p, a, b));
                let steps = (a.distance(b) / ALONG_SIDE_M).ceil();
                for step in 0..steps as u32 {
                    add(a + (b - a) * (f64::from(step) / steps));
                }
            }
        }
        found.sort_by(|a, b| {
            a.away_m.total_cmp(&b.away_m).then(a.at.x.total_cmp(&b.at.x)).then(a.at.y.total_cmp(&b.at.y))
        });
        found
    }

    pub(super) fn way(&self, from: Point, to: Point) -> Option<Vec<Point>> {
        let path = self.ways.path((from - self.origin).as_vec2(), (to - self.origin).as_vec2())?;
        let mut way: Vec<Point> = path.path.iter().map(|corner| corner.as_dvec2() + self.origin).collect();
        way.pop();
        way.push(to);
        Some(way)
    }
}

/// Distance between the points along a piece's sides (our choice).
const ALONG_SIDE_M: f64 = 0.1;

/// Moves a convex outline outwards, with rounded corners.
fn grown(outline: &[Point], by_m: f64) -> Vec<Point> {
    let count = outline.len();
    let outward = |i: usize| -(outline[(i + 1) % count] - outline[i % count]).normalize_or_zero().perp();
    let mut grown = Vec::new();
    for (i, &corner) in outline.iter().enumerate() {
        let mut normals = vec![outward(i + count - 1)];
        turn(normals[0], outward(i), &mut normals);
        // The sides with these normals touch the circle around the corner, and meet here.
        grown.extend(
            normals.windows(2).map(|pair| corner + (pair[0] + pair[1]) * (by_m / (1.0 + pair[0].dot(pair[1])))),
        );
    }
    grown
}

/// Appends the normals after `from` up to `to`, in turns of at most the angle of `TURN_COS`.
fn turn(from: Point, to: Point, normals: &mut Vec<Point>) {
    let middle = (from + to).normalize_or_zero();
    if from.dot(to) < TURN_COS && middle != Point::ZERO {
        turn(from, middle, normals);
        turn(middle, to, normals);
    } else {
        normals.push(to);
    }
}

/// A border as an obstacle, a little longer than it is so that it joins the next.
fn fence(a: Point, b: Point) -> Vec<Point> {
    let along = (b - a).normalize_or_zero() * FENCE_M;
    geometry::thick_segment(a - along, b + along, 2.0 * FENCE_M)
}

/// Half of the thickness (our choice).
const FENCE_M: f64 = 0.002;

/// The pieces inside the home, and the sizes of their connected areas.
fn pieces(ways: &polyanya::Mesh, origin: Point, is_inside: impl Fn(Point) -> bool) -> (Vec<GroundPiece>, Vec<f64>) {
    let (mut pieces, mut areas) = (Vec::new(), Vec::new());
    let mut sides: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for layer in &ways.layers {
        for polygon in &layer.polygons {
            let corners: Vec<Point> = polygon
                .vertices
                .iter()
                .filter_map(|&vertex| layer.vertices.get(vertex as usize))
                .map(|vertex| vertex.coords.as_dvec2() + origin)
                .collect();
            let middle = corners.iter().sum::<Point>() / corners.len() as f64;
            if corners.len() < 3 || !is_inside(middle) {
                continue;
            }
            let (least, most) = geometry::bounds(corners.iter().copied());
            let own = areas.len();
            areas.push(geometry::signed_area(&corners).abs());
            pieces.push(GroundPiece { corners, least, most, area: own });
            let next = polygon.vertices.iter().cycle().skip(1);
            for (&a, &b) in polygon.vertices.iter().zip(next) {
                if let Some(neighbour) = sides.insert((a.min(b), a.max(b)), own) {
                    join(&mut pieces, &mut areas, own, neighbour);
                }
            }
        }
    }
    (pieces, areas)
}

/// Joins the areas of two pieces; the area that ends has size 0.
fn join(pieces: &mut [GroundPiece], areas: &mut [f64], piece: usize, neighbour: usize) {
    let (gone, kept) = (pieces[piece].area, pieces[neighbour].area);
    if gone != kept {
        areas[kept] += areas[gone];
        areas[gone] = 0.0;
        for piece in pieces.iter_mut().filter(|piece| piece.area == gone) {
            piece.area = kept;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<Point> {
        vec![Point::new(x, y), Point::new(x + side, y), Point::new(x + side, y + side), Point::new(x, y + side)]
    }

    #[test]
    fn a_grown_outline_keeps_at_least_the_distance_and_little_more() {
        for outline in [square(0.0, 0.0, 1.0), vec![Point::ZERO, Point::new(3.0, 0.0), Point::new(0.0, 0.2)]] {
            let grown = grown(&outline, 0.2);
            assert!(geometry::is_convex(&grown) && geometry::signed_area(&grown) > 0.0);
            for (a, b) in geometry::sides(&grown) {
                for step in 0..=10 {
                    let away = geometry::distance_to_area(&outline, a + (b - a) * (f64::from(step) / 10.0));
                    assert!((0.2 - 1e-12..=0.2 * 1.09).contains(&away), "{away}");
                }
            }
        }
    }

    #[test]
    fn areas_that_a_wall_parts_are_two() {
        let wall = geometry::thick_segment(Point::new(2.0, -1.0), Point::new(2.0, 3.0), 0.1);
        let home = square(0.0, 0.0, 4.0);
        let ground = |walls: &[&[Point]]| {
            let borders: Vec<_> = geometry::sides(&home).collect();
            WalkableGround::new((Point::ZERO, Point::splat(4.0)), walls, &borders, 0.2, |p| {
                geometry::contains(&home, p)
            })
        };
        let (west, east) = (Point::new(1.0, 1.0), Point::new(3.0, 1.0));
        let open = ground(&[&wall]);
        assert_eq!(open.area_at(west), open.area_at(east));
        assert!(open.way(west, east).is_some_and(|way| way.len() > 1));
        assert_eq!(open.area_at(Point::new(2.1, 1.0)), None);
        let longer = geometry::thick_segment(Point::new(2.0, -1.0), Point::new(2.0, 5.0), 0.1);
        let closed = ground(&[&longer]);
        assert!(closed.area_at(west).is_some() && closed.area_at(west) != closed.area_at(east));
        assert_eq!(closed.way(west, east), None);
    }

    /// The triangulation hashes; results must not depend on the order.
    #[test]
    fn the_same_obstacles_make_the_same_ground() {
        let obstacles: Vec<Vec<Point>> = (0..20)
            .map(|i| square(f64::from(i % 5) * 0.83, f64::from(i / 5) * 0.71, 0.3 + 0.01 * f64::from(i)))
            .collect();
        let obstacles: Vec<&[Point]> = obstacles.iter().map(|outline| &outline[..]).collect();
        let ground = || WalkableGround::new((Point::ZERO, Point::splat(5.0)), &obstacles, &[], 0.1, |_| true);
        let first = ground();
        assert!((0..5).all(|_| ground().pieces == first.pieces));
    }
}
