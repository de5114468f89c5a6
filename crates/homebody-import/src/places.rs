//! Places with names that roles know, for things that only the plan's own words or furniture reveal.

use crate::floor::BuiltFloor;
use crate::furniture::Furniture;
use crate::names::NamePool;
use homebody_core::geometry::{self, Point};
use homebody_core::languages::{RoomUse, room_use};
use homebody_core::plan::FLAT_M;
use homebody_core::role::Role;

/// The name of a place that stands for a role, and its rooms.
const CALLED: [(Role, &str, RoomUse); 3] = [
    (Role::Fridge, "kitchen", RoomUse::Kitchen),
    (Role::Toilet, "bathroom", RoomUse::Bathroom),
    (Role::Armchair, "living room", RoomUse::LivingRoom),
];

/// Other roles of a kitchen than the fridge.
const IN_KITCHENS: [Role; 2] = [Role::Stove, Role::Sink];

/// Step between the places tried in a room, and smallest distance from walls and furniture (our choice).
const STEP_M: f64 = 0.1;
const CLEAR_M: f64 = 0.3;

/// Largest number of places tried in a room (our choice). A larger room is a hall.
const MOST_TRIED: f64 = 10_000.0;

pub fn named(floor: &BuiltFloor, names: &mut NamePool) -> Vec<(String, Point)> {
    let mut places = Vec::new();
    for (role, name, used_as) in CALLED {
        let is_known = floor.furniture.iter().any(|piece| piece.is_for(role))
            || floor.rooms.iter().any(|room| role.is_called(&room.name.to_lowercase()));
        if is_known {
            continue;
        }
        let in_kitchen = |piece: &&Furniture| IN_KITCHENS.iter().any(|&role| piece.is_for(role));
        let beside = floor.furniture.iter().find(in_kitchen).filter(|_| role == Role::Fridge).map(|piece| piece.at);
        let within = |p: Point| floor.rooms.iter().position(|room| geometry::contains(&room.outline, p));
        let called = || floor.rooms.iter().position(|room| room_use(&room.name) == Some(used_as));
        let spot = beside.and_then(|p| free(floor, within(p)?, Some(p))).or_else(|| free(floor, called()?, None));
        // Roles do not know names with a number.
        places.extend(spot.filter(|_| names.is_free(name)).map(|p| (names.give(name, name), p)));
    }
    places
}

/// A place in a room to stand: the nearest to a point, or the one with the most room around it.
fn free(floor: &BuiltFloor, room: usize, near: Option<Point>) -> Option<Point> {
    let outline = &floor.rooms[room].outline;
    let (least, most) = geometry::bounds(outline.iter().copied());
    let size = most - least;
    let step_m = STEP_M.max((size.x * size.y / MOST_TRIED).sqrt());
    let solid = floor.furniture.iter().filter(|piece| piece.height_m > FLAT_M);
    let solids: Vec<[Point; 4]> = solid.map(Furniture::outline).collect();
    let clear_m = |p: Point| {
        let pieces = solids.iter().map(|solid| geometry::distance_to_area(solid, p));
        let walls = floor
            .walls
            .iter()
            .map(|wall| geometry::distance_to_segment(p, wall.from, wall.to) - wall.thickness_m / 2.0);
        pieces.chain(walls).fold(geometry::distance_to_border(outline, p), f64::min)
    };
    let (columns, rows) = ((size.x / step_m) as usize, (size.y / step_m) as usize);
    let at = |index: usize| least + Point::new((index % (columns + 1)) as f64, (index / (columns + 1)) as f64) * step_m;
    let all = (0..(columns + 1) * (rows + 1)).map(at).filter(|p| geometry::contains(outline, *p));
    let clear = all.map(|p| (clear_m(p), p)).filter(|(clear_m, _)| *clear_m >= CLEAR_M);
    let best = match near {
        Some(near) => clear.min_by(|a, b| a.1.distance(near).total_cmp(&b.1.distance(near))),
        None => clear.max_by(|a, b| a.0.total_cmp(&b.0)),
    };
    best.map(|(_, p)| p)
}
