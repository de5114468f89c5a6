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
use super::outbox::{Change, Outbox};
use super::power::Power;
use super::pressure::Pressure;
use super::stove_temperature::StoveTemperature;
use super::temperature::Temperature;
use crate::home::sun::Sun;
use crate::random::Stream;
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
