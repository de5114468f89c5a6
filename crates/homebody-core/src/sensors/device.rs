//! What the sensors that do not look for movement have in common.
//!
//! They are told what happens to things and bodies, and speak up at once or when their timer runs out.
//!
//! We assume that whoever tells them does so as it happens, and of what began earlier with the same words as at first.
//!
//! A device that is told something keeps what it must and says when its timer is due, which may be now: then it has been told
//! all that happens at this instant, in whatever order. Only a change of state is a message, so that being told again changes
//! nothing. Those that measure do so in rounds, each from an instant of its own on.
//!
//! Left out: what becomes of a message on its way to the logger.

use super::bed::Bed;
use super::contact::Contact;
use super::flow::Flow;
use super::light::Light;
use super::power::Power;
use super::pressure::Pressure;
use super::stove_temperature::StoveTemperature;
use super::temperature::Temperature;
use crate::event::{MotionState, Provenance, Trigger, Value, Vitals};
use crate::home::Sun;
use crate::ids::{ResidentId, ThingId};
use crate::random::{Range, Stream};
use crate::scenario::path::Posture;
use crate::time::Micros;

/// A sensor that is told, one kind each.
#[derive(Clone, Debug, PartialEq)]
pub enum Device {
    Contact(Contact),
    Bed(Bed),
    StoveTemperature(StoveTemperature),
    Pressure(Pressure),
    Power(Power),
    Flow(Flow),
    Light(Light),
    Temperature(Temperature),
}

/// What a device is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// A resident used a thing: index into the home's things.
    Use { resident: ResidentId, thing: ThingId, on: bool },
    /// From now until `end` a resident's body does this. What began earlier may be told again, with its own `begin`.
    Body { resident: ResidentId, begin: Micros, end: Micros, doing: MotionState, posture: Posture },
    /// From now on a resident's heart and lungs are like this.
    Vitals { resident: ResidentId, vitals: Vitals },
}

/// What devices say, for the world to send.
#[derive(Clone, Debug, Default)]
pub struct Outbox(pub Vec<(Value, Provenance)>);

impl Outbox {
    pub fn say(&mut self, value: Value, resident: Option<ResidentId>, seen_at: Micros, trigger: Trigger) {
        self.0.push((value, Provenance { resident, seen_at, trigger }));
    }
}

impl Device {
    /// The device at the beginning of a run, with random numbers of its own, under this sun.
    pub fn begin(&self, stream: Stream, sun: Sun) -> Device {
        match self {
            Device::Contact(device) => Device::Contact(device.clone()),
            Device::Bed(device) => Device::Bed(device.begin(stream)),
            Device::StoveTemperature(device) => Device::StoveTemperature(device.begin(stream)),
            Device::Pressure(device) => Device::Pressure(device.clone()),
            Device::Power(device) => Device::Power(device.begin(stream)),
            Device::Flow(device) => Device::Flow(device.clone()),
            Device::Light(device) => Device::Light(device.begin(stream, sun)),
            Device::Temperature(device) => Device::Temperature(device.begin(stream, sun)),
        }
    }

    /// Whether it wants to be told what bodies do, which they say far more often than what they use.
    pub fn feels_bodies(&self) -> bool {
        match self {
            Device::Bed(_) | Device::Pressure(_) => true,
            Device::Contact(_) | Device::StoveTemperature(_) | Device::Power(_) | Device::Flow(_) => false,
            Device::Light(_) | Device::Temperature(_) => false,
        }
    }

    /// Something happens at `at`; timers that are due earlier have run out before, those that are due then have not. What
    /// depends on all that happens at this instant waits for a timer that is due now.
    pub fn on_event(&mut self, at: Micros, change: &Change, outbox: &mut Outbox) {
        match self {
            Device::Contact(device) => device.on_event(at, change, outbox),
            Device::Bed(device) => device.on_event(at, change),
            Device::StoveTemperature(device) => device.on_event(at, change, outbox),
            Device::Pressure(device) => device.on_event(at, change),
            Device::Power(device) => device.on_event(at, change, outbox),
            Device::Flow(device) => device.on_event(at, change, outbox),
            Device::Light(device) => device.on_event(at, change),
            Device::Temperature(_) => {}
        }
    }

    /// When its timer is due next: after it was told something, now at the earliest; after its timer ran out, later.
    pub fn timer(&self) -> Micros {
        match self {
            Device::Contact(device) => device.timer(),
            Device::Bed(device) => device.timer(),
            Device::StoveTemperature(device) => device.timer(),
            Device::Pressure(device) => device.timer(),
            Device::Power(device) => device.timer(),
            Device::Flow(device) => device.timer(),
            Device::Light(device) => device.timer(),
            Device::Temperature(device) => device.timer(),
        }
    }

    /// Its timer runs out.
    pub fn on_timer(&mut self, at: Micros, outbox: &mut Outbox) {
        match self {
            Device::Contact(device) => device.on_timer(at, outbox),
            Device::Bed(device) => device.on_timer(at, outbox),
            Device::StoveTemperature(device) => device.on_timer(at, outbox),
            Device::Pressure(device) => device.on_timer(at, outbox),
            Device::Power(device) => device.on_timer(at, outbox),
            Device::Flow(device) => device.on_timer(at, outbox),
            Device::Light(device) => device.on_timer(at, outbox),
            Device::Temperature(device) => device.on_timer(at, outbox),
        }
    }
}

/// Instants at which a device measures: every so often, from one on that its own random numbers give, so that not all of a
/// home measure at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounds {
    every: Micros,
    first: Micros,
}

impl Rounds {
    pub fn new(every: Micros) -> Rounds {
        Rounds { every, first: 0 }
    }

    pub fn begin(self, stream: &mut Stream) -> Rounds {
        Rounds { first: stream.span(Range { least: 0, most: self.every - 1 }), ..self }
    }

    pub fn every(&self) -> Micros {
        self.every
    }

    pub fn first(&self) -> Micros {
        self.first
    }

    /// The first one later than `at`, which is not before 0.
    pub fn after(&self, at: Micros) -> Micros {
        match at - self.first {
            before if before < 0 => self.first,
            since => at + self.every - since % self.every,
        }
    }
}

/// A number as a reading: in thousandths, of which there are no more than a reading holds.
pub fn reading(number: f64) -> Value {
    Value::Reading(libm::round(number * 1000.0) as i32)
}

/// A stream that nobody draws from: what a device holds until a run begins.
pub fn no_stream() -> Stream {
    Stream::named(0, "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_come_every_so_often() {
        let rounds = Rounds { every: 10, first: 3 };
        let next = [0, 2, 3, 4, 12, 13, 14].map(|at| rounds.after(at));
        assert_eq!(next, [3, 3, 13, 13, 13, 23, 23]);
        let first = Rounds::new(10).begin(&mut Stream::named(1, "rounds")).first();
        assert!((0..10).contains(&first));
    }

    #[test]
    fn readings_are_rounded_to_thousandths() {
        assert_eq!([21.5, -0.0004, -3.25, 1e9].map(reading), [21_500, 0, -3_250, i32::MAX].map(Value::Reading));
    }
}
