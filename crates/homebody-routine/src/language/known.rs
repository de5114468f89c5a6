//! What a text may name.

use super::lexicon::Lexicon;
use crate::routine::Activity;

/// What a text may name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// The resident's name, where there is one.
    pub person: Option<String>,
    /// Places where something can be done, seats and beds among them.
    pub places: Vec<String>,
    /// Doors, furniture, lamps: what can be on, or open.
    pub things: Vec<String>,
    pub rooms: Vec<String>,
    /// Names of conditions, as their files are called.
    pub conditions: Vec<String>,
    /// Year, month and day of the run's first day, which ties dates to days.
    pub first_date: Option<(i16, u8, u8)>,
    /// The words that are known: those of the program, and a scenario's own.
    pub lexicon: Lexicon,
    /// What is done without being said.
    pub usual: Vec<Activity>,
}
