//! What the sensors that do not look for movement have in common: they are told what happens to things and bodies,
//! and speak up at once or when their timer runs out.

use super::contact::Contact;
use crate::event::{Cause, Doing, Value, Vitals, Why};
use crate::random::Stream;
use crate::scenario::path::Posture;
use crate::time::Micros;

/// A sensor that is told, one kind each.
#[derive(Clone, Debug, PartialEq)]
pub enum Device {
    Contact(Contact),
}

/// What a device is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// A resident used a thing: index into the home's things.
    Act { resident: u32, thing: u32, on: bool },
    /// From now until `end` a resident's body does this. What began earlier may be told again, with its own `begin`.
    Body { resident: u32, begin: Micros, end: Micros, doing: Doing, posture: Posture },
    /// From now on a resident's heart and lungs are like this.
    Vitals { resident: u32, vitals: Vitals },
}

/// What devices say, for the world to send.
#[derive(Clone, Debug, Default)]
pub struct Said(pub Vec<(Value, Cause)>);

impl Said {
    pub fn say(&mut self, value: Value, resident: Option<u32>, seen_at: Micros, why: Why) {
        self.0.push((value, Cause { resident, seen_at, why }));
    }
}

impl Device {
    /// The device at the beginning of a run, with random numbers of its own.
    pub fn begin(&self, _stream: Stream) -> Device {
        match self {
            Device::Contact(device) => Device::Contact(device.clone()),
        }
    }

    /// Whether it wants to be told what bodies do, which they say far more often than what they use.
    pub fn feels_bodies(&self) -> bool {
        match self {
            Device::Contact(_) => false,
        }
    }

    /// Something happens at `at`; timers that are due earlier have run out before.
    pub fn told(&mut self, at: Micros, change: &Change, said: &mut Said) {
        match self {
            Device::Contact(device) => device.told(at, change, said),
        }
    }

    /// When its timer is due next.
    pub fn timer(&self) -> Micros {
        match self {
            Device::Contact(device) => device.timer(),
        }
    }

    /// Its timer runs out.
    pub fn due(&mut self, at: Micros, said: &mut Said) {
        match self {
            Device::Contact(device) => device.due(at, said),
        }
    }
}
