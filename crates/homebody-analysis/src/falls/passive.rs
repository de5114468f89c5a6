//! What passive sensors tell of somebody who may have fallen: that they moved, where, that they sit or lie where a sensor feels it,
//! and that the door to the outside was used.
//!
//! We assume that a motion sensor whose area holds a bed or a seat tells of who is in it, and that all others tell of who is not.
//!
//! Left out: what appliances, water and temperatures tell.

use homebody_core::event::Value;
use homebody_core::geometry::{Point, depth_in_area, point};
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::plan::Plan;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::role::Role;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::time::RunTime;

/// Where somebody rests. Who lies beside a toilet is seen by the same sensor as who sits on it, so it is none of them.
const RESTING: [Role; 5] = [Role::Bed, Role::Armchair, Role::Sofa, Role::DiningSeat, Role::GuestSeat];

/// Height below which a piece is not a seat, in metres (our choice): rugs, shower trays.
const LOWEST_SEAT_M: f64 = 0.2;

/// What a message of a passive sensor tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PassiveMeaning {
    /// Somebody moved.
    Moved {
        /// Whether that was where somebody sits or lies.
        at_rest: bool,
    },
    /// A pad or a bed's sensor feels somebody.
    Rests,
    /// A pad or a bed's sensor feels nobody any more.
    Rises,
    /// The door to the outside was opened or closed.
    Door,
}

/// What one of a home's sensors can tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ear {
    /// Movement.
    Motion {
        /// Whether it looks at a bed or a seat.
        at_rest: bool,
    },
    /// That somebody is in a bed or on a seat.
    Seat,
    /// That the door to the outside is used.
    Door,
    /// That something else was opened or closed, or stepped on.
    Use,
    /// Nothing of this.
    Deaf,
}

impl Ear {
    /// Of each sensor of a home, in the order of its file.
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

    /// What it tells by a message.
    pub fn hears(self, value: Value) -> Option<PassiveMeaning> {
        match (self, value) {
            // What is over began with a movement.
            (Ear::Motion { .. }, Value::Off) | (Ear::Deaf, _) => None,
            (Ear::Motion { at_rest }, _) => Some(PassiveMeaning::Moved { at_rest }),
            (Ear::Seat, Value::Out | Value::Off) => Some(PassiveMeaning::Rises),
            (Ear::Seat, _) => Some(PassiveMeaning::Rests),
            (Ear::Door, _) => Some(PassiveMeaning::Door),
            (Ear::Use, _) => Some(PassiveMeaning::Moved { at_rest: false }),
        }
    }
}

/// A message and when it came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassiveMessage {
    /// When it came.
    pub at: RunTime,
    /// What it tells.
    pub heard: PassiveMeaning,
}

fn is_for_rest(piece: &FurnitureFile) -> bool {
    let name = piece.name.to_lowercase();
    RESTING.iter().any(|&role| piece.role.map_or_else(|| role.is_called(&name), |own| own == role))
}

fn middle(plan: &Plan, piece: &FurnitureFile) -> Option<Point> {
    plan.things.iter().find(|thing| thing.name == piece.name).map(|thing| thing.at)
}
