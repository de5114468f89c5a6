//! The names that a script may use: the functions that Homebody calls, and those of the home.

use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;

/// Called whenever the body is free.
pub const NEXT: &str = "next";
/// Called whenever something around has changed.
pub const NOTICE: &str = "notice";
/// Called at the start of a run.
pub const BEGIN: &str = "begin";

/// With their numbers of parameters.
pub const ASKED: [(&str, usize); 3] = [(NEXT, 1), (NOTICE, 1), (BEGIN, 0)];

#[derive(Clone, Debug, Default)]
pub struct ScriptNames {
    pub places: Vec<String>,
    /// Furniture to get on or into.
    pub seats: Vec<String>,
    /// Doors, furniture and rooms.
    pub things: Vec<String>,
    pub rooms: Vec<String>,
}

impl ScriptNames {
    /// Things named after the resident have a shorter name, too.
    pub fn new(home: &HomeFile, plan: &Plan, resident: Option<&str>) -> ScriptNames {
        let whose = resident.map(|name| format!("{}'s ", name.to_lowercase()));
        let with_own = |names: Vec<String>| -> Vec<String> {
            let own = |name: &String| Some(name.to_lowercase().strip_prefix(whose.as_ref()?)?.to_owned());
            let own: Vec<String> = names.iter().filter_map(own).collect();
            names.into_iter().chain(own).collect()
        };
        let furniture = home.furniture.iter().map(|piece| piece.name.clone());
        let seats = home.furniture.iter().filter(|piece| piece.enterable).map(|piece| piece.name.clone());
        let rooms: Vec<String> = plan.rooms.iter().map(|room| room.name.clone()).collect();
        ScriptNames {
            places: with_own(plan.places.iter().map(|(name, _)| name.clone()).chain(furniture).collect()),
            seats: with_own(seats.collect()),
            things: plan.things.iter().map(|thing| thing.name.clone()).collect(),
            rooms,
        }
    }
}
