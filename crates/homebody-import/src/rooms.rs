//! Rooms: outlines in order, extended to the middle of the walls around them, without overlaps.
//!
//! Plans draw rooms between the faces of walls, and into doorways; a home's rooms meet in the middle of walls. So each
//! side along a wall moves onto its middle line, and the moved sides meet in the corners.

use crate::drawing::{self, Label, PlanDrawing, PlanPiece};
use crate::error::ImportError;
use crate::names::NamePool;
use crate::outline::{NamedRoom, SAME_M, filled, is_sound, tidy, untangled};
use crate::overlaps;
use crate::walls::StraightWall;
use homebody_core::geometry::{self, Point};
use homebody_core::problem::counted;

/// Largest number of rooms on a floor of a home (our choice).
pub const MOST_ROOMS: usize = 200;

/// Largest number of corners of all rooms (our choice): a large house has some hundreds. All rooms are compared with
/// each other.
pub const MOST_CORNERS: usize = 2_000;

/// Length below which a side is a step in a doorway or a niche (our choice).
const LEAST_SIDE_M: f64 = 0.2;

/// Largest distance of a side from the face of its wall (our choice): rooms drawn by hand are that inexact.
const OFF_FACE_M: f64 = 0.2;

/// Sine of the largest angle between a side and a wall that it runs along (our choice): 3 degrees.
const ALONG_SINE: f64 = 0.05;

/// Smallest share of a side along the wall (our choice).
const ALONG_SHARE: f64 = 0.4;

/// Largest distance that a corner is moved (our choice): in sharp angles, the lines of walls meet far away.
const FARTHEST_M: f64 = 0.6;

pub fn place(
    drawn: &[drawing::PlanRoom],
    walls: &[StraightWall],
    names: &mut NamePool,
    remarks: &mut Vec<String>,
) -> Result<Vec<NamedRoom>, ImportError> {
    let hint = "import one level of it, or a plan of one home";
    let too_many = |what, count, most| Err(ImportError::TooMany { what, count, most, hint });
    if drawn.len() > MOST_ROOMS {
        return too_many("rooms", drawn.len(), MOST_ROOMS);
    }
    let corners = drawn.iter().map(|room| room.corners.len()).sum();
    if corners > MOST_CORNERS {
        return too_many("corners of rooms", corners, MOST_CORNERS);
    }
    let mut rooms = Vec::new();
    for room in drawn {
        let name = names.give(&room.name, "room");
        // The way to a hole and back touches itself.
        let drawn = tidy(&room.corners);
        let (corners, holes) = if geometry::crosses_itself(&drawn) { filled(drawn) } else { (drawn, 0) };
        if holes > 0 {
            let holes = counted(holes, "hole is filled", "holes are filled");
            remarks.push(format!("{holes} in {name:?}, such as for stairs: a room has none"));
        }
        let Some(outline) = untangled(&corners) else {
            remarks.push(format!("left out: the room {name:?}, whose outline encloses nothing"));
            continue;
        };
        if geometry::crosses_itself(&corners) {
            remarks.push(format!("the outline of {name:?} crossed itself; its corners are in another order now"));
        }
        let sides = with_corners(&outline, &room.corners);
        let outline = Some(to_walls(&sides, walls)).filter(|outline| is_sound(outline)).unwrap_or(outline);
        rooms.push(NamedRoom::new(name, outline));
    }
    Ok(overlaps::removed(rooms, remarks))
}

/// The rooms of a level that people can be in; those without a name take the text in them.
///
/// A room drawn for its ceiling alone lies over others, and is left out unless all are drawn so.
pub fn named(drawing: &PlanDrawing, remarks: &mut Vec<String>) -> Vec<drawing::PlanRoom> {
    let has_floor = drawing.rooms.iter().any(|room| room.has_floor);
    let rooms = drawing.rooms.iter().filter(|room| room.has_floor || !has_floor);
    let mut rooms: Vec<drawing::PlanRoom> = rooms.cloned().collect();
    if rooms.len() < drawing.rooms.len() {
        let left = counted(drawing.rooms.len() - rooms.len(), "room", "rooms");
        remarks.push(format!("left out: {left} drawn without a floor, for a ceiling alone"));
    }
    rooms.iter_mut().for_each(|room| name_by_label(room, &drawing.labels));
    rooms
}

/// A room without a name takes its text, if it has only one.
pub fn name_by_label(room: &mut drawing::PlanRoom, labels: &[Label]) {
    if room.name.trim().is_empty() && room.corners.len() <= MOST_CORNERS && labels.len() <= MOST_ROOMS {
        let mut within = labels.iter().filter(|label| geometry::contains(&room.corners, label.at));
        if let (Some(label), None) = (within.next(), within.next()) {
            room.name.clone_from(&label.text);
        }
    }
}

/// Walls along the rooms with a door, in a plan that has doors but no walls.
pub fn outlines(rooms: &[drawing::PlanRoom], doors: &[PlanPiece]) -> Vec<drawing::PlanWall> {
    /// Thickness of these walls, and largest distance of a door from them (our choice).
    const THICKNESS_M: f64 = 0.1;
    const AT_DOOR_M: f64 = 0.3;
    let mut walls: Vec<drawing::PlanWall> = Vec::new();
    if rooms.len() > MOST_ROOMS || rooms.iter().map(|room| room.corners.len()).sum::<usize>() > MOST_CORNERS {
        return walls;
    }
    let is_at = |room: &&drawing::PlanRoom| {
        doors.iter().any(|door| geometry::distance_to_border(&room.corners, door.at) <= AT_DOOR_M)
    };
    for (from, to) in rooms.iter().filter(is_at).flat_map(|room| geometry::sides(&room.corners)) {
        let is_one = |wall: &drawing::PlanWall| {
            let are = |a: Point, b: Point| a.distance(b) < LEAST_SIDE_M / 2.0;
            are(wall.from, from) && are(wall.to, to) || are(wall.from, to) && are(wall.to, from)
        };
        if !walls.iter().any(is_one) {
            walls.push(drawing::PlanWall { level: None, from, to, thickness_m: THICKNESS_M, arc_rad: 0.0 });
        }
    }
    walls
}

#[derive(Clone, Copy)]
struct GuideLine {
    through: Point,
    along: Point,
}

impl GuideLine {
    fn foot(&self, p: Point) -> Point {
        self.through + self.along * (p - self.through).dot(self.along)
    }

    fn meet(&self, other: &GuideLine) -> Option<Point> {
        let turn = self.along.perp_dot(other.along);
        let way = (other.through - self.through).perp_dot(other.along) / turn;
        (turn.abs() > ALONG_SINE).then_some(self.through + self.along * way)
    }
}

/// The outline with the drawn corners in the middle of its sides: a wall or another room ends there.
fn with_corners(outline: &[Point], drawn: &[Point]) -> Vec<Point> {
    let mut all = Vec::with_capacity(drawn.len());
    for (a, b) in geometry::sides(outline) {
        all.push(a);
        let along = (b - a).normalize_or_zero();
        let on_side = drawn.iter().filter(|&&corner| geometry::distance_to_segment(corner, a, b) < SAME_M);
        let mut at: Vec<f64> = on_side.map(|&corner| (corner - a).dot(along)).collect();
        at.sort_by(f64::total_cmp);
        let mut last = 0.0;
        for at in at {
            if at - last >= LEAST_SIDE_M && a.distance(b) - at >= LEAST_SIDE_M {
                all.push(a + along * at);
                last = at;
            }
        }
    }
    all
}

/// The outline with its sides moved onto the middle of their walls.
fn to_walls(outline: &[Point], walls: &[StraightWall]) -> Vec<Point> {
    let lines: Vec<GuideLine> = geometry::sides(outline).map(|(a, b)| line(a, b, walls)).collect();
    let n = outline.len();
    let mut moved = Vec::with_capacity(2 * n);
    for (index, &corner) in outline.iter().enumerate() {
        let (into, out) = (&lines[(index + n - 1) % n], &lines[index]);
        match into.meet(out).filter(|p| p.distance(corner) <= FARTHEST_M) {
            Some(meeting) => moved.push(meeting),
            // A step from one line to the other.
            None => moved.extend([into.foot(corner), out.foot(corner)]),
        }
    }
    tidy(&moved)
}

/// The line of a side: the middle line of the wall with most of it, or its own.
fn line(a: Point, b: Point, walls: &[StraightWall]) -> GuideLine {
    let (length, along) = (a.distance(b), (b - a).normalize_or_zero());
    let middle = (a + b) / 2.0;
    let own = GuideLine { through: middle, along };
    if length < LEAST_SIDE_M {
        return own;
    }
    let shared_m = |wall: &StraightWall| {
        let (from, to) = ((wall.from - a).dot(along), (wall.to - a).dot(along));
        from.max(to).min(length) - from.min(to).max(0.0)
    };
    let near = walls.iter().filter(|wall| {
        let line = GuideLine { through: wall.from, along: wall.along() };
        let is_along = wall.along().perp_dot(along).abs() <= ALONG_SINE;
        let off_m = |p: Point| p.distance(line.foot(p));
        // The side may lie in the wall or on either of its faces.
        let most_m = wall.thickness_m / 2.0 + OFF_FACE_M;
        is_along && off_m(a).max(off_m(b)) <= most_m && off_m(middle) <= most_m
    });
    // Of adjacent walls, the nearer one.
    let off_m = |wall: &StraightWall| (middle - wall.from).perp_dot(wall.along()).abs();
    let fit = |wall: &StraightWall| shared_m(wall) - 2.0 * off_m(wall);
    let most = near.map(|wall| (shared_m(wall), wall)).max_by(|(_, a), (_, b)| fit(a).total_cmp(&fit(b)));
    match most {
        Some((shared_m, wall)) if shared_m >= ALONG_SHARE * length => {
            GuideLine { through: wall.from, along: wall.along() }
        }
        _ => own,
    }
}
