//! Walls that have a length, and doors that are in them.

use super::{Report, at};
use crate::geometry::{self, point};
use crate::home::plan::span_on_wall;
use crate::scenario::home::{DoorFile, HomeFile};

/// Shorter walls and narrower doors are mistakes.
const LEAST_LENGTH_M: f64 = 0.001;
const LEAST_DOOR_M: f64 = 0.05;

pub fn check(report: &mut Report, home: &HomeFile) {
    let before = report.count();
    for (index, wall) in home.walls.iter().enumerate() {
        if point(wall.from).distance(point(wall.to)) < LEAST_LENGTH_M {
            report.add(&format!("/walls/{index}/to"), "this wall has no length: it ends where it begins");
        }
    }
    let walls_are_sound = report.count() == before;
    let mut sound = Vec::new();
    for (index, door) in home.doors.iter().enumerate() {
        let width = point(door.from).distance(point(door.to));
        if width < LEAST_DOOR_M {
            let what = format!("the door {:?} has no width: its jambs are {width} m apart", door.name);
            report.add(&format!("/doors/{index}/to"), what);
        } else if spans(home, door).next().is_none() {
            // The wall that it should be on may be one of those.
            if walls_are_sound {
                report_off_wall(report, home, index, door);
            }
        } else {
            sound.push((index, door));
        }
    }
    for (i, (index, door)) in sound.iter().enumerate() {
        if let Some((_, other)) = sound[..i].iter().find(|(_, other)| overlap(home, door, other)) {
            let what = format!("the doors {:?} and {:?} overlap", other.name, door.name);
            report.add(&format!("/doors/{index}/from"), what);
        }
    }
}

/// The walls that a door is in, each with where on it.
fn spans<'a>(home: &'a HomeFile, door: &'a DoorFile) -> impl Iterator<Item = (usize, (f64, f64))> + 'a {
    let on = |from, to| span_on_wall(point(from), point(to), point(door.from), point(door.to));
    home.walls.iter().enumerate().filter_map(move |(index, wall)| Some((index, on(wall.from, wall.to)?)))
}

fn overlap(home: &HomeFile, a: &DoorFile, b: &DoorFile) -> bool {
    const TOUCHING_M: f64 = 1e-6;
    spans(home, a).any(|(wall, (start, end))| {
        let mut same_wall = spans(home, b).filter(|(other, _)| *other == wall);
        same_wall.any(|(_, (from, to))| end.min(to) - start.max(from) > TOUCHING_M)
    })
}

fn report_off_wall(report: &mut Report, home: &HomeFile, index: usize, door: &DoorFile) {
    let distance = |jamb: [f64; 2], (from, to): ([f64; 2], [f64; 2])| {
        geometry::distance_to_segment(point(jamb), point(from), point(to))
    };
    let walls = home.walls.iter().map(|wall| (wall.from, wall.to));
    let near = walls.map(|wall| (distance(door.from, wall).max(distance(door.to, wall)), wall));
    let nearest = near.min_by(|(a, _), (b, _)| a.total_cmp(b));
    let Some((far, wall)) = nearest else {
        return report.add(&format!("/doors/{index}"), format!("the door {:?} is on no wall", door.name));
    };
    let jamb = if distance(door.from, wall) >= distance(door.to, wall) { "from" } else { "to" };
    let (from, to) = (at(point(wall.0)), at(point(wall.1)));
    let hint = format!("the wall from {from} to {to} comes nearest; this jamb is {far:.3} m off its middle line");
    report.hinted(&format!("/doors/{index}/{jamb}"), format!("the door {:?} is on no wall", door.name), hint);
}
