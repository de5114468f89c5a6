//! Undrawn rooms of a plan: the spaces that its walls enclose.
//!
//! Walls are cut at their crossings, dead ends are removed, and each space is followed along its walls, on the left. A
//! space around a free-standing building, such as a garden, overlaps it and is left out.

use crate::drawing;
use crate::outline::{NamedRoom, is_sound, tidy};
use crate::rooms::{MOST_CORNERS, MOST_ROOMS};
use crate::walls::{OFF_FACE_M, StraightWall};
use homebody_core::geometry::{self, Point, overlap};
use homebody_core::problem::counted;
use std::collections::{BTreeMap, BTreeSet};

/// Distance below which ends of walls are one (our choice): the walls were meant to meet.
const JOINED_M: f64 = 0.15;

/// Area below which a space is a shaft (our choice).
const LEAST_AREA_M2: f64 = 0.5;

/// Largest number of walls, and of pieces of walls, in the plan of a home (our choice).
const MOST_WALLS: usize = 2_000;
const MOST_PIECES: usize = 10_000;

/// Largest share of a space covered by other rooms if it has no room of its own (our choice).
const COVERED_SHARE: f64 = 0.2;

/// Smallest area of the ground around a house, and of a space in it that is large enough for a home (our choice).
const GROUND_M2: f64 = 150.0;
const HOUSE_M2: f64 = 15.0;

/// Largest number of spaces on a floor of a home (our choice).
const MOST_SPACES: usize = 400;

pub fn without_room(walls: &[StraightWall], rooms: &[NamedRoom]) -> Vec<Vec<Point>> {
    let mut spaces = spaces(walls);
    if spaces.len() > MOST_SPACES {
        return Vec::new();
    }
    let area = |space: &[Point]| geometry::signed_area(space).abs();
    let around = |space: &Vec<Point>| {
        let smaller = spaces.iter().filter(|other| area(other) < area(space));
        area(space) > GROUND_M2 && smaller.map(|other| overlap::area(space, other)).sum::<f64>() > HOUSE_M2
    };
    let around: Vec<bool> = spaces.iter().map(around).collect();
    let mut is_around = around.iter();
    spaces.retain(|_| is_around.next() == Some(&false));
    spaces.retain(|space| {
        let covered: f64 = rooms.iter().map(|room| overlap::area(space, &room.outline)).sum();
        covered < COVERED_SHARE * area(space)
    });
    spaces
}

/// Replaces each room that is drawn around several enclosed spaces by a room for each; the largest keeps the name.
pub fn split_rooms(
    rooms: Vec<drawing::PlanRoom>,
    walls: &[StraightWall],
    remarks: &mut Vec<String>,
) -> Vec<drawing::PlanRoom> {
    /// Area below which a space is a closet (our choice).
    const LEAST_M2: f64 = 2.0;
    /// Smallest share within a room of a space that belongs to that room (our choice).
    const WITHIN_SHARE: f64 = 0.9;
    /// Share of the room that these spaces cover (our choice).
    const OF_ROOM_SHARE: f64 = 0.5;
    // Larger plans are refused elsewhere.
    let corners: usize = rooms.iter().map(|room| room.corners.len()).sum();
    if rooms.is_empty() || rooms.len() > MOST_ROOMS || corners > MOST_CORNERS {
        return rooms;
    }
    let area = |outline: &[Point]| geometry::signed_area(outline).abs();
    let mut spaces = spaces(walls);
    spaces.retain(|space| area(space) >= LEAST_M2);
    spaces.sort_by(|a, b| area(b).total_cmp(&area(a)));
    if spaces.len() > MOST_SPACES {
        return rooms;
    }
    let share = |room: &drawing::PlanRoom, space: &[Point]| overlap::area(&room.corners, space) / area(space);
    let shares: Vec<Vec<f64>> =
        spaces.iter().map(|space| rooms.iter().map(|room| share(room, space)).collect()).collect();
    let mut parted: Vec<drawing::PlanRoom> = Vec::new();
    for (index, room) in rooms.into_iter().enumerate() {
        let is_its = |shares: &[f64]| {
            let others = shares.iter().sum::<f64>() - shares[index];
            shares[index] >= WITHIN_SHARE && others < COVERED_SHARE
        };
        let its: Vec<&Vec<Point>> =
            spaces.iter().zip(&shares).filter(|(_, shares)| is_its(shares)).map(|(space, _)| space).collect();
        let covered: f64 = its.iter().map(|space| area(space)).sum();
        // A name for two spaces joins them to one room.
        let least = if room.name.trim().is_empty() { 2 } else { 3 };
        if its.len() < least || covered < OF_ROOM_SHARE * area(&room.corners) {
            parted.push(room);
            continue;
        }
        remarks.push(format!(
            "{} that walls enclose are rooms now, instead of one around them",
            counted(its.len(), "space", "spaces")
        ));
        let names = std::iter::once(room.name.clone()).chain(std::iter::repeat(String::new()));
        parted.extend(its.into_iter().zip(names).map(|(space, name)| drawing::PlanRoom {
            name,
            corners: space.clone(),
            ..room
        }));
    }
    parted
}

/// The enclosed spaces, along the middle lines of walls; none with too many walls.
fn spaces(walls: &[StraightWall]) -> Vec<Vec<Point>> {
    let graph = if walls.len() > MOST_WALLS { None } else { Graph::new(walls) };
    let Some(mut graph) = graph else { return Vec::new() };
    graph.take_off_dead_ends();
    let outlines = graph.faces().into_iter().map(|face| tidy(&face));
    outlines.filter(|face| is_sound(face) && geometry::signed_area(face) >= LEAST_AREA_M2).collect()
}

struct Graph {
    places: Vec<Point>,
    joined: Vec<BTreeSet<usize>>,
}

impl Graph {
    fn new(walls: &[StraightWall]) -> Option<Graph> {
        let mut graph = Graph { places: Vec::new(), joined: Vec::new() };
        let mut pieces = 0;
        for wall in walls {
            let mut cuts = vec![0.0, 1.0];
            let reach = JOINED_M / wall.length();
            for other in walls.iter().filter(|other| *other != wall) {
                cuts.extend(cut(wall, other).filter(|share| (reach..=1.0 - reach).contains(share)));
            }
            cuts.sort_by(f64::total_cmp);
            cuts.dedup_by(|share, before| *share - *before < reach && *share < 1.0);
            pieces += cuts.len() - 1;
            if pieces > MOST_PIECES {
                return None;
            }
            let places: Vec<usize> =
                cuts.iter().map(|share| graph.place(wall.from + (wall.to - wall.from) * *share)).collect();
            for ends in places.windows(2).filter(|ends| ends[0] != ends[1]) {
                graph.joined[ends[0]].insert(ends[1]);
                graph.joined[ends[1]].insert(ends[0]);
            }
        }
        graph.link(walls);
        Some(graph)
    }

    /// Extends walls that end inside of another, or at its face, to its middle line: pillars are drawn as short thick
    /// walls, and other walls meet them from all sides.
    fn link(&mut self, walls: &[StraightWall]) {
        for wall in walls.iter().filter(|wall| wall.thickness_m / 2.0 + OFF_FACE_M > JOINED_M) {
            for other in walls.iter().filter(|other| *other != wall) {
                for end in [other.from, other.to] {
                    let foot = geometry::nearest_on_segment(end, wall.from, wall.to);
                    if foot.distance(end) > wall.thickness_m / 2.0 + OFF_FACE_M {
                        continue;
                    }
                    let ends = [self.place(end), self.place(foot)];
                    if ends[0] != ends[1] {
                        self.joined[ends[0]].insert(ends[1]);
                        self.joined[ends[1]].insert(ends[0]);
                    }
                }
            }
        }
    }

    fn place(&mut self, p: Point) -> usize {
        let near = (0..self.places.len()).filter(|&place| self.places[place].distance(p) <= JOINED_M);
        let nearest = near.min_by(|&a, &b| self.places[a].distance(p).total_cmp(&self.places[b].distance(p)));
        nearest.unwrap_or_else(|| {
            self.places.push(p);
            self.joined.push(BTreeSet::new());
            self.places.len() - 1
        })
    }

    fn take_off_dead_ends(&mut self) {
        let mut dead: Vec<usize> = (0..self.places.len()).filter(|&place| self.joined[place].len() == 1).collect();
        while let Some(place) = dead.pop() {
            let Some(other) = self.joined[place].pop_first() else { continue };
            self.joined[other].remove(&place);
            if self.joined[other].len() == 1 {
                dead.push(other);
            }
        }
    }

    /// The outlines of all spaces; outer outlines run clockwise.
    fn faces(&self) -> Vec<Vec<Point>> {
        let mut next: BTreeMap<(usize, usize), (usize, usize)> = BTreeMap::new();
        for (place, joined) in self.joined.iter().enumerate() {
            let angle = |&other: &usize| {
                let way = self.places[other] - self.places[place];
                way.y.atan2(way.x)
            };
            let mut around: Vec<usize> = joined.iter().copied().collect();
            around.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
            for (index, &from) in around.iter().enumerate() {
                // The walk continues on the next way clockwise: the sharpest left turn.
                let to = around[(index + around.len() - 1) % around.len()];
                next.insert((from, place), (place, to));
            }
        }
        let mut faces = Vec::new();
        while let Some((start, mut way)) = next.pop_first() {
            let mut face = vec![self.places[start.1]];
            while let Some(following) = next.remove(&way) {
                face.push(self.places[way.1]);
                way = following;
            }
            faces.push(face);
        }
        faces
    }
}

/// The crossing or end of another wall on this one, as a share of its length.
fn cut(wall: &StraightWall, other: &StraightWall) -> impl Iterator<Item = f64> {
    let (way, across) = (wall.to - wall.from, other.to - other.from);
    let turn = way.perp_dot(across);
    let (along, beside) =
        ((other.from - wall.from).perp_dot(across) / turn, (other.from - wall.from).perp_dot(way) / turn);
    let crosses = (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&beside);
    let reach_m = JOINED_M.max(wall.thickness_m / 2.0 + OFF_FACE_M);
    let touches = [other.from, other.to].map(|end| {
        let is_near = geometry::distance_to_segment(end, wall.from, wall.to) <= reach_m;
        is_near.then(|| (end - wall.from).dot(way) / way.length_squared())
    });
    crosses.then_some(along).into_iter().chain(touches.into_iter().flatten())
}
