//! Doors: spans of the walls that they stand in.

use crate::drawing::PlanPiece;
use crate::error::ImportError;
use crate::kinds;
use crate::names::NamePool;
use crate::outline::NamedRoom;
use crate::walls::{DOOR_OFF_M, StraightWall};
use homebody_core::geometry::{self, Point};
use homebody_core::problem::counted;

#[derive(Clone, Debug)]
pub struct WallDoor {
    pub name: String,
    pub from: Point,
    pub to: Point,
    pub is_outside: bool,
    /// Its preference as the way home: 2 for a front door, 0 for a window that reaches the floor.
    pub leads_home: usize,
}

/// Largest number of doors of a home.
const MOST_DOORS: usize = 1_000;

/// Width below which no person walks through a door (our choice). The check refuses doors narrower than 5 cm.
const LEAST_WIDTH_M: f64 = 0.1;

/// Smallest cosine of the angle between a door and a wall that it is in (our choice): 45 degrees.
const IN_WALL_COSINE: f64 = 0.707;

/// Shortest move of a door that is reported (our choice).
const MOVED_M: f64 = 0.05;

/// Sine of the largest angle between parallel walls, and distance or overlap of separate things (our choice): a door
/// within a centimetre of two walls is already in both.
const BESIDE_SINE: f64 = 0.05;
const BESIDE_M: f64 = 0.02;

/// Walls next to its own that a door may pass through (our choice): houses have two faces, and some a layer between.
const MOST_BESIDE: usize = 2;

/// Distances behind the face of a wall at which a room is searched for (our choice): rooms drawn by hand end before
/// walls do.
const BEHIND_M: [f64; 5] = [0.05, 0.15, 0.25, 0.35, 0.45];

pub fn without_windows(openings: Vec<PlanPiece>, remarks: &mut Vec<String>) -> Result<Vec<PlanPiece>, ImportError> {
    let (windows, doors): (Vec<PlanPiece>, Vec<PlanPiece>) = openings.into_iter().partition(kinds::is_window);
    if !windows.is_empty() {
        let windows = counted(windows.len(), "window, which makes", "windows, which make");
        remarks.push(format!("left out: {windows} no difference to motion sensors"));
    }
    if doors.len() > MOST_DOORS {
        let hint = "import one level of it, or a plan of one home";
        return Err(ImportError::TooMany { what: "doors", count: doors.len(), most: MOST_DOORS, hint });
    }
    Ok(doors)
}

/// Largest distance from a door to the ends of the walls that it is drawn between (our choice).
const BESIDE_GAP_M: f64 = 0.35;

/// Smallest share along a wall of a door in that wall (our choice). For another door, a gap is searched.
const IN_WALL_SHARE: f64 = 0.5;

/// Walls for doors that are drawn in gaps between walls.
pub fn gaps(doors: &[PlanPiece], walls: &[StraightWall], remarks: &mut Vec<String>) -> Vec<StraightWall> {
    let gaps: Vec<StraightWall> = doors.iter().filter_map(|door| gap(door, walls)).collect();
    if !gaps.is_empty() {
        let are = counted(gaps.len(), "door is drawn in a gap", "doors are drawn in gaps");
        remarks.push(format!(
            "{are} between walls, and in a wall of {} now",
            if gaps.len() > 1 { "their own" } else { "its own" }
        ));
    }
    gaps
}

fn gap(door: &PlanPiece, walls: &[StraightWall]) -> Option<StraightWall> {
    let along = geometry::direction(door.turn_rad.to_degrees());
    let in_wall_m = |wall: &StraightWall| {
        let at = (door.at - wall.from).dot(wall.along());
        (at + door.width_m / 2.0).min(wall.length()) - (at - door.width_m / 2.0).max(0.0)
    };
    if door.width_m < LEAST_WIDTH_M || near(door, walls).any(|wall| in_wall_m(wall) >= IN_WALL_SHARE * door.width_m) {
        return None;
    }
    let beside = |side: f64| {
        let jamb = door.at + along * (side * door.width_m / 2.0);
        let off_m =
            |wall: &StraightWall| geometry::distance_to_segment(jamb, wall.from, wall.to) - wall.thickness_m / 2.0;
        let near = walls.iter().map(|wall| (off_m(wall), wall)).filter(|(off_m, _)| *off_m <= BESIDE_GAP_M);
        let (_, wall) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((geometry::nearest_on_segment(jamb, wall.from, wall.to), wall.thickness_m))
    };
    let ((from, thin_m), (to, thick_m)) = (beside(-1.0)?, beside(1.0)?);
    let wall = StraightWall { from, to, thickness_m: thin_m.min(thick_m) };
    let is_across = wall.along().dot(along) >= IN_WALL_COSINE;
    (is_across && wall.length() >= LEAST_WIDTH_M.max(door.width_m / 2.0)).then_some(wall)
}

/// The doors in their walls. A door with a room on one side only leads out.
pub fn place(
    doors: &[PlanPiece],
    walls: &[StraightWall],
    rooms: &[NamedRoom],
    names: &mut NamePool,
    remarks: &mut Vec<String>,
) -> Vec<WallDoor> {
    let mut placed = Vec::new();
    for door in doors {
        let name = names.give(&door.name, "door");
        let Some(wall) = wall_of(door, walls) else {
            remarks.push(format!("left out: the door {name:?}, which is in no wall"));
            continue;
        };
        let drawn = span(door, wall);
        let moved_m = (door.at - (drawn.0 + drawn.1) / 2.0).dot(wall.along()).abs();
        let width_m = drawn.0.distance(drawn.1);
        let (from, to) = beside_others(&placed, &name, drawn, remarks);
        let middle = (from + to) / 2.0;
        if width_m < door.width_m - MOVED_M {
            let was = door.width_m;
            remarks.push(format!("the door {name:?} is {width_m:.2} m wide, not {was:.2} m, as its wall is short"));
        } else if moved_m > MOVED_M {
            remarks.push(format!("the door {name:?} moved by {moved_m:.2} m into its wall"));
        }
        let beside = walls.iter().filter(|other| goes_through_both(door, wall, other));
        let beside: Vec<&StraightWall> = beside.take(MOST_BESIDE).collect();
        let last = beside.iter().copied().chain([wall]);
        let is_inside = |side: f64| last.clone().any(|wall| is_inside(middle, wall, rooms, side));
        let is_outside = is_inside(1.0) != is_inside(-1.0);
        let leads_home = kinds::leads_home(door);
        placed.push(WallDoor { name: name.clone(), from, to, is_outside, leads_home });
        for other in beside {
            let again = names.give(&name, "door");
            remarks.push(format!("the door {name:?} goes through two walls; in the other it is {again:?}"));
            let (from, to) = beside_others(&placed, &again, span(door, other), remarks);
            placed.push(WallDoor { name: again, from, to, is_outside, leads_home });
        }
    }
    placed
}

/// The best preference of a door as the way home: 0 without a door that leads out, 3 for a front door.
pub fn way_out(doors: &[WallDoor]) -> usize {
    doors.iter().filter(|door| door.is_outside).map(|door| door.leads_home + 1).max().unwrap_or(0)
}

fn near<'a>(door: &PlanPiece, walls: &'a [StraightWall]) -> impl Iterator<Item = &'a StraightWall> {
    let across = geometry::direction(door.turn_rad.to_degrees());
    walls.iter().filter(move |wall| {
        let off_m = geometry::distance_to_segment(door.at, wall.from, wall.to);
        wall.along().dot(across).abs() >= IN_WALL_COSINE
            && off_m <= wall.thickness_m / 2.0 + DOOR_OFF_M
            && wall.length().min(door.width_m) >= LEAST_WIDTH_M
    })
}

fn wall_of<'a>(door: &PlanPiece, walls: &'a [StraightWall]) -> Option<&'a StraightWall> {
    // Of walls that meet, the one with more of the door; of adjacent walls, the nearer one.
    let fit = |wall: &StraightWall| {
        let at = (door.at - wall.from).dot(wall.along());
        let shared = (at + door.width_m / 2.0).min(wall.length()) - (at - door.width_m / 2.0).max(0.0);
        shared - 2.0 * geometry::distance_to_segment(door.at, wall.from, wall.to)
    };
    near(door, walls).max_by(|a, b| fit(a).total_cmp(&fit(b)))
}

/// The span of a door in a wall, no wider than the wall, moved into it if necessary.
fn span(door: &PlanPiece, wall: &StraightWall) -> (Point, Point) {
    let half = door.width_m.min(wall.length()) / 2.0;
    let at = (door.at - wall.from).dot(wall.along()).clamp(half, (wall.length() - half).max(half));
    (wall.from + wall.along() * (at - half), wall.from + wall.along() * (at + half))
}

/// The part of a span that no earlier door covers. Only overlaps up to the width of a frame are cut, as between two
/// leaves; the check removes one of two doors that overlap more.
fn beside_others(
    placed: &[WallDoor],
    name: &str,
    (mut from, mut to): (Point, Point),
    remarks: &mut Vec<String>,
) -> (Point, Point) {
    /// Largest width of a frame (our choice).
    const MOST_M: f64 = 0.2;
    for other in placed {
        let along = (to - from).normalize_or_zero();
        let off_m = |p: Point| (p - from).perp_dot(along).abs();
        let ends = [other.from, other.to].map(|p| (p - from).dot(along));
        let (begin, end) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let length_m = from.distance(to);
        if off_m(other.from).max(off_m(other.to)) > BESIDE_M || length_m < 2.0 * MOST_M {
            continue;
        }
        if begin < 0.0 && (0.0..=MOST_M).contains(&end) {
            from += along * end;
        } else if end > length_m && (0.0..=MOST_M).contains(&(length_m - begin)) {
            to = from + along * begin;
        } else {
            continue;
        }
        if from.distance(to) < length_m {
            remarks.push(format!("the door {name:?} overlapped {:?} and ends at it now", other.name));
        }
    }
    (from, to)
}

/// True if a door also goes through the adjacent wall, as between two houses.
fn goes_through_both(door: &PlanPiece, own: &StraightWall, other: &StraightWall) -> bool {
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

fn is_inside(middle: Point, wall: &StraightWall, rooms: &[NamedRoom], side: f64) -> bool {
    let out = wall.along().perp() * side;
    let at = BEHIND_M.map(|behind| middle + out * (wall.thickness_m / 2.0 + behind));
    at.iter().any(|&p| rooms.iter().any(|room| geometry::contains(&room.outline, p)))
}
