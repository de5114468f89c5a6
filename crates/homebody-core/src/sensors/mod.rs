//! The sensors: one file per kind, all in the same shape, and the timing they share.

pub mod ceiling_motion;
pub mod contact;
pub mod device;
pub mod motion;
pub mod timing;
pub mod zones;

use crate::geometry::{self, Point};
use crate::home::plan::Plan;
use crate::scenario::home::SensorFile;
use device::Device;
use timing::Timing;

/// A sensor as a run uses it.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    pub name: String,
    /// Of sensors that look for movement.
    pub timing: Timing,
    pub kind: Kind,
    /// Where it is, seen from above.
    pub at: Point,
}

/// What a sensor works with: two kinds look for movement, the others are told what happens.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    Motion(motion::Motion),
    CeilingMotion(ceiling_motion::CeilingMotion),
    /// As it is when a run begins.
    Device(Device),
}

impl Sensor {
    /// The sensor that a file that has passed its checks describes.
    pub fn new(file: &SensorFile, plan: &Plan) -> Sensor {
        let (kind, at) = match file {
            SensorFile::Motion(file) => {
                let motion = motion::Motion::new(file);
                let lens = motion.lens;
                (Kind::Motion(motion), lens)
            }
            SensorFile::CeilingMotion(file) => {
                let area = ceiling_motion::CeilingMotion::new(file);
                let middle = geometry::inner_point(&area.outline);
                (Kind::CeilingMotion(area), middle)
            }
            SensorFile::Contact(file) => {
                let thing = plan.thing(&file.on);
                let (open, at) =
                    thing.map_or((false, Point::ZERO), |thing| (plan.things[thing].on, plan.things[thing].at));
                (Kind::Device(Device::Contact(contact::Contact::new(thing.unwrap_or(0) as u32, open))), at)
            }
        };
        Sensor { name: file.name().to_owned(), timing: Timing::new(file.timing()), kind, at }
    }

    /// Whether it has a fan of beams, rather than an area below it.
    pub fn is_on_wall(&self) -> bool {
        matches!(self.kind, Kind::Motion(_))
    }

    /// Whether it looks for movement, rather than being told what happens.
    pub fn looks(&self) -> bool {
        !matches!(self.kind, Kind::Device(_))
    }
}
