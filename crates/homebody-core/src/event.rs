//! What comes out of the world: firings, and apart from them the truth.

use crate::geometry::Point;
use crate::scenario::path::Posture;
use crate::time::Micros;

/// One message of a sensor as it leaves the device. Never holds ground truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Firing {
    /// The run's firings are numbered from 0, in order of time and, at one instant, of sensors.
    pub seq: u64,
    pub at: Micros,
    /// Index into the home's sensors.
    pub sensor: u32,
}

/// One piece of ground truth.
#[derive(Clone, Debug, PartialEq)]
pub enum Fact {
    /// Why a firing came: whose movement the sensor saw, and when it saw it.
    Cause { seq: u64, resident: u32, seen_at: Micros },
    /// What a resident's body does over a span; the spans of a resident follow each other without gaps.
    Movement { resident: u32, begin: Micros, end: Micros, doing: Doing, posture: Posture },
    /// From `at` on, the resident is in this room (index into the plan's rooms), or in none: between
    /// rooms or away.
    Room { resident: u32, at: Micros, room: Option<u32> },
    /// From `at` on, the resident does this; nothing ends what was done before.
    Activity { resident: u32, at: Micros, name: Option<String> },
}

/// What a body does over a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doing {
    /// A straight movement at constant speed.
    Stride { from: Point, to: Point },
    /// Movement on the spot: `amplitude_m` is how far what moves moves.
    Stir { at: Point, amplitude_m: f64 },
    /// Keeping still.
    Rest { at: Point },
    /// Out of the home.
    Away,
}

/// What an advance of a run has brought: firings in order of time, facts in the order in which they came to be known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Events {
    pub firings: Vec<Firing>,
    pub facts: Vec<Fact>,
}

impl Events {
    pub fn clear(&mut self) {
        self.firings.clear();
        self.facts.clear();
    }
}
