//! The messages of passive sensors about a person who may have fallen: movement and its place, an occupied bed or seat, and use of the door
//! to the outside.
//!
//! We assume that a motion sensor whose area holds a bed or a seat sees the person in it, and that all others see a person who is not.
//!
//! Left out: appliances, water and temperatures.

use homebody_core::event::Value;
use homebody_core::geometry::{Point, depth_in_area, point};
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::plan::Plan;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::role::Role;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::time::RunTime;

/// Places of rest. The sensor that sees a toilet sees a person who lies next to it, too, so a toilet is not among them.
const RESTING: [Role; 5] = [Role::Bed, Role::Armchair, Role::Sofa, Role::DiningSeat, Role::GuestSeat];

/// Height below which a piece is not a seat, in metres (our choice): rugs, shower trays.
const LOWEST_SEAT_M: f64 = 0.2;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PassiveMeaning {
    Moved {
        at_rest: bool,
    },
    /// A pad or a bed's sensor becomes occupied.
    Rests,
    /// A pad or a bed's sensor becomes free.
    Rises,
    Door,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ear {
    Motion {
        at_rest: bool,
    },
    Seat,
    Door,
    /// A thing opens or closes, or a person steps on it.
    Use,
    Deaf,
}

impl Ear {
    /// The meanings of each sensor of a home, in the order of its file.
    pub fn all_of_home(home: &ResolvedHome) -> Vec<Ear> {
        let seat = |piece: &&FurnitureFile| piece.enterable && piece.height_m >= LOWEST_SEAT_M && is_for_rest(piece);
        let seats: Vec<&FurnitureFile> = home.furniture.iter().filter(seat).collect();
        let is_seat = |name: &str| seats.iter().any(|piece| piece.name == name);
        let ear = |sensor: &SensorFile| match sensor {
            file if file.senses_motion() => {
                let area: Option<Vec<Point>> = file.area_below().map(|area| area.iter().map(|&at| point(at)).collect());
                let holds = |middle: Point| area.as_ref().is_some_and(|area| depth_in_area(area, middle) >= 0.0);
                Ear::Motion { at_rest: seats.iter().any(|piece| middle(home.plan(), piece).is_some_and(holds)) }
            }
            SensorFile::Bed(_) => Ear::Seat,
            SensorFile::Pressure(file) if file.on.as_deref().is_some_and(is_seat) => Ear::Seat,
            SensorFile::Pressure(_) => Ear::Use,
            SensorFile::Contact(file) => match home.doors.iter().find(|door| door.name == file.on) {
                Some(door) if door.outside => Ear::Door,
                _ => Ear::Use,
            },
            _ => Ear::Deaf,
        };
        home.sensors.iter().map(ear).collect()
    }

    pub fn hears(self, value: Value) -> Option<PassiveMeaning> {
        match (self, value) {
            // An end means that there was a movement.
            (Ear::Motion { .. }, Value::Off) | (Ear::Deaf, _) => None,
            (Ear::Motion { at_rest }, _) => Some(PassiveMeaning::Moved { at_rest }),
            (Ear::Seat, Value::Out | Value::Off) => Some(PassiveMeaning::Rises),
            (Ear::Seat, _) => Some(PassiveMeaning::Rests),
            (Ear::Door, _) => Some(PassiveMeaning::Door),
            (Ear::Use, _) => Some(PassiveMeaning::Moved { at_rest: false }),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassiveMessage {
    pub at: RunTime,
    pub heard: PassiveMeaning,
}

fn is_for_rest(piece: &FurnitureFile) -> bool {
    let name = piece.name.to_lowercase();
    RESTING.iter().any(|&role| piece.role.map_or_else(|| role.is_called(&name), |own| own == role))
}

fn middle(plan: &Plan, piece: &FurnitureFile) -> Option<Point> {
    plan.things.iter().find(|thing| thing.name == piece.name).map(|thing| thing.at)
}
