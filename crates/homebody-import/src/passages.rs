//! Passages without a door: gaps between walls at which the rooms on both sides end, and seams between rooms that
//! nearly meet.

use crate::drawing;
use crate::outline::NamedRoom;
use crate::walls::{MOST_SEARCHED, StraightWall};
use homebody_core::geometry::{self, Point};

/// Smallest and largest width of such a gap (our choice): a narrower one is an error, and no one draws two rooms with a
/// wider one.
const WIDE_M: [f64; 2] = [0.5, 4.0];

/// Largest distance from the line of a wall at which another wall continues it, and from a wall's face at which it ends
/// (our choice).
const ASIDE_M: f64 = 0.1;

/// Largest distance of rooms from the middle of a gap (our choice): half of a thick wall, drawn carelessly.
const BEYOND_M: f64 = 0.4;

pub struct WallGap {
    pub wall: StraightWall,
    pub from: Point,
    pub to: Point,
}

/// The gaps without a door between rooms of the plan.
pub fn gaps(walls: &[StraightWall], doors: &[Point], rooms: &[drawing::PlanRoom]) -> Vec<WallGap> {
    let mut passages: Vec<WallGap> = Vec::new();
    if walls.len() > MOST_SEARCHED {
        return passages;
    }
    for wall in walls {
        for (end, out) in [(wall.from, -wall.along()), (wall.to, wall.along())] {
            let Some((width_m, other)) = next(walls, wall, end, out) else { continue };
            let to = end + out * width_m;
            // A continuing wall ends there; a crossing wall is within half of its thickness.
            let is_across = other.along().dot(out).abs() < 0.7;
            let reveal_m = if is_across { other.thickness_m / 2.0 } else { 0.0 };
            let passage = WallGap {
                wall: StraightWall { from: end, to, thickness_m: wall.thickness_m },
                from: end,
                to: to - out * reveal_m,
            };
            let is_near = |p: Point| geometry::distance_to_segment(p, passage.from, passage.to) <= BEYOND_M;
            let is_known = passages.iter().any(|known| is_near((known.from + known.to) / 2.0));
            let is_wide = passage.from.distance(passage.to) >= WIDE_M[0];
            if is_wide && !is_known && !doors.iter().copied().any(is_near) && is_between(&passage, rooms) {
                passages.push(passage);
            }
        }
    }
    passages
}

/// The next wall beyond the end of a wall, and its distance.
fn next<'a>(walls: &'a [StraightWall], own: &StraightWall, end: Point, out: Point) -> Option<(f64, &'a StraightWall)> {
    let is_joined = |wall: &&StraightWall| {
        geometry::distance_to_segment(end, wall.from, wall.to) <= wall.thickness_m / 2.0 + ASIDE_M
    };
    if walls.iter().filter(|wall| *wall != own).any(|wall| is_joined(&wall)) {
        return None;
    }
    let ends = walls.iter().filter(|wall| *wall != own).flat_map(|wall| {
        let goes_on = [wall.from, wall.to].into_iter().filter(|p| (*p - end).perp_dot(out).abs() <= ASIDE_M);
        let goes_on = goes_on.map(|p| (p - end).dot(out));
        let turn = out.perp_dot(wall.along());
        let across_m = (wall.from - end).perp_dot(wall.along()) / turn;
        let meets = geometry::distance_to_segment(end + out * across_m, wall.from, wall.to) <= ASIDE_M;
        goes_on.chain((turn.abs() > 0.3 && meets).then_some(across_m)).map(move |width_m| (width_m, wall))
    });
    let ahead = ends.filter(|(width_m, _)| *width_m > 0.0).min_by(|a, b| a.0.total_cmp(&b.0));
    ahead.filter(|(width_m, _)| (WIDE_M[0]..=WIDE_M[1]).contains(width_m))
}

/// True if the rooms on both sides end at it.
fn is_between(passage: &WallGap, rooms: &[drawing::PlanRoom]) -> bool {
    let middle = (passage.from + passage.to) / 2.0;
    let across = (passage.to - passage.from).normalize_or_zero().perp();
    let at = |p: Point| rooms.iter().position(|room| geometry::contains(&room.corners, p));
    let side = |side: f64| (1..=8).find_map(|step| at(middle + across * (side * f64::from(step) / 8.0 * BEYOND_M)));
    at(middle).is_none() && matches!((side(1.0), side(-1.0)), (Some(one), Some(other)) if one != other)
}

/// Smallest and largest distance between rooms that were meant to meet (our choice).
const SEAM_M: [f64; 2] = [0.0015, 0.3];

/// Sine of the largest angle between parallel sides of rooms (our choice).
const ALONG_SINE: f64 = 0.05;

/// Step of the search for a wall in a seam, and largest number of steps along one side (our choice).
const STEP_M: f64 = 0.1;
const MOST_STEPS: f64 = 300.0;

/// Largest number of corners of a room that is compared with others (our choice): each side is compared with all of
/// theirs.
const MOST_CORNERS: usize = 100;

/// Largest number of seams of a home (our choice).
const MOST_SEAMS: usize = 100;

/// The seams without a wall between rooms that nearly meet.
pub fn seams(walls: &[StraightWall], rooms: &[NamedRoom]) -> Vec<WallGap> {
    let mut seams = Vec::new();
    if walls.len() > MOST_SEARCHED {
        return seams;
    }
    let simple: Vec<&NamedRoom> = rooms.iter().filter(|room| room.outline.len() <= MOST_CORNERS).collect();
    for (index, one) in simple.iter().enumerate() {
        let (least, most) = geometry::bounds(one.outline.iter().copied());
        for other in &simple[index + 1..] {
            let (low, high) = geometry::bounds(other.outline.iter().copied());
            if low.cmpgt(most + SEAM_M[1]).any() || high.cmplt(least - SEAM_M[1]).any() {
                continue;
            }
            for (a, b) in geometry::sides(&one.outline) {
                for side in geometry::sides(&other.outline) {
                    seams.extend(seam((a, b), side, walls, rooms));
                }
            }
        }
    }
    seams.truncate(MOST_SEAMS);
    seams
}

/// The empty parts between two sides.
fn seam((a, b): (Point, Point), (c, d): (Point, Point), walls: &[StraightWall], rooms: &[NamedRoom]) -> Vec<WallGap> {
    let (along, length_m) = ((b - a).normalize_or_zero(), a.distance(b));
    let off_m = ((c + d) / 2.0 - a).perp_dot(along);
    let is_along = along.perp_dot((d - c).normalize_or_zero()).abs() <= ALONG_SINE;
    let ends = [c, d].map(|p| (p - a).dot(along));
    let (begin_m, end_m) = (ends[0].min(ends[1]).max(0.0), ends[0].max(ends[1]).min(length_m));
    if !is_along || !(SEAM_M[0]..=SEAM_M[1]).contains(&off_m.abs()) || end_m - begin_m < WIDE_M[0] {
        return Vec::new();
    }
    let middle = |at_m: f64| a + along * at_m - along.perp() * (off_m / 2.0);
    let is_free = |p: Point| {
        let is_walled =
            |wall: &StraightWall| geometry::distance_to_segment(p, wall.from, wall.to) <= wall.thickness_m / 2.0 + 0.02;
        !walls.iter().any(is_walled) && !rooms.iter().any(|room| geometry::contains(&room.outline, p))
    };
    let step_m = STEP_M.max((end_m - begin_m) / MOST_STEPS);
    let steps = ((end_m - begin_m) / step_m) as usize;
    let mut runs: Vec<[f64; 2]> = Vec::new();
    for at_m in (0..=steps).map(|step| begin_m + step as f64 * step_m).filter(|at_m| is_free(middle(*at_m))) {
        match runs.last_mut() {
            Some([_, end]) if at_m - *end < 1.5 * step_m => *end = at_m,
            _ => runs.push([at_m, at_m]),
        }
    }
    let passage = |[begin, end]: [f64; 2]| {
        let (from, to) = (middle(begin), middle(end));
        // A little more than the gap, so that rounding leaves no gap.
        WallGap { wall: StraightWall { from, to, thickness_m: off_m.abs() + 0.02 }, from, to }
    };
    runs.into_iter().filter(|[begin, end]| end - begin >= WIDE_M[0]).map(passage).collect()
}

/// Makes walls in gaps as thick as the distance between the rooms, so that a body in such a door is in a room or in the
/// door.
pub fn thick_enough(walls: &mut [StraightWall], rooms: &[NamedRoom]) {
    /// Largest distance of rooms that were meant to meet at a door (our choice).
    const MOST_M: f64 = 0.4;
    for wall in walls {
        let middle = (wall.from + wall.to) / 2.0;
        let side_m = |out: Point| {
            let near = rooms.iter().map(|room| geometry::distance_to_area(&room.outline, middle + out * MOST_M / 2.0));
            let is_there = near.fold(f64::INFINITY, f64::min) <= MOST_M / 2.0;
            let steps = (0..=40).map(|step| MOST_M * f64::from(step) / 40.0);
            let first = |depth: &f64| rooms.iter().any(|room| geometry::contains(&room.outline, middle + out * *depth));
            if is_there { steps.into_iter().find(first) } else { None }
        };
        let across = wall.along().perp();
        let depth_m = [across, -across].into_iter().filter_map(side_m).fold(0.0, f64::max);
        wall.thickness_m = wall.thickness_m.max(2.0 * depth_m + 0.01);
    }
}
