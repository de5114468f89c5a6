//! Furniture for the home of a new scenario.

use crate::error::ScaffoldError;
use crate::residents::{NewScenario, inhabited_texts};
use homebody_core::geometry;
use homebody_core::home::form::HomeFile;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::plan::{Plan, furniture_outline};
use homebody_core::scenario::load::Scenario;
use homebody_import::home_text;
use homebody_routine::furniture::additions;
use homebody_routine::household::RoutineLanguage;

/// Largest number of rounds of additions: a new piece may block another.
const ROUNDS: usize = 4;

/// Adds the furniture of an ordinary routine to the home of a new scenario, as far as there is room. Returns a sentence
/// for each piece.
pub fn furnish(new: &mut NewScenario) -> Result<Vec<String>, ScaffoldError> {
    let mut added = Vec::new();
    for _ in 0..ROUNDS {
        let pieces = additions(&inhabited_texts(new), "scenario.json")?;
        if pieces.is_empty() {
            break;
        }
        let scenario = Scenario::load_in(&mut RoutineLanguage::default(), &inhabited_texts(new), "scenario.json")?;
        let mut home = HomeFile::clone(&scenario.home);
        added.extend(pieces.iter().map(|piece| sentence(&home, scenario.home.plan(), piece)));
        home.furniture.extend(pieces);
        new.home = home_text(&home);
    }
    Ok(added)
}

fn sentence(home: &HomeFile, plan: &Plan, piece: &FurnitureFile) -> String {
    let room = plan.room_at(geometry::inner_point(&furniture_outline(piece)));
    let room = room.map(|room| format!(" in {:?}", home.rooms[room].name)).unwrap_or_default();
    format!("added, which the plan does not have: {:?}{room}", piece.name)
}
