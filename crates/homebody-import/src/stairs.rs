//! Floors that stairs join, unfolded into one plane: beside each other, with a passage between them that is as long as the stairs
//! are to walk.

use crate::doors::Door;
use crate::drawing::Piece;
use crate::exits::{DOOR_M, Exit, FLIGHT_M, exits};
use crate::floor::{AllNames, Floor};
use crate::outline::Room;
use crate::walls::Wall;
use homebody_core::geometry::{self, Point, overlap};

/// A passage that is so much longer than its stairs is none (ours): too much of a life would be climbing.
const MOST_LONGER_M: f64 = 8.0;

/// Floors are so far apart at least (ours), so that no sensor of one is taken for one of the other.
const APART_M: f64 = 1.5;

/// Stairs that rise less than this share of what lies between two levels lead to none (ours).
const LEAST_RISE: f64 = 0.6;

/// How much longer a passage may be for a floor that is not turned, is turned by a half, by a quarter, by anything else (ours):
/// plans are read the easier the less of them is turned.
const TURNED_M: [f64; 4] = [0.0, 2.0, 3.0, 6.0];

/// How thick a passage's walls are.
const WALL_M: f64 = 0.1;

/// A turn around the origin, and then a move.
#[derive(Clone, Copy, Debug)]
struct Motion {
    turn: Point,
    by: Point,
}

/// What stays where it is.
const STILL: Motion = Motion { turn: Point::X, by: Point::ZERO };

impl Motion {
    fn of(&self, p: Point) -> Point {
        self.turn.rotate(p) + self.by
    }
}

/// How a floor is joined to another: where each is left, how it moves, and how long the passage is.
#[derive(Clone, Copy, Debug)]
struct Join {
    from: Exit,
    motion: Motion,
    length_m: f64,
}

/// Joins to one floor those that stairs lead to, each as high as it says: they are drawn beside it, with the passages between
/// them. Gives which they are, that one included.
pub fn unfolded(floors: &[(f64, Floor)], first: usize, names: &mut AllNames) -> (Floor, Vec<usize>) {
    let mut all = floors[first].1.clone();
    let mut taken = vec![first];
    for is_up in [true, false] {
        let (mut there, mut motion) = (first, STILL);
        loop {
            let next = if is_up { there + 1 } else { there.wrapping_sub(1) };
            let Some((height_m, floor)) = floors.get(next) else { break };
            let rise_m = (height_m - floors[there].0).abs();
            let lower = if is_up { there } else { next };
            let Some(stairs) = up(&floors[lower].1, rise_m) else { break };
            let moved_there = moved(&floors[there].1, motion);
            let run_m = stairs.width_m.max(stairs.depth_m).hypot(rise_m);
            let exits_there = exits(&moved_there, &moved_piece(stairs, motion));
            let exits_next = exits(floor, stairs);
            let joins = exits_there
                .iter()
                .flat_map(|from| exits_next.iter().filter_map(|to| join(&all, floor, *from, *to, run_m)));
            let Some((_, join)) = joins.min_by(|a, b| a.0.total_cmp(&b.0)) else { break };
            // The passage stands for them.
            let drawn_at = if is_up { motion.of(stairs.at) } else { join.motion.of(stairs.at) };
            all = and(and(all, flight(&join, is_up, names)), moved(floor, join.motion));
            all.furniture.retain(|piece| piece.at != drawn_at);
            taken.push(next);
            (there, motion) = (next, join.motion);
        }
    }
    taken.sort_unstable();
    (all, taken)
}

/// The stairs of a floor that lead up to one so much higher.
fn up(floor: &Floor, rise_m: f64) -> Option<&Piece> {
    let reach_m = |stairs: &Piece| stairs.elevation_m + stairs.height_m;
    let leads_up = floor.stairs.iter().filter(|stairs| reach_m(stairs) >= LEAST_RISE * rise_m);
    leads_up.max_by(|a, b| reach_m(a).total_cmp(&reach_m(b)))
}

fn and(mut one: Floor, other: Floor) -> Floor {
    one.rooms.extend(other.rooms);
    one.walls.extend(other.walls);
    one.doors.extend(other.doors);
    one.furniture.extend(other.furniture);
    one
}

/// One way to join them, with how little it is liked.
fn join(there: &Floor, next: &Floor, from: Exit, to: Exit, run_m: f64) -> Option<(f64, Join)> {
    let beyond = |floor: &Floor, exit: &Exit| {
        floor.points().map(|p| (p - exit.at).dot(exit.out)).fold(exit.thickness_m / 2.0, f64::max)
    };
    let (beyond_there, beyond_next) = (beyond(there, &from), beyond(next, &to));
    let length_m = run_m.max(beyond_there + beyond_next + APART_M);
    if length_m > run_m + MOST_LONGER_M || !is_clear(there, &from, beyond_there) || !is_clear(next, &to, beyond_next) {
        return None;
    }
    // What takes the one way out to the opposite of the other.
    let back = -from.out;
    let turn = Point::new(to.out.dot(back), to.out.perp_dot(back));
    let by = from.at + from.out * length_m - turn.rotate(to.at);
    let turned = match turn {
        turn if turn.x > 1.0 - 1e-6 => 0,
        turn if turn.x < -1.0 + 1e-6 => 1,
        turn if turn.x.abs() < 1e-6 => 2,
        _ => 3,
    };
    let disliked = length_m - run_m + from.away_m + to.away_m + TURNED_M[turned];
    Some((disliked, Join { from, motion: Motion { turn, by }, length_m }))
}

/// Whether nothing of a floor is in the way out of it.
fn is_clear(floor: &Floor, exit: &Exit, beyond_m: f64) -> bool {
    let begin = exit.at + exit.out * (exit.thickness_m / 2.0 + 0.01);
    let end = exit.at + exit.out * (beyond_m + 0.02);
    let way = geometry::thick_segment(begin, end, FLIGHT_M);
    let is_crossed =
        |wall: &Wall| geometry::distance_between_segments((begin, end), (wall.from, wall.to)) < FLIGHT_M / 2.0 - 0.06;
    !floor.rooms.iter().any(|room| overlap::area(&room.outline, &way) > 0.004)
        && !floor.walls.iter().any(|wall| {
            // The wall that it leads through, and those in line with it, end where the way begins.
            let is_own = geometry::distance_to_segment(exit.at, wall.from, wall.to) < 0.02;
            !is_own && is_crossed(wall)
        })
}

/// A floor somewhere else.
fn moved(floor: &Floor, motion: Motion) -> Floor {
    let turn_deg = motion.turn.y.atan2(motion.turn.x).to_degrees();
    let mut floor = floor.clone();
    let points = floor.walls.iter_mut().flat_map(|wall| [&mut wall.from, &mut wall.to]);
    points.for_each(|p| *p = motion.of(*p));
    floor.rooms.iter_mut().flat_map(|room| &mut room.outline).for_each(|p| *p = motion.of(*p));
    floor.doors.iter_mut().flat_map(|door| [&mut door.from, &mut door.to]).for_each(|p| *p = motion.of(*p));
    for piece in &mut floor.furniture {
        piece.at = motion.of(piece.at);
        piece.turn_deg = crate::furniture::turned(piece.turn_deg + turn_deg);
    }
    floor
}

fn moved_piece(piece: &Piece, motion: Motion) -> Piece {
    let turn_rad = piece.turn_rad + motion.turn.y.atan2(motion.turn.x);
    Piece { at: motion.of(piece.at), turn_rad, ..piece.clone() }
}

/// The passage: a room of its own between two walls, with a door at each end.
fn flight(join: &Join, is_up: bool, names: &mut AllNames) -> Floor {
    let Join { from, length_m, .. } = *join;
    let (out, side) = (from.out, from.out.perp());
    let (begin, end) = (from.at, from.at + out * length_m);
    let rail = |across: f64| Wall { from: begin + side * across, to: end + side * across, thickness_m: WALL_M };
    let (left, right) = (FLIGHT_M / 2.0, -FLIGHT_M / 2.0);
    let outline = vec![begin + side * right, end + side * right, end + side * left, begin + side * left];
    let mut door = |at: Point, name: &str| {
        let half = side * (DOOR_M / 2.0);
        let name = names.doors.give(name, "door");
        Door { name, from: at + half, to: at - half, is_outside: false, leads_home: 0 }
    };
    let mut ends = ["foot of the stairs", "head of the stairs"];
    if !is_up {
        ends.reverse();
    }
    Floor {
        rooms: vec![Room::new(names.spots.give("stairs", "stairs"), outline)],
        walls: vec![rail(left), rail(right)],
        doors: vec![door(begin, ends[0]), door(end, ends[1])],
        furniture: Vec::new(),
        stairs: Vec::new(),
        is_open: false,
    }
}
