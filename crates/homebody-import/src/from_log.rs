//! A schematic home of a place that nobody has drawn: from the names of a log's sensors, from what was done as they spoke, and from
//! which of them follow each other.
//!
//! Rooms become rectangles of a usual size that fill one large rectangle, so arranged that those between which somebody went are
//! beside each other. Doors are where somebody went through, things where their names say, and sensors over them. Where somebody
//! has measured on a picture where the sensors are, they are there, and the rooms are parted between them.
//!
//! We assume that one who walks goes about 0.8 m a second. Left out: windows, levels, anything that no sensor tells of but what a
//! life needs.

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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Speaks {
    /// That something moves.
    Motion,
    /// That a door is opened or closed.
    Contact,
}

/// A sensor of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct LogSensor {
    /// Its id in the log.
    pub id: String,
    /// The meaning of its firing.
    pub speaks: Speaks,
    /// The number of its firings.
    pub firings: u64,
    /// Its room by the user's table.
    pub room: Option<String>,
    /// At what it is there, in any words.
    pub place: Option<String>,
    /// Its measured position, in metres.
    pub at: Option<Point>,
    /// By label, how often it spoke while that was done.
    pub done: Vec<(String, u64)>,
    /// The number of long silences that it began or ended.
    pub at_silence: u64,
    /// The first decile, the median and the last decile of how long its ONs last, where that is told.
    pub on_s: Option<[f64; 3]>,
}

impl LogSensor {
    /// A sensor of which no more is known.
    pub fn new(id: &str, speaks: Speaks, firings: u64) -> LogSensor {
        LogSensor {
            id: id.into(),
            speaks,
            firings,
            room: None,
            place: None,
            at: None,
            done: Vec::new(),
            at_silence: 0,
            on_s: None,
        }
    }
}

/// A way between two sensors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogWay {
    /// Their numbers.
    pub between: [usize; 2],
    /// The number of times that a person took it.
    pub times: u64,
    /// The time from the one firing to the other.
    pub soon_s: f64,
}

impl LogWay {
    /// The other end of the way, if this sensor is at one.
    fn other(&self, sensor: usize) -> Option<usize> {
        match self.between {
            [a, b] if a == sensor => Some(b),
            [a, b] if b == sensor => Some(a),
            _ => None,
        }
    }
}
