//! What a door, a window, a flight of stairs or a lamp is, by its words in the catalogue and in its name, and by its place.

use crate::drawing::Piece;
use homebody_core::vocabulary::{FRONT_WORDS, WINDOW_WORDS, has_any};

/// Smallest height of a window's sill (our choice): thresholds and steps are lower.
const SILL_M: f64 = 0.3;

/// Height of a sill that people step over, and of the top of an opening that they walk through (our choice).
const STEP_M: f64 = 0.15;
const HEADROOM_M: f64 = 1.8;

/// What makes a window one that people walk through.
const DOOR: &str = "door french porte -tür türe puerta porta deur balcony";

/// Windows that nobody opens far enough, however low they reach.
const FIXED: &str = "fixed fixe fisso fissa fest festes fijo fija fixo hung panes";

/// The words for stairs.
const STAIRS: &str = "stair stairs staircase stairway treppe -treppe escalier scala scale escalera escada trap trappa \
    schody schodiště лестница 楼梯 階段";

/// Height of the underside above which furniture blocks no one (our choice): lamps on ceilings, high cupboards.
const OVERHEAD_M: f64 = 1.5;

/// Whether an opening is a window that nobody walks through.
pub fn is_window(opening: &Piece) -> bool {
    opening.elevation_m > SILL_M || is_called_window(opening) && !reaches_floor(opening)
}

/// Whether somebody goes in and out by an opening rather than by another: 2 for a front door, 1 for other doors, 0 for windows
/// that reach the floor.
pub fn leads_home(opening: &Piece) -> usize {
    if has(opening, FRONT_WORDS) { 2 } else { usize::from(!is_called_window(opening)) }
}

fn is_called_window(opening: &Piece) -> bool {
    has(opening, WINDOW_WORDS) && !has(opening, DOOR)
}

/// Whether an opening is as high as a door and can be opened as one, whatever it is called.
fn reaches_floor(opening: &Piece) -> bool {
    let top_m = opening.elevation_m + opening.height_m;
    opening.elevation_m <= STEP_M && top_m >= HEADROOM_M && !has(opening, FIXED)
}

pub fn is_overhead(piece: &Piece) -> bool {
    piece.elevation_m > OVERHEAD_M
}

/// Whether a piece is a flight of stairs.
pub fn is_stairs(piece: &Piece) -> bool {
    /// Rise below which stairs are steps (our choice).
    const LEAST_RISE_M: f64 = 1.5;
    piece.height_m >= LEAST_RISE_M && (piece.is_cut_out || has(piece, STAIRS))
}

fn has(piece: &Piece, known: &str) -> bool {
    has_any(&piece.catalog, known) || has_any(&piece.words, known)
}
