//! Input and output of devices.
//!
//! A device hears what happens to things and bodies, and hands its messages to the world.
//!
//! We assume that it hears of things as they happen, and of earlier movements in the same words as at first.
//!
//! A message says whose doing it was, when that was seen, and whether something happened or a timer ran out.
//!
//! Left out: what becomes of a message on its way to the logger.

use crate::body::figure::Stature;
use crate::camera::silhouette::Picture;
use crate::event::{Provenance, Trigger, Value, Vitals};
use crate::ids::{ResidentId, ThingId};
use crate::motion::MotionSegment;
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::random::{DrawnValue, Stream};
use crate::time::RunTime;

/// A change that a device hears of.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant says what its data are")]
pub enum Change {
    /// A thing was used: index into the home's things.
    Use {
        resident: Option<ResidentId>,
        thing: ThingId,
        /// The state afterwards: on or open, or off or closed.
        on: bool,
    },
    /// A resident's movement from now on. An earlier one may come again, with its own begin.
    Body {
        resident: ResidentId,
        stature: Stature,
        /// The movement, which lasts until its end unless another one comes before.
        segment: MotionSegment,
        /// A random number of the movement, the same for all devices: the direction of a fall.
        chance: DrawnValue,
    },
    /// A sensor that it is tied to has spoken.
    Fired,
    /// From now on a resident's heart and lungs are like this.
    Vitals { resident: ResidentId, vitals: Vitals },
}

/// The behaviour of a device. Many devices need few of these methods.
pub trait DeviceModel: Clone {
    /// The device at the beginning of a run, with random numbers of its own, under this sun, its model made by these numbers.
    fn begin(&self, _stream: Stream, _sun: Sun, _numbers: &Numbers) -> Self {
        self.clone()
    }

    /// Whether it reacts to movements of bodies, which are far more frequent than uses of things.
    fn feels_bodies(&self) -> bool {
        false
    }

    /// Whether it reacts to movements of all bodies, those of cats, too, because it looks at them.
    fn sees_bodies(&self) -> bool {
        false
    }

    /// The names of the sensors that wake it.
    fn woken_by(&self) -> &[String] {
        &[]
    }

    /// Whether it takes pictures now.
    fn is_awake(&self) -> bool {
        false
    }

    /// A change at `at`. Earlier timers have run out, those of this instant have not. A decision that depends on all
    /// changes of this instant waits for a timer that is due now.
    fn on_event(&mut self, _at: RunTime, _change: &Change, _outbox: &mut Outbox) {}

    /// The next instant of its timer: after a change, now at the earliest; after its timer ran out, later.
    fn timer(&self) -> RunTime {
        RunTime::NEVER
    }

    /// Its timer runs out.
    fn on_timer(&mut self, _at: RunTime, _outbox: &mut Outbox) {}
}

/// The output of devices, for the world to send.
#[derive(Clone, Debug, Default)]
pub struct Outbox {
    /// Messages.
    pub messages: Vec<(Value, Provenance)>,
    /// Pictures that are kept apart from the messages.
    pub pictures: Vec<Picture>,
}

impl Outbox {
    /// Adds a message of this instant: its resident, if any, the first instant of the cause, and the kind of the cause.
    pub fn send(&mut self, value: Value, resident: Option<ResidentId>, seen_at: RunTime, trigger: Trigger) {
        self.messages.push((value, Provenance { resident, seen_at, trigger }));
    }
}

/// A number as a reading: in thousandths, within the range of a reading.
pub fn reading(number: f64) -> Value {
    Value::Reading(libm::round(number * 1000.0) as i32)
}

/// Devices by themselves, for the tests of their modules.
#[cfg(test)]
pub mod testing {
    use super::*;

    /// The user of things. A device that names the first resident by mistake names another one.
    pub const USER: ResidentId = ResidentId(4);

    /// A change of a thing by the user.
    pub fn used(thing: ThingId, on: bool) -> Change {
        Change::Use { resident: Some(USER), thing, on }
    }

    /// The messages of a device until an instant, while the user turns a thing on and off.
    pub fn says(
        device: &mut impl DeviceModel,
        thing: ThingId,
        uses: &[(RunTime, bool)],
        until: RunTime,
    ) -> Vec<(RunTime, Value, Option<ResidentId>)> {
        let (mut outbox, mut said) = (Outbox::default(), Vec::new());
        let mut take = |at, outbox: &mut Outbox| {
            said.extend(outbox.messages.drain(..).map(|(value, provenance)| (at, value, provenance.resident)));
        };
        for (at, on) in uses.iter().map(|&(at, on)| (at, Some(on))).chain([(until, None)]) {
            while device.timer() < at {
                let due = device.timer();
                device.on_timer(due, &mut outbox);
                assert!(device.timer() > due, "the timer stands still");
                take(due, &mut outbox);
            }
            if let Some(on) = on {
                device.on_event(at, &used(thing, on), &mut outbox);
                take(at, &mut outbox);
            }
        }
        said
    }

    /// The readings among messages.
    pub fn readings(said: &[(RunTime, Value, Option<ResidentId>)]) -> Vec<f64> {
        let number =
            |value: &Value| if let Value::Reading(thousandths) = value { Some(f64::from(*thousandths)) } else { None };
        said.iter().filter_map(|(_, value, _)| Some(number(value)? / 1000.0)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_are_rounded_to_thousandths() {
        assert_eq!([21.5, -0.0004, -3.25, 1e9].map(reading), [21_500, 0, -3_250, i32::MAX].map(Value::Reading));
    }
}
