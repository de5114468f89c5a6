//! The names that a text may use.

use super::lexicon::Lexicon;
use crate::routine::Activity;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct KnownNames {
    pub person: Option<String>,
    pub places: Vec<String>,
    pub things: Vec<String>,
    pub rooms: Vec<String>,
    pub floors: Vec<String>,
    pub conditions: Vec<String>,
    pub first_date: Option<(i16, u8, u8)>,
    pub lexicon: Lexicon,
    pub usual: Vec<Activity>,
}
