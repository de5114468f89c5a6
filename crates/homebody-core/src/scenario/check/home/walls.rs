//! Walls that have a length, and doors that are in them.

use super::messages::HomeMessage;
use super::{ProblemReport, TOLERANCE_M, at};
use crate::geometry::{self, point};
use crate::home::form::HomeFile;
use crate::plan::form::{DoorFile, WallFile};
use crate::plan::span_on_wall;

/// Shorter walls and narrower doors are mistakes.
const LEAST_LENGTH_M: f64 = 0.001;
const LEAST_DOOR_M: f64 = 0.05;

/// Largest numbers of meetings of walls, and of things in walls, in a home (our choice): the search for ways takes
/// longer and longer.
const MOST_MEETINGS: usize = 20_000;
const MOST_IN_WALLS: usize = 2_000;

pub fn check(report: &mut ProblemReport, home: &HomeFile) {
    let before = report.count();
    check_meetings(report, home);
    check_doors_in_walls(report, home);
    if report.count() > before {
        return;
    }
    for (index, wall) in home.walls.iter().enumerate() {
        if point(wall.from).distance(point(wall.to)) < LEAST_LENGTH_M {
            report.add(&format!("/walls/{index}/to"), HomeMessage::ShortWall);
        }
    }
    let walls_are_sound = report.count() == before;
    let mut sound = Vec::new();
    for (index, door) in home.doors.iter().enumerate() {
        let width_m = point(door.from).distance(point(door.to));
        if width_m < LEAST_DOOR_M {
            report.add(&format!("/doors/{index}/to"), HomeMessage::NarrowDoor { door: door.name.clone(), width_m });
        } else {
            let spans = spans(home, door);
            // A door on no wall may be meant for one that has no length.
            if spans.is_empty() && walls_are_sound {
                report_off_wall(report, home, index, door);
            }
            sound.push((index, spans));
        }
    }
    for (i, (index, spans)) in sound.iter().enumerate() {
        if let Some((other, _)) = sound[..i].iter().find(|(_, other)| overlap(spans, other)) {
            let [a, b] = [other, index].map(|door| home.doors[*door].name.clone());
            report.add(&format!("/doors/{index}/from"), HomeMessage::DoorsOverlap { a, b });
        }
    }
}

fn check_meetings(report: &mut ProblemReport, home: &HomeFile) {
    let ends = |wall: &WallFile| (point(wall.from), point(wall.to));
    let walls: Vec<_> = home.walls.iter().map(ends).collect();
    let mut meetings = 0;
    for (index, &(a, b)) in walls.iter().enumerate() {
        meetings += walls[..index].iter().filter(|&&(c, d)| geometry::segments_meet(a, b, c, d)).count();
        if meetings > MOST_MEETINGS {
            return report.add("/walls", HomeMessage::WallMeetings { most: MOST_MEETINGS });
        }
    }
}

fn check_doors_in_walls(report: &mut ProblemReport, home: &HomeFile) {
    let mut in_walls = 0;
    for door in &home.doors {
        in_walls += spans(home, door).len();
        if in_walls > MOST_IN_WALLS {
            return report.add("/doors", HomeMessage::DoorsInWalls { most: MOST_IN_WALLS });
        }
    }
}

/// The position of a door on a wall: the wall's index, and the distances of the door's begin and end from the wall's
/// start.
type SpanOnWall = (usize, (f64, f64));

/// A door may be on several walls, where they meet.
fn spans(home: &HomeFile, door: &DoorFile) -> Vec<SpanOnWall> {
    let on = |wall: &WallFile| span_on_wall(point(wall.from), point(wall.to), point(door.from), point(door.to));
    home.walls.iter().enumerate().filter_map(|(index, wall)| Some((index, on(wall)?))).collect()
}

fn overlap(spans: &[SpanOnWall], others: &[SpanOnWall]) -> bool {
    spans.iter().any(|(wall, (start, end))| {
        let mut same_wall = others.iter().filter(|(other, _)| other == wall);
        same_wall.any(|(_, (from, to))| end.min(*to) - start.max(*from) > TOLERANCE_M)
    })
}

fn report_off_wall(report: &mut ProblemReport, home: &HomeFile, index: usize, door: &DoorFile) {
    let distance = |jamb: [f64; 2], (from, to): ([f64; 2], [f64; 2])| {
        geometry::distance_to_segment(point(jamb), point(from), point(to))
    };
    let walls = home.walls.iter().map(|wall| (wall.from, wall.to));
    let near = walls.map(|wall| (distance(door.from, wall).max(distance(door.to, wall)), wall));
    let nearest = near.min_by(|(a, _), (b, _)| a.total_cmp(b));
    let name = door.name.clone();
    let Some((far_m, wall)) = nearest else {
        let message = HomeMessage::OffWall { door: name, wall: None, distance_m: None };
        return report.add(&format!("/doors/{index}"), message);
    };
    let jamb = if distance(door.from, wall) >= distance(door.to, wall) { "from" } else { "to" };
    let (from, to) = (at(point(wall.0)), at(point(wall.1)));
    let (wall, distance_m) = (Some(format!("the wall from {from} to {to}")), Some(far_m));
    report.add(&format!("/doors/{index}/{jamb}"), HomeMessage::OffWall { door: name, wall, distance_m });
}
