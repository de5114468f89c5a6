//! The floor between outlines, as convex pieces that fit together.
//!
//! Outlines overlap, cross and touch as people draw them. They are triangulated as drawn, and sides are cut at their
//! crossings. Rounding moves the new corners, so slanted sides bend a little. A new corner may come to lie on the wrong
//! side of another corner nearby; then a side cannot be inserted any more, and another method starts from the
//! beginning.
//!
//! That method is exact, but moves sides by up to half a step of a grid: the union of the outlines is cut out of the
//! frame in whole steps, which leaves rings that meet at corners only. Triangulating the area between them needs no
//! further cuts.

use homebody_core::geometry::{self, Point};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use polyanya::{Layer, Polygon, Vertex};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Intersection, LineIntersectionIterator, Point2, Triangulation};
use std::collections::BTreeMap;

/// Corners lie on a grid of this: the search reckons in single precision, which has these numbers exactly, and walls in
/// one line stay in one line.
const GRID_M: f64 = 1.0 / 4096.0;

/// Largest number of sides of an outline. One with more is tangled (our choice: large houses have half as many).
const MOST_SIDES: usize = 1_000;

/// Largest number of parts that sides are cut into (our choice).
const MOST_PARTS: usize = 4 * MOST_SIDES;

/// Largest shift of a cut off a side by rounding, in steps of the grid: between sides nearly in one line, it moves it
/// far away.
const MOST_OFF: f64 = 0.01;

/// Outlines that are combined together (our choice): most of many are covered and need no second look.
const AT_ONCE: usize = 64;

/// A closed row of corners, in steps of the grid.
type Ring = Vec<Point>;
type WholeRing = Vec<IntPoint>;

type Triangles = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The part of the rectangle with these corners outside of all outlines, which are convex with corners
/// counter-clockwise.
pub fn free((least, most): (Point, Point), outlines: impl Iterator<Item = Vec<Point>>) -> polyanya::Mesh {
    let on_grid = |ring: Vec<Point>| ring.iter().map(|corner| (corner / GRID_M).round()).collect::<Ring>();
    let frame = on_grid(vec![least, Point::new(most.x, least.y), most, Point::new(least.x, most.y)]);
    let outlines: Vec<Ring> = outlines.map(on_grid).collect();
    let layer = as_drawn(&frame, &outlines).unwrap_or_else(|| between(&cut_out(&frame, &outlines)));
    let mut floor = polyanya::Mesh { layers: vec![layer], ..Default::default() };
    while floor.merge_polygons() {}
    floor.bake();
    floor
}

/// The outlines triangulated as drawn; nothing if they are too tangled for that.
fn as_drawn(frame: &Ring, outlines: &[Ring]) -> Option<Layer> {
    let rings = || [frame].into_iter().chain(outlines);
    if rings().map(Vec::len).sum::<usize>() > MOST_SIDES {
        return None;
    }
    let mut triangles = Triangles::new();
    let mut parts = 0;
    for ring in rings() {
        let mut last = None;
        for corner in ring.iter().chain(ring.first()) {
            let to = triangles.insert(Point2::new(corner.x, corner.y)).ok()?;
            let mut from = last.replace(to).unwrap_or(to);
            while from != to {
                from = step(&mut triangles, from, to)?;
                parts += 1;
                if parts > MOST_PARTS {
                    return None;
                }
            }
        }
    }
    let is_free = |middle: Point| !outlines.iter().any(|outline| geometry::contains(outline, middle));
    let is_free: Vec<bool> =
        triangles.all_faces().map(|face| face.as_inner().is_some_and(|face| is_free(point(face.center())))).collect();
    let layer = layer(&triangles, &is_free);
    // A piece without area in single precision cannot be searched.
    let has_area = |piece: &Polygon| {
        let corners: Vec<Point> =
            piece.vertices.iter().map(|&vertex| layer.vertices[vertex as usize].coords.as_dvec2()).collect();
        geometry::signed_area(&corners) > 0.0
    };
    layer.polygons.iter().all(has_area).then_some(layer)
}

fn point(at: Point2<f64>) -> Point {
    Point::new(at.x, at.y)
}

/// Inserts the beginning of a side, up to the corner that it meets or the side that it crosses, which is cut there.
fn step(triangles: &mut Triangles, from: FixedVertexHandle, to: FixedVertexHandle) -> Option<FixedVertexHandle> {
    let mut met = LineIntersectionIterator::new_from_handles(triangles, from, to).skip(1);
    let crossed = loop {
        match met.next()? {
            Intersection::VertexIntersection(corner) => break Err(corner.fix()),
            Intersection::EdgeOverlap(side) => break Err(side.to().fix()),
            Intersection::EdgeIntersection(side) if side.is_constraint_edge() => break Ok(side.fix()),
            Intersection::EdgeIntersection(_) => {}
        }
    };
    let put = |triangles: &mut Triangles, a, b| (!triangles.try_add_constraint(a, b).is_empty()).then_some(b);
    match crossed {
        Err(corner) => put(triangles, from, corner),
        Ok(side) => {
            let [a, b] = triangles.directed_edge(side).vertices().map(|corner| corner.fix());
            let at = |corner| point(triangles.vertex(corner).position());
            let sides = [(at(a), at(b)), (at(from), at(to))];
            let cut = crossing(sides);
            if !sides.iter().all(|&(a, b)| geometry::distance_to_segment(cut, a, b) < MOST_OFF) {
                return None;
            }
            triangles.remove_constraint_edge(side.as_undirected());
            let cut = triangles.insert(Point2::new(cut.x, cut.y)).ok()?;
            put(triangles, a, cut)?;
            put(triangles, cut, b)?;
            put(triangles, from, cut)
        }
    }
}

/// The intersection of the lines through two sides, up to rounding.
fn crossing(sides: [(Point, Point); 2]) -> Point {
    let [(a, at_a), (b, at_b)] = sides.map(|(from, to)| {
        let across = Point::new(to.y - from.y, from.x - to.x);
        (across, across.x * from.x + across.y * from.y)
    });
    Point::new(b.y * at_a - a.y * at_b, a.x * at_b - b.x * at_a) / (a.x * b.y - b.x * a.y)
}

fn cut_out(frame: &Ring, outlines: &[Ring]) -> Vec<WholeRing> {
    let whole = |ring: &Ring| ring.iter().map(|corner| IntPoint::new(corner.x as i32, corner.y as i32)).collect();
    let outlines: Vec<WholeRing> = outlines.iter().map(whole).collect();
    let mut cut = Overlay::new(0);
    cut.add_contour(&whole(frame), ShapeType::Subject);
    cut.add_contours(&together(&outlines), ShapeType::Clip);
    cut.overlay(OverlayRule::Difference, FillRule::NonZero).concat()
}

/// The rings around the union of the outlines.
fn together(outlines: &[WholeRing]) -> Vec<WholeRing> {
    let rings = match outlines.len() {
        0..=AT_ONCE => outlines.to_vec(),
        many => {
            let (first, second) = outlines.split_at(many / 2);
            [together(first), together(second)].concat()
        }
    };
    let mut union = Overlay::new(0);
    union.add_contours(&rings, ShapeType::Subject);
    union.overlay(OverlayRule::Subject, FillRule::NonZero).concat()
}

/// Triangles of the points inside of an odd number of rings.
fn between(rings: &[WholeRing]) -> Layer {
    let mut triangles = Triangles::new();
    let mut insert = |corner: &IntPoint| triangles.insert(Point2::new(f64::from(corner.x), f64::from(corner.y)));
    let rings: Vec<Vec<FixedVertexHandle>> =
        rings.iter().map(|ring| ring.iter().flat_map(&mut insert).collect()).collect();
    let mut sides = BTreeMap::new();
    for ring in &rings {
        for (&from, &to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            for side in triangles.try_add_constraint(from, to) {
                *sides.entry(side.as_undirected().index()).or_insert(0) += 1;
            }
        }
    }
    // From the outside in: a side of a ring separates free from covered ground.
    let parts = |side: usize| sides.get(&side).is_some_and(|count| count % 2 == 1);
    let mut is_free: Vec<Option<bool>> = vec![None; triangles.num_all_faces()];
    is_free[triangles.outer_face().index()] = Some(false);
    let mut next: Vec<_> = triangles.convex_hull().map(|side| (side.rev(), false)).collect();
    while let Some((side, beyond)) = next.pop() {
        let known = &mut is_free[side.face().index()];
        if known.is_none() {
            let free = beyond != parts(side.as_undirected().index());
            *known = Some(free);
            next.extend([side.next(), side.prev()].map(|side| (side.rev(), free)));
        }
    }
    let is_free: Vec<bool> = is_free.iter().map(|free| *free == Some(true)).collect();
    layer(&triangles, &is_free)
}

fn layer(triangles: &Triangles, is_free: &[bool]) -> Layer {
    let faces = || triangles.inner_faces().filter(|face| is_free[face.index()]);
    let mut numbers = vec![u32::MAX; triangles.num_all_faces()];
    (0..).zip(faces()).for_each(|(number, face)| numbers[face.index()] = number);
    let vertices = triangles.vertices().map(|vertex| {
        let mut around: Vec<u32> = vertex.out_edges().map(|side| numbers[side.face().index()]).collect();
        // The list begins with a piece, if it has one.
        let first = around.iter().position(|&number| number != u32::MAX).unwrap_or(0);
        around.rotate_left(first);
        around.dedup();
        Vertex::new((point(vertex.position()) * GRID_M).as_vec2(), around)
    });
    let mut layer = Layer::default();
    layer.vertices.extend(vertices);
    layer
        .polygons
        .extend(faces().map(|face| Polygon::new(face.vertices().map(|vertex| vertex.index() as u32).into(), false)));
    layer
}
