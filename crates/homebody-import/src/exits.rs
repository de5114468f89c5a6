//! Exits of a floor to stairs, for floors drawn next to each other: gaps for a door in its outer walls.

use crate::drawing::PlanPiece;
use crate::floor::BuiltFloor;
use crate::outline::NamedRoom;
use crate::walls::{MOST_SEARCHED, StraightWall};
use homebody_core::geometry::{self, Point};
use homebody_core::languages::{RoomUse, room_use};
use homebody_core::plan::FLAT_M;
use homebody_core::role::Role;

/// Width of the way through the wall, and of the flight of stairs between the centre lines of its walls (our choice).
pub const DOOR_M: f64 = 0.9;
pub const FLIGHT_M: f64 = 1.0;

/// Distance between places in one wall, with room for another flight of stairs, and largest numbers of places tried on
/// a floor and in a wall, the nearest to the stairs first (our choice).
const MOST_EXITS: usize = 16;
const MOST_IN_WALL: usize = 3;
const APART_M: f64 = FLIGHT_M + 0.2;

/// Additional distance that a place in a better room may have (our choice).
const WORSE_M: f64 = 4.0;

/// Step between the places tried along a wall, and largest number of steps along one wall (our choice).
const STEP_M: f64 = 0.2;
const MOST_STEPS: f64 = 100.0;

/// Depth before the wall that has to be free (our choice): a person turns there.
const FREE_M: f64 = 0.75;

#[derive(Clone, Copy, Debug)]
pub struct WallExit {
    /// On the middle line of the wall.
    pub at: Point,
    /// The way out, of length 1.
    pub out: Point,
    pub thickness_m: f64,
    pub away_m: f64,
    /// The room inside of the door.
    pub room: usize,
}

/// Places for a door in outer walls: of the rooms of the drawn stairs, then of those around them and next to these; the
/// nearest first.
pub fn exits(floor: &BuiltFloor, stairs: &PlanPiece) -> Vec<WallExit> {
    if floor.walls.len() > MOST_SEARCHED {
        return Vec::new();
    }
    let area = stairs.outline();
    let within: Vec<usize> = (0..floor.rooms.len()).filter(|&room| shares(floor, room, &area)).collect();
    let near_m = stairs.width_m.min(stairs.depth_m) / 2.0 + FREE_M;
    let is_near = |room: &usize| geometry::distance_to_area(&floor.rooms[*room].outline, stairs.at) <= near_m;
    let near: Vec<usize> = (0..floor.rooms.len()).filter(is_near).collect();
    // Some plans leave a hole in the floor for stairs.
    let at = if within.is_empty() { &near } else { &within };
    let is_next = |room: usize| at.iter().any(|&known| known != room && are_joined(floor, room, known));
    // People do not go upstairs through a bathroom, nor through a bedroom if another room has a place.
    let has = |room: usize, role: Role| {
        let pieces = floor.furniture.iter().filter(|piece| piece.is_for(role));
        pieces.into_iter().any(|piece| geometry::contains(&floor.rooms[room].outline, piece.at))
    };
    let is_bathroom = |room: usize| has(room, Role::Toilet) || has(room, Role::Shower);
    let is_beside =
        |room: &usize| (near.contains(room) || is_next(*room)) && !within.contains(room) && !is_bathroom(*room);
    let (by_night, by_day): (Vec<usize>, Vec<usize>) =
        (0..floor.rooms.len()).filter(is_beside).partition(|&room| has(room, Role::Bed));
    // A worse place counts as farther, so that it is taken only without a better one.
    let of = |rooms: &[usize], worse_m: f64| {
        let exits = rooms.iter().flat_map(|&room| room_exits(floor, room, stairs.at));
        exits.map(|exit| WallExit { away_m: exit.away_m + worse_m, ..exit }).collect::<Vec<_>>()
    };
    let mut all = [of(&within, 0.0), of(&by_day, WORSE_M), of(&by_night, 2.0 * WORSE_M)].concat();
    all.sort_by(|a, b| a.away_m.total_cmp(&b.away_m));
    all.truncate(MOST_EXITS);
    all
}

/// True if a room has at least a fifth of an area.
fn shares(floor: &BuiltFloor, room: usize, area: &[Point]) -> bool {
    const SHARE: f64 = 0.2;
    let whole = geometry::signed_area(area).abs();
    geometry::overlap::area(&floor.rooms[room].outline, area) >= SHARE * whole
}

fn are_joined(floor: &BuiltFloor, one: usize, other: usize) -> bool {
    let touches = |room: usize, p: Point| geometry::distance_to_area(&floor.rooms[room].outline, p) <= 0.3;
    let middle = |(from, to): (Point, Point)| (from + to) / 2.0;
    let through_door =
        || floor.doors.iter().map(|door| middle((door.from, door.to))).any(|p| touches(one, p) && touches(other, p));
    let is_open = |p: Point| {
        let is_walled = |wall: &StraightWall| geometry::distance_to_segment(p, wall.from, wall.to) <= wall.thickness_m;
        geometry::distance_to_area(&floor.rooms[other].outline, p) <= 0.02 && !floor.walls.iter().any(is_walled)
    };
    through_door() || geometry::sides(&floor.rooms[one].outline).any(|(a, b)| is_open((a + b) / 2.0))
}

/// A place for a front door: in a hall if possible, else in the largest room with a place for it.
pub fn front_door(floor: &BuiltFloor) -> Option<WallExit> {
    if floor.walls.is_empty() || floor.walls.len() > MOST_SEARCHED {
        return None;
    }
    let is_hall = |room: &NamedRoom| room_use(&room.name) == Some(RoomUse::Hall);
    let mut rooms: Vec<usize> = (0..floor.rooms.len()).collect();
    let area = |room: usize| geometry::signed_area(&floor.rooms[room].outline).abs();
    rooms.sort_by(|&a, &b| area(b).total_cmp(&area(a)));
    rooms.sort_by_key(|&room| !is_hall(&floor.rooms[room]));
    rooms.into_iter().find_map(|room| {
        let exits = room_exits(floor, room, geometry::inner_point(&floor.rooms[room].outline));
        exits.into_iter().min_by(|a, b| a.away_m.total_cmp(&b.away_m))
    })
}

/// The places in each outer wall of a room that are nearest to a point. A drawing at that very point is not in the way.
fn room_exits(floor: &BuiltFloor, room: usize, near: Point) -> Vec<WallExit> {
    let mut found = Vec::new();
    let outline = &floor.rooms[room].outline;
    let (least, most) = geometry::bounds(outline.iter().copied());
    for wall in &floor.walls {
        let (low, high) = (wall.from.min(wall.to) - FREE_M, wall.from.max(wall.to) + FREE_M);
        if wall.length() < DOOR_M + 2.0 * STEP_M || low.cmpgt(most).any() || high.cmplt(least).any() {
            continue;
        }
        let step_m = STEP_M.max(wall.length() / MOST_STEPS);
        let steps = ((wall.length() - DOOR_M) / step_m) as usize;
        let first_m = (wall.length() - steps as f64 * step_m) / 2.0;
        let places = (0..=steps).map(|step| wall.from + wall.along() * (first_m + step as f64 * step_m));
        for out in [wall.along().perp(), -wall.along().perp()] {
            let exit = |at: Point| WallExit { at, out, thickness_m: wall.thickness_m, away_m: at.distance(near), room };
            let fit = places.clone().map(exit).filter(|exit| is_outer(floor, exit) && is_free(floor, exit, wall, near));
            let mut fit: Vec<WallExit> = fit.collect();
            fit.sort_by(|a, b| a.away_m.total_cmp(&b.away_m));
            let mut taken: Vec<WallExit> = Vec::new();
            for exit in fit {
                if taken.len() < MOST_IN_WALL && taken.iter().all(|other| other.at.distance(exit.at) >= APART_M) {
                    taken.push(exit);
                }
            }
            found.extend(taken);
        }
    }
    found
}

/// The points in a grid on one side of an exit, between two depths from the middle of the wall.
fn grid(exit: &WallExit, depths_m: [f64; 3]) -> impl Iterator<Item = Point> {
    let along = exit.out.perp() * (DOOR_M / 2.0 - 0.05);
    let (at, out) = (exit.at, exit.out);
    depths_m.into_iter().flat_map(move |depth| [-1.0, 0.0, 1.0].map(|side| at + along * side + out * depth))
}

/// True if one side is in the room, deep enough to turn there, and the other side in no room.
fn is_outer(floor: &BuiltFloor, exit: &WallExit) -> bool {
    let face_m = exit.thickness_m / 2.0;
    let outline = &floor.rooms[exit.room].outline;
    let is_in_one = |p: Point| floor.rooms.iter().any(|room| geometry::contains(&room.outline, p));
    grid(exit, [-face_m - 0.1, -face_m - FREE_M / 2.0, -face_m - FREE_M]).all(|p| geometry::contains(outline, p))
        && !grid(exit, [face_m + 0.1, face_m + 0.4, face_m + 0.8]).any(is_in_one)
}

/// True without doors, other walls and furniture at the place of the door.
fn is_free(floor: &BuiltFloor, exit: &WallExit, own: &StraightWall, drawn_at: Point) -> bool {
    let face_m = exit.thickness_m / 2.0;
    let apart_m = DOOR_M / 2.0 + 0.1;
    let has_door = floor.doors.iter().any(|door| geometry::distance_to_segment(exit.at, door.from, door.to) < apart_m);
    let others = || floor.walls.iter().filter(|wall| *wall != own);
    let is_walled =
        |p: Point| others().any(|wall| geometry::distance_to_segment(p, wall.from, wall.to) <= wall.thickness_m / 2.0);
    let pieces = || floor.furniture.iter().filter(|piece| piece.height_m > FLAT_M && piece.at != drawn_at);
    let is_stood_on = |p: Point| pieces().any(|piece| geometry::contains(&piece.outline(), p));
    let inside = [-face_m - 0.05, -face_m - FREE_M / 2.0, -face_m - FREE_M];
    !has_door
        && !grid(exit, inside).any(|p| is_walled(p) || is_stood_on(p))
        && !grid(exit, [0.0, face_m + 0.2, face_m + 0.5]).any(is_walled)
}
