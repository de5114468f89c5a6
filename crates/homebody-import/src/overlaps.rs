//! Overlapping rooms: each patch of floor belongs to one of them.

use crate::outline::{NamedRoom, is_sound, tidy};
use homebody_core::geometry::{self, Point, overlap};

/// Largest area that two rooms may share: half of the limit of the check.
const MOST_SHARED_M2: f64 = 0.005;

/// Smallest covered share of a room that is drawn around others, such as one around a whole home (our choice).
const AROUND_SHARE: f64 = 0.5;

/// Share of its area above which a room is left out instead of cut (our choice).
const MOST_LOST_SHARE: f64 = 0.25;

/// Largest number of sides that are tried for cutting (our choice): rooms that overlap by accident share one.
const MOST_TRIED: usize = 8;

pub fn removed(mut rooms: Vec<NamedRoom>, remarks: &mut Vec<String>) -> Vec<NamedRoom> {
    leave_out_around(&mut rooms, remarks);
    let mut parted: Vec<NamedRoom> = Vec::new();
    // Larger rooms keep their shape.
    let mut order: Vec<usize> = (0..rooms.len()).collect();
    order.sort_by(|&a, &b| area(&rooms[b].outline).total_cmp(&area(&rooms[a].outline)));
    let mut kept: Vec<usize> = Vec::new();
    for index in order {
        let NamedRoom { name, outline, .. } = &rooms[index];
        let mut cut = outline.clone();
        let mut first = None;
        for other in &parted {
            if overlap::area(&cut, &other.outline) > MOST_SHARED_M2 {
                first.get_or_insert(other.name.clone());
                cut = cut_off(&cut, &other.outline).unwrap_or_default();
            }
        }
        let is_left = area(&cut) >= (1.0 - MOST_LOST_SHARE) * area(outline) && is_sound(&cut);
        match first {
            Some(other) if is_left => remarks.push(format!("{name:?} overlapped {other:?} and ends at it now")),
            Some(other) => {
                remarks.push(format!("left out: the room {name:?}, which overlaps {other:?}"));
                continue;
            }
            None => {}
        }
        parted.push(NamedRoom::new(name.clone(), cut));
        kept.push(index);
    }
    let mut parted: Vec<(usize, NamedRoom)> = kept.into_iter().zip(parted).collect();
    parted.sort_by_key(|(index, _)| *index);
    parted.into_iter().map(|(_, room)| room).collect()
}

fn leave_out_around(rooms: &mut Vec<NamedRoom>, remarks: &mut Vec<String>) {
    let covered = |room: &NamedRoom| -> f64 {
        let own = area(&room.outline);
        let smaller = rooms.iter().filter(|other| area(&other.outline) < own);
        smaller.map(|other| overlap::area(&room.outline, &other.outline)).sum::<f64>() / own
    };
    let around: Vec<bool> = rooms.iter().map(|room| covered(room) > AROUND_SHARE).collect();
    let mut is_around = around.iter();
    rooms.retain(|room| {
        let leave = is_around.next() == Some(&true);
        if leave {
            remarks.push(format!("left out: the room {:?}, most of which other rooms cover", room.name));
        }
        !leave
    });
}

fn area(outline: &[Point]) -> f64 {
    geometry::signed_area(outline).abs()
}

/// The outline cut along the side of another that costs least area, if a cut along one side removes the overlap.
fn cut_off(outline: &[Point], other: &[Point]) -> Option<Vec<Point>> {
    let least = (1.0 - MOST_LOST_SHARE) * area(outline);
    let turn = geometry::signed_area(other).signum();
    let cut = geometry::sides(other).map(|(a, b)| tidy(&beyond(outline, a, (b - a).perp() * -turn)));
    let mut cut: Vec<Vec<Point>> = cut.filter(|cut| area(cut) >= least && is_sound(cut)).collect();
    cut.sort_by(|a, b| area(b).total_cmp(&area(a)));
    cut.into_iter().take(MOST_TRIED).find(|cut| overlap::area(cut, other) <= MOST_SHARED_M2)
}

/// The part of an outline beyond a line, by Sutherland & Hodgman (1974): its corners keep their exact coordinates,
/// which boolean operations on a grid would move.
fn beyond(outline: &[Point], on_line: Point, outward: Point) -> Vec<Point> {
    let side = |p: Point| (p - on_line).dot(outward);
    let mut kept = Vec::new();
    for (a, b) in geometry::sides(outline) {
        if side(a) >= 0.0 {
            kept.push(a);
        }
        if (side(a) >= 0.0) != (side(b) >= 0.0) {
            kept.push(a + (b - a) * (side(a) / (side(a) - side(b))));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn room(name: &str, [x, y, width, depth]: [f64; 4]) -> NamedRoom {
        let corners = [(x, y), (x + width, y), (x + width, y + depth), (x, y + depth)];
        NamedRoom::new(name.into(), corners.map(Point::from).to_vec())
    }

    #[test]
    fn overlapping_rooms_are_cut() {
        let mut remarks = Vec::new();
        let rooms = vec![
            room("flat", [0.0, 0.0, 8.0, 4.0]),
            room("west", [0.0, 0.0, 4.1, 4.0]),
            room("east", [4.0, 0.0, 4.0, 4.0]),
            room("corner", [7.0, 3.0, 0.8, 0.8]),
        ];
        let parted = removed(rooms, &mut remarks);
        let areas: Vec<(&str, f64)> = parted.iter().map(|room| (&room.name[..], area(&room.outline))).collect();
        assert_eq!(areas.len(), 2, "{areas:?} {remarks:?}");
        assert!((areas[0].1 - 16.4).abs() < 1e-9 && (areas[1].1 - 15.6).abs() < 1e-9, "{areas:?}");
        assert_eq!(remarks.len(), 3, "{remarks:?}");
    }
}
