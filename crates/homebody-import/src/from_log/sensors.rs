//! The sensors of a schematic home: narrow ones over things and spots, wide ones over rooms, contacts on doors and things.

use super::doors::DoorGap;
use super::interpretation::{LogRoom, SensorAim};
use super::pieces::NeededPiece;
use super::placement::Placement;
use super::shape::{Rect, rounded};
use super::{LogSensor, Speaks};
use crate::names::NamePool;
use homebody_core::geometry::Point;
use homebody_core::sensors::ceiling_motion::CeilingMotionFile;
use homebody_core::sensors::contact::ContactFile;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::sensors::notice::{ChanceFile, Notice};
use homebody_core::sensors::preset::{MotionSettings, Preset};

/// Side of the floor that a narrow sensor sees (our choice): the thing below it, and a person before the thing.
const NARROW_M: f64 = 1.2;
/// Distance from the walls of its room at which the field of a wide sensor ends (our choice).
const AT_WALL_M: f64 = 0.1;
/// Side of the field of a wide sensor that sees a part of its room (our choice).
const WIDE_M: f64 = 2.6;
/// Angle of a movement that a wide sensor always notices, slightly less than for a narrow one (our choice): it explains
/// most firings of two real homes.
const WIDE_SURE_DEG: f64 = 25.0;
/// Largest deviation of nine in ten ONs from the most frequent duration, in parts of it, for a unit with a fixed ON
/// (our choice).
const ALIKE: f64 = 0.25;
/// Duration of ON below which a unit follows the movement (our choice).
const SHORTEST_PULSE_S: f64 = 2.0;

/// The make of all sensors of a log, and the time for which the logger holds an ON.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Make {
    pub preset: Preset,
    /// `None` if the log has no OFF.
    pub hold_s: Option<f64>,
}

/// The make of most motion sensors of a log, by the length of their ONs.
pub fn make(sensors: &[LogSensor]) -> Make {
    let of: Vec<[f64; 3]> =
        sensors.iter().filter(|sensor| sensor.speaks == Speaks::Motion).filter_map(|sensor| sensor.on_s).collect();
    let is_pulse = |[first, middle, last]: &&[f64; 3]| {
        *middle >= SHORTEST_PULSE_S && first.min(*last) >= middle * (1.0 - ALIKE) && *last <= middle * (1.0 + ALIKE)
    };
    let pulses = of.iter().filter(is_pulse).count() * 2 > of.len();
    let mut holds: Vec<f64> = of.iter().map(|[first, middle, _]| if pulses { *middle } else { *first }).collect();
    holds.sort_by(f64::total_cmp);
    Make {
        preset: match holds.is_empty() {
            true => Preset::Paper,
            false if pulses => Preset::CasasPulse,
            false => Preset::CasasFollow,
        },
        hold_s: holds.get(holds.len() / 2).map(|hold| (hold * 100.0).round() / 100.0),
    }
}

pub struct Furnished<'a> {
    pub rooms: &'a [LogRoom],
    pub rects: &'a [Rect],
    pub doors: &'a [(String, DoorGap)],
    pub pieces: &'a [NeededPiece],
    /// By piece; `None` without a place.
    pub piece_names: &'a [Option<String>],
    pub places: &'a Placement,
}

/// The sensors with their ids in the log; those without a place are reported.
pub fn place_sensors(
    sensors: &[LogSensor],
    what: &[(usize, SensorAim)],
    home: &Furnished,
    make: Make,
) -> (Vec<(SensorFile, String)>, Vec<String>) {
    let mut names = NamePool::default();
    let (mut hung, mut left) = (Vec::new(), Vec::new());
    for (number, sensor) in sensors.iter().enumerate() {
        let (room, what) = what[number];
        let kind = if sensor.speaks == Speaks::Contact { " contact" } else { "" };
        let room_name = &home.rooms[room].name;
        let wanted = match what {
            SensorAim::Area => format!("{room_name} area"),
            SensorAim::Thing(thing) => format!("{room_name} {}{kind}", thing.name),
            SensorAim::Door => format!("{room_name} door{kind}"),
            SensorAim::FrontDoor if sensor.speaks == Speaks::Contact => "front door contact".to_owned(),
            SensorAim::FrontDoor => "front door motion".to_owned(),
            SensorAim::Spot | SensorAim::Wide => format!("{room_name} motion"),
        };
        let file = match sensor.speaks {
            Speaks::Contact => {
                on(number, room, what, home).map(|on| SensorFile::Contact(ContactFile { name: String::new(), on }))
            }
            Speaks::Motion => {
                let floor = floor(number, room, what, home);
                floor.map(|floor| {
                    SensorFile::CeilingMotion(ceiling(
                        &floor,
                        matches!(what, SensorAim::Area | SensorAim::Wide),
                        make.preset,
                    ))
                })
            }
        };
        match file {
            Some(mut file) => {
                *file.name_mut() = names.give(&wanted, "sensor");
                hung.push((file, sensor.id.clone()));
            }
            None => left.push(sensor.id.clone()),
        }
    }
    (hung, left)
}

fn floor(sensor: usize, room: usize, what: SensorAim, home: &Furnished) -> Option<Rect> {
    if what == SensorAim::Area {
        return Some(home.rects[room].inset(AT_WALL_M));
    }
    let at = home.places.sensors[sensor]?;
    // The position of a measured sensor may be on the other side of a wall that was guessed.
    let own = home.rects[room].has(at).then_some(room);
    let room = own.or_else(|| home.rects.iter().position(|rect| rect.has(at)))?;
    let size = if what == SensorAim::Wide { WIDE_M } else { NARROW_M };
    Some(Rect::around(at, Point::splat(size)).clipped(&home.rects[room].inset(AT_WALL_M)))
}

fn ceiling(floor: &Rect, is_wide: bool, preset: Preset) -> CeilingMotionFile {
    // A log does not show misses, so these sensors miss nothing.
    let chance = ChanceFile { sure_deg: is_wide.then_some(WIDE_SURE_DEG), missed: 0.0, ..ChanceFile::default() };
    CeilingMotionFile {
        name: String::new(),
        area: floor.corners().into_iter().map(rounded).collect(),
        settings: MotionSettings {
            preset,
            notice: (preset != Preset::Paper).then_some(Notice::Chance(chance)),
            ..MotionSettings::default()
        },
    }
}

/// The door or thing of a contact.
fn on(sensor: usize, room: usize, what: SensorAim, home: &Furnished) -> Option<String> {
    let door =
        |fits: &dyn Fn(&DoorGap) -> bool| home.doors.iter().find(|(_, door)| fits(door)).map(|(name, _)| name.clone());
    match what {
        SensorAim::Thing(_) => {
            let piece = home.pieces.iter().position(|piece| piece.sensors.contains(&sensor))?;
            home.piece_names[piece].clone()
        }
        SensorAim::FrontDoor => door(&|door| door.rooms[1].is_none()),
        SensorAim::Door => {
            let at = home.places.sensors[sensor]?;
            let near = home.doors.iter().filter(|(_, door)| door.other(room).is_some());
            near.min_by(|a, b| a.1.middle().distance(at).total_cmp(&b.1.middle().distance(at)))
                .map(|(name, _)| name.clone())
        }
        SensorAim::Area | SensorAim::Wide | SensorAim::Spot => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_of_on_decide_the_make() {
        let make_of = |on_s: Option<[f64; 3]>| make(&[LogSensor { on_s, ..LogSensor::new("M1", Speaks::Motion, 9) }]);
        assert_eq!(make_of(Some([3.9, 4.0, 4.3])), Make { preset: Preset::CasasPulse, hold_s: Some(4.0) });
        assert_eq!(make_of(Some([1.1, 1.8, 4.3])), Make { preset: Preset::CasasFollow, hold_s: Some(1.1) });
        assert_eq!(make_of(None), Make { preset: Preset::Paper, hold_s: None });
    }
}
