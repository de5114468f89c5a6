//! A schematic home of a place without a plan: from the names of a log's sensors, the activities during their firings,
//! and their order.
//!
//! Rooms become rectangles of a usual size that fill one large rectangle, arranged so that people can go between rooms
//! as the log shows. Doors are on the routes of people, things are placed by their names, and sensors over them. With
//! sensor positions measured on a picture, sensors keep these positions, and the rooms are divided between them.
//!
//! We assume a walking speed of about 0.8 m/s. Left out: windows, levels, and things without a sensor, except those
//! that a resident needs.

mod words;

mod interpretation;
mod shape;
mod arrangement;
mod measured_rooms;
mod pieces;
mod doors;
mod placement;
mod sensors;
mod home;

pub use home::{Schematic, SchematicError, schematic};

use homebody_core::geometry::Point;

/// The meaning of a sensor's firing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Speaks {
    #[default]
    Motion,
    Contact,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogSensor {
    pub id: String,
    pub speaks: Speaks,
    pub firings: u64,
    /// Its room in the user's table.
    pub room: Option<String>,
    /// The thing or place that it watches, in any words.
    pub place: Option<String>,
    /// Its measured position, in metres.
    pub at: Option<Point>,
    /// By label: its firings during that activity.
    pub done: Vec<(String, u64)>,
    /// The number of long silences before or after it.
    pub at_silence: u64,
    /// The first decile, the median and the last decile of the durations of ON, if the log has OFF.
    pub on_s: Option<[f64; 3]>,
}

impl LogSensor {
    pub fn new(id: &str, speaks: Speaks, firings: u64) -> LogSensor {
        LogSensor { id: id.into(), speaks, firings, ..LogSensor::default() }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogWay {
    /// Indices of sensors.
    pub between: [usize; 2],
    pub times: u64,
    /// Time between the two firings.
    pub soon_s: f64,
}

impl LogWay {
    /// The other end of the way, if this sensor is at one end.
    fn other(&self, sensor: usize) -> Option<usize> {
        match self.between {
            [a, b] if a == sensor => Some(b),
            [a, b] if b == sensor => Some(a),
            _ => None,
        }
    }
}
