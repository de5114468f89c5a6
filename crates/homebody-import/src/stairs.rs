//! Floors joined by stairs, unfolded into one plane: next to each other, with a passage as long as the stairs.

use crate::doors::WallDoor;
use crate::drawing::PlanPiece;
use crate::exits::{DOOR_M, FLIGHT_M, WallExit, exits};
use crate::floor::{AllNames, BuiltFloor};
use crate::outline::NamedRoom;
use crate::walls::StraightWall;
use homebody_core::geometry::{self, Point, overlap};

/// Largest difference of length between a passage and its stairs (our choice): otherwise residents spend too much time
/// climbing.
const MOST_LONGER_M: f64 = 8.0;

/// Smallest distance between floors, so that no sensor of one sees the other (our choice).
const APART_M: f64 = 1.5;

/// Smallest rise of stairs as a share of the distance between two levels that they connect (our choice).
const LEAST_RISE: f64 = 0.6;

/// Distance below which two levels are drawings of one level (our choice), without stairs between them.
const LEAST_APART_M: f64 = 0.5;

/// Additional length of a passage allowed for a floor that is not turned, or is turned by a half, by a quarter, or by
/// another angle (our choice): a plan with few turns is easier to read.
const TURNED_M: [f64; 4] = [0.0, 2.0, 3.0, 6.0];

const WALL_M: f64 = 0.1;

/// A turn around the origin, and then a move.
#[derive(Clone, Copy, Debug)]
struct FloorMotion {
    turn: Point,
    by: Point,
}

const STILL: FloorMotion = FloorMotion { turn: Point::X, by: Point::ZERO };

impl FloorMotion {
    fn apply(&self, p: Point) -> Point {
        self.turn.rotate(p) + self.by
    }
}

/// A join of two floors: the exit, the motion of the second, and the length of the passage.
#[derive(Clone, Copy, Debug)]
struct FloorJoin {
    from: WallExit,
    motion: FloorMotion,
    length_m: f64,
}

/// A floor in the drawing: its index, its motion, and its flights of stairs that became passages.
struct UnfoldedFloor {
    index: usize,
    motion: FloorMotion,
    used: Vec<usize>,
}

/// Joins floors to the first one by their stairs, in the heights that the plan gives, with passages between them.
/// Returns the indices of the joined floors, including the first.
///
/// Floors come from below. A floor without stairs, such as a gallery, does not stop those beyond it.
pub fn unfold(floors: &[(f64, BuiltFloor)], first: usize, names: &mut AllNames) -> (BuiltFloor, Vec<usize>) {
    let mut all = floors[first].1.clone();
    let mut drawn = vec![UnfoldedFloor { index: first, motion: STILL, used: Vec::new() }];
    let beyond = (first + 1..floors.len()).chain((0..first).rev());
    for next in beyond {
        let is_up = next > first;
        // From the nearest of those between, which were joined before.
        let mut from: Vec<usize> =
            (0..drawn.len()).filter(|&at| (drawn[at].index >= first) == is_up || at == 0).collect();
        from.sort_by_key(|&at| drawn[at].index.abs_diff(next));
        let found = from.into_iter().find_map(|at| {
            let there = &drawn[at];
            flight_to(floors, there, next, is_up, &all).map(|(stairs, join)| (at, stairs, join))
        });
        let Some((at, (lower, stairs), join)) = found else { continue };
        let piece = &floors[lower].1.stairs[stairs];
        // The passage replaces them.
        let drawn_at = if is_up { drawn[at].motion.apply(piece.at) } else { join.motion.apply(piece.at) };
        all = combined(combined(all, flight(&join, is_up, names)), moved(&floors[next].1, join.motion));
        all.furniture.retain(|piece| piece.at != drawn_at);
        drawn.push(UnfoldedFloor { index: next, motion: join.motion, used: Vec::new() });
        let of_lower = if is_up { at } else { drawn.len() - 1 };
        drawn[of_lower].used.push(stairs);
    }
    let mut taken: Vec<usize> = drawn.into_iter().map(|floor| floor.index).collect();
    taken.sort_unstable();
    (all, taken)
}

/// The stairs between a drawn floor and the next, by their lower floor, and the best way to join both.
fn flight_to(
    floors: &[(f64, BuiltFloor)],
    there: &UnfoldedFloor,
    next: usize,
    is_up: bool,
    all: &BuiltFloor,
) -> Option<((usize, usize), FloorJoin)> {
    let rise_m = (floors[next].0 - floors[there.index].0).abs();
    if rise_m < LEAST_APART_M {
        return None;
    }
    let (lower, used): (usize, &[usize]) = if is_up { (there.index, &there.used) } else { (next, &[]) };
    let stairs = up(&floors[lower].1, rise_m, used)?;
    let piece = &floors[lower].1.stairs[stairs];
    let floor = &floors[next].1;
    let run_m = piece.width_m.max(piece.depth_m).hypot(rise_m);
    let exits_there = exits(&moved(&floors[there.index].1, there.motion), &moved_piece(piece, there.motion));
    let exits_next = exits(floor, piece);
    let joins =
        exits_there.iter().flat_map(|from| exits_next.iter().filter_map(|to| join(all, floor, *from, *to, run_m)));
    joins.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, join)| ((lower, stairs), join))
}

/// The unused stairs of a floor that rise to another at this height: the highest that end there, else the lowest that
/// lead further up.
fn up(floor: &BuiltFloor, rise_m: f64, used: &[usize]) -> Option<usize> {
    let reach_m = |stairs: usize| floor.stairs[stairs].elevation_m + floor.stairs[stairs].height_m;
    let free = (0..floor.stairs.len()).filter(|stairs| !used.contains(stairs));
    let leads_up: Vec<usize> = free.filter(|&stairs| reach_m(stairs) >= LEAST_RISE * rise_m).collect();
    let (ends, continues): (Vec<usize>, Vec<usize>) =
        leads_up.into_iter().partition(|&stairs| reach_m(stairs) <= rise_m / LEAST_RISE);
    let highest = ends.into_iter().max_by(|&a, &b| reach_m(a).total_cmp(&reach_m(b)));
    highest.or_else(|| continues.into_iter().min_by(|&a, &b| reach_m(a).total_cmp(&reach_m(b))))
}

fn combined(mut one: BuiltFloor, other: BuiltFloor) -> BuiltFloor {
    one.rooms.extend(other.rooms);
    one.walls.extend(other.walls);
    one.doors.extend(other.doors);
    one.furniture.extend(other.furniture);
    one
}

/// One way to join them, with its cost.
fn join(there: &BuiltFloor, next: &BuiltFloor, from: WallExit, to: WallExit, run_m: f64) -> Option<(f64, FloorJoin)> {
    let beyond = |floor: &BuiltFloor, exit: &WallExit| {
        floor.points().map(|p| (p - exit.at).dot(exit.out)).fold(exit.thickness_m / 2.0, f64::max)
    };
    let (beyond_there, beyond_next) = (beyond(there, &from), beyond(next, &to));
    let length_m = run_m.max(beyond_there + beyond_next + APART_M);
    if length_m > run_m + MOST_LONGER_M || !is_clear(there, &from, beyond_there) || !is_clear(next, &to, beyond_next) {
        return None;
    }
    // The turn from one exit to the opposite direction of the other.
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
    Some((disliked, FloorJoin { from, motion: FloorMotion { turn, by }, length_m }))
}

/// True if the way out of a floor is clear of its parts.
fn is_clear(floor: &BuiltFloor, exit: &WallExit, beyond_m: f64) -> bool {
    let begin = exit.at + exit.out * (exit.thickness_m / 2.0 + 0.01);
    let end = exit.at + exit.out * (beyond_m + 0.02);
    let way = geometry::thick_segment(begin, end, FLIGHT_M);
    let is_crossed = |wall: &StraightWall| {
        geometry::distance_between_segments((begin, end), (wall.from, wall.to)) < FLIGHT_M / 2.0 - 0.06
    };
    !floor.rooms.iter().any(|room| overlap::area(&room.outline, &way) > 0.004)
        && !floor.walls.iter().any(|wall| {
            // The wall of the exit, and those in line with it, end where the way begins.
            let is_own = geometry::distance_to_segment(exit.at, wall.from, wall.to) < 0.02;
            !is_own && is_crossed(wall)
        })
}

fn moved(floor: &BuiltFloor, motion: FloorMotion) -> BuiltFloor {
    let turn_deg = motion.turn.y.atan2(motion.turn.x).to_degrees();
    let mut floor = floor.clone();
    let points = floor.walls.iter_mut().flat_map(|wall| [&mut wall.from, &mut wall.to]);
    points.for_each(|p| *p = motion.apply(*p));
    floor.rooms.iter_mut().flat_map(|room| &mut room.outline).for_each(|p| *p = motion.apply(*p));
    floor.doors.iter_mut().flat_map(|door| [&mut door.from, &mut door.to]).for_each(|p| *p = motion.apply(*p));
    for piece in &mut floor.furniture {
        piece.at = motion.apply(piece.at);
        piece.turn_deg = crate::furniture::normalised_turn(piece.turn_deg + turn_deg);
    }
    floor
}

fn moved_piece(piece: &PlanPiece, motion: FloorMotion) -> PlanPiece {
    let turn_rad = piece.turn_rad + motion.turn.y.atan2(motion.turn.x);
    PlanPiece { at: motion.apply(piece.at), turn_rad, ..piece.clone() }
}

/// The passage: a room of its own between two walls, with a door at each end.
fn flight(join: &FloorJoin, is_up: bool, names: &mut AllNames) -> BuiltFloor {
    let FloorJoin { from, length_m, .. } = *join;
    let (out, side) = (from.out, from.out.perp());
    let (begin, end) = (from.at, from.at + out * length_m);
    let rail = |across: f64| StraightWall { from: begin + side * across, to: end + side * across, thickness_m: WALL_M };
    let (left, right) = (FLIGHT_M / 2.0, -FLIGHT_M / 2.0);
    let outline = vec![begin + side * right, end + side * right, end + side * left, begin + side * left];
    let mut door = |at: Point, name: &str| {
        let half = side * (DOOR_M / 2.0);
        let name = names.doors.give(name, "door");
        WallDoor { name, from: at + half, to: at - half, is_outside: false, leads_home: 0 }
    };
    let mut ends = ["foot of the stairs", "head of the stairs"];
    if !is_up {
        ends.reverse();
    }
    BuiltFloor {
        rooms: vec![NamedRoom::new(names.spots.give("stairs", "stairs"), outline)],
        walls: vec![rail(left), rail(right)],
        doors: vec![door(begin, ends[0]), door(end, ends[1])],
        furniture: Vec::new(),
        stairs: Vec::new(),
        is_open: false,
    }
}
