//! What stays the same for a resident who lives by a script.

use homebody_core::home::Home;
use homebody_core::random::Stream;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_walk::places::Places;
use homebody_walk::{Gains, Mesh};
use std::sync::Arc;

const HOUR: Micros = 3_600 * SECOND;

/// All that stays the same for a resident who lives by a script.
#[derive(Debug)]
pub struct Cast {
    /// The home.
    pub home: Arc<Home>,
    /// Its places, as the resident uses them.
    pub places: Arc<Places>,
    /// What the body walks by.
    pub mesh: Arc<Mesh>,
    /// Which time of day an instant is.
    pub calendar: Calendar,
    /// The names of all who have a body, by their ids.
    pub names: Vec<String>,
    /// The resident's name.
    pub name: String,
    /// How fast the resident usually walks.
    pub pace_mps: f64,
    /// How the resident wanders.
    pub gains: Gains,
    /// The run's.
    pub seed: u64,
}

impl Cast {
    /// The time of day, from 0 to 24.
    pub fn hour(&self, now: Micros) -> f64 {
        let midnight = self.calendar.instant(self.calendar.day(now), 0);
        ((now - midnight) as f64 / HOUR as f64).clamp(0.0, DAY as f64 / HOUR as f64)
    }

    /// A stream of the resident's script.
    pub(crate) fn stream(&self, name: &str) -> Stream {
        Stream::named(self.seed, &format!("script/{}/{name}", self.name))
    }
}
