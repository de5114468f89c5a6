//! The purpose of a piece of furniture: by its catalogue name and its shape, then by its own name in some languages.

use crate::drawing::PlanPiece;
use homebody_core::role::Role;
use homebody_core::vocabulary::{ROLE_WORDS, has_any};

/// Words for other things that people lie, sit, stand or walk on.
const ENTERABLE: &str = "bunk crib cot wheelchair deckchair seat ottoman rocker bidet rug carpet mat doormat teppich tapis \
    tappeto alfombra tapete";

/// Seats at table without a chair.
const STOOL: &str = "stool bench pouf hocker bank tabouret sgabello taburete banco kruk pall 凳";

/// Words for things whose name contains that of an enterable one, such as a bed table.
const BESIDE: &str = "table stand nightstand lamp light cabinet shelf shelves cupboard drawer rack mirror curtain screen \
    sink basin washbasin heater radiator machine holder brush paper towel upper hood bedside side pillow toy tv work tisch -tisch";

/// Words for things that hang above others.
const ABOVE: &str = "upper hood wall+cabinet dunstabzug hängeschrank";

/// The purpose of a piece, and whether people can enter it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceMeaning {
    pub role: Option<Role>,
    pub is_enterable: bool,
    /// True for a stool, which is a seat at table without a chair.
    pub is_stool: bool,
}

pub fn piece_meaning(piece: &PlanPiece) -> PieceMeaning {
    // The catalogue name is in one language and chosen by its maker; the piece's own name may be anything.
    let role = role(piece, &piece.catalog).or_else(|| role(piece, &piece.words));
    let is = |known: &str| {
        let is_in = |words: &[String]| has_any(words, known) && !has_any(words, BESIDE);
        is_in(&piece.catalog) || is_in(&piece.words)
    };
    let is_stool = is(STOOL) && is_seat(piece);
    let is_called = || ROLE_WORDS.iter().any(|(role, known)| is_entered(*role) && is(known));
    let is_enterable = role.map_or_else(is_called, is_entered) || is(ENTERABLE) || is(STOOL);
    PieceMeaning { role, is_enterable, is_stool }
}

/// True if people use a piece of this role from inside.
fn is_entered(role: Role) -> bool {
    matches!(role, Role::Bed | Role::Toilet | Role::Shower | Role::Sofa | Role::Armchair | Role::DiningSeat)
}

/// The role in some words, if the piece has the shape of it.
fn role(piece: &PlanPiece, words: &[String]) -> Option<Role> {
    let is_out = |role| has_any(words, if is_entered(role) { BESIDE } else { ABOVE });
    let said = ROLE_WORDS.iter().find(|(role, known)| has_any(words, known) && !is_out(*role));
    said.map(|(role, _)| *role).filter(|role| has_shape(piece, *role))
}

/// True for a piece of a plausible size: plans also contain beds of dolls, and fridges for the top of a counter.
fn has_shape(piece: &PlanPiece, role: Role) -> bool {
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

fn is_seat(piece: &PlanPiece) -> bool {
    piece.width_m.min(piece.depth_m) >= 0.28 && piece.elevation_m <= 0.4 && (0.25..=1.8).contains(&piece.height_m)
}
