//! What a door, a window or a piece of furniture is, by the words of its name and of its name in the catalogue.

use crate::drawing::Piece;

/// Higher sills are those of windows (ours): thresholds and steps are lower.
const SILL_M: f64 = 0.3;

/// The words for windows in the catalogue, and in some languages in which people name them.
const WINDOW: &str = "window windows fenster fenetre fenêtre ventana finestra janela raam fönster vindu okno";

/// What makes a window one that people walk through.
const DOOR: &str = "door french porte tür puerta porta deur balcony";

/// What people lie, sit, stand or walk on, so that they can be where it is.
const ENTERABLE: &str = "bed bunk crib cot futon mattress daybed chair armchair wheelchair deckchair seat stool bench \
    recliner rocker ottoman pouf sofa couch settee loveseat toilet wc lavatory bidet rug carpet mat doormat shower \
    bath bathtub";

/// What stands beside those, under a name that has theirs in it, such as a bed table.
const BESIDE: &str = "table stand nightstand lamp light cabinet shelf shelves cupboard drawer drawers rack mirror \
    curtain screen sink basin washbasin heater machine holder brush paper towel";

/// Furniture whose underside is above this stands in nobody's way (ours): lamps on ceilings, cupboards up high.
const OVERHEAD_M: f64 = 1.5;

/// Whether an opening is a window that nobody walks through.
pub fn is_window(opening: &Piece) -> bool {
    opening.elevation_m > SILL_M || has(opening, WINDOW) && !has(opening, DOOR)
}

pub fn is_enterable(piece: &Piece) -> bool {
    has(piece, ENTERABLE) && !has(piece, BESIDE)
}

pub fn is_overhead(piece: &Piece) -> bool {
    piece.elevation_m > OVERHEAD_M
}

fn has(piece: &Piece, known: &str) -> bool {
    known.split_whitespace().any(|known| piece.words.iter().any(|word| word == known))
}
