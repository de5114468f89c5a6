//! Adds to a home that begins the furniture that a life lacks there.

use super::inhabited::{Begun, lived_in};
use crate::error::Error;
use homebody_core::geometry;
use homebody_core::home::plan::{Plan, furniture_outline};
use homebody_core::scenario::home::{FurnitureFile, HomeFile};
use homebody_core::scenario::load::Scenario;
use homebody_import::home_text;
use homebody_routine::furnished::additions;
use homebody_routine::household::RoutineLanguage;

/// The most rounds of additions: after one piece is replaced, another can be out of reach.
const ROUNDS: usize = 4;

/// Adds to the home of a scenario that begins what an ordinary life lacks there, as far as there is room; gives a sentence for
/// each piece.
///
/// # Errors
///
/// [`Error::Problems`]: what is wrong with the home itself.
pub fn furnish(begun: &mut Begun) -> Result<Vec<String>, Error> {
    let mut added = Vec::new();
    for _ in 0..ROUNDS {
        let pieces = additions(&lived_in(begun), "scenario.json")?;
        if pieces.is_empty() {
            break;
        }
        let scenario = Scenario::load_in(&mut RoutineLanguage::default(), &lived_in(begun), "scenario.json")?;
        let mut home = HomeFile::clone(&scenario.home);
        added.extend(pieces.iter().map(|piece| told(&home, scenario.home.plan(), piece)));
        home.furniture.extend(pieces);
        begun.home = home_text(&home);
    }
    Ok(added)
}

/// Names a piece that was added, and its room.
fn told(home: &HomeFile, plan: &Plan, piece: &FurnitureFile) -> String {
    let room = plan.room_at(geometry::inner_point(&furniture_outline(piece)));
    let room = room.map(|room| format!(" in {:?}", home.rooms[room].name)).unwrap_or_default();
    format!("added, which the plan does not have: {:?}{room}", piece.name)
}
