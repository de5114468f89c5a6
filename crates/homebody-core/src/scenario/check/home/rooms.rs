//! Rooms: outlines that enclose an area, each its own.

use super::Report;
use super::areas::is_flat;
use crate::geometry::{self, Point, overlap, point};
use crate::scenario::home::HomeFile;

/// Outlines measured from both sides of a wall never agree better than this.
const OVERLAP_TOLERANCE_M2: f64 = 0.01;

/// Largest number of corners of all rooms (our choice): the search for overlaps takes time with the square of it.
const MOST_CORNERS: usize = 5_000;

/// Largest number of overlaps that are searched for (our choice).
const MOST_OVERLAPS: usize = 200;

pub fn check(report: &mut Report, home: &HomeFile) {
    if home.rooms.iter().map(|room| room.outline.len()).sum::<usize>() > MOST_CORNERS {
        let what = format!("the rooms have more than {MOST_CORNERS} corners together");
        return report.hinted("/rooms", what, "a bay of ten corners is as round as sensors can tell");
    }
    let mut sound: Vec<(usize, Vec<Point>)> = Vec::new();
    for (index, room) in home.rooms.iter().enumerate() {
        let outline: Vec<Point> = room.outline.iter().map(|&at| point(at)).collect();
        let repeated = (0..outline.len()).find(|&i| outline[i] == outline[(i + outline.len() - 1) % outline.len()]);
        let (place, name) = (format!("/rooms/{index}/outline"), &room.name);
        if let Some(corner) = repeated {
            let hint = "the last corner is joined to the first without being repeated";
            // The corner that repeats the last is the first, and the last is the one to remove.
            let corner = if corner == 0 { outline.len() - 1 } else { corner };
            report.hinted(&format!("{place}/{corner}"), format!("a corner of {name:?} is given twice"), hint);
        } else if is_flat(&outline) {
            report.add(&place, format!("the room {name:?} has no area"));
        } else if geometry::crosses_itself(&outline) || doubles_back(&outline) {
            report.hinted(&place, format!("the outline of {name:?} crosses itself"), "give its corners in order");
        } else {
            sound.push((index, outline));
        }
    }
    let pairs = sound.iter().enumerate().flat_map(|(i, one)| sound[..i].iter().map(move |other| (one, other)));
    let overlaps = pairs.filter_map(|((index, outline), (other, other_outline))| {
        let area = overlap::area(outline, other_outline);
        (area > OVERLAP_TOLERANCE_M2).then_some((index, other, area))
    });
    for (index, other, area) in overlaps.take(MOST_OVERLAPS) {
        let (name, other) = (&home.rooms[*index].name, &home.rooms[*other].name);
        let what = format!("the rooms {other:?} and {name:?} overlap by {area:.2} m²");
        report.add(&format!("/rooms/{index}/outline"), what);
    }
}

/// Whether a side runs back along the one before it.
fn doubles_back(outline: &[Point]) -> bool {
    let n = outline.len();
    (0..n).any(|i| {
        let (into, out) = (outline[(i + 1) % n] - outline[i], outline[(i + 2) % n] - outline[(i + 1) % n]);
        into.perp_dot(out) == 0.0 && into.dot(out) < 0.0
    })
}
