//! Doors: spans of the walls that they stand in.

use crate::drawing::Piece;
use crate::error::NotImported;
use crate::kinds;
use crate::names::Names;
use crate::outline::Room;
use crate::walls::{DOOR_OFF_M, Wall};
use homebody_core::geometry::{self, Point};
use homebody_core::problem::counted;

/// A door in a wall.
#[derive(Clone, Debug)]
pub struct Door {
    pub name: String,
    pub from: Point,
    pub to: Point,
    pub is_outside: bool,
}

/// What a home has at most.
const MOST_DOORS: usize = 1_000;

/// The check refuses doors narrower than 5 cm; nobody walks through those narrower than this (ours).
const LEAST_WIDTH_M: f64 = 0.1;

/// The cosine of the angle between a door and its wall, up to which it stands in it (ours): 45 degrees.
const IN_WALL_COSINE: f64 = 0.707;

/// A door that moves further is worth a remark (ours).
const MOVED_M: f64 = 0.05;

/// The sine of the angle up to which walls run beside each other (ours), and how far apart or into each other things are
/// that are not one (ours): a door within a centimetre of two walls is in both already.
const BESIDE_SINE: f64 = 0.05;
const BESIDE_M: f64 = 0.02;

/// The walls beside its own that a door goes through (ours): houses have two faces, and some a layer between.
const MOST_BESIDE: usize = 2;

/// How far behind the face of a wall it is looked for a room, in steps (ours): rooms drawn by hand end before walls do.
const BEHIND_M: [f64; 5] = [0.05, 0.15, 0.25, 0.35, 0.45];

/// The doors among the openings, without windows.
pub fn only(openings: Vec<Piece>, remarks: &mut Vec<String>) -> Result<Vec<Piece>, NotImported> {
    let (windows, doors): (Vec<Piece>, Vec<Piece>) = openings.into_iter().partition(kinds::is_window);
    if !windows.is_empty() {
        let windows = counted(windows.len(), "window", "windows");
        remarks.push(format!("left out: {windows}, which make no difference to motion sensors"));
    }
    if doors.len() > MOST_DOORS {
        let hint = "import one level of it, or a plan of one home";
        return Err(NotImported::TooMany { what: "doors", count: doors.len(), most: MOST_DOORS, hint });
    }
    Ok(doors)
}

/// The doors in their walls; those between a room and none lead out.
pub fn place(doors: &[Piece], walls: &[Wall], rooms: &[Room], remarks: &mut Vec<String>) -> Vec<Door> {
    let (mut names, mut placed) = (Names::default(), Vec::new());
    for door in doors {
        let name = names.give(&door.name, "door");
        let Some(wall) = wall_of(door, walls) else {
            remarks.push(format!("left out: the door {name:?}, which is in no wall"));
            continue;
        };
        let (from, to) = span(door, wall);
        let middle = (from + to) / 2.0;
        let (width_m, moved_m) = (from.distance(to), (door.at - middle).dot(wall.along()).abs());
        if width_m < door.width_m - MOVED_M {
            let was = door.width_m;
            remarks.push(format!("the door {name:?} is {width_m:.2} m wide, not {was:.2} m, as its wall is short"));
        } else if moved_m > MOVED_M {
            remarks.push(format!("the door {name:?} moved by {moved_m:.2} m into its wall"));
        }
        let beside = walls.iter().filter(|other| goes_through_both(door, wall, other));
        let beside: Vec<&Wall> = beside.take(MOST_BESIDE).collect();
        let last = beside.iter().copied().chain([wall]);
        let is_inside = |side: f64| last.clone().any(|wall| is_inside(middle, wall, rooms, side));
        let is_outside = is_inside(1.0) != is_inside(-1.0);
        placed.push(Door { name: name.clone(), from, to, is_outside });
        for other in beside {
            let again = names.give(&name, "door");
            remarks.push(format!("the door {name:?} goes through two walls; in the other it is {again:?}"));
            let (from, to) = span(door, other);
            placed.push(Door { name: again, from, to, is_outside });
        }
    }
    if !placed.iter().any(|door| door.is_outside) {
        remarks.push("no door leads out of the home: mark the front door as \"outside\" in home.json".to_owned());
    }
    placed
}

/// The wall that a door stands in.
fn wall_of<'a>(door: &Piece, walls: &'a [Wall]) -> Option<&'a Wall> {
    let across = geometry::direction(door.turn_rad.to_degrees());
    let near = walls.iter().filter(|wall| {
        let off_m = geometry::distance_to_segment(door.at, wall.from, wall.to);
        wall.along().dot(across).abs() >= IN_WALL_COSINE
            && off_m <= wall.thickness_m / 2.0 + DOOR_OFF_M
            && wall.length().min(door.width_m) >= LEAST_WIDTH_M
    });
    // Where walls meet, the one that has more of the door; of walls side by side, the nearer one.
    let fit = |wall: &Wall| {
        let at = (door.at - wall.from).dot(wall.along());
        let shared = (at + door.width_m / 2.0).min(wall.length()) - (at - door.width_m / 2.0).max(0.0);
        shared - 2.0 * geometry::distance_to_segment(door.at, wall.from, wall.to)
    };
    near.max_by(|a, b| fit(a).total_cmp(&fit(b)))
}

/// Where in a wall a door stands, moved into it as far as it must, and no wider than it.
fn span(door: &Piece, wall: &Wall) -> (Point, Point) {
    let half = door.width_m.min(wall.length()) / 2.0;
    let at = (door.at - wall.from).dot(wall.along()).clamp(half, (wall.length() - half).max(half));
    (wall.from + wall.along() * (at - half), wall.from + wall.along() * (at + half))
}

/// Whether a door also goes through a wall that stands beside its own, as where two houses meet.
fn goes_through_both(door: &Piece, own: &Wall, other: &Wall) -> bool {
    let way = other.along();
    let at = (door.at - other.from).dot(way);
    let off_m = (door.at - other.from).perp_dot(way).abs();
    let apart_m = ((own.from + own.to) / 2.0 - other.from).perp_dot(way).abs();
    way.perp_dot(own.along()).abs() <= BESIDE_SINE
        && apart_m > BESIDE_M
        && off_m < (door.depth_m + other.thickness_m) / 2.0 - BESIDE_M
        && at >= door.width_m / 2.0
        && at <= other.length() - door.width_m / 2.0
}

/// Whether there is a room on one side of a place in a wall.
fn is_inside(middle: Point, wall: &Wall, rooms: &[Room], side: f64) -> bool {
    let out = wall.along().perp() * side;
    let at = BEHIND_M.map(|behind| middle + out * (wall.thickness_m / 2.0 + behind));
    at.iter().any(|&p| rooms.iter().any(|room| geometry::contains(&room.outline, p)))
}
