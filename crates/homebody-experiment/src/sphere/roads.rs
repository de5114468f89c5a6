//! The ways through a house: where a person can stand, and how to get from there to anywhere else.
//!
//! A lattice of points with clearance, the middles of open doors, and the seats and beds; neighbours
//! with a free straight line between them are linked. Ways are shortest paths in this graph with the
//! waypoints taken out that a straight line can do without.

use homebody_core::geometry::{self, Point};
use homebody_core::home::plan::{Opening, Origin, Plan, Solid};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

/// Half a body and a little (ours): the narrowest passage of the house, 0.73 m, still has room.
const CLEARANCE_M: f64 = 0.25;
/// Narrow enough that some lattice line runs through any passage from 0.7 m on that runs along the axes.
const LATTICE_M: f64 = 0.2;
/// Lattice points are linked to their eight neighbours, doors to whatever is as near as this.
const DOOR_LINK_M: f64 = 0.6;
/// From the middle of a double bed to the floor beside it.
const SEAT_LINK_M: f64 = 1.6;

/// A point of the graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    pub at: Point,
    pub kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// The floor of a room.
    Floor { room: usize },
    /// The middle of an open door and the rooms on its sides.
    Door { rooms: [usize; 2] },
    /// Enterable furniture; `extent_m` is its greatest length.
    Seat { room: usize, extent_m: f64 },
}

/// The graph of a house.
pub struct Roads<'a> {
    plan: &'a Plan,
    pub nodes: Vec<Node>,
    links: Vec<Vec<(usize, f64)>>,
}

/// How far everything is from one node.
pub struct Reach {
    /// Infinite where no way leads.
    pub distance_m: Vec<f64>,
    before: Vec<usize>,
}

impl<'a> Roads<'a> {
    pub fn new(plan: &'a Plan) -> Roads<'a> {
        let mut roads = Roads { plan, nodes: Vec::new(), links: Vec::new() };
        roads.add_floor();
        let floor = roads.nodes.len();
        roads.add_doors();
        let doors = roads.nodes.len();
        roads.add_seats();
        roads.links = vec![Vec::new(); roads.nodes.len()];
        for node in 0..roads.nodes.len() {
            for other in 0..node.min(doors) {
                let (a, b) = (roads.nodes[node].at, roads.nodes[other].at);
                let free = match node {
                    _ if node < floor => a.distance(b) < LATTICE_M * 1.5 && roads.is_free(a, b),
                    _ if node < doors => a.distance(b) < DOOR_LINK_M && roads.is_free(a, b),
                    // A seat may stand against a wall, and one gets up over its own edge.
                    _ => other < floor && a.distance(b) < SEAT_LINK_M && !roads.is_stopped(a, b, 0.05),
                };
                if free {
                    roads.links[node].push((other, a.distance(b)));
                    roads.links[other].push((node, a.distance(b)));
                }
            }
        }
        roads
    }

    fn add_floor(&mut self) {
        let (least, most) = self.plan.bounds();
        let count = ((most - least) / LATTICE_M).ceil();
        for (column, row) in
            (0..count.x as usize).flat_map(|column| (0..count.y as usize).map(move |row| (column, row)))
        {
            let at = least + Point::new(column as f64, row as f64) * LATTICE_M;
            let seated = self.seats().any(|seat| geometry::contains(&seat.outline, at));
            if let Some(room) = self.plan.room_at(at)
                && !seated
                && self.plan.is_walkable(at, CLEARANCE_M)
            {
                self.nodes.push(Node { at, kind: Kind::Floor { room } });
            }
        }
    }

    fn add_doors(&mut self) {
        for Opening { outline: opening, .. } in &self.plan.openings {
            let middle = (opening[0] + opening[2]) / 2.0;
            // The corners run along the wall, then across it; a step further is in the room.
            let across = (opening[2] - opening[1]) / 2.0;
            let beyond = across + across.normalize_or_zero() * 0.1;
            let rooms = (self.plan.room_at(middle - beyond), self.plan.room_at(middle + beyond));
            if let (Some(a), Some(b)) = rooms
                && a != b
            {
                self.nodes.push(Node { at: middle, kind: Kind::Door { rooms: [a, b] } });
            }
        }
    }

    fn add_seats(&mut self) {
        let seats = self.seats().filter_map(|seat| {
            let at = geometry::inner_point(&seat.outline);
            let (least, most) = geometry::bounds(seat.outline.iter().copied());
            let extent_m = (most - least).max_element();
            Some(Node { at, kind: Kind::Seat { room: self.plan.room_at(at)?, extent_m } })
        });
        let seats: Vec<Node> = seats.collect();
        self.nodes.extend(seats);
    }

    fn seats(&self) -> impl Iterator<Item = &Solid> {
        let seats = self.plan.solids.iter().filter(|solid| !solid.stops_bodies);
        seats.filter(|solid| matches!(solid.origin, Origin::Furniture(_)))
    }

    /// Whether a body can walk the straight line, around seats and beds too.
    fn is_free(&self, a: Point, b: Point) -> bool {
        !self.is_stopped(a, b, CLEARANCE_M)
            && !self.seats().any(|seat| geometry::segment_inside_convex(&seat.outline, a, b).is_some())
    }

    fn is_stopped(&self, a: Point, b: Point, clearance_m: f64) -> bool {
        let mut stops = self.plan.solids.iter().filter(|solid| solid.stops_bodies);
        stops.any(|solid| distance_to_leg(&solid.outline, a, b) < clearance_m)
    }

    /// The doors on the way from one room to another through the fewest others; none if no way leads there.
    pub fn doors_between(&self, from: usize, to: usize) -> Vec<usize> {
        let doors = self.nodes.iter().enumerate().filter_map(|(node, Node { kind, .. })| match kind {
            Kind::Door { rooms } => Some((node, *rooms)),
            _ => None,
        });
        let doors: Vec<(usize, [usize; 2])> = doors.collect();
        let mut came_by: Vec<Option<(usize, usize)>> = vec![None; self.plan.rooms.len()];
        let mut queue = VecDeque::from([from]);
        while let Some(room) = queue.pop_front() {
            for &(door, [a, b]) in &doors {
                let next = if a == room { b } else { a };
                if (a == room || b == room) && next != from && came_by[next].is_none() {
                    came_by[next] = Some((door, room));
                    queue.push_back(next);
                }
            }
        }
        let mut way = Vec::new();
        let mut room = to;
        while let Some((door, before)) = came_by[room] {
            way.push(door);
            room = before;
        }
        way.reverse();
        way
    }

    /// How far everything is from a node (Dijkstra).
    pub fn reach(&self, from: usize) -> Reach {
        let mut reach =
            Reach { distance_m: vec![f64::INFINITY; self.nodes.len()], before: vec![usize::MAX; self.nodes.len()] };
        reach.distance_m[from] = 0.0;
        // Whole micrometres, because floats have no order.
        let key = |distance_m: f64| (distance_m * 1e6) as u64;
        let mut open = BinaryHeap::from([Reverse((0, from))]);
        while let Some(Reverse((distance, node))) = open.pop() {
            if distance > key(reach.distance_m[node]) {
                continue;
            }
            for &(next, length_m) in &self.links[node] {
                let distance_m = reach.distance_m[node] + length_m;
                if distance_m < reach.distance_m[next] {
                    reach.distance_m[next] = distance_m;
                    reach.before[next] = node;
                    open.push(Reverse((key(distance_m), next)));
                }
            }
        }
        reach
    }

    /// The waypoints to a node that the reach covers, without the start.
    pub fn way(&self, reach: &Reach, to: usize) -> Vec<Point> {
        let mut nodes = vec![to];
        while let Some(&before) = reach.before.get(nodes[nodes.len() - 1]).filter(|&&before| before != usize::MAX) {
            nodes.push(before);
        }
        nodes.reverse();
        let points: Vec<Point> = nodes.iter().map(|&node| self.nodes[node].at).collect();
        let (mut way, mut here) = (Vec::new(), 0);
        while here + 1 < points.len() {
            let straight = (here + 2..points.len()).rev().find(|&next| self.is_free(points[here], points[next]));
            here = straight.unwrap_or(here + 1);
            way.push(points[here]);
        }
        way
    }
}

/// The least distance between a straight leg and a convex outline; zero if they meet.
fn distance_to_leg(outline: &[Point], a: Point, b: Point) -> f64 {
    if geometry::segment_inside_convex(outline, a, b).is_some() {
        return 0.0;
    }
    let ends = geometry::distance_to_border(outline, a).min(geometry::distance_to_border(outline, b));
    outline.iter().map(|&corner| geometry::distance_to_segment(corner, a, b)).fold(ends, f64::min)
}

#[cfg(test)]
mod tests {
    use super::super::path::tests::{house, room};
    use super::*;

    #[test]
    fn ways_keep_clear_of_walls_and_beds() {
        let plan = house();
        let roads = Roads::new(&plan);
        let of_room = |name: &str, seat: bool| {
            let room = room(&plan, name);
            let fits = |kind: Kind| match kind {
                Kind::Floor { room: of } => of == room && !seat,
                Kind::Seat { room: of, .. } => of == room && seat,
                Kind::Door { .. } => false,
            };
            roads.nodes.iter().position(|node| fits(node.kind)).unwrap()
        };
        let (kitchen, bed) = (of_room("kitchen", false), of_room("bedroom", true));
        let reach = roads.reach(kitchen);
        let way = roads.way(&reach, bed);
        assert_eq!(way.last(), Some(&roads.nodes[bed].at));
        let mut length_m = 0.0;
        let mut here = roads.nodes[kitchen].at;
        for (index, &next) in way.iter().enumerate() {
            let clearance_m = if index + 1 == way.len() { 0.0 } else { CLEARANCE_M };
            assert!(!roads.is_stopped(here, next, clearance_m - 1e-9), "{here} to {next}");
            length_m += here.distance(next);
            here = next;
        }
        assert!(length_m <= reach.distance_m[bed] + 1e-9);
        assert!(way.len() < 8, "{way:?} is not straightened");
    }

    #[test]
    fn rooms_are_joined_by_their_doors() {
        let plan = house();
        let roads = Roads::new(&plan);
        let (kitchen, hall, bedroom) = (room(&plan, "kitchen"), room(&plan, "hall"), room(&plan, "bedroom"));
        let doors = roads.doors_between(kitchen, bedroom);
        let at: Vec<Point> = doors.iter().map(|&door| roads.nodes[door].at).collect();
        assert_eq!(at, [Point::new(3.0, 0.8), Point::new(5.0, 2.2)]);
        let Kind::Door { mut rooms } = roads.nodes[doors[0]].kind else { panic!("no door") };
        rooms.sort();
        assert_eq!(rooms, [kitchen, hall]);
        assert!(roads.doors_between(kitchen, room(&plan, "shed")).is_empty());
        assert!(roads.doors_between(hall, hall).is_empty());
    }
}
