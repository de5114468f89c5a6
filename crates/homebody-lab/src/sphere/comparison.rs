//! What a comparison of real and simulated sensors says: figures by room, and what of them agrees.

use serde::Serialize;

/// How the real sensors and the simulated ones compare.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    pub recordings: usize,
    /// How much annotated time was compared.
    pub annotated_s: f64,
    /// Of the seconds on which two annotators named a room, over the recordings that have two, the share on which it was
    /// the same.
    pub annotator_agreement: Option<f64>,
    /// One for each sensor.
    pub rooms: Vec<RoomComparison>,
    /// All rooms together.
    pub overall: RoomComparison,
    /// The same in words.
    pub findings: Vec<Finding>,
}

/// The sensor of one room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomComparison {
    pub room: String,
    /// How often and how long the person was there.
    pub visits: usize,
    pub in_room_s: f64,
    pub real: Figures,
    pub simulated: Figures,
    /// Cohen's kappa between the two, second by second; nothing where both are always the same.
    pub kappa: Option<f64>,
}

/// What one sensor did.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Figures {
    pub intervals: usize,
    pub on_s: f64,
    /// Visits in which it was ON at some time.
    pub visits_seen: usize,
    /// Median from entry to the first ON, of the visits it saw.
    pub latency_s: Option<f64>,
    /// Share of ON time in which the person was in the room.
    pub precision: Option<f64>,
    /// Share of the person's time in the room in which it was ON.
    pub recall: Option<f64>,
}

/// One thing that agrees or does not.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    pub agrees: bool,
    pub what: String,
}
