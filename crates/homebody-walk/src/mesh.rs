//! The walkable floor of a home, and shortest ways on it.
//!
//! A mesh covers the floor that the middle of a body may be on. It is built once for a home and a radius; a way then
//! costs some microseconds. Ways lead around beds, chairs and toilets, and enter them by one straight last step.
//!
//! We assume that nothing in the home moves: doors stay as the plan has them, chairs where they are. A body turns
//! sideways in a narrow gap: if no way exists for the whole radius, three quarters of it are tried, then half. A step
//! into a seat may be 1.5 m long, any other step to a place too near to things half a metre.
//!
//! Every solid is grown by the radius, its corners rounded from outside, so that a way on the mesh keeps its distance
//! from all solids. The free ground is triangulated, and polyanya finds the any-angle shortest way (Cui, Harabor &
//! Grastien 2017). Borders of the home without a wall are fences. For a place off free ground, points of the ground
//! around it are tried, the nearest first, until nothing stands between.
//!
//! Left out: other people, doors that are opened on the way, and the shape of a body, which is not round.

mod floor;
mod ground;
#[cfg(test)]
mod tests;

use ground::{GroundPoint, WalkableGround};
use homebody_core::geometry::{self, Point};
use homebody_core::numbers::Numbers;
use homebody_core::plan::{Origin, Plan, Solid};
use homebody_core::random::Stream;

homebody_core::numbers! {
    /// Greatest height of enterable things that bodies walk over: rugs, mats, shower trays.
    static RUG_M = "mesh.rug": 0.05, "m", [0.0, 0.3];
    /// Share of its radius that a body takes when it turns sideways a little.
    static SIDEWAYS_A_LITTLE = "mesh.sideways_a_little": 0.75, "1", [0.5, 1.0];
    /// Share of its radius that a body takes when it turns sideways: shoulders are twice as wide as the chest is deep.
    static SIDEWAYS = "mesh.sideways": 0.5, "1", [0.2, 0.5];
    /// Longest step into a seat: to the middle of a wide bed.
    static INTO_SEAT_M = "mesh.into_seat": 1.5, "m", [0.2, 5.0];
    /// Longest step to another place that is too near to things.
    static TO_PLACE_M = "mesh.to_place": 0.5, "m", [0.0, 3.0];
}

/// Number of tries for a random point before the room's own point is used (our choice).
const TRIES: u32 = 32;

/// The floor of a home for a body of one radius, in metres in the plane of the home.
#[derive(Clone, Debug)]
pub struct Mesh {
    plan: Plan,
    obstacles: Vec<Obstacle>,
    /// Pieces of the outer border.
    borders: Vec<(Point, Point)>,
    /// For the whole radius, then for the two narrower ones.
    grounds: Vec<WalkableGround>,
    /// By room of the plan, a free point to go to, and its connected area.
    rooms: Vec<(Point, Option<usize>)>,
    into_seat_m: f64,
    to_place_m: f64,
}

#[derive(Clone, Debug)]
struct Obstacle {
    outline: Vec<Point>,
    is_seat: bool,
    least: Point,
    most: Point,
}

impl Obstacle {
    /// A cheap test of bounding boxes, before the exact geometry.
    fn may_be_near(&self, least: Point, most: Point, distance_m: f64) -> bool {
        let reach = Point::splat(distance_m);
        (self.least - reach).cmple(most).all() && (self.most + reach).cmpge(least).all()
    }

    /// A lower bound of its distance to a point.
    fn away(&self, p: Point) -> f64 {
        p.distance(p.clamp(self.least, self.most))
    }

    /// A seat contains a person at the point.
    fn holds(&self, p: Point) -> bool {
        self.is_seat && geometry::contains(&self.outline, p)
    }

    /// By more than a touch.
    fn cuts(&self, a: Point, b: Point) -> bool {
        geometry::segment_inside_convex(&self.outline, a, b).is_some_and(|(enter, leave)| leave - enter > 1e-9)
    }
}

impl Mesh {
    /// `radius_m` is above 0. Takes some milliseconds.
    pub fn new(plan: &Plan, radius_m: f64) -> Mesh {
        Mesh::with_numbers(plan, radius_m, &Numbers::default())
    }

    pub fn with_numbers(plan: &Plan, radius_m: f64, numbers: &Numbers) -> Mesh {
        let rug_m = numbers.of(&RUG_M);
        // A closed door within the home can be opened.
        let is_furniture = |solid: &Solid| matches!(solid.origin, Origin::Furniture(_));
        let obstacles: Vec<Obstacle> = plan
            .solids
            .iter()
            .filter(|solid| solid.stops_bodies || is_furniture(solid) && solid.height_m > rug_m)
            .map(|solid| {
                let (least, most) = geometry::bounds(solid.outline.iter().copied());
                Obstacle { outline: solid.outline.clone(), is_seat: !solid.stops_bodies, least, most }
            })
            .collect();
        let borders = borders(plan);
        let outlines: Vec<&[Point]> = obstacles.iter().map(|obstacle| &obstacle.outline[..]).collect();
        let ground =
            |part: f64| WalkableGround::new(plan.bounds(), &outlines, &borders, radius_m * part, |p| plan.is_inside(p));
        let grounds = [1.0, numbers.of(&SIDEWAYS_A_LITTLE), numbers.of(&SIDEWAYS)].map(ground).into();
        let (into_seat_m, to_place_m) = (numbers.of(&INTO_SEAT_M), numbers.of(&TO_PLACE_M));
        let rooms = Vec::new();
        let mut mesh = Mesh { plan: plan.clone(), obstacles, borders, grounds, rooms, into_seat_m, to_place_m };
        mesh.rooms = plan.rooms.iter().map(|room| mesh.room_point(&room.outline)).collect();
        mesh
    }

    pub fn is_free(&self, p: Point) -> bool {
        self.grounds.first().is_some_and(|ground| self.is_free_for(p, ground.clearance_m))
    }

    /// The free point for one straight step to `to`: `to` itself if it is free, else the nearest, preferably in the
    /// largest area. `None` without one.
    pub fn approach(&self, to: Point) -> Option<Point> {
        if self.is_free(to) {
            return Some(to);
        }
        let footings = self.grounds.iter().map(|ground| (ground, self.footings(ground, to)));
        let (ground, footings) = footings.into_iter().find(|(_, footings)| !footings.is_empty())?;
        let largest = footings.into_iter().reduce(|a, b| if ground.size(b.area) > ground.size(a.area) { b } else { a });
        largest.map(|footing| footing.at)
    }

    /// The corners after `from`, and `to`; `None` without a route. Empty if the body is already there; straight within one
    /// seat.
    pub fn path(&self, from: Point, to: Point) -> Option<Vec<Point>> {
        if from == to {
            return Some(Vec::new());
        }
        let shares_seat = self.obstacles.iter().any(|seat| seat.holds(from) && seat.holds(to));
        if shares_seat && !self.blocks(from, to, |obstacle| !obstacle.is_seat) {
            return Some(vec![to]);
        }
        self.grounds.iter().find_map(|ground| self.path_over(ground, from, to))
    }

    pub fn can_reach(&self, from: Point, to: Point) -> bool {
        self.path(from, to).is_some()
    }

    /// The free point just inside an outer door, open or closed, whose opening has its middle at `door`. `None` if the body
    /// cannot stand within 1.5 m of it.
    pub fn inside_of(&self, door: Point) -> Option<Point> {
        let ground = self.grounds.first()?;
        let stands_in_opening = |p| self.plan.openings.iter().any(|opening| geometry::contains(&opening.outline, p));
        let step = |at: Point| {
            let area = ground.area_at(at)?;
            let is_room = self.plan.room_at(at).is_some() && !stands_in_opening(at);
            let is_between =
                |obstacle: &Obstacle| !geometry::contains(&obstacle.outline, door) && obstacle.cuts(door, at);
            (is_room && !self.obstacles.iter().any(is_between)).then(|| (ground.size(area), self.room_around(at), at))
        };
        (1..=15).find_map(|tenths| {
            let around =
                (0..16).map(|part| door + geometry::direction(f64::from(part) * 22.5) * (f64::from(tenths) / 10.0));
            let best = around.filter_map(step).reduce(|a, b| if (b.0, b.1) > (a.0, a.1) { b } else { a });
            best.map(|(_, _, at)| at)
        })
    }

    /// A free point of a room of the plan, uniform over those with a route to the room's own point. Draws at most 64
    /// values; if all tries fail, it is the room's own point.
    pub fn free_point(&self, room: usize, stream: &mut Stream) -> Point {
        let (own, area) = self.rooms[room];
        let room = &self.plan.rooms[room].outline;
        let (least, most) = geometry::bounds(room.iter().copied());
        for _ in 0..TRIES {
            let p = Point::new(stream.between(least.x, most.x), stream.between(least.y, most.y));
            let is_near = || self.grounds.first().is_some_and(|ground| ground.area_at(p) == area);
            if area.is_some() && geometry::contains(room, p) && is_near() {
                return p;
            }
        }
        own
    }

    /// The free distance from a point in a direction (degrees, 0 east, 90 north), to the centimetre and at most `most_m`. 0
    /// if the point is not free.
    pub fn free_way(&self, from: Point, towards_deg: f64, most_m: f64) -> f64 {
        let ahead = geometry::direction(towards_deg);
        let is_clear = |metres: f64| self.is_clear_way(from, from + ahead * metres);
        if is_clear(most_m) {
            return most_m;
        }
        let (mut clear, mut blocked) = (0.0, most_m);
        while blocked - clear > 0.01 {
            let middle = (clear + blocked) / 2.0;
            if is_clear(middle) { clear = middle } else { blocked = middle }
        }
        clear
    }

    fn is_clear(&self, from: Point, to: Point, clearance_m: f64) -> bool {
        let (least, most) = (from.min(to), from.max(to));
        let is_near = |obstacle: &Obstacle| {
            obstacle.may_be_near(least, most, clearance_m)
                && distance_in_segment(&obstacle.outline, from, to) < clearance_m
        };
        self.plan.is_inside(from)
            && self.plan.is_inside(to)
            && !self.obstacles.iter().any(is_near)
            && !self.meets_border(from, to)
    }

    fn meets_border(&self, from: Point, to: Point) -> bool {
        let (least, most) = (from.min(to), from.max(to));
        self.borders.iter().any(|&(a, b)| {
            let may_meet = a.min(b).cmple(most).all() && a.max(b).cmpge(least).all();
            may_meet && geometry::segments_meet(from, to, a, b)
        })
    }

    pub(super) fn sides_near(&self, p: Point, reach_m: f64) -> Vec<(Point, Point)> {
        let is_near = |&(a, b): &(Point, Point)| p.distance(p.clamp(a.min(b), a.max(b))) <= reach_m;
        let obstacles = self.obstacles.iter().filter(|obstacle| obstacle.away(p) <= reach_m);
        let sides = obstacles.flat_map(|obstacle| geometry::sides(&obstacle.outline));
        sides.chain(self.borders.iter().copied()).filter(is_near).collect()
    }

    pub(super) fn is_clear_way(&self, from: Point, to: Point) -> bool {
        self.grounds.first().is_some_and(|ground| self.is_clear(from, to, ground.clearance_m))
    }

    fn path_over(&self, ground: &WalkableGround, from: Point, to: Point) -> Option<Vec<Point>> {
        let (starts, ends) = (self.footings(ground, from), self.footings(ground, to));
        let pairs = starts.iter().flat_map(|start| ends.iter().map(move |end| (start, end)));
        let (start, end) = pairs
            .filter(|(start, end)| start.area == end.area)
            .min_by(|a, b| (a.0.away_m + a.1.away_m).total_cmp(&(b.0.away_m + b.1.away_m)))?;
        let mut way = vec![start.at];
        way.extend(ground.way(start.at, end.at)?);
        self.straighten(&mut way, ground.clearance_m);
        let mut path = vec![from];
        path.extend(way);
        path.push(to);
        path.dedup();
        path.remove(0);
        Some(path)
    }

    /// Joins two corners within a step into one if there is room, because people turn once.
    fn straighten(&self, way: &mut Vec<Point>, clearance_m: f64) {
        let mut first = 1;
        while first + 2 < way.len() {
            let (before, after) = (way[first - 1], way[first + 2]);
            let corner = corner_of([before, way[first], way[first + 1], after]);
            match corner.filter(|&corner| {
                self.is_clear(before, corner, clearance_m) && self.is_clear(corner, after, clearance_m)
            }) {
                Some(corner) => {
                    way[first] = corner;
                    way.remove(first + 1);
                }
                None => first += 1,
            }
        }
    }

    /// By connected area, the starting point of one straight step to `p`.
    fn footings(&self, ground: &WalkableGround, p: Point) -> Vec<GroundPoint> {
        if let Some(area) = ground.area_at(p) {
            return vec![GroundPoint { at: p, area, away_m: 0.0 }];
        }
        let is_seat = self.obstacles.iter().any(|obstacle| obstacle.holds(p));
        let reach_m = if is_seat { self.into_seat_m } else { self.to_place_m };
        // The step keeps the distance of the place itself, or of the narrowest route.
        let narrowest_m = self.grounds.last().map_or(0.0, |ground| ground.clearance_m);
        let keeps_m = if is_seat { 0.0 } else { narrowest_m.min(self.room_around(p) - 1e-6) };
        let keeps_off = |at: Point| keeps_m <= 0.0 || self.is_clear(p, at, keeps_m);
        let around = ground.around(p, reach_m);
        let mut footings: Vec<GroundPoint> = Vec::new();
        // Routes into bed avoid chairs if possible.
        for climbs in [false, true] {
            for footing in &around {
                let counts =
                    |obstacle: &Obstacle| !obstacle.is_seat || !climbs && !geometry::contains(&obstacle.outline, p);
                let is_new = footings.iter().all(|known| known.area != footing.area);
                if is_new && !self.blocks(p, footing.at, counts) && keeps_off(footing.at) {
                    footings.push(*footing);
                }
            }
        }
        footings
    }

    fn blocks(&self, a: Point, b: Point, counts: impl Fn(&Obstacle) -> bool) -> bool {
        self.obstacles.iter().any(|obstacle| counts(obstacle) && obstacle.cuts(a, b)) || self.meets_border(a, b)
    }

    /// A free point of the room, and its area; if the whole radius does not fit, the free point nearest to the middle, or
    /// the middle.
    fn room_point(&self, room: &[Point]) -> (Point, Option<usize>) {
        let middle = geometry::inner_point(room);
        let Some(ground) = self.grounds.first() else { return (middle, None) };
        let (least, most) = geometry::bounds(room.iter().copied());
        let around = ground.around(middle, least.distance(most)).into_iter();
        let best = around
            .filter(|footing| geometry::contains(room, footing.at))
            .reduce(|a, b| if ground.size(b.area) > ground.size(a.area) { b } else { a });
        match best {
            Some(footing) => (footing.at, Some(footing.area)),
            None => (self.approach(middle).unwrap_or(middle), None),
        }
    }

    fn is_free_for(&self, p: Point, clearance_m: f64) -> bool {
        self.plan.is_inside(p) && self.room_around(p) >= clearance_m
    }

    fn room_around(&self, p: Point) -> f64 {
        self.obstacles.iter().fold(f64::INFINITY, |least, obstacle| match obstacle.away(p) <= least {
            true => least.min(geometry::distance_to_area(&obstacle.outline, p)),
            false => least,
        })
    }
}

/// Distance on both sides of a border at which the home is looked up.
const BESIDE_M: f64 = 1e-3;

fn borders(plan: &Plan) -> Vec<(Point, Point)> {
    let openings = || plan.openings.iter().map(|opening| &opening.outline);
    let parts = || plan.rooms.iter().map(|room| &room.outline).chain(openings());
    let mut borders = Vec::new();
    for (a, b) in parts().flat_map(|outline| geometry::sides(outline)) {
        let way = b - a;
        let mut cuts = vec![0.0, 1.0];
        for (c, d) in parts().flat_map(|outline| geometry::sides(outline)) {
            let turn = way.perp_dot(d - c);
            cuts.push((c - a).perp_dot(d - c) / turn);
            // Sides in one line cut each other at their ends.
            cuts.extend([c, d].map(|end| (end - a).dot(way) / way.length_squared()));
        }
        cuts.retain(|cut| (0.0..=1.0).contains(cut));
        cuts.sort_by(f64::total_cmp);
        let beside = way.normalize_or_zero().perp() * BESIDE_M;
        for pair in cuts.windows(2).filter(|pair| (pair[1] - pair[0]) * way.length() > BESIDE_M) {
            let middle = a + way * ((pair[0] + pair[1]) / 2.0);
            if plan.is_inside(middle + beside) != plan.is_inside(middle - beside) {
                borders.push((a + way * pair[0], a + way * pair[1]));
            }
        }
    }
    borders
}

/// The intersection of the first and last leg of a route with two corners, if it is near to both.
fn corner_of([before, first, second, after]: [Point; 4]) -> Option<Point> {
    let (come, go) = (first - before, after - second);
    let turn = come.perp_dot(go);
    let further = (second - first).perp_dot(go) / turn;
    let earlier = (second - first).perp_dot(come) / turn;
    let corner = first + come * further;
    let is_near = [first, second].iter().all(|bend| bend.distance(corner) <= ONE_CORNER_M);
    (turn != 0.0 && further >= 0.0 && earlier <= 0.0 && is_near).then_some(corner)
}

/// Distance from the meeting point of corners within which they become one (our choice).
const ONE_CORNER_M: f64 = 0.25;

fn distance_in_segment(outline: &[Point], from: Point, to: Point) -> f64 {
    if geometry::segment_inside_convex(outline, from, to).is_some() {
        return 0.0;
    }
    let corners = outline.iter().map(|&corner| geometry::distance_to_segment(corner, from, to));
    let ends = [from, to].map(|end| geometry::distance_to_border(outline, end));
    corners.chain(ends).fold(f64::INFINITY, f64::min)
}
