//! What a piece of furniture is for: by what the catalogue calls it and by its shape, then by its name in some languages.

use crate::drawing::Piece;
use homebody_core::role::Role;
use homebody_core::vocabulary::{ROLE_WORDS, has_any};

/// What people lie, sit, stand or walk on besides, so that they can be where it is.
const ENTERABLE: &str = "bunk crib cot wheelchair deckchair seat ottoman rocker bidet rug carpet mat doormat teppich tapis \
    tappeto alfombra tapete";

/// Seats that are taken at table where there is no chair.
const STOOL: &str = "stool bench pouf hocker bank tabouret sgabello taburete banco kruk pall 凳";

/// What stands beside those that people are in, under a name that has theirs in it, such as a bed table.
const BESIDE: &str = "table stand nightstand lamp light cabinet shelf shelves cupboard drawer rack mirror curtain screen \
    sink basin washbasin heater radiator machine holder brush paper towel upper hood bedside side pillow toy tv work tisch -tisch";

/// What hangs above what people use.
const ABOVE: &str = "upper hood wall+cabinet dunstabzug hängeschrank";

/// What a piece is for, and whether people can be where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meaning {
    pub role: Option<Role>,
    pub is_enterable: bool,
    /// Whether it is a seat that is taken at table where there is no chair.
    pub is_stool: bool,
}

/// What a piece is by all that is known of it.
pub fn of(piece: &Piece) -> Meaning {
    // What the catalogue says is in one language, and its maker chose it; a name may be anything.
    let role = role(piece, &piece.catalog).or_else(|| role(piece, &piece.words));
    let is = |known: &str| {
        let is_in = |words: &[String]| has_any(words, known) && !has_any(words, BESIDE);
        is_in(&piece.catalog) || is_in(&piece.words)
    };
    let is_stool = is(STOOL) && is_seat(piece);
    let is_called = || ROLE_WORDS.iter().any(|(role, known)| is_entered(*role) && is(known));
    let is_enterable = role.map_or_else(is_called, is_entered) || is(ENTERABLE) || is(STOOL);
    Meaning { role, is_enterable, is_stool }
}

/// Whether people are in a piece with the role, and not before it.
fn is_entered(role: Role) -> bool {
    matches!(role, Role::Bed | Role::Toilet | Role::Shower | Role::Sofa | Role::Armchair | Role::DiningSeat)
}

/// The role that some words say, if the piece has the shape of it.
fn role(piece: &Piece, words: &[String]) -> Option<Role> {
    let is_out = |role| has_any(words, if is_entered(role) { BESIDE } else { ABOVE });
    let said = ROLE_WORDS.iter().find(|(role, known)| has_any(words, known) && !is_out(*role));
    said.map(|(role, _)| *role).filter(|role| has_shape(piece, *role))
}

/// Whether a piece is large enough to be used, and no larger than such things are: there are beds of dolls, and fridges
/// for the top of a counter.
fn has_shape(piece: &Piece, role: Role) -> bool {
    let (long_m, short_m) = (piece.width_m.max(piece.depth_m), piece.width_m.min(piece.depth_m));
    let top_m = piece.elevation_m + piece.height_m;
    match role {
        Role::Bed => long_m >= 1.6 && short_m >= 0.6,
        Role::Toilet => short_m >= 0.25 && long_m <= 1.5 && top_m <= 1.8,
        Role::Shower => short_m >= 0.5,
        Role::Sofa | Role::Armchair | Role::DiningSeat => is_seat(piece),
        Role::Fridge | Role::Stove => short_m >= 0.3,
        _ => true,
    }
}

/// Whether somebody can sit on it.
fn is_seat(piece: &Piece) -> bool {
    piece.width_m.min(piece.depth_m) >= 0.28 && piece.elevation_m <= 0.4 && (0.25..=1.8).contains(&piece.height_m)
}
