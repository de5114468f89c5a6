//! Where a piece of furniture that a home lacks could stand, so that people get to it and still to all else.

use crate::living::places::Places;
use homebody_core::geometry::{self, Point, overlap};
use homebody_core::home::plan::{Origin, Plan, furniture_outline};
use homebody_core::numbers::Numbers;
use homebody_core::role::Role;
use homebody_core::scenario::home::{FurnitureFile, HomeFile};
use homebody_core::scenario::resident::ResidentFile;
use homebody_walk::Mesh;

/// A piece that a life needs: its width, its depth and its height in metres, and words of the rooms where it usually is.
struct Needed {
    role: Role,
    size_m: [f64; 2],
    height_m: f64,
    is_enterable: bool,
    rooms: &'static [&'static str],
}

/// Usual sizes of these things (ours).
const NEEDED: [Needed; 4] = [
    Needed { role: Role::Bed, size_m: [0.9, 2.0], height_m: 0.5, is_enterable: true, rooms: &["bed"] },
    Needed {
        role: Role::Toilet,
        size_m: [0.4, 0.65],
        height_m: 0.45,
        is_enterable: true,
        rooms: &["toilet", "wc", "bath"],
    },
    Needed {
        role: Role::Armchair,
        size_m: [0.7, 0.7],
        height_m: 0.9,
        is_enterable: true,
        rooms: &["living", "lounge"],
    },
    Needed { role: Role::Fridge, size_m: [0.6, 0.6], height_m: 1.8, is_enterable: false, rooms: &["kitchen"] },
];

/// How far apart places are tried, how near a piece is to a wall or to another, and how far from doors it stays (ours).
const STEP_M: f64 = 0.1;
const BESIDE_M: f64 = 0.02;
const FROM_DOORS_M: f64 = 0.7;

/// How much room there is to be before the front of a piece (ours).
const IN_FRONT_M: f64 = 0.6;

/// How far from a wall is as bad as a front that is blocked (ours).
const BLOCKED_M: f64 = 1.0;

/// A piece whose back is nearer to a wall than this stands at it (ours).
const AT_WALL_M: f64 = 0.3;

/// So many places are tried in a room, and walked to at its walls, elsewhere in it, and in all (ours): each walk takes a while.
const MOST_TRIED: f64 = 4_000.0;
const MOST_WALKED_IN_ROOM: usize = 3;
const MOST_WALKED: usize = 12;

/// A piece of furniture for a role in a place where it can stand; nothing where there is no room, or none for that role.
///
/// People of this radius get to it, and to all that they got to before.
pub fn piece(home: &HomeFile, role: Role, resident: &ResidentFile, numbers: &Numbers) -> Option<FurnitureFile> {
    let needed = NEEDED.iter().find(|needed| needed.role == role)?;
    let plan = Plan::new(home);
    let doors: Vec<Point> = plan.things.iter().take(home.doors.len()).map(|door| door.at).collect();
    let name = free_name(home, role.row().names[0]);
    let new = |at: Point, turn_deg: f64| FurnitureFile {
        name: name.clone(),
        at: Some([at.x, at.y].map(|length| (length * 1e3).round() / 1e3)),
        size_m: Some(needed.size_m),
        turn_deg,
        outline: None,
        height_m: needed.height_m,
        enterable: needed.is_enterable,
        // A name with a number says nothing by itself.
        role: (!role.is_called(&name)).then_some(role),
    };
    let before = reached(home, &plan, resident, numbers);
    let mut walked = 0;
    for room in in_order(home, &plan, needed) {
        let mut fit: Vec<(f64, FurnitureFile)> = Vec::new();
        for turn_deg in [0.0, 90.0, 180.0, 270.0] {
            let places = grid(&plan, room).map(|at| new(at, turn_deg));
            fit.extend(places.filter_map(|piece| Some((out_of_place_m(&plan, room, &doors, &piece)?, piece))));
        }
        fit.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (at_walls, others) = fit.split_at(fit.partition_point(|(away_m, _)| *away_m < AT_WALL_M));
        // Those side by side are blocked by the same: of a few all over the room one is free.
        let spread = |places: &[(f64, FurnitureFile)]| -> Vec<FurnitureFile> {
            let step = places.len().div_ceil(MOST_WALKED_IN_ROOM).max(1);
            places.iter().step_by(step).map(|(_, piece)| piece.clone()).collect()
        };
        for piece in spread(at_walls).into_iter().chain(spread(others)) {
            walked += 1;
            if walked > MOST_WALKED {
                return None;
            }
            let mut furnished = home.clone();
            furnished.furniture.push(piece.clone());
            let now = reached(&furnished, &Plan::new(&furnished), resident, numbers);
            if now.contains(&piece.name.to_lowercase()) && before.iter().all(|name| now.contains(name)) {
                return Some(piece);
            }
        }
    }
    None
}

/// The names of all that there is a way to.
fn reached(home: &HomeFile, plan: &Plan, resident: &ResidentFile, numbers: &Numbers) -> Vec<String> {
    let places = Places::new(home, plan, &Mesh::with_numbers(plan, resident.radius_m, numbers), &resident.name);
    places.all().iter().filter(|spot| spot.is_reachable).map(|spot| spot.name.clone()).collect()
}

/// A name that begins so and that nothing in the home has.
fn free_name(home: &HomeFile, wanted: &str) -> String {
    let furniture = home.furniture.iter().map(|piece| &piece.name);
    let others = home.rooms.iter().map(|room| &room.name).chain(home.places.iter().map(|place| &place.name));
    let taken: Vec<String> = furniture.chain(others).map(|name| name.trim().to_lowercase()).collect();
    let names = std::iter::once(wanted.to_owned()).chain((2..).map(|number| format!("{wanted} {number}")));
    names.into_iter().find(|name| !taken.contains(name)).unwrap_or_default()
}

/// The rooms in which a piece is looked a place for: those where such pieces usually are, then the others from the largest.
fn in_order(home: &HomeFile, plan: &Plan, needed: &Needed) -> Vec<usize> {
    /// Where nobody would put it.
    const NOWHERE: [&str; 6] = ["stairs", "balcony", "terrace", "garage", "hall", "landing"];
    let area = |room: usize| geometry::signed_area(&plan.rooms[room].outline).abs();
    let rank = |room: usize| {
        let name = home.rooms[room].name.to_lowercase();
        let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
        if has(needed.rooms) { 0 } else { 1 + usize::from(has(&NOWHERE)) }
    };
    let mut rooms: Vec<usize> = (0..plan.rooms.len()).collect();
    rooms.sort_by(|&a, &b| rank(a).cmp(&rank(b)).then(area(b).total_cmp(&area(a))));
    rooms
}

/// Points all over a room.
fn grid(plan: &Plan, room: usize) -> impl Iterator<Item = Point> {
    let (least, most) = geometry::bounds(plan.rooms[room].outline.iter().copied());
    let size = most - least;
    let step_m = STEP_M.max((size.x * size.y / MOST_TRIED).sqrt());
    let (columns, rows) = ((size.x / step_m) as usize, (size.y / step_m) as usize);
    let at = move |index: usize| Point::new((index % columns.max(1)) as f64, (index / columns.max(1)) as f64);
    (0..columns * rows).map(move |index| least + (at(index) + 0.5) * step_m)
}

/// How far the back of a piece is from a wall, and by how much more it is out of place where its front is blocked. None: it
/// does not fit, for it is not in the room, overlaps something, or stands in a doorway.
fn out_of_place_m(plan: &Plan, room: usize, doors: &[Point], piece: &FurnitureFile) -> Option<f64> {
    let outline = furniture_outline(piece);
    let around = &plan.rooms[room].outline;
    let is_within = |outline: &[Point]| {
        geometry::sides(outline)
            .all(|(a, b)| [0.0, 0.25, 0.5, 0.75].iter().all(|&share| geometry::contains(around, a + (b - a) * share)))
    };
    let is_free = |outline: &[Point]| plan.solids.iter().all(|solid| overlap::area(outline, &solid.outline) < 1e-6);
    let (least, most) = geometry::bounds(outline.iter().copied());
    let beside = Point::splat(BESIDE_M);
    let (least, most) = (least - beside, most + beside);
    let box_around = [least, Point::new(most.x, least.y), most, Point::new(least.x, most.y)];
    let is_clear = || doors.iter().all(|&door| geometry::distance_to_area(&outline, door) >= FROM_DOORS_M);
    if !(is_within(&outline) && is_free(&box_around) && is_clear()) {
        return None;
    }
    // Unturned, its back is above.
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
    fn what_is_put_into_an_empty_room_has_its_back_at_a_wall_and_room_before_it() {
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
        for needed in &NEEDED {
            let numbers = Numbers::default();
            let piece = piece(&home, needed.role, &resident, &numbers).expect("there is room");
            let plan = Plan::new(&home);
            let outline = furniture_outline(&piece);
            let away_m = out_of_place_m(&plan, 0, &[], &piece).expect("it fits in");
            assert!(away_m < 2.0 * STEP_M, "{}: {away_m} m, {outline:?}", piece.name);
            home.furniture.push(piece);
        }
    }
}
