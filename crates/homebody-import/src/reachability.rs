//! Moves unreachable pieces: chairs under a table, and pieces that stand into a wall.

use crate::walls::MOST_SEARCHED;
use homebody_core::geometry::{self, At, Point, overlap};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::plan::{Origin, Plan, Solid, furniture_outline};
use homebody_core::role::Role;
use homebody_walk::Mesh;
use homebody_walk::places::HomePlaces;
use std::collections::BTreeSet;

/// Radius of the body in the search: the default of a resident.
const BODY_M: f64 = 0.22;

/// Largest numbers of pieces and rooms of a home that is checked: each round searches the whole home for ways.
const MOST_PIECES: usize = 400;
const MOST_ROOMS: usize = 100;

/// Largest number of unreachable pieces that are tried.
const MOST_UNREACHED: usize = 40;

/// Number of places tried for each piece, and number of pieces tried one by one if they block each other.
const MOST_TRIED: usize = 12;
const MOST_ALONE: usize = 24;

/// The steps of a move, and the longest move: people pull a chair out by its own depth.
const STEP_M: f64 = 0.05;
/// Longest move of a seat.
const MOST_SEAT_M: f64 = 1.0;
/// Longest move of another piece.
const MOST_OTHER_M: f64 = 0.5;

/// Distance from the edge of a table to a chair that is pulled out.
const BEYOND_EDGE_M: f64 = 0.1;

/// The overlap of two pieces that counts as none, in square metres.
const SHARED_M2: f64 = 0.01;

#[derive(Clone, Copy)]
struct Move {
    to: Point,
    by_m: f64,
}

/// Moves unreachable furniture that people use, and reports the rooms without a way in. Reachable pieces stay, and no
/// other piece becomes unreachable.
pub fn make_reachable(home: &mut HomeFile, remarks: &mut Vec<String>) {
    if home.walls.len() > MOST_SEARCHED || home.furniture.len() > MOST_PIECES || home.rooms.len() > MOST_ROOMS {
        return;
    }
    if home.rooms.len() < 2 && !home.furniture.iter().any(is_used) {
        return;
    }
    let plan = Plan::new(&*home);
    let mut reached = ways(home, &plan);
    let unreached: Vec<usize> = (0..home.furniture.len())
        .filter(|&index| is_used(&home.furniture[index]) && !reached.contains(&key(&home.furniture[index])))
        .take(MOST_UNREACHED)
        .collect();
    let moves: Vec<(usize, Vec<Move>)> =
        unreached.into_iter().map(|index| (index, moves(home, &plan, index))).collect();
    let drawn: Vec<Option<At>> = home.furniture.iter().map(|piece| piece.at).collect();
    let rounds = moves.iter().map(|(_, moves)| moves.len()).max().unwrap_or_default();
    let mut alone = 0;
    for round in 0..rounds {
        let left = moves.iter().filter(|(index, _)| !reached.contains(&key(&home.furniture[*index])));
        let tried: Vec<(usize, Move)> = left.filter_map(|(index, moves)| Some((*index, *moves.get(round)?))).collect();
        if try_moves(home, &tried, &mut reached) || tried.len() < 2 {
            continue;
        }
        for one in tried {
            alone += 1;
            if alone <= MOST_ALONE {
                try_moves(home, &[one], &mut reached);
            }
        }
    }
    remarks.extend(moves_remark(home, &drawn));
    remarks.extend(closed_rooms(home));
}

/// Moves pieces, and keeps the moves that make a piece reachable; undoes all of them if another becomes unreachable.
fn try_moves(home: &mut HomeFile, moves: &[(usize, Move)], reached: &mut BTreeSet<String>) -> bool {
    let mut moved = home.clone();
    for (index, to) in moves {
        moved.furniture[*index].at = Some(at(to.to));
    }
    let mut now = ways(&moved, &Plan::new(&moved));
    let (kept, useless): (Vec<usize>, Vec<usize>) =
        moves.iter().map(|(index, _)| *index).partition(|&index| now.contains(&key(&home.furniture[index])));
    if kept.is_empty() {
        return false;
    }
    if !useless.is_empty() {
        for &index in &useless {
            moved.furniture[index].at = home.furniture[index].at;
        }
        now = ways(&moved, &Plan::new(&moved));
    }
    let is_better = kept.iter().all(|&index| now.contains(&key(&home.furniture[index]))) && reached.is_subset(&now);
    if is_better {
        *home = moved;
        *reached = now;
    }
    is_better
}

fn ways(home: &HomeFile, plan: &Plan) -> BTreeSet<String> {
    let places = HomePlaces::new(home, plan, &Mesh::new(plan, BODY_M), "");
    places.all().iter().filter(|spot| spot.is_reachable).map(|spot| spot.name.clone()).collect()
}

fn key(piece: &FurnitureFile) -> String {
    piece.name.to_lowercase()
}

/// True for a piece with a role, or one to sit or lie on.
fn is_used(piece: &FurnitureFile) -> bool {
    piece.enterable || piece.role.is_some() || Role::from_name(&key(piece)).next().is_some()
}

fn at(p: Point) -> At {
    [p.x, p.y].map(|length| (length * 1e3).round() / 1e3)
}

/// Other places for a piece, the nearest first: out of the overlapping piece or wall, along the sides of either.
fn moves(home: &HomeFile, plan: &Plan, index: usize) -> Vec<Move> {
    let piece = &home.furniture[index];
    let Some(from) = piece.at.map(geometry::point) else { return Vec::new() };
    let outline = furniture_outline(piece);
    let own = Origin::Furniture(index);
    let is_near = |solid: &&Solid| {
        solid.origin != own && solid.stops_bodies && geometry::distance_to_area(&solid.outline, from) < MOST_SEAT_M
    };
    let solids: Vec<&Solid> = plan.solids.iter().filter(is_near).collect();
    let stands_in = solids.iter().filter(|solid| overlap::area(&outline, &solid.outline) > SHARED_M2);
    let sides = stands_in.flat_map(|solid| geometry::sides(&solid.outline)).chain(geometry::sides(&outline));
    let mut directions: Vec<Point> = Vec::new();
    for (a, b) in sides {
        let out = -(b - a).normalize_or_zero().perp();
        if out != Point::ZERO && directions.iter().all(|known| known.dot(out) < 0.999) {
            directions.push(out);
        }
    }
    let most_m = if piece.enterable { MOST_SEAT_M } else { MOST_OTHER_M };
    let room = plan.room_at(from);
    let stands = |p: Point| {
        let moved: Vec<Point> = outline.iter().map(|&corner| corner + (p - from)).collect();
        let clear = |solid: &&Solid| match piece.enterable {
            // The front of a seat stays under the table.
            true => {
                let is_wall = !matches!(solid.origin, Origin::Furniture(_));
                geometry::distance_to_area(&solid.outline, p) >= BEYOND_EDGE_M
                    && !(is_wall && overlap::area(&moved, &solid.outline) > SHARED_M2)
            }
            false => overlap::area(&moved, &solid.outline) <= SHARED_M2,
        };
        plan.room_at(p) == room && solids.iter().all(clear) && is_apart(home, index, &moved)
    };
    let steps = (most_m / STEP_M) as u32;
    let mut found: Vec<Move> = Vec::new();
    for out in directions {
        let way = (1..=steps).map(|step| STEP_M * f64::from(step));
        let fit = way.map(|by_m| Move { to: from + out * by_m, by_m }).filter(|step| stands(step.to));
        // The first fit may still be too near to something.
        found.extend(fit.step_by(3).take(3));
    }
    found.sort_by(|a, b| a.by_m.total_cmp(&b.by_m));
    found.truncate(MOST_TRIED);
    found
}

/// True if a piece keeps clear of all seats that it does not already cover in the drawing.
fn is_apart(home: &HomeFile, index: usize, moved: &[Point]) -> bool {
    let drawn = furniture_outline(&home.furniture[index]);
    let others = home.furniture.iter().enumerate().filter(|(other, piece)| *other != index && piece.enterable);
    let (least, most) = geometry::bounds(moved.iter().copied());
    let is_near = |other: &Vec<Point>| {
        let (low, high) = geometry::bounds(other.iter().copied());
        low.cmple(most).all() && high.cmpge(least).all()
    };
    others.map(|(_, piece)| furniture_outline(piece)).filter(is_near).all(|other| {
        let shared_m2 = overlap::area(moved, &other);
        shared_m2 <= SHARED_M2 || shared_m2 <= overlap::area(&drawn, &other)
    })
}

fn moves_remark(home: &HomeFile, drawn: &[Option<At>]) -> Option<String> {
    /// Largest number of names in it.
    const NAMED: usize = 6;
    let moved = home.furniture.iter().zip(drawn).filter_map(|(piece, drawn)| {
        let by_m = geometry::point((*drawn)?).distance(geometry::point(piece.at?));
        (by_m > 0.0).then(|| format!("{:?} by {by_m:.2} m", piece.name))
    });
    let moved: Vec<String> = moved.collect();
    let more = moved.len().saturating_sub(NAMED);
    let named = moved[..moved.len() - more].join(", ");
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let what = "moved away from furniture or walls, so that residents can reach them";
    (!moved.is_empty()).then(|| format!("{what}: {named}{more}"))
}

fn closed_rooms(home: &HomeFile) -> Option<String> {
    let plan = Plan::new(home);
    let places = HomePlaces::new(home, &plan, &Mesh::new(&plan, BODY_M), "");
    let names: Vec<String> = places.closed_rooms().map(|room| format!("{:?}", home.rooms[room].name)).collect();
    let what = "no resident can enter";
    let why = "no door leads there from the rest of the home, or something is in the way";
    (!names.is_empty()).then(|| format!("{what} {}: {why}", names.join(", ")))
}
