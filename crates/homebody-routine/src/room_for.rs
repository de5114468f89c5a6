//! Free places for missing furniture, which people can reach without blocking other places.

use crate::behaviour::places::{HomePlace, HomePlaces};
use homebody_core::geometry::{self, Point, overlap};
use homebody_core::home::form::HomeFile;
use homebody_core::languages::{self, RoomUse};
use homebody_core::numbers::Numbers;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::plan::{Origin, Plan, Solid, furniture_outline};
use homebody_core::posture::Posture;
use homebody_core::resident::ResidentFile;
use homebody_core::role::Role;
use homebody_walk::Mesh;

/// A kind of furniture: size in metres, and its usual rooms, the most usual first.
struct Needed {
    role: Role,
    size_m: [f64; 2],
    height_m: f64,
    is_enterable: bool,
    rooms: &'static [RoomUse],
}

/// Usual sizes (our choice).
const NEEDED: [Needed; 8] = [
    Needed {
        role: Role::Bed,
        size_m: [0.9, 2.0],
        height_m: 0.5,
        is_enterable: true,
        rooms: &[RoomUse::Bedroom, RoomUse::LivingRoom],
    },
    Needed { role: Role::Toilet, size_m: [0.4, 0.65], height_m: 0.45, is_enterable: true, rooms: &[RoomUse::Bathroom] },
    Needed {
        role: Role::Armchair,
        size_m: [0.7, 0.7],
        height_m: 0.9,
        is_enterable: true,
        rooms: &[RoomUse::LivingRoom, RoomUse::Bedroom, RoomUse::Kitchen],
    },
    Needed { role: Role::Fridge, size_m: [0.6, 0.6], height_m: 1.8, is_enterable: false, rooms: KITCHEN },
    Needed {
        role: Role::DiningSeat,
        size_m: [0.45, 0.45],
        height_m: 0.9,
        is_enterable: true,
        rooms: &[RoomUse::Kitchen, RoomUse::LivingRoom],
    },
    Needed { role: Role::Stove, size_m: [0.6, 0.6], height_m: 0.9, is_enterable: false, rooms: KITCHEN },
    Needed {
        role: Role::Washbasin,
        size_m: [0.5, 0.4],
        height_m: 0.85,
        is_enterable: false,
        rooms: &[RoomUse::Bathroom],
    },
    Needed { role: Role::Shower, size_m: [0.8, 0.8], height_m: 0.05, is_enterable: true, rooms: &[RoomUse::Bathroom] },
];

const KITCHEN: &[RoomUse] = &[RoomUse::Kitchen, RoomUse::LivingRoom];

/// Step between the places tried, gap to a wall or to another piece, and distance from doors (our choice).
const STEP_M: f64 = 0.1;
const BESIDE_M: f64 = 0.02;
const FROM_DOORS_M: f64 = 0.7;

/// Room before the front of a piece (our choice).
const IN_FRONT_M: f64 = 0.6;

/// Distance from a wall that is as bad as a blocked front (our choice).
const BLOCKED_M: f64 = 1.0;

/// Distance from a wall within which a piece with its back to it is at the wall (our choice).
const AT_WALL_M: f64 = 0.3;

/// Largest numbers of places tried in a room, and of places walked to at its walls, elsewhere in it, and in all (our
/// choice): each walk takes time.
const MOST_TRIED: f64 = 4_000.0;
const MOST_WALKED_IN_ROOM: usize = 3;
const MOST_WALKED: usize = 18;
const MOST_WALKED_IN_ALL: usize = 60;

/// Largest number of separate parts of a home that are tried.
const MOST_PARTS: usize = 4;

pub const NEEDS: [Role; 4] = [Role::Bed, Role::Toilet, Role::Armchair, Role::Fridge];

#[derive(Clone, Debug, Default)]
pub struct MissingFurniture {
    /// By role, a new piece that fits next to those before it; `None` if none fits.
    pub pieces: Vec<(Role, Option<FurnitureFile>)>,
    pub rooms: Vec<String>,
}

impl MissingFurniture {
    pub fn piece(&self, role: Role) -> Option<&FurnitureFile> {
        self.pieces.iter().find(|(of, _)| *of == role)?.1.as_ref()
    }
}

///
/// The missing furniture, with a place for each piece in the best part of the home, for basic needs and the given roles
/// that are unreachable there.
///
/// The best part has, or has room for, most of the needs; then the one with the front door; then the largest.
pub fn lacking(home: &HomeFile, unreached: &[Role], resident: &ResidentFile, numbers: &Numbers) -> MissingFurniture {
    let plan = Plan::new(home);
    let mesh = Mesh::with_numbers(&plan, resident.radius_m, numbers);
    let parts = parts(home, &plan, &mesh);
    let has_name = |role: &&Role| NEEDED.iter().any(|needed| needed.role == **role) && !NEEDS.contains(role);
    let roles: Vec<Role> = NEEDS.iter().chain(unreached.iter().filter(has_name)).copied().collect();
    let mut best: Option<(usize, MissingFurniture)> = None;
    let mut left_to_walk = MOST_WALKED_IN_ALL;
    for part in parts.into_iter().take(MOST_PARTS) {
        let mut furnished = home.clone();
        let places = HomePlaces::from_hub(home, &plan, &mesh, &resident.name, Some(part.at));
        let is_there = |role: Role| {
            // Sleeping needs a place to lie or sit.
            let fits = |spot: &HomePlace| role != Role::Bed || spot.is_of(role) || spot.posture != Posture::Standing;
            places.for_role(role).is_some_and(|spot| spot.is_reachable && fits(spot))
                && places.out_of_reach(role).is_none()
        };
        let missing: Vec<Role> = roles.iter().copied().filter(|&role| !is_there(role)).collect();
        let mut pieces = Vec::new();
        for role in missing {
            let piece = piece(&furnished, role, &part, resident, numbers, &mut left_to_walk);
            furnished.furniture.extend(piece.clone());
            pieces.push((role, piece));
        }
        let left = pieces.iter().filter(|(_, piece)| piece.is_none()).count();
        if best.as_ref().is_none_or(|(least, _)| left < *least) {
            let rooms = part.rooms.iter().map(|&room| home.rooms[room].name.clone()).collect();
            best = Some((left, MissingFurniture { pieces, rooms }));
        }
        if left == 0 {
            break;
        }
    }
    best.map(|(_, lacking)| lacking).unwrap_or_default()
}

/// Rooms with routes between them, and a point in one.
struct ConnectedRooms {
    at: Point,
    rooms: Vec<usize>,
}

/// The part with the front door first, then the largest.
fn parts(home: &HomeFile, plan: &Plan, mesh: &Mesh) -> Vec<ConnectedRooms> {
    let mut parts: Vec<ConnectedRooms> = Vec::new();
    for room in 0..plan.rooms.len() {
        let outline = &plan.rooms[room].outline;
        // A table may stand in the middle.
        let beside = || grid(plan, room).find(|&at| geometry::contains(outline, at) && mesh.is_free(at));
        let Some(at) = mesh.approach(geometry::inner_point(outline)).or_else(beside) else { continue };
        match parts.iter_mut().find(|part| mesh.can_reach(part.at, at)) {
            Some(part) => part.rooms.push(room),
            None => parts.push(ConnectedRooms { at, rooms: vec![room] }),
        }
    }
    let outside = home.doors.iter().zip(&plan.things).filter(|(door, _)| door.outside).map(|(_, thing)| thing.at);
    let ways_out: Vec<Point> = outside.filter_map(|door| mesh.inside_of(door)).collect();
    let has_way_out = |part: &ConnectedRooms| ways_out.iter().any(|&at| mesh.can_reach(part.at, at));
    let area = |part: &ConnectedRooms| -> f64 {
        part.rooms.iter().map(|&room| geometry::signed_area(&plan.rooms[room].outline).abs()).sum()
    };
    parts.sort_by(|a, b| has_way_out(b).cmp(&has_way_out(a)).then(area(b).total_cmp(&area(a))));
    parts
}

///
/// A piece for a role in a free place of a part. `None` if nothing is free, or the role has no piece.
///
/// People of this radius reach it, and all that they reached before.
fn piece(
    home: &HomeFile,
    role: Role,
    part: &ConnectedRooms,
    resident: &ResidentFile,
    numbers: &Numbers,
    left_to_walk: &mut usize,
) -> Option<FurnitureFile> {
    let needed = NEEDED.iter().find(|needed| needed.role == role)?;
    let plan = Plan::new(home);
    let doors: Vec<Point> = plan.things.iter().take(home.doors.len()).map(|door| door.at).collect();
    let rooms = || home.rooms.iter().map(|room| room.name.as_str());
    let name = free_name(home, languages::called(role, rooms()).unwrap_or(role.row().names[0]));
    let new = |at: Point, turn_deg: f64| FurnitureFile {
        name: name.clone(),
        at: Some([at.x, at.y].map(|length| (length * 1e3).round() / 1e3)),
        size_m: Some(needed.size_m),
        turn_deg,
        outline: None,
        height_m: needed.height_m,
        enterable: needed.is_enterable,
        // A name with a number, or in another language, implies no role.
        role: (!role.is_called(&name.to_lowercase())).then_some(role),
    };
    let before = reached(home, &plan, part.at, resident, numbers);
    let mut walked = 0;
    for room in in_order(home, &plan, needed, part) {
        let mut fit: Vec<(f64, FurnitureFile)> = Vec::new();
        for turn_deg in [0.0, 90.0, 180.0, 270.0] {
            let places = grid(&plan, room).map(|at| new(at, turn_deg));
            fit.extend(places.filter_map(|piece| Some((out_of_place_m(&plan, room, &doors, &piece)?, piece))));
        }
        fit.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (at_walls, others) = fit.split_at(fit.partition_point(|(away_m, _)| *away_m < AT_WALL_M));
        // Adjacent places share their obstacles, so a few all over the room are tried.
        let spread = |places: &[(f64, FurnitureFile)]| -> Vec<FurnitureFile> {
            let step = places.len().div_ceil(MOST_WALKED_IN_ROOM).max(1);
            places.iter().step_by(step).map(|(_, piece)| piece.clone()).collect()
        };
        for piece in spread(at_walls).into_iter().chain(spread(others)) {
            walked += 1;
            if walked > MOST_WALKED || *left_to_walk == 0 {
                return None;
            }
            *left_to_walk -= 1;
            let mut furnished = home.clone();
            furnished.furniture.push(piece.clone());
            let now = reached(&furnished, &Plan::new(&furnished), part.at, resident, numbers);
            if now.contains(&piece.name.to_lowercase()) && before.iter().all(|name| now.contains(name)) {
                return Some(piece);
            }
        }
    }
    None
}

/// Names of the places that can be reached.
fn reached(home: &HomeFile, plan: &Plan, from: Point, resident: &ResidentFile, numbers: &Numbers) -> Vec<String> {
    let mesh = Mesh::with_numbers(plan, resident.radius_m, numbers);
    // A piece may stand on the point.
    let from = mesh.approach(from);
    let places = HomePlaces::from_hub(home, plan, &mesh, &resident.name, from);
    places.all().iter().filter(|spot| spot.is_reachable).map(|spot| spot.name.clone()).collect()
}

fn free_name(home: &HomeFile, wanted: &str) -> String {
    let furniture = home.furniture.iter().map(|piece| &piece.name);
    let others = home.rooms.iter().map(|room| &room.name).chain(home.places.iter().map(|place| &place.name));
    let taken: Vec<String> = furniture.chain(others).map(|name| name.trim().to_lowercase()).collect();
    let names = std::iter::once(wanted.to_owned()).chain((2..).map(|number| format!("{wanted} {number}")));
    names.into_iter().find(|name| !taken.contains(name)).unwrap_or_default()
}

/// Usual rooms first, then rooms of unknown use, the smallest first for a toilet, else the largest. Halls, garages and
/// other side rooms come last.
fn in_order(home: &HomeFile, plan: &Plan, needed: &Needed, part: &ConnectedRooms) -> Vec<usize> {
    let area = |room: usize| geometry::signed_area(&plan.rooms[room].outline).abs();
    let rank = |room: usize| match languages::room_use(&home.rooms[room].name) {
        None => 1,
        Some(RoomUse::Aside | RoomUse::Hall) => 4,
        Some(room_use) => match needed.rooms.iter().position(|usual| *usual == room_use) {
            Some(0) => 0,
            Some(_) => 2,
            None => 3,
        },
    };
    let is_small = needed.rooms == [RoomUse::Bathroom];
    let mut rooms = part.rooms.clone();
    rooms.sort_by(|&a, &b| {
        let by_area = if is_small { area(a).total_cmp(&area(b)) } else { area(b).total_cmp(&area(a)) };
        rank(a).cmp(&rank(b)).then(by_area)
    });
    rooms
}

fn grid(plan: &Plan, room: usize) -> impl Iterator<Item = Point> {
    let (least, most) = geometry::bounds(plan.rooms[room].outline.iter().copied());
    let size = most - least;
    let step_m = STEP_M.max((size.x * size.y / MOST_TRIED).sqrt());
    let (columns, rows) = ((size.x / step_m) as usize, (size.y / step_m) as usize);
    let at = move |index: usize| Point::new((index % columns.max(1)) as f64, (index / columns.max(1)) as f64);
    (0..columns * rows).map(move |index| least + (at(index) + 0.5) * step_m)
}

/// Distance of the back of a piece from a wall, with a penalty for a blocked front. `None` if the piece leaves the room,
/// overlaps something or stands in a doorway.
fn out_of_place_m(plan: &Plan, room: usize, doors: &[Point], piece: &FurnitureFile) -> Option<f64> {
    let outline = furniture_outline(piece);
    let around = &plan.rooms[room].outline;
    let is_within = |outline: &[Point]| {
        geometry::sides(outline)
            .all(|(a, b)| [0.0, 0.25, 0.5, 0.75].iter().all(|&share| geometry::contains(around, a + (b - a) * share)))
    };
    let is_free = |outline: &[Point]| {
        // A cheap test of bounding boxes, before the exact geometry.
        let (least, most) = geometry::bounds(outline.iter().copied());
        let may_meet = |solid: &&Solid| {
            let (low, high) = geometry::bounds(solid.outline.iter().copied());
            low.cmple(most).all() && high.cmpge(least).all()
        };
        plan.solids.iter().filter(may_meet).all(|solid| overlap::area(outline, &solid.outline) < 1e-6)
    };
    let (least, most) = geometry::bounds(outline.iter().copied());
    let beside = Point::splat(BESIDE_M);
    let (least, most) = (least - beside, most + beside);
    let box_around = [least, Point::new(most.x, least.y), most, Point::new(least.x, most.y)];
    let is_clear = || doors.iter().all(|&door| geometry::distance_to_area(&outline, door) >= FROM_DOORS_M);
    if !(is_within(&outline) && is_clear() && is_free(&box_around)) {
        return None;
    }
    let [front_left, front_right, back_right, back_left] = outline[..] else { return None };
    let walls = plan.solids.iter().filter(|solid| matches!(solid.origin, Origin::Wall(_)));
    let back = (back_left + back_right) / 2.0;
    let to_wall_m = walls.map(|wall| geometry::distance_to_area(&wall.outline, back)).fold(f64::MAX, f64::min);
    let ahead = (front_left - back_left).normalize_or_zero() * IN_FRONT_M;
    let before = [front_left + ahead, front_right + ahead, front_right, front_left];
    let is_open = is_within(&before) && is_free(&before);
    Some(to_wall_m + if is_open { 0.0 } else { BLOCKED_M })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{from_value, json};

    #[test]
    fn furniture_in_an_empty_room_has_its_back_to_a_wall_and_free_floor_in_front() {
        let mut home: HomeFile = from_value(json!({
            "name": "one room",
            "rooms": [{ "name": "room", "outline": [[0, 0], [4.2, 0], [4.2, 3.6], [0, 3.6]] }],
            "walls": [
                { "from": [0, 0], "to": [4.2, 0] }, { "from": [4.2, 0], "to": [4.2, 3.6] },
                { "from": [4.2, 3.6], "to": [0, 3.6] }, { "from": [0, 3.6], "to": [0, 0] }
            ],
            "doors": [{ "name": "front door", "from": [1, 0], "to": [1.9, 0], "outside": true }]
        }))
        .unwrap();
        let resident: ResidentFile = from_value(json!({ "name": "ann", "driver": { "path": "ann.json" } })).unwrap();
        for need in NEEDS {
            let lacking = lacking(&home, &[need], &resident, &Numbers::default());
            let piece = lacking.piece(need).expect("there is room").clone();
            let plan = Plan::new(&home);
            let outline = furniture_outline(&piece);
            let away_m = out_of_place_m(&plan, 0, &[], &piece).expect("it fits in");
            assert!(away_m < 2.0 * STEP_M, "{}: {away_m} m, {outline:?}", piece.name);
            home.furniture.push(piece);
        }
    }

    #[test]
    fn finds_a_place_in_a_room_with_a_table_in_its_middle() {
        let home = |size_m: [f64; 2]| -> HomeFile {
            from_value(json!({
                "name": "one room",
                "rooms": [{ "name": "room", "outline": [[0, 0], [6, 0], [6, 5], [0, 5]] }],
                "walls": [],
                "furniture": [{ "name": "table", "at": [3, 2.5], "size_m": size_m, "height_m": 0.7 }]
            }))
            .unwrap()
        };
        let resident: ResidentFile = from_value(json!({ "name": "ann", "driver": { "path": "ann.json" } })).unwrap();
        let lacking = |size_m: [f64; 2]| lacking(&home(size_m), &[], &resident, &Numbers::default());
        assert!(NEEDS.iter().all(|&need| lacking([1.5, 1.5]).piece(need).is_some()));
        // A table as large as the room leaves no place.
        assert!(NEEDS.iter().all(|&need| lacking([5.8, 4.8]).piece(need).is_none()));
    }
}
