//! One generated person, measured from the truth of their run and from what their sensors say.

use super::nights::nights;
use super::{Days, Lived, Nights, Sensing};
use homebody_timeline::Episode;
use serde::Serialize;

/// One person, measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Person {
    pub nights: Nights,
    pub days: Days,
    pub sensing: Sensing,
}

impl Person {
    /// Measures a person.
    pub fn of(lived: &Lived) -> Person {
        let done = lived.timeline.activities.iter().filter(|one| !one.time.is_empty());
        let activities: Vec<Episode> = done.cloned().collect();
        let moves = lived.moves();
        let nights = nights(lived, &activities, &moves);
        Person {
            nights: Nights::of(&nights, &activities),
            days: Days::of(lived, &activities, &moves),
            sensing: Sensing::of(lived),
        }
    }
}
