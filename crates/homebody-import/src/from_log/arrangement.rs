//! An arrangement of rooms in one rectangle with walls in common where people went from room to room.
//!
//! The rectangle is cut in two, and each part again, until each room has its own: a tree of cuts. The first tree keeps
//! rooms with strong ties together; then single changes are made as long as one of them improves it.

use super::shape::{Rect, cut};
use homebody_core::geometry::Point;

#[derive(Clone, Copy, Debug)]
pub struct RoomNeed {
    pub area_m2: f64,
    /// True for a room that people mostly pass through, which may be long.
    pub is_way: bool,
    pub has_way_out: bool,
}

#[derive(Clone, Debug)]
enum CutTree {
    Room(usize),
    Cut { is_upright: bool, parts: Box<[CutTree; 2]> },
}

/// Length of wall that a door with its frame needs (our choice).
pub const DOOR_NEEDS_M: f64 = 1.15;
/// Smallest width of a room, and of a room that is only passed through (our choice).
const LEAST_M: f64 = 1.9;
const LEAST_WAY_M: f64 = 1.25;
/// Largest ratio of a room's length to its width, and of that of a room that is only passed through (our choice).
const LONGEST: f64 = 1.9;
const LONGEST_WAY: f64 = 7.0;
/// Ratio of the home's width to its depth (our choice).
const WIDTH: f64 = 1.3;
/// Weights of the shapes of rooms and of a way out inside, in comparison with the ways (our choice).
const SHAPES: f64 = 0.6;
const WAY_OUT: f64 = 0.5;
/// Largest number of changes that are tried (our choice): a home of ten rooms needs some thousand.
const MOST_TRIALS: usize = 60_000;

/// The rectangles of rooms, in metres from the corner of the home. `ties` are the strengths of the ties of two rooms.
pub fn arrange(rooms: &[RoomNeed], ties: &[Vec<f64>]) -> Vec<Rect> {
    let area: f64 = rooms.iter().map(|room| room.area_m2).sum();
    let width = (area * WIDTH).sqrt();
    let whole = Rect { least: Point::ZERO, most: Point::new(width, area / width) };
    let laid = |tree: &CutTree| {
        let mut rects = vec![whole; rooms.len()];
        lay_out(tree, whole, rooms, &mut rects);
        rects
    };
    let mut best = by_ties(rooms.len(), ties);
    let mut cost = cost_of(&laid(&best), rooms, ties, &whole);
    let mut trials = 0;
    loop {
        let mut is_better = false;
        for change in changes(&best, rooms.len()) {
            trials += 1;
            let new = cost_of(&laid(&change), rooms, ties, &whole);
            if new < cost - 1e-9 {
                (best, cost, is_better) = (change, new, true);
                break;
            }
        }
        if !is_better || trials > MOST_TRIALS {
            return laid(&best);
        }
    }
}

/// A tree that separates rooms with the strongest ties last.
fn by_ties(count: usize, ties: &[Vec<f64>]) -> CutTree {
    let mut clusters: Vec<(Vec<usize>, CutTree, bool)> =
        (0..count).map(|room| (vec![room], CutTree::Room(room), true)).collect();
    while clusters.len() > 1 {
        let tie = |a: &[usize], b: &[usize]| {
            let sum: f64 = a.iter().flat_map(|&a| b.iter().map(move |&b| ties[a][b])).sum();
            sum / (a.len() + b.len()) as f64
        };
        let pairs = (0..clusters.len()).flat_map(|a| (a + 1..clusters.len()).map(move |b| (a, b)));
        let strongest = pairs.max_by(|&(a, b), &(c, d)| {
            tie(&clusters[a].0, &clusters[b].0).total_cmp(&tie(&clusters[c].0, &clusters[d].0))
        });
        let Some((a, b)) = strongest else { break };
        let (rooms, second, upright) = clusters.remove(b);
        let (first_rooms, first, is_upright) = &mut clusters[a];
        first_rooms.extend(rooms);
        let is_cut_upright = *is_upright && upright || *is_upright != upright && first_rooms.len().is_multiple_of(2);
        *first = CutTree::Cut { is_upright: is_cut_upright, parts: Box::new([first.clone(), second]) };
        *is_upright = !is_cut_upright;
    }
    clusters.into_iter().next().map_or(CutTree::Room(0), |(_, tree, _)| tree)
}

fn lay_out(tree: &CutTree, rect: Rect, rooms: &[RoomNeed], rects: &mut [Rect]) {
    match tree {
        CutTree::Room(room) => rects[*room] = rect,
        CutTree::Cut { is_upright, parts } => {
            let [first, second] = parts.each_ref().map(|part| area(part, rooms));
            let share = first / (first + second);
            let at = rect.least + rect.size() * share;
            let [a, b] = cut(&rect, *is_upright, if *is_upright { at.x } else { at.y });
            lay_out(&parts[0], a, rooms, rects);
            lay_out(&parts[1], b, rooms, rects);
        }
    }
}

fn area(tree: &CutTree, rooms: &[RoomNeed]) -> f64 {
    match tree {
        CutTree::Room(room) => rooms[*room].area_m2,
        CutTree::Cut { parts, .. } => parts.iter().map(|part| area(part, rooms)).sum(),
    }
}

fn cost_of(rects: &[Rect], rooms: &[RoomNeed], ties: &[Vec<f64>], whole: &Rect) -> f64 {
    let (mut apart, mut all) = (0.0, 0.0);
    for a in 0..rects.len() {
        for b in 0..a {
            let tie = ties[a][b];
            if tie > 0.0 {
                all += tie;
                apart += tie * distance(&rects[a], &rects[b]);
            }
        }
    }
    let shapes: f64 = rects.iter().zip(rooms).map(|(rect, room)| misshapen(rect, room)).sum();
    let is_inside = |(rect, room): (&Rect, &RoomNeed)| room.has_way_out && outer_side(rect, whole).is_none();
    let inside = rects.iter().zip(rooms).filter(|&pair| is_inside(pair)).count() as f64;
    apart / f64::max(all, 1.0) + SHAPES * shapes / rects.len() as f64 + WAY_OUT * inside
}

/// The cost of two rooms without a wall for a door between them; 0 if there is one.
fn distance(a: &Rect, b: &Rect) -> f64 {
    match a.common_side(b).map(|(from, to)| from.distance(to)) {
        Some(length) if length >= DOOR_NEEDS_M => 0.0,
        Some(length) => 1.0 - length / DOOR_NEEDS_M * 0.5,
        None => 1.0 + a.gap(b),
    }
}

fn misshapen(rect: &Rect, room: &RoomNeed) -> f64 {
    let size = rect.size();
    let (short, long) = (size.min_element(), size.max_element());
    let (longest, least) = if room.is_way { (LONGEST_WAY, LEAST_WAY_M) } else { (LONGEST, LEAST_M) };
    (long / short - longest).max(0.0) + 4.0 * (least - short).max(0.0)
}

/// The longest side of a rectangle on the outside of the home with room for a door.
pub fn outer_side(rect: &Rect, whole: &Rect) -> Option<(Point, Point)> {
    let is_outer = |(from, to): &(Point, Point)| {
        let middle = (*from + *to) / 2.0;
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
        near(middle.x, whole.least.x)
            || near(middle.x, whole.most.x)
            || near(middle.y, whole.least.y)
            || near(middle.y, whole.most.y)
    };
    let sides = rect.sides().into_iter().filter(is_outer).filter(|(from, to)| from.distance(*to) >= DOOR_NEEDS_M);
    sides.max_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)))
}

/// All trees with one difference: a turned cut, two exchanged rooms, a moved room.
fn changes(tree: &CutTree, count: usize) -> impl Iterator<Item = CutTree> + use<> {
    let nodes = 2 * count - 1;
    let (base, other, third) = (tree.clone(), tree.clone(), tree.clone());
    let turned = (0..nodes).filter_map(move |node| {
        let mut new = base.clone();
        turn(&mut new, &mut { node }).then_some(new)
    });
    let swapped = (0..count).flat_map(move |a| (0..a).map(move |b| (a, b))).map(move |(a, b)| {
        let mut new = other.clone();
        swap(&mut new, a, b);
        new
    });
    let moved = (0..count)
        .flat_map(move |room| {
            (0..nodes.saturating_sub(2)).flat_map(move |node| (0..4).map(move |way| (room, node, way)))
        })
        .filter_map(move |(room, node, way)| {
            let rest = without(&third, room)?;
            Some(with(&rest, room, &mut { node }, way))
        });
    turned.chain(swapped).chain(moved)
}

/// Turns the cut of this number, in the order of writing; false without one.
fn turn(tree: &mut CutTree, number: &mut usize) -> bool {
    let CutTree::Cut { is_upright, parts } = tree else { return false };
    if *number == 0 {
        *is_upright = !*is_upright;
        return true;
    }
    *number -= 1;
    parts.iter_mut().any(|part| turn(part, number))
}

fn swap(tree: &mut CutTree, a: usize, b: usize) {
    match tree {
        CutTree::Room(room) if *room == a => *room = b,
        CutTree::Room(room) if *room == b => *room = a,
        CutTree::Room(_) => {}
        CutTree::Cut { parts, .. } => parts.iter_mut().for_each(|part| swap(part, a, b)),
    }
}

/// The tree without a room; `None` if it was the only one.
fn without(tree: &CutTree, room: usize) -> Option<CutTree> {
    match tree {
        CutTree::Room(one) => (*one != room).then_some(CutTree::Room(*one)),
        CutTree::Cut { is_upright, parts } => match parts.each_ref().map(|part| without(part, room)) {
            [Some(a), Some(b)] => Some(CutTree::Cut { is_upright: *is_upright, parts: Box::new([a, b]) }),
            [a, b] => a.or(b),
        },
    }
}

/// The tree with a room on one of the four sides of the node of this number.
fn with(tree: &CutTree, room: usize, number: &mut usize, side: usize) -> CutTree {
    if *number == 0 {
        *number = usize::MAX;
        let (new, old) = (CutTree::Room(room), tree.clone());
        let parts = if side.is_multiple_of(2) { [new, old] } else { [old, new] };
        return CutTree::Cut { is_upright: side < 2, parts: Box::new(parts) };
    }
    *number -= 1;
    match tree {
        CutTree::Room(room) => CutTree::Room(*room),
        CutTree::Cut { is_upright, parts } => {
            let [a, b] = parts.each_ref().map(|part| with(part, room, number, side));
            CutTree::Cut { is_upright: *is_upright, parts: Box::new([a, b]) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted(area_m2: f64, is_way: bool) -> RoomNeed {
        RoomNeed { area_m2, is_way, has_way_out: is_way }
    }

    #[test]
    fn rooms_with_ties_are_adjacent_and_fill_the_home() {
        let rooms: Vec<RoomNeed> =
            [13.0, 6.0, 11.0, 19.0, 9.0, 6.0].into_iter().enumerate().map(|(n, area)| wanted(area, n == 5)).collect();
        let mut ties = vec![vec![0.0; 6]; 6];
        for (a, b) in [(0, 1), (0, 5), (2, 3), (3, 5), (4, 5), (2, 4)] {
            (ties[a][b], ties[b][a]) = (10.0, 10.0);
        }
        let rects = arrange(&rooms, &ties);
        let whole: f64 = rects.iter().map(|rect| rect.size().x * rect.size().y).sum();
        assert!((whole - 64.0).abs() < 1e-6);
        for a in 0..6 {
            assert!((rects[a].size().x * rects[a].size().y - rooms[a].area_m2).abs() < 1e-6);
            for b in 0..a {
                assert!(!rects[a].inset(1e-6).overlaps(&rects[b]), "{rects:?}");
                assert!(ties[a][b] == 0.0 || distance(&rects[a], &rects[b]) == 0.0, "{a} and {b}: {rects:?}");
            }
        }
        let home = Rect { least: Point::ZERO, most: rects.iter().fold(Point::ZERO, |most, rect| most.max(rect.most)) };
        assert!(outer_side(&rects[5], &home).is_some());
    }
}
