//! Kinds of doors, windows, stairs and lamps, by the words of their catalogue and name, and by their place.

use crate::drawing::PlanPiece;
use homebody_core::vocabulary::{FRONT_WORDS, WINDOW_WORDS, has_any};

/// Smallest height of a window's sill (our choice): thresholds and steps are lower.
const SILL_M: f64 = 0.3;

/// Height of a sill that people step over, and of the top of an opening that they walk through (our choice).
const STEP_M: f64 = 0.15;
const HEADROOM_M: f64 = 1.8;

/// Words for a window that people walk through.
const DOOR: &str = "door french porte -tür türe puerta porta deur balcony";

/// Windows that people do not open far enough, however low they reach.
const FIXED: &str = "fixed fixe fisso fissa fest festes fijo fija fixo hung panes";

const STAIRS: &str = "stair stairs staircase stairway treppe -treppe escalier scala scale escalera escada trap trappa \
    schody schodiště лестница 楼梯 階段";

/// Height of the underside above which furniture blocks no one (our choice): lamps on ceilings, high cupboards.
const OVERHEAD_M: f64 = 1.5;

pub fn is_window(opening: &PlanPiece) -> bool {
    opening.elevation_m > SILL_M || is_called_window(opening) && !reaches_floor(opening)
}

/// The preference for an opening as the way home: 2 for a front door, 1 for other doors, 0 for windows that reach the
/// floor.
pub fn leads_home(opening: &PlanPiece) -> usize {
    if has(opening, FRONT_WORDS) { 2 } else { usize::from(!is_called_window(opening)) }
}

fn is_called_window(opening: &PlanPiece) -> bool {
    has(opening, WINDOW_WORDS) && !has(opening, DOOR)
}

/// True if an opening is as high as a door and can be opened, by whatever name.
fn reaches_floor(opening: &PlanPiece) -> bool {
    let top_m = opening.elevation_m + opening.height_m;
    opening.elevation_m <= STEP_M && top_m >= HEADROOM_M && !has(opening, FIXED)
}

pub fn is_overhead(piece: &PlanPiece) -> bool {
    piece.elevation_m > OVERHEAD_M
}

pub fn is_stairs(piece: &PlanPiece) -> bool {
    /// Rise below which stairs are steps (our choice).
    const LEAST_RISE_M: f64 = 1.5;
    piece.height_m >= LEAST_RISE_M && (piece.is_cut_out || has(piece, STAIRS))
}

fn has(piece: &PlanPiece, known: &str) -> bool {
    has_any(&piece.catalog, known) || has_any(&piece.words, known)
}
