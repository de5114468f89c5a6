//! The sensors: one file per kind, all in the same shape, and the timing they share.

pub mod bed;
pub mod ceiling_motion;
pub mod contact;
pub mod device;
pub mod flow;
pub mod light;
pub mod motion;
pub mod outbox;
pub mod power;
pub mod pressure;
pub mod rounds;
pub mod stove_temperature;
pub mod temperature;
pub mod timing;
pub mod zones;

use crate::geometry::{self, Point};
use crate::home::plan::Plan;
use crate::ids::ThingId;
use crate::scenario::home::SensorFile;
use bed::Bed;
use ceiling_motion::CeilingMotion;
use contact::Contact;
use device::Device;
use flow::Flow;
use light::Light;
use motion::Motion;
use power::Power;
use pressure::Pressure;
use stove_temperature::StoveTemperature;
use temperature::Temperature;
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
    Motion(Motion),
    CeilingMotion(CeilingMotion),
    /// As it is when a run begins.
    Device(Box<Device>),
}

impl Sensor {
    /// The sensor that a file describes; nothing where the plan does not have what it is on, or the room that it is in.
    pub fn new(file: &SensorFile, plan: &Plan) -> Option<Sensor> {
        let site = Site::of(file, plan)?;
        let device = |device| (Kind::Device(Box::new(device)), site.at);
        let (kind, at) = match file {
            SensorFile::Motion(file) => {
                let motion = Motion::new(file);
                let lens = motion.lens;
                (Kind::Motion(motion), lens)
            }
            SensorFile::CeilingMotion(file) => {
                let area = CeilingMotion::new(file);
                let middle = geometry::inner_point(&area.outline);
                (Kind::CeilingMotion(area), middle)
            }
            SensorFile::Contact(_) => device(Device::Contact(Contact::new(site.thing, site.is_open))),
            SensorFile::Bed(file) => device(Device::Bed(Bed::new(file, site.outline))),
            SensorFile::StoveTemperature(file) => {
                device(Device::StoveTemperature(StoveTemperature::new(file, site.thing)))
            }
            SensorFile::Pressure(file) => match &file.area {
                Some(area) => {
                    let area: Vec<Point> = area.iter().map(|&at| geometry::point(at)).collect();
                    let middle = geometry::inner_point(&area);
                    (Kind::Device(Box::new(Device::Pressure(Pressure::new(file, area, true)))), middle)
                }
                None => {
                    let is_mat = site.height_m <= pressure::MAT_HEIGHT_M;
                    device(Device::Pressure(Pressure::new(file, site.outline, is_mat)))
                }
            },
            SensorFile::Power(file) => device(Device::Power(Power::new(file, site.thing))),
            SensorFile::Flow(file) => device(Device::Flow(Flow::new(file, site.thing))),
            SensorFile::Light(file) => device(Device::Light(Light::new(file, site.thing))),
            SensorFile::Temperature(file) => device(Device::Temperature(Temperature::new(file))),
        };
        Some(Sensor { name: file.name().to_owned(), timing: Timing::new(file.timing()), kind, at })
    }

    /// Whether it has a fan of beams, rather than an area below it.
    pub fn is_on_wall(&self) -> bool {
        matches!(self.kind, Kind::Motion(_))
    }

    /// Whether it looks for movement, rather than being told what happens.
    pub fn senses_motion(&self) -> bool {
        !matches!(self.kind, Kind::Device(_))
    }
}

/// What a sensor is on: a thing, or the lamp of the room that it is in.
struct Site {
    thing: ThingId,
    is_open: bool,
    at: Point,
    outline: Vec<Point>,
    height_m: f64,
}

impl Site {
    /// Nothing where the plan does not have it. A sensor that is on nothing asks for none of this.
    fn of(file: &SensorFile, plan: &Plan) -> Option<Site> {
        let thing = match (file.on(), file.room()) {
            (Some(on), _) => Some(plan.thing(on)?),
            (None, Some(room)) => Some(plan.lamp(room)?),
            (None, None) => None,
        };
        let found = thing.map(|thing| &plan.things[thing]);
        let piece = file.on().and_then(|on| plan.piece(on));
        Some(Site {
            thing: ThingId::of(thing.unwrap_or(plan.things.len())),
            is_open: found.is_some_and(|thing| thing.on),
            at: found.map_or(Point::ZERO, |thing| thing.at),
            outline: piece.map(|piece| piece.outline.clone()).unwrap_or_default(),
            height_m: piece.map_or(f64::INFINITY, |piece| piece.height_m),
        })
    }
}
