//! The state of a run at an instant, for those who watch it. It does not affect the run.

use crate::geometry::Point;
use crate::ids::{RoomId, ThingId};
use crate::posture::Posture;
use crate::sensor_set::SensorSet;
use crate::time::RunTime;

/// A run at the instant that it has come to.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The instant.
    pub now: RunTime,
    /// By resident; nothing for those who are out.
    pub bodies: Vec<Option<Presence>>,
    /// The sensors that see a movement; also those of places that a sensor is moved to during the run.
    pub seeing: SensorSet,
    /// The things that are on, or open.
    pub on: Vec<ThingId>,
    /// The cameras that are awake.
    pub awake: SensorSet,
}

/// A body in the home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Presence {
    /// The middle, in metres.
    pub at: Point,
    /// The direction of its last stride, of length one; the x axis before the first.
    pub heading: Point,
    /// The posture.
    pub posture: Posture,
    /// The room that it is in; `None` between rooms.
    pub room: Option<RoomId>,
}
