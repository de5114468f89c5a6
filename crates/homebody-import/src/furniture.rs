//! Furniture: rectangles on the floor of rooms, from the floor to their height.

use crate::drawing::PlanPiece;
use crate::error::ImportError;
use crate::kinds;
use crate::meaning::{self, PieceMeaning};
use crate::names::NamePool;
use crate::outline::{NamedRoom, rectangle};
use homebody_core::geometry::{self, Point};
use homebody_core::home::form::REACH_OUT_M;
use homebody_core::problem::counted;
use homebody_core::role::Role;

#[derive(Clone, Debug)]
pub struct Furniture {
    pub name: String,
    pub at: Point,
    pub size_m: [f64; 2],
    pub turn_deg: f64,
    pub height_m: f64,
    pub is_enterable: bool,
    /// Its role, unless its name says so.
    pub role: Option<Role>,
}

/// Largest number of pieces of furniture of a home.
const MOST_PIECES: usize = 1_000;

/// The range of widths and depths of a home.
const SIZE_M: [f64; 2] = [0.001, 1_000.0];
/// Greatest height of a piece.
const MOST_HEIGHT_M: f64 = 10.0;

pub fn place(
    pieces: Vec<PlanPiece>,
    rooms: &[NamedRoom],
    names: &mut NamePool,
    remarks: &mut Vec<String>,
) -> Result<Vec<Furniture>, ImportError> {
    let (visible, hidden): (Vec<PlanPiece>, Vec<PlanPiece>) = pieces.into_iter().partition(|piece| piece.is_visible);
    let (overhead, standing): (Vec<PlanPiece>, Vec<PlanPiece>) = visible.into_iter().partition(kinds::is_overhead);
    let (inside, outside): (Vec<PlanPiece>, Vec<PlanPiece>) =
        standing.into_iter().partition(|piece| is_in(piece, rooms));
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
        return Err(ImportError::TooMany { what: "pieces of furniture", count: inside.len(), most: MOST_PIECES, hint });
    }
    let meanings: Vec<PieceMeaning> = inside.iter().map(meaning::piece_meaning).collect();
    let is_chair = |meaning: &PieceMeaning| meaning.role == Some(Role::DiningSeat);
    let has_chair = meanings.iter().any(is_chair);
    let meant = |meaning: PieceMeaning| match meaning {
        PieceMeaning { is_stool: true, role: None, .. } if !has_chair => {
            PieceMeaning { role: Some(Role::DiningSeat), ..meaning }
        }
        meaning => meaning,
    };
    Ok(inside.iter().zip(meanings).map(|(piece, meaning)| furniture(piece, meant(meaning), names)).collect())
}

fn furniture(piece: &PlanPiece, meaning: PieceMeaning, names: &mut NamePool) -> Furniture {
    let millimetres = |length: f64| (length * 1e3).round() / 1e3;
    let name = names.give(&piece.name, "piece");
    let is_said = |role: &Role| Role::from_name(&name.to_lowercase()).any(|said| said == *role);
    Furniture {
        role: meaning.role.filter(|role| !is_said(role)),
        name,
        at: piece.at,
        size_m: [piece.width_m, piece.depth_m].map(|size| millimetres(size).clamp(SIZE_M[0], SIZE_M[1])),
        turn_deg: normalised_turn(piece.turn_rad.to_degrees()),
        height_m: millimetres(piece.elevation_m + piece.height_m).clamp(0.0, MOST_HEIGHT_M),
        is_enterable: meaning.is_enterable,
    }
}

/// A turn in the range of homes: up to half a circle either way, in thousandths of a degree.
pub fn normalised_turn(turn_deg: f64) -> f64 {
    let turn = turn_deg.rem_euclid(360.0);
    ((if turn > 180.0 { turn - 360.0 } else { turn }) * 1e3).round() / 1e3 + 0.0
}

impl Furniture {
    pub fn outline(&self) -> [Point; 4] {
        rectangle(self.at, self.size_m, self.turn_deg)
    }

    pub fn is_for(&self, role: Role) -> bool {
        self.role.map_or_else(|| role.is_called(&self.name.to_lowercase()), |said| said == role)
    }
}

/// True for a piece in a room that overlaps nothing but walls.
fn is_in(piece: &PlanPiece, rooms: &[NamedRoom]) -> bool {
    let near = |p: Point| rooms.iter().any(|room| geometry::distance_to_area(&room.outline, p) < REACH_OUT_M);
    rooms.iter().any(|room| geometry::contains(&room.outline, piece.at)) && piece.outline().into_iter().all(near)
}
