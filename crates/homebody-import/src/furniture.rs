//! Furniture: rectangles on the floor of rooms, as high as they reach.

use crate::drawing::Piece;
use crate::error::NotImported;
use crate::kinds;
use crate::names::Names;
use crate::outline::Room;
use homebody_core::geometry::{self, Point};
use homebody_core::problem::counted;
use homebody_core::scenario::home::REACH_OUT_M;

/// A piece of furniture of the home.
#[derive(Clone, Debug)]
pub struct Furniture {
    pub name: String,
    pub at: Point,
    pub size_m: [f64; 2],
    pub turn_deg: f64,
    pub height_m: f64,
    pub is_enterable: bool,
}

/// What a home has at most.
const MOST_PIECES: usize = 1_000;

/// What a home takes for widths, depths and heights.
const SIZE_M: [f64; 2] = [0.001, 1_000.0];
/// The greatest height of a piece.
const MOST_HEIGHT_M: f64 = 10.0;

/// The pieces that stand in rooms.
pub fn place(
    pieces: Vec<Piece>,
    rooms: &[Room],
    names: &mut Names,
    remarks: &mut Vec<String>,
) -> Result<Vec<Furniture>, NotImported> {
    let (visible, hidden): (Vec<Piece>, Vec<Piece>) = pieces.into_iter().partition(|piece| piece.is_visible);
    let (overhead, standing): (Vec<Piece>, Vec<Piece>) = visible.into_iter().partition(kinds::is_overhead);
    let (inside, outside): (Vec<Piece>, Vec<Piece>) = standing.into_iter().partition(|piece| is_in(piece, rooms));
    for (left, why) in [
        (&hidden, "hidden in the plan"),
        (&overhead, "more than 1.5 m above the floor"),
        (&outside, "not within a room"),
    ] {
        if !left.is_empty() {
            let pieces = counted(left.len(), "piece of furniture", "pieces of furniture");
            remarks.push(format!("left out: {pieces} {why}"));
        }
    }
    if inside.len() > MOST_PIECES {
        let hint = "import one level of it, or delete small things in a copy";
        return Err(NotImported::TooMany { what: "pieces of furniture", count: inside.len(), most: MOST_PIECES, hint });
    }
    Ok(inside.iter().map(|piece| furniture(piece, names)).collect())
}

fn furniture(piece: &Piece, names: &mut Names) -> Furniture {
    let millimetres = |length: f64| (length * 1e3).round() / 1e3;
    let turn = piece.turn_rad.to_degrees().rem_euclid(360.0);
    let turn_deg = ((if turn > 180.0 { turn - 360.0 } else { turn }) * 1e3).round() / 1e3 + 0.0;
    Furniture {
        name: names.give(&piece.name, "piece"),
        at: piece.at,
        size_m: [piece.width_m, piece.depth_m].map(|size| millimetres(size).clamp(SIZE_M[0], SIZE_M[1])),
        turn_deg,
        height_m: millimetres(piece.elevation_m + piece.height_m).clamp(0.0, MOST_HEIGHT_M),
        is_enterable: kinds::is_enterable(piece),
    }
}

/// Whether a piece is in a room, and reaches no further out than into its walls.
fn is_in(piece: &Piece, rooms: &[Room]) -> bool {
    let along = geometry::direction(piece.turn_rad.to_degrees());
    let (x, y) = (along * (piece.width_m / 2.0), along.perp() * (piece.depth_m / 2.0));
    let corners = [x + y, x - y, -x + y, -x - y].map(|corner| piece.at + corner);
    let near = |p: Point| rooms.iter().any(|room| geometry::distance_to_area(&room.outline, p) < REACH_OUT_M);
    rooms.iter().any(|room| geometry::contains(&room.outline, piece.at)) && corners.into_iter().all(near)
}
