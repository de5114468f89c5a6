//! The model of a sensor that looks for movement.
//!
//! Each such kind implements it in its own file.
//!
//! We assume that a lens sees along straight beams, or everything over an area.
//!
//! The home asks for the beams once for each height of bodies; the world asks for the rest while it runs.
//!
//! Left out: the time of messages, which the timing decides, and the chance that a movement is noticed.

use super::notice::View;
use crate::geometry::Point;
use crate::plan::Plan;
use crate::stride::Beam;
use crate::time::Span;

/// A sensor that looks for movement.
pub trait LookingModel {
    /// The position of its lens, seen from above.
    fn lens(&self) -> Point;

    /// Its beams on bodies of this height, cut by walls, doors and furniture, in the order of the beams of the sensor.
    fn beams(&self, plan: &Plan, body_m: f64) -> Vec<Beam>;

    /// A body at this point as its lens sees it.
    fn view(&self, at: Point) -> View;

    /// The changes that count as movement.
    fn level(&self) -> DetectionLevel {
        DetectionLevel::Paper
    }

    /// The outline of the area below it, counter-clockwise.
    fn area_below(&self) -> Option<&[Point]> {
        None
    }
}

/// The changes that count as movement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DetectionLevel {
    /// Any change in a beam is a movement.
    Paper,
    /// A movement is seen up to `reach_per_m` metres away for each metre that it spans in a second.
    Sensitivity {
        /// The greatest distance, in metres, of a visible movement of a metre in a second.
        reach_per_m: f64,
    },
    /// `pulses` of alternating sign within `window` make a detection.
    Zones {
        /// The number of pulses of a detection.
        pulses: u32,
        /// The longest time that they take.
        window: Span,
        /// The angle between two neighbouring zones of the uppermost row, in radians: movement on the spot is seen if
        /// it spans as much.
        pitch_rad: f64,
    },
}
