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

use super::form::Site;
use super::kinds::devices;
use super::outbox::{Change, DeviceModel, Outbox};
use crate::home::sun::Sun;
use crate::numbers::Numbers;
use crate::random::Stream;
use crate::scenario::home::SensorFile;
use crate::time::Micros;

macro_rules! device {
    ($($kind:ident($module:ident, $form:ident))*) => {
        /// A sensor that is told, one kind each.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs, reason = "each kind's model says what it is, in a file of its own")]
        pub enum Device {
            $($kind(super::$module::$kind)),*
        }

        impl Device {
            /// The device that a file that has passed its checks describes, at its site; nothing for sensors that look for
            /// movement.
            pub fn new(file: &SensorFile, site: &Site) -> Option<Device> {
                match file {
                    SensorFile::Motion(_) | SensorFile::CeilingMotion(_) => None,
                    $(SensorFile::$kind(file) => Some(Device::$kind(super::$module::$kind::new(file, site)))),*
                }
            }
        }

        impl DeviceModel for Device {
            fn begin(&self, stream: Stream, sun: Sun, numbers: &Numbers) -> Device {
                match self { $(Device::$kind(device) => Device::$kind(device.begin(stream, sun, numbers))),* }
            }

            fn feels_bodies(&self) -> bool {
                match self { $(Device::$kind(device) => device.feels_bodies()),* }
            }

            fn sees_bodies(&self) -> bool {
                match self { $(Device::$kind(device) => device.sees_bodies()),* }
            }

            fn woken_by(&self) -> &[String] {
                match self { $(Device::$kind(device) => device.woken_by()),* }
            }

            fn is_awake(&self) -> bool {
                match self { $(Device::$kind(device) => device.is_awake()),* }
            }

            fn on_event(&mut self, at: Micros, change: &Change, outbox: &mut Outbox) {
                match self { $(Device::$kind(device) => device.on_event(at, change, outbox)),* }
            }

            fn timer(&self) -> Micros {
                match self { $(Device::$kind(device) => device.timer()),* }
            }

            fn on_timer(&mut self, at: Micros, outbox: &mut Outbox) {
                match self { $(Device::$kind(device) => device.on_timer(at, outbox)),* }
            }
        }
    };
}
devices!(device);
