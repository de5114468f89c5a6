//! Open-air rooms, such as a terrace or the paving before a front door: if the way out leads into one, it is outside,
//! and does not belong to the home.

use crate::doors::{self, WallDoor};
use crate::outline::NamedRoom;
use crate::walls::{MOST_SEARCHED, StraightWall};
use homebody_core::geometry::{self, Point};

/// Smallest share of the outline of an open-air room without a wall or another room along it (our choice): for a
/// terrace in the corner of a house it is half.
const OPEN_SHARE: f64 = 0.4;

/// Step between the points checked along an outline, and largest number of points (our choice).
const STEP_M: f64 = 0.25;
const MOST_STEPS: f64 = 100.0;

/// Largest distance of walls and rooms that are along an outline (our choice).
const ALONG_M: f64 = 0.3;

/// Distances before a door at which its room is searched (our choice): beyond a thick wall and a step.
const BEFORE_M: [f64; 6] = [0.1, 0.2, 0.3, 0.4, 0.55, 0.7];

/// Preferences of a door and of a front door as the way home.
const BY_DOOR: usize = 2;
const BY_FRONT_DOOR: usize = 3;

/// Removes the open-air rooms before the doors that people come home by, if no such door leads out yet; these doors
/// then lead out. Returns true if there are any.
pub fn remove_open_rooms(
    rooms: &mut Vec<NamedRoom>,
    walls: &[StraightWall],
    doors: &mut [WallDoor],
    remarks: &mut Vec<String>,
) -> bool {
    let now = doors::way_out(doors);
    if now == BY_FRONT_DOOR || walls.is_empty() || walls.len() > MOST_SEARCHED {
        return false;
    }
    let open: Vec<bool> = rooms.iter().map(|room| is_open(room, rooms, walls)).collect();
    let between: Vec<[Option<usize>; 2]> = doors.iter().map(|door| sides(door, rooms)).collect();
    // The open-air room that a door leads to from another room.
    let to_open = |two: &[Option<usize>; 2]| match *two {
        [Some(one), Some(other)] if open[one] != open[other] => Some(if open[one] { one } else { other }),
        _ => None,
    };
    let to_open: Vec<Option<usize>> = between.iter().map(to_open).collect();
    let of_open = doors.iter().zip(&to_open).filter(|(_, room)| room.is_some());
    let best = of_open.map(|(door, _)| door.leads_home + 1).max().unwrap_or(0);
    if best <= now || best < if now > 0 { BY_FRONT_DOOR } else { BY_DOOR } {
        return false;
    }
    let mut left: Vec<usize> = Vec::new();
    for (door, room) in doors.iter().zip(&to_open) {
        left.extend(room.filter(|_| door.leads_home + 1 == best));
    }
    // Other open-air rooms that are reached only through these, such as a garden behind a porch, are outside, too.
    let beyond = |left: &[usize]| {
        let reached = |room: usize| between.iter().filter(move |two| two.contains(&Some(room)));
        let is_behind = |room: &usize| {
            open[*room]
                && !left.contains(room)
                && reached(*room).count() > 0
                && reached(*room).all(|two| two.iter().flatten().any(|other| left.contains(other)))
        };
        (0..rooms.len()).find(is_behind)
    };
    while let Some(room) = beyond(&left) {
        left.push(room);
    }
    for (door, two) in doors.iter_mut().zip(&between) {
        door.is_outside |= two.iter().flatten().any(|room| left.contains(room));
    }
    let mut index = 0..;
    rooms.retain(|room| {
        let leave = index.next().is_some_and(|index| left.contains(&index));
        if leave {
            remarks.push(format!("left out: the room {:?}, which lies in the open; doors to it lead out", room.name));
        }
        !leave
    });
    true
}

/// True if enough of a room's outline has no wall and no other room along it.
fn is_open(room: &NamedRoom, rooms: &[NamedRoom], walls: &[StraightWall]) -> bool {
    let length_m: f64 = geometry::sides(&room.outline).map(|(a, b)| a.distance(b)).sum();
    let step_m = STEP_M.max(length_m / MOST_STEPS);
    let (mut all, mut free) = (0_u32, 0_u32);
    for (a, b) in geometry::sides(&room.outline) {
        let steps = (a.distance(b) / step_m).ceil() as usize;
        for p in (0..steps).map(|step| a + (b - a) * ((step as f64 + 0.5) / steps as f64)) {
            let is_walled = walls
                .iter()
                .any(|wall| geometry::distance_to_segment(p, wall.from, wall.to) <= wall.thickness_m / 2.0 + ALONG_M);
            let others = rooms.iter().filter(|other| !std::ptr::eq(*other, room));
            let is_beside = || others.clone().any(|other| geometry::distance_to_area(&other.outline, p) <= ALONG_M);
            all += 1;
            free += u32::from(!is_walled && !is_beside());
        }
    }
    f64::from(free) >= OPEN_SHARE * f64::from(all)
}

fn sides(door: &WallDoor, rooms: &[NamedRoom]) -> [Option<usize>; 2] {
    let middle = (door.from + door.to) / 2.0;
    let across = (door.to - door.from).normalize_or_zero().perp();
    let at = |p: Point| rooms.iter().position(|room| geometry::contains(&room.outline, p));
    [1.0, -1.0].map(|side| BEFORE_M.iter().find_map(|before| at(middle + across * (side * before))))
}
