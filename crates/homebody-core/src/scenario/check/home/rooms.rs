//! Rooms: outlines that enclose an area, each its own.

use super::ProblemReport;
use super::areas::is_flat;
use super::messages::HomeMessage;
use crate::geometry::{self, Point, overlap};
use crate::home::form::HomeFile;

/// Outlines measured from both sides of a wall never agree better than this.
const OVERLAP_TOLERANCE_M2: f64 = 0.01;

/// Largest number of corners of all rooms (our choice): the search for overlaps takes time with the square of it.
const MOST_CORNERS: usize = 5_000;

/// Largest number of overlaps that are searched for (our choice).
const MOST_OVERLAPS: usize = 200;

pub fn check(report: &mut ProblemReport, home: &HomeFile) {
    if home.rooms.iter().map(|room| room.outline.len()).sum::<usize>() > MOST_CORNERS {
        return report.add("/rooms", HomeMessage::TooManyCorners { most: MOST_CORNERS });
    }
    let mut sound: Vec<(usize, Vec<Point>)> = Vec::new();
    for (index, room) in home.rooms.iter().enumerate() {
        let outline = geometry::points(&room.outline);
        let repeated = (0..outline.len()).find(|&i| outline[i] == outline[(i + outline.len() - 1) % outline.len()]);
        let place = format!("/rooms/{index}/outline");
        if let Some(corner) = repeated {
            // The corner that repeats the last is the first, and the last is the one to remove.
            let corner = if corner == 0 { outline.len() - 1 } else { corner };
            report.add(&format!("{place}/{corner}"), HomeMessage::RepeatedCorner { room: room.name.clone() });
        } else if is_flat(&outline) {
            report.add(&place, HomeMessage::NoArea { what: format!("the room {:?}", room.name) });
        } else if geometry::crosses_itself(&outline) || doubles_back(&outline) {
            report.add(&place, HomeMessage::CrossesItself { what: format!("the outline of {:?}", room.name) });
        } else {
            sound.push((index, outline));
        }
    }
    let pairs = sound.iter().enumerate().flat_map(|(i, one)| sound[..i].iter().map(move |other| (one, other)));
    let overlaps = pairs.filter_map(|((index, outline), (other, other_outline))| {
        let area = overlap::area(outline, other_outline);
        (area > OVERLAP_TOLERANCE_M2).then_some((index, other, area))
    });
    for (index, other, area_m2) in overlaps.take(MOST_OVERLAPS) {
        let [a, b] = [other, index].map(|room| home.rooms[*room].name.clone());
        report.add(&format!("/rooms/{index}/outline"), HomeMessage::Overlap { a, b, area_m2 });
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
