//! The house of the recordings: places to stand and sit in its rooms, the doors between them, and the distances.
//!
//! Paths are those of a mesh for the resident's body. The places to stand are the free points of a lattice.

use homebody_core::geometry::{self, Point};
use homebody_core::plan::{Opening, Origin, Plan};
use homebody_walk::{Mesh, Routes};
use std::collections::VecDeque;
use std::sync::Arc;

/// Distance between the points to stand on (our choice): less than a step.
const LATTICE_M: f64 = 0.2;

/// Distance beyond its radius that a body keeps from things (our choice). With 0.22 m, the narrowest passage of the
/// SPHERE house, 0.73 m, is still wide enough.
const KEEPS_OFF_M: f64 = 0.03;

/// A house with its paths. Points are metres in its plane, rooms are indices into those of its plan.
pub struct SphereHouse<'a> {
    pub(super) plan: &'a Plan,
    routes: Routes,
    floor: Vec<Vec<Point>>,
    doors: Vec<Door>,
    seats: Vec<Seat>,
}

struct Door {
    at: Point,
    rooms: [usize; 2],
}

struct Seat {
    at: Point,
    room: usize,
    extent_m: f64,
}

/// A path without its start, and its length.
#[derive(Clone, Debug)]
pub(super) struct HouseWay {
    pub(super) to: Arc<[Point]>,
    pub(super) length_m: f64,
}

impl<'a> SphereHouse<'a> {
    /// The house for a body with this radius, which is above 0.
    pub fn new(plan: &'a Plan, radius_m: f64) -> SphereHouse<'a> {
        let mesh = Mesh::new(plan, radius_m + KEEPS_OFF_M);
        let floor = floor(plan, &mesh);
        SphereHouse { plan, routes: Routes::new(Arc::new(mesh)), floor, doors: doors(plan), seats: seats(plan) }
    }

    /// The points of a room to stand on; empty if the body does not fit into it.
    pub(super) fn floor(&self, room: usize) -> &[Point] {
        &self.floor[room]
    }

    /// The shortest path; `None` without a path.
    pub(super) fn way(&mut self, from: Point, to: Point) -> Option<HouseWay> {
        let way = self.routes.path(from, to)?;
        let length_m = [from].iter().chain(&*way).zip(&*way).map(|(a, b)| a.distance(*b)).sum();
        Some(HouseWay { to: way, length_m })
    }

    pub(super) fn distance_m(&mut self, from: Point, to: Point) -> f64 {
        self.way(from, to).map_or(f64::INFINITY, |way| way.length_m)
    }

    /// The distance of each point to stand on in a room, in their order.
    pub(super) fn floor_distances_m(&mut self, from: Point, room: usize) -> Vec<f64> {
        (0..self.floor[room].len()).map(|index| self.distance_m(from, self.floor[room][index])).collect()
    }

    /// The middles of the seats and beds of a room, each with its greatest length in metres.
    pub(super) fn seats(&self, room: usize) -> Vec<(Point, f64)> {
        let of_room = self.seats.iter().filter(|seat| seat.room == room);
        of_room.map(|seat| (seat.at, seat.extent_m)).collect()
    }

    /// The middles of the doors on the path from one room to another through the fewest others; empty without a path.
    pub(super) fn doors_between(&self, from: usize, to: usize) -> Vec<Point> {
        let mut came_by: Vec<Option<(Point, usize)>> = vec![None; self.plan.rooms.len()];
        let mut queue = VecDeque::from([from]);
        while let Some(room) = queue.pop_front() {
            for &Door { at, rooms: [a, b] } in &self.doors {
                let next = if a == room { b } else { a };
                if (a == room || b == room) && next != from && came_by[next].is_none() {
                    came_by[next] = Some((at, room));
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
}

fn floor(plan: &Plan, mesh: &Mesh) -> Vec<Vec<Point>> {
    let (least, most) = plan.bounds();
    let count = ((most - least) / LATTICE_M).ceil();
    let mut floor = vec![Vec::new(); plan.rooms.len()];
    for (column, row) in (0..count.x as usize).flat_map(|column| (0..count.y as usize).map(move |row| (column, row))) {
        let at = least + Point::new(column as f64, row as f64) * LATTICE_M;
        if let Some(room) = plan.room_at(at)
            && mesh.is_free(at)
        {
            floor[room].push(at);
        }
    }
    floor
}

fn doors(plan: &Plan) -> Vec<Door> {
    let door = |Opening { outline, .. }: &Opening| {
        let middle = (outline[0] + outline[2]) / 2.0;
        // The corners run along the wall, then across it; a step further is in the room.
        let across = (outline[2] - outline[1]) / 2.0;
        let beyond = across + across.normalize_or_zero() * 0.1;
        let (a, b) = (plan.room_at(middle - beyond)?, plan.room_at(middle + beyond)?);
        (a != b).then_some(Door { at: middle, rooms: [a, b] })
    };
    plan.openings.iter().filter_map(door).collect()
}

fn seats(plan: &Plan) -> Vec<Seat> {
    let furniture = plan.solids.iter().filter(|solid| matches!(solid.origin, Origin::Furniture(_)));
    let seats = furniture.filter(|solid| !solid.stops_bodies).filter_map(|seat| {
        let at = geometry::inner_point(&seat.outline);
        let (least, most) = geometry::bounds(seat.outline.iter().copied());
        Some(Seat { at, room: plan.room_at(at)?, extent_m: (most - least).max_element() })
    });
    seats.collect()
}

#[cfg(test)]
mod tests {
    use super::super::path::tests::{plan, room};
    use super::*;

    const RADIUS_M: f64 = 0.22;

    #[test]
    fn a_room_has_points_all_over_its_free_floor() {
        let plan = plan();
        let house = SphereHouse::new(&plan, RADIUS_M);
        for name in ["kitchen", "hall", "bedroom", "shed"] {
            let room = room(&plan, name);
            let floor = house.floor(room);
            assert!(floor.iter().all(|&at| plan.is_walkable(at, RADIUS_M) && plan.room_at(at) == Some(room)), "{name}");
            let (least, most) = geometry::bounds(floor.iter().copied());
            let (west_south, east_north) = geometry::bounds(plan.rooms[room].outline.iter().copied());
            assert!((least - west_south).max_element() < 0.6 && (east_north - most).max_element() < 0.6, "{name}");
        }
        let thick = SphereHouse::new(&plan, 1.6);
        assert!(thick.floor(room(&plan, "hall")).is_empty(), "a body that does not fit stands nowhere");
    }

    #[test]
    fn ways_are_as_long_as_they_are() {
        let plan = plan();
        let mut house = SphereHouse::new(&plan, RADIUS_M);
        let (from, bed) = (Point::new(2.0, 1.0), house.seats(room(&plan, "bedroom"))[0].0);
        let way = house.way(from, bed).unwrap();
        assert_eq!(way.to.last(), Some(&bed));
        let straight_m = from.distance(bed);
        assert!((straight_m..1.5 * straight_m).contains(&way.length_m), "{way:?}");
        assert_eq!(house.distance_m(from, Point::new(10.0, 1.0)), f64::INFINITY, "the shed has no door");
    }

    #[test]
    fn rooms_are_joined_by_their_doors() {
        let plan = plan();
        let house = SphereHouse::new(&plan, RADIUS_M);
        let (kitchen, hall, bedroom) = (room(&plan, "kitchen"), room(&plan, "hall"), room(&plan, "bedroom"));
        assert_eq!(house.doors_between(kitchen, bedroom), [Point::new(3.0, 0.8), Point::new(5.0, 2.2)]);
        assert_eq!(house.doors_between(bedroom, hall), [Point::new(5.0, 2.2)]);
        assert!(house.doors_between(kitchen, room(&plan, "shed")).is_empty());
        assert!(house.doors_between(hall, hall).is_empty());
    }
}
