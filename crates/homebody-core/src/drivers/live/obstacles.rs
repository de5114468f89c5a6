//! The obstacles of a body, and its way among them.
//!
//! Nothing moves by forces here, so casting the body's shape along its way is the whole of the
//! physics, and no physics world is stepped. The engine's own character controller is for floors
//! seen from the side: its search for ground costs more than the casts, and in a corner it bounces
//! from wall to wall twenty times. Sliding on a plan needs less: see [`Obstacles::slide`].
//!
//! The engine computes in `f32`, and once in some hundred thousand casts along a wall it misses the
//! wall. So the end of every step is checked against the plan itself, in `f64`.

use crate::drivers::surroundings::PlacedBody;
use crate::geometry::{self, Point};
use crate::ids::ThingId;
use crate::plan::{Origin, Plan, Solid};
use parry2d::bounding_volume::Aabb;
use parry2d::math::{Pose, Vector};
use parry2d::partitioning::{Bvh, BvhNode};
use parry2d::query::details::NormalConstraints;
use parry2d::query::{DefaultQueryDispatcher, ShapeCastOptions};
use parry2d::shape::{Ball, CompositeShape, CompositeShapeRef, Shape, SharedShape};

/// The gap that casts keep between the body and its obstacles. A cast is at its weakest if it begins in touch with an
/// obstacle.
const CLEARANCE_M: f32 = 0.005;

/// Distance below which corners are one (our choice): a tenth of a millimetre does not affect a body.
const SAME_CORNER_M: f32 = 1e-4;

/// Largest number of turns around obstacles: enough to bend round two things, or to be pushed out of both.
const MOST_TURNS: usize = 4;

/// The share of a slide's length by which it leads away from the wall, so that the next cast along the wall does not
/// meet the same wall again.
const NUDGE: f32 = 1e-3;

/// A slide slower than this share of the wanted speed does not happen: a body that pushes against a wall stands, and
/// does not creep along it.
const GRIP: f32 = 1e-2;

/// The share of a way's length by which it may lead back into the last obstacle and still be free.
const PINNED: f32 = 1e-2;

/// Everything a body of one radius runs into.
#[derive(Clone, Debug)]
pub struct Obstacles {
    radius_m: f64,
    /// The fixed ones, as in the plan; their places in the list are their numbers in the tree.
    fixed: Vec<Vec<Point>>,
    doors: Vec<InnerDoor>,
    parts: ObstacleShapes,
    /// A ball for each other body that has ever been near, by its number; the first `near_count` of them take part.
    others: Vec<u32>,
    near_count: usize,
}

/// The shapes of all obstacles. Those in the tree take part: all fixed ones except open doors, and the other bodies
/// that are near.
#[derive(Clone, Debug, Default)]
struct ObstacleShapes {
    tree: Bvh,
    shapes: Vec<(Pose, SharedShape)>,
}

impl ObstacleShapes {
    /// Adds a shape, which does not take part yet, and returns its number.
    fn add(&mut self, shape: SharedShape) -> u32 {
        self.shapes.push((Pose::IDENTITY, shape));
        (self.shapes.len() - 1) as u32
    }

    fn take_part(&mut self, number: u32) {
        let (pose, shape) = &self.shapes[number as usize];
        self.tree.insert(shape.compute_aabb(pose), number);
    }
}

impl CompositeShape for ObstacleShapes {
    fn map_part_at(&self, number: u32, ask: &mut dyn FnMut(Option<&Pose>, &dyn Shape, Option<&dyn NormalConstraints>)) {
        let (pose, shape) = &self.shapes[number as usize];
        ask(Some(pose), &**shape, None);
    }

    fn bvh(&self) -> &Bvh {
        &self.tree
    }
}

/// A door within the home, in a wall.
#[derive(Clone, Copy, Debug)]
struct InnerDoor {
    thing: ThingId,
    number: u32,
    is_shut: bool,
}

/// The corners of an outline as the engine knows them, without those that it could not tell apart: it panics where an outline
/// is a single point to it.
pub(super) fn corners(outline: &[Point]) -> Vec<Vector> {
    let mut corners: Vec<Vector> = Vec::new();
    for corner in outline.iter().map(|corner| corner.as_vec2()) {
        if corners.iter().all(|other| other.distance(corner) > SAME_CORNER_M) {
            corners.push(corner);
        }
    }
    corners
}

impl Obstacles {
    pub fn new(plan: &Plan, radius_m: f64) -> Obstacles {
        let leads_out = |outline: &[Point]| plan.leads_out(outline, radius_m);
        let solids = plan.solids.iter().filter(|solid| solid.stops_bodies);
        let solids = solids.map(|Solid { origin, outline, .. }| match origin {
            Origin::Door(door) => (outline, Some((*door, true))),
            _ => (outline, None),
        });
        // One that leads out into a room is open to bodies, however it is used.
        let openings =
            plan.openings.iter().filter(|opening| plan.things[opening.door].on || leads_out(&opening.outline));
        let openings = openings.map(|opening| (&opening.outline, Some((opening.door, false))));
        let mut all = Obstacles {
            radius_m,
            fixed: Vec::new(),
            doors: Vec::new(),
            parts: ObstacleShapes::default(),
            others: Vec::new(),
            near_count: 0,
        };
        for (outline, door) in solids.chain(openings) {
            let corners = corners(outline);
            // An outline without area stops no body.
            if corners.len() < 3 {
                continue;
            }
            let Some(hull) = SharedShape::convex_hull(&corners) else { continue };
            let number = all.parts.add(hull);
            all.fixed.push(outline.clone());
            // No body leaves the home, even through an open door.
            let within = door.filter(|_| !leads_out(outline));
            if within.is_none_or(|(_, is_shut)| is_shut) {
                all.parts.take_part(number);
            }
            all.doors.extend(within.map(|(door, is_shut)| InnerDoor { thing: ThingId::new(door), number, is_shut }));
        }
        all
    }

    /// Doors are as they have been left; none is shut on a body that stands in it.
    pub fn set_doors(&mut self, at: Point, is_open: impl Fn(ThingId) -> bool) {
        for index in 0..self.doors.len() {
            let InnerDoor { thing, number, is_shut } = self.doors[index];
            let shall_be_shut = !is_open(thing);
            if shall_be_shut == is_shut {
                continue;
            }
            let outline = &self.fixed[number as usize];
            if !shall_be_shut {
                self.parts.tree.remove(number);
            } else if geometry::distance_to_area(outline, at) >= self.radius_m + f64::from(CLEARANCE_M) {
                self.parts.take_part(number);
            } else {
                continue;
            }
            self.doors[index].is_shut = shall_be_shut;
        }
    }

    /// The end of the movement of a body at `from` by `way`: up to the first obstacle, and then along it. Between two
    /// obstacles that leave no way, it stops.
    pub fn slide(&mut self, from: Point, way: Point, others: impl Iterator<Item = PlacedBody>) -> Point {
        self.place_others(from, way.length(), others);
        let parts = CompositeShapeRef(&self.parts as &dyn CompositeShape);
        let ball = Ball::new(self.radius_m as f32);
        let start = from.as_vec2();
        let (mut moved, mut left) = (Vector::ZERO, way.as_vec2());
        let mut touched = Vector::ZERO;
        for _ in 0..MOST_TURNS {
            let Some(heading) = left.try_normalize() else { break };
            let options = ShapeCastOptions {
                max_time_of_impact: left.length(),
                target_distance: CLEARANCE_M,
                stop_at_penetration: false,
                compute_impact_geometry_on_penetration: true,
            };
            let pose = Pose::from_translation(start + moved);
            let Some((_, hit)) = parts.cast_shape(&DefaultQueryDispatcher, &pose, heading, &ball, options) else {
                moved += left;
                break;
            };
            moved += heading * hit.time_of_impact;
            left -= heading * hit.time_of_impact;
            let away = hit.normal1;
            left -= away * left.dot(away).min(0.0);
            if left.length() < GRIP * way.length() as f32 || left.dot(touched) < -PINNED * left.length() {
                break;
            }
            left += away * (left.length() * NUDGE);
            touched = away;
        }
        self.out_of_walls(from, from + moved.as_dvec2())
    }

    /// Puts balls at the other bodies that could be touched within `reach_m`.
    fn place_others(&mut self, from: Point, reach_m: f64, others: impl Iterator<Item = PlacedBody>) {
        for &ball in &self.others[..self.near_count] {
            self.parts.tree.remove(ball);
        }
        self.near_count = 0;
        for other in others {
            let touching_m = self.radius_m + other.build.radius_m + 2.0 * f64::from(CLEARANCE_M);
            if from.distance(other.at) > reach_m + touching_m {
                continue;
            }
            if self.near_count == self.others.len() {
                self.others.push(self.parts.add(SharedShape::ball(1.0)));
            }
            let number = self.others[self.near_count];
            self.parts.shapes[number as usize] =
                (Pose::from_translation(other.at.as_vec2()), SharedShape::ball(other.build.radius_m as f32));
            self.parts.take_part(number);
            self.near_count += 1;
        }
    }

    /// The end of a step, moved out of fixed obstacles that a cast has missed; without a way out, the step does not
    /// happen.
    fn out_of_walls(&self, from: Point, to: Point) -> Point {
        if self.near(from, to).any(|outline| geometry::segment_inside_convex(outline, from, to).is_some()) {
            return from;
        }
        let mut at = to;
        for _ in 0..MOST_TURNS {
            let mut nearest = self.near(at, at).map(|outline| nearest_on_border(outline, at));
            let Some(nearest) = nearest.find(|nearest| nearest.distance(at) < self.radius_m) else { return at };
            // A little more than needed, or rounding would find it too near again.
            at = nearest + (at - nearest).normalize_or_zero() * (self.radius_m + 1e-9);
        }
        from
    }

    /// The fixed obstacles that may touch a body on the way between two points.
    fn near(&self, from: Point, to: Point) -> impl Iterator<Item = &[Point]> {
        let reach = Vector::splat(self.radius_m as f32 + CLEARANCE_M);
        let around = Aabb::new(from.min(to).as_vec2() - reach, from.max(to).as_vec2() + reach);
        let around = BvhNode::leaf(around, 0);
        let leaves = self.parts.tree.leaves(move |node| node.intersects(&around));
        leaves.filter_map(|leaf| self.fixed.get(leaf as usize)).map(|outline| &outline[..])
    }
}

fn nearest_on_border(outline: &[Point], p: Point) -> Point {
    let nearest = geometry::sides(outline).map(|(a, b)| geometry::nearest_on_segment(p, a, b));
    nearest.fold(
        Point::INFINITY,
        |best, on_side| {
            if on_side.distance_squared(p) < best.distance_squared(p) { on_side } else { best }
        },
    )
}
