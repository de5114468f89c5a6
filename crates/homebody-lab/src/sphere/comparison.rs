//! The comparison of real and simulated sensors: figures by room, and their agreement.

use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    pub recordings: usize,
    pub annotated_s: f64,
    /// The share of seconds with the same room by two annotators, over the recordings that have two, of the seconds on which both
    /// named a room.
    pub annotator_agreement: Option<f64>,
    pub rooms: Vec<RoomComparison>,
    pub overall: RoomComparison,
    pub findings: Vec<Finding>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomComparison {
    pub room: String,
    pub visits: usize,
    pub in_room_s: f64,
    pub real: SensorFigures,
    pub simulated: SensorFigures,
    /// Cohen's kappa between the two, second by second; `None` if both are constant.
    pub kappa: Option<f64>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SensorFigures {
    pub intervals: usize,
    pub on_s: f64,
    pub visits_seen: usize,
    /// Median from entry to the first ON, of visits with an ON.
    pub latency_s: Option<f64>,
    /// Share of ON time in which the person was in the room.
    pub precision: Option<f64>,
    /// Share of the person's time in the room with the sensor ON.
    pub recall: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    pub agrees: bool,
    pub what: String,
}
