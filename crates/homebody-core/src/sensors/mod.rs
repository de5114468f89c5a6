//! The sensors: one file per kind, all in the same shape, and the timing they share.

pub mod ceiling_motion;
pub mod motion;
pub mod timers;
pub mod timing;
pub mod zones;

use crate::geometry::Point;
use crate::scenario::home::SensorFile;
use timing::Timing;

/// A sensor as a run uses it.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    pub name: String,
    pub timing: Timing,
    pub kind: Kind,
}

/// What a sensor sees with.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    Motion(motion::Motion),
    CeilingMotion(ceiling_motion::CeilingMotion),
}

impl Sensor {
    pub fn new(file: &SensorFile) -> Sensor {
        let kind = match file {
            SensorFile::Motion(file) => Kind::Motion(motion::Motion::new(file)),
            SensorFile::CeilingMotion(file) => Kind::CeilingMotion(ceiling_motion::CeilingMotion::new(file)),
        };
        Sensor { name: file.name().to_owned(), timing: Timing::new(file.timing()), kind }
    }

    /// Whether it has a fan of beams, rather than an area below it.
    pub fn is_on_wall(&self) -> bool {
        matches!(self.kind, Kind::Motion(_))
    }

    /// Where it hangs, seen from above.
    pub fn at(&self) -> Point {
        match &self.kind {
            Kind::Motion(motion) => motion.lens,
            Kind::CeilingMotion(area) => crate::geometry::inner_point(&area.outline),
        }
    }
}
