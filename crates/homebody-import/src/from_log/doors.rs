//! Doors between rooms that follow each other in the log, and the door out.

use super::arrangement::{DOOR_NEEDS_M, outer_side};
use super::shape::Rect;
use homebody_core::geometry::Point;
use std::collections::VecDeque;

#[derive(Clone, Debug)]
pub struct DoorGap {
    pub from: Point,
    pub to: Point,
    pub rooms: [Option<usize>; 2],
}

/// Width of a door, and of the wall next to it (our choice).
const WIDTH_M: f64 = 0.9;
const JAMB_M: f64 = 0.1;
/// Smallest width of the wall of a door where no other way exists (our choice).
const LEAST_WALL_M: f64 = 0.8;
/// Smallest share of the ways of the quieter of two rooms that lead to the other one if a door joins them (our choice).
const LEAST_SHARE: f64 = 0.06;

impl DoorGap {
    pub fn middle(&self) -> Point {
        (self.from + self.to) / 2.0
    }

    pub fn other(&self, room: usize) -> Option<usize> {
        match self.rooms {
            [Some(a), Some(b)] if a == room => Some(b),
            [Some(a), Some(b)] if b == room => Some(a),
            _ => None,
        }
    }

    fn in_wall((from, to): (Point, Point), rooms: [Option<usize>; 2]) -> DoorGap {
        let along = (to - from).normalize_or_zero();
        let width = f64::min(WIDTH_M, from.distance(to) - 2.0 * JAMB_M);
        let middle = (from + to) / 2.0;
        DoorGap { from: middle - along * width / 2.0, to: middle + along * width / 2.0, rooms }
    }
}

/// The doors between rooms: on the ways of people, and for rooms that could not be reached otherwise.
pub fn between(rects: &[Rect], ways: &[Vec<f64>], is_way: &[bool]) -> Vec<DoorGap> {
    let mut pairs: Vec<(usize, usize, (Point, Point), f64)> = Vec::new();
    for a in 0..rects.len() {
        for b in 0..a {
            if let Some(side) = rects[a].common_side(&rects[b]).filter(|(from, to)| from.distance(*to) >= LEAST_WALL_M)
            {
                pairs.push((a, b, side, ways[a][b]));
            }
        }
    }
    let all = |room: usize| ways[room].iter().sum::<f64>();
    let is_walked = |&(a, b, (from, to), times): &(usize, usize, (Point, Point), f64)| {
        times > 0.0 && times >= LEAST_SHARE * all(a).min(all(b)) && from.distance(to) >= DOOR_NEEDS_M
    };
    let mut doors: Vec<DoorGap> = Vec::new();
    let mut group: Vec<usize> = (0..rects.len()).collect();
    let mut join = |a: usize, b: usize| {
        let (a, b) = (group[a], group[b]);
        group.iter_mut().filter(|of| **of == b).for_each(|of| *of = a);
        a != b
    };
    for &(a, b, side, _) in pairs.iter().filter(|pair| is_walked(pair)) {
        join(a, b);
        doors.push(DoorGap::in_wall(side, [Some(b), Some(a)]));
    }
    // Passages before all other rooms, and wide walls first.
    let worth = |&(a, b, (from, to), times): &(usize, usize, (Point, Point), f64)| {
        times * 100.0 + if is_way[a] || is_way[b] { 50.0 } else { 0.0 } + from.distance(to)
    };
    pairs.sort_by(|one, other| worth(other).total_cmp(&worth(one)));
    for (a, b, side, _) in pairs {
        if join(a, b) {
            doors.push(DoorGap::in_wall(side, [Some(b), Some(a)]));
        }
    }
    doors
}

pub fn out(rects: &[Rect], candidates: &[usize]) -> Option<DoorGap> {
    let whole = Rect::around_all(rects);
    candidates.iter().find_map(|&room| Some(DoorGap::in_wall(outer_side(&rects[room], &whole)?, [Some(room), None])))
}

/// By room, the index of the first door on the way there from `room`; `None` for itself and for unreachable rooms.
pub fn next(doors: &[DoorGap], room: usize, count: usize) -> Vec<Option<usize>> {
    let mut first = vec![None; count];
    let mut is_known = vec![false; count];
    is_known[room] = true;
    let mut queue = VecDeque::from([room]);
    while let Some(here) = queue.pop_front() {
        for (number, door) in doors.iter().enumerate() {
            if let Some(there) = door.other(here).filter(|&there| !is_known[there]) {
                is_known[there] = true;
                first[there] = first[here].or(Some(number));
                queue.push_back(there);
            }
        }
    }
    first
}
