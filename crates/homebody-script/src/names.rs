//! What a script may name: the functions that it is asked by, and what its home has.

use homebody_core::home::plan::Plan;
use homebody_core::scenario::home::HomeFile;

/// Asked what comes next, whenever the body is free.
pub const NEXT: &str = "next";
/// Asked whether something is to be done at once, whenever something around has changed.
pub const NOTICE: &str = "notice";
/// Asked what is to be remembered, as a run begins.
pub const BEGIN: &str = "begin";

/// The functions that a script is asked by, each with how many values it is handed.
pub const ASKED: [(&str, usize); 3] = [(NEXT, 1), (NOTICE, 1), (BEGIN, 0)];

/// What may be named in a home.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Places, pieces of furniture and rooms.
    pub places: Vec<String>,
    /// Furniture that people get on or into.
    pub seats: Vec<String>,
    /// Doors, furniture and rooms.
    pub things: Vec<String>,
    /// Rooms.
    pub rooms: Vec<String>,
}

impl Names {
    /// The names of a home for a resident, to whom what is called after them has a shorter name too.
    pub fn of(home: &HomeFile, plan: &Plan, resident: Option<&str>) -> Names {
        let whose = resident.map(|name| format!("{}'s ", name.to_lowercase()));
        let with_own = |names: Vec<String>| -> Vec<String> {
            let own = |name: &String| Some(name.to_lowercase().strip_prefix(whose.as_ref()?)?.to_owned());
            let own: Vec<String> = names.iter().filter_map(own).collect();
            names.into_iter().chain(own).collect()
        };
        let furniture = home.furniture.iter().map(|piece| piece.name.clone());
        let seats = home.furniture.iter().filter(|piece| piece.enterable).map(|piece| piece.name.clone());
        let rooms: Vec<String> = plan.rooms.iter().map(|room| room.name.clone()).collect();
        Names {
            places: with_own(plan.places.iter().map(|(name, _)| name.clone()).chain(furniture).collect()),
            seats: with_own(seats.collect()),
            things: plan.things.iter().map(|thing| thing.name.clone()).collect(),
            rooms,
        }
    }
}
