//! The places of things along walls and of the spots that sensors see: sensors that fire soon after each other are
//! near.

use super::doors::{DoorGap, next};
use super::interpretation::SensorAim;
use super::pieces::NeededPiece;
use super::shape::Rect;
use super::{LogSensor, LogWay};
use homebody_core::geometry::Point;

/// Walking speed from one sensor to the next (our choice).
const PACE_MPS: f64 = 0.8;
/// Distance between sensors that see a person at the same time (our choice).
const BESIDE_M: f64 = 0.8;
/// Distance between a wall and the things along it, and between adjacent things (our choice).
const AT_WALL_M: f64 = 0.07;
const BETWEEN_M: f64 = 0.05;
/// Depth of free floor before a thing that a person stands at, and on both sides of a door (our choice).
const BEFORE_M: f64 = 0.75;
const AT_DOOR_M: f64 = 0.75;
/// Distance of a person who stands before a thing from the centre line of any wall (our choice): half of the thickest
/// wall, a body and a hand's breadth.
const STANDS_M: f64 = 0.45;
/// Room that a body needs on each side, and side of the cells for the search of its way (our choice).
const BODY_M: f64 = 0.3;
const CELL_M: f64 = 0.1;
/// Largest distance from a door or a seat to the floor that people walk on (our choice).
const NEAR_M: f64 = 0.8;
/// Distance between the places that are tried (our choice).
const STEP_M: f64 = 0.15;
/// Weight of a measured position, in comparison with ways (our choice). Things without a sensor keep away from doors.
const MEASURED: f64 = 1000.0;
/// Number of times that everything is placed again around the rest (our choice).
const ROUNDS: usize = 3;

#[derive(Clone, Copy, Debug)]
pub struct PieceSpot {
    pub rect: Rect,
    /// The place of a person who uses it.
    pub used_at: Point,
    /// The free floor before it; `None` for an enterable piece.
    free: Option<Rect>,
}

#[derive(Debug)]
pub struct Placement {
    /// By piece; `None` if its room is too small for it.
    pub pieces: Vec<Option<PieceSpot>>,
    /// By sensor, its target; `None` for sensors over whole rooms, and for targets without a place.
    pub sensors: Vec<Option<Point>>,
}

pub struct PlacementSite<'a> {
    pub sensors: &'a [LogSensor],
    pub ways: &'a [LogWay],
    pub what: &'a [(usize, SensorAim)],
    pub rects: &'a [Rect],
    pub doors: &'a [DoorGap],
    pub pieces: &'a [NeededPiece],
}

pub fn placed(site: &PlacementSite) -> Placement {
    let nexts: Vec<_> = (0..site.rects.len()).map(|room| next(site.doors, room, site.rects.len())).collect();
    let mut places = Placement { pieces: vec![None; site.pieces.len()], sensors: vec![None; site.sensors.len()] };
    for (number, &(room, what)) in site.what.iter().enumerate() {
        if matches!(what, SensorAim::Door | SensorAim::FrontDoor) {
            places.sensors[number] = at_door(site, number, room, what, &nexts[room]);
        }
    }
    let times = |piece: &NeededPiece| {
        site.ways
            .iter()
            .filter(|way| way.between.iter().any(|end| piece.sensors.contains(end)))
            .map(|way| way.times)
            .sum::<u64>()
    };
    let mut order: Vec<usize> = (0..site.pieces.len()).collect();
    // Pieces without a sensor take the remaining places.
    order.sort_by_key(|&piece| std::cmp::Reverse((!site.pieces[piece].sensors.is_empty(), times(&site.pieces[piece]))));
    for _ in 0..ROUNDS {
        for &number in &order {
            let piece = &site.pieces[number];
            places.pieces[number] = None;
            let stands = slots(site, piece, number, &places);
            let cost = |stands: &PieceSpot| match &piece.sensors[..] {
                [] => {
                    -site.doors.iter().map(|door| door.middle().distance(stands.used_at)).fold(f64::INFINITY, f64::min)
                }
                sensors => sensors.iter().map(|&sensor| site.cost(sensor, stands.used_at, &places, &nexts)).sum(),
            };
            let mut stands: Vec<(f64, PieceSpot)> = stands.into_iter().map(|stands| (cost(&stands), stands)).collect();
            stands.sort_by(|a, b| a.0.total_cmp(&b.0));
            let best =
                stands.into_iter().map(|(_, stands)| stands).find(|stands| leaves_ways(site, piece, stands, &places));
            places.pieces[number] = best;
            piece.sensors.iter().for_each(|&sensor| places.sensors[sensor] = best.map(|stands| stands.used_at));
        }
        for number in 0..site.sensors.len() {
            let (room, what) = site.what[number];
            if matches!(what, SensorAim::Spot | SensorAim::Wide) {
                places.sensors[number] = None;
                let cost = |at: &Point| site.cost(number, *at, &places, &nexts) + site.crowded(number, *at, &places);
                let best =
                    spots(site.rects[room]).into_iter().map(|at| (cost(&at), at)).min_by(|a, b| a.0.total_cmp(&b.0));
                places.sensors[number] = site.sensors[number].at.or(best.map(|(_, at)| at));
            }
        }
    }
    places
}

/// The floor before the door with the strongest tie to a sensor.
fn at_door(site: &PlacementSite, sensor: usize, room: usize, what: SensorAim, next: &[Option<usize>]) -> Option<Point> {
    let times = |door: usize| -> u64 {
        let to = |way: &&LogWay| way.other(sensor).is_some_and(|other| next[site.what[other].0] == Some(door));
        site.ways.iter().filter(to).map(|way| way.times).sum()
    };
    let doors = site.doors.iter().enumerate().filter(|(_, door)| match what {
        SensorAim::FrontDoor => door.rooms[1].is_none(),
        _ => door.other(room).is_some(),
    });
    let door = doors.max_by_key(|(number, _)| times(*number)).map(|(_, door)| door)?;
    let inward = (site.rects[room].middle() - door.middle()).normalize_or_zero();
    let along = (door.to - door.from).normalize_or_zero();
    let across = inward - along * inward.dot(along);
    Some(site.sensors[sensor].at.unwrap_or(door.middle() + across.normalize_or_zero() * BESIDE_M / 2.0))
}

impl PlacementSite<'_> {
    /// The misfit of a place to the ways of a sensor.
    fn cost(&self, sensor: usize, at: Point, places: &Placement, nexts: &[Vec<Option<usize>>]) -> f64 {
        if let Some(measured) = self.sensors[sensor].at {
            return MEASURED * measured.distance(at);
        }
        let room = self.what[sensor].0;
        let of = |way: &LogWay| {
            let other = way.other(sensor)?;
            let weight = (way.times as f64).sqrt();
            let there = self.what[other].0;
            if there != room {
                let door = nexts[room][there]?;
                return Some(weight * at.distance(self.doors[door].middle()));
            }
            let wanted = (way.soon_s * PACE_MPS).max(BESIDE_M);
            Some(weight * (at.distance(places.sensors[other]?) - wanted).abs())
        };
        self.ways.iter().filter_map(of).sum()
    }

    /// The cost of a spot near the spots of other sensors.
    fn crowded(&self, sensor: usize, at: Point, places: &Placement) -> f64 {
        /// Cost of a metre less between sensors (our choice).
        const CROWDED: f64 = 20.0;
        let here = |other: usize| other != sensor && self.what[other].0 == self.what[sensor].0;
        let others = (0..places.sensors.len()).filter(|&other| here(other)).filter_map(|other| places.sensors[other]);
        others.map(|other| CROWDED * (BESIDE_M - other.distance(at)).max(0.0)).sum()
    }
}

fn spots(rect: Rect) -> Vec<Point> {
    let inner = rect.inset(f64::min(0.5, rect.size().min_element() / 2.0 - 0.01));
    let count = |length: f64| (length / STEP_M) as usize;
    let (columns, rows) = (count(inner.size().x), count(inner.size().y));
    let along = |least: f64, most: f64, step: usize, steps: usize| {
        least + (most - least) * (step as f64 + 0.5) / (steps as f64 + 1.0)
    };
    (0..=columns)
        .flat_map(|x| (0..=rows).map(move |y| (x, y)))
        .map(|(x, y)| {
            Point::new(along(inner.least.x, inner.most.x, x, columns), along(inner.least.y, inner.most.y, y, rows))
        })
        .collect()
}

/// Possible places of a piece along the walls of its room, clear of other pieces and doors.
fn slots(site: &PlacementSite, piece: &NeededPiece, number: usize, places: &Placement) -> Vec<PieceSpot> {
    let room = site.rects[piece.room];
    let inner = room.inset(AT_WALL_M);
    let [width, depth] = piece.thing.size_m;
    let doors: Vec<Rect> = site.doors.iter().map(clearance).collect();
    let others: Vec<&PieceSpot> = places
        .pieces
        .iter()
        .enumerate()
        .filter(|(other, _)| *other != number)
        .filter_map(|(_, stands)| stands.as_ref())
        .collect();
    let is_free = |stands: &PieceSpot| {
        let space = stands.rect.inset(-BETWEEN_M);
        let blocks = |other: &&&PieceSpot| {
            space.overlaps(&other.rect)
                || other.free.is_some_and(|free| free.overlaps(&stands.rect))
                || stands.free.is_some_and(|free| free.overlaps(&other.rect))
        };
        inner.inset(-1e-9).contains(&stands.rect)
            && stands.free.is_none_or(|free| inner.inset(-1e-9).contains(&free))
            && (stands.free.is_none() || room.inset(STANDS_M).has(stands.used_at))
            && !doors.iter().any(|door| door.overlaps(&stands.rect))
            && !others.iter().any(|other| blocks(&other))
    };
    let mut slots = Vec::new();
    for (wall, inward) in [(0, Point::Y), (1, Point::NEG_X), (2, Point::NEG_Y), (3, Point::X)] {
        let is_along_x = wall % 2 == 0;
        let size = if is_along_x { Point::new(width, depth) } else { Point::new(depth, width) };
        let length = if is_along_x { inner.size().x } else { inner.size().y } - width;
        let steps = (length / STEP_M).floor().max(0.0) as usize;
        for step in 0..=steps {
            let along = length * step as f64 / steps.max(1) as f64;
            let least = match wall {
                0 => inner.least + Point::new(along, 0.0),
                1 => Point::new(inner.most.x - depth, inner.least.y + along),
                2 => Point::new(inner.least.x + along, inner.most.y - depth),
                _ => inner.least + Point::new(0.0, along),
            };
            let rect = Rect { least, most: least + size };
            let before = rect.middle() + inward * (depth + BEFORE_M) / 2.0;
            let free = Rect::around(
                before,
                if is_along_x { Point::new(width, BEFORE_M) } else { Point::new(BEFORE_M, width) },
            );
            let stands = match piece.thing.enterable {
                true => PieceSpot { rect, used_at: rect.middle(), free: None },
                false => PieceSpot { rect, used_at: before, free: Some(free) },
            };
            slots.push(stands);
        }
    }
    slots.retain(is_free);
    slots
}

/// True if a way remains from each door of the room to everything in it.
fn leaves_ways(site: &PlacementSite, piece: &NeededPiece, stands: &PieceSpot, places: &Placement) -> bool {
    let room = site.rects[piece.room];
    let others = site.pieces.iter().zip(&places.pieces).filter(|(other, _)| other.room == piece.room);
    let all: Vec<&PieceSpot> = others.filter_map(|(_, stands)| stands.as_ref()).chain([stands]).collect();
    let solid: Vec<Rect> = all.iter().map(|stands| stands.rect.inset(-BODY_M)).collect();
    let floor = room.inset(BODY_M + AT_WALL_M);
    let columns = (floor.size().x / CELL_M).floor().max(0.0) as usize + 1;
    let rows = (floor.size().y / CELL_M).floor().max(0.0) as usize + 1;
    let middle = |cell: usize| floor.least + Point::new((cell % columns) as f64, (cell / columns) as f64) * CELL_M;
    let is_free: Vec<bool> = (0..columns * rows).map(|cell| !solid.iter().any(|rect| rect.has(middle(cell)))).collect();
    let nearest = |(at, reach_m): (Point, f64)| {
        let near = (0..columns * rows).filter(|&cell| is_free[cell] && middle(cell).distance(at) < reach_m + NEAR_M);
        near.min_by(|&a, &b| middle(a).distance(at).total_cmp(&middle(b).distance(at)))
    };
    let doors = site.doors.iter().filter(|door| door.rooms.contains(&Some(piece.room)));
    let doors = doors.map(|door| (door.middle(), 0.0));
    // A person steps into an enterable piece from its side.
    let used = all.iter().map(|stands| {
        let reach_m = if stands.free.is_none() { stands.rect.size().max_element() / 2.0 } else { 0.0 };
        (stands.used_at, reach_m)
    });
    let Some(wanted) = doors.chain(used).map(nearest).collect::<Option<Vec<usize>>>() else { return false };
    let Some(&first) = wanted.first() else { return true };
    let mut is_reached = vec![false; columns * rows];
    let mut to_go = vec![first];
    while let Some(cell) = to_go.pop() {
        if std::mem::replace(&mut is_reached[cell], true) {
            continue;
        }
        let (column, row) = (cell % columns, cell / columns);
        let beside = [
            (column > 0).then(|| cell - 1),
            (column + 1 < columns).then(|| cell + 1),
            (row > 0).then(|| cell - columns),
            (row + 1 < rows).then(|| cell + columns),
        ];
        to_go.extend(beside.into_iter().flatten().filter(|&next| is_free[next] && !is_reached[next]));
    }
    wanted.into_iter().all(|cell| is_reached[cell])
}

fn clearance(door: &DoorGap) -> Rect {
    let (least, most) = (door.from.min(door.to), door.from.max(door.to));
    let across = if least.x == most.x { Point::new(AT_DOOR_M, BETWEEN_M) } else { Point::new(BETWEEN_M, AT_DOOR_M) };
    Rect { least: least - across, most: most + across }
}
