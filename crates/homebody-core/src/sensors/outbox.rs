//! What devices are told, and what they say.
//!
//! A device hears what happens to things and bodies, and hands its messages to the world.
//!
//! We assume that it is told of things as they happen, and of what began earlier in the same words as at first.
//!
//! A message says whose doing it was, when that was seen, and whether something happened or a timer ran out.
//!
//! Left out: what becomes of a message on its way to the logger.

use crate::body::figure::Stature;
use crate::camera::silhouette::Picture;
use crate::event::{Provenance, Trigger, Value, Vitals};
use crate::ids::{ResidentId, ThingId};
use crate::motion::MotionState;
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::posture::Posture;
use crate::random::{DrawnValue, Stream};
use crate::time::RunTime;

/// What a device is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// A thing was used: index into the home's things.
    Use {
        /// Who used it; `None` from outside.
        resident: Option<ResidentId>,
        /// What was used.
        thing: ThingId,
        /// How it is afterwards: on or open, or off or closed.
        on: bool,
    },
    /// From now until `end` a resident's body does this. What began earlier may be told again, with its own `begin`.
    Body {
        /// Whose body it is.
        resident: ResidentId,
        /// How large it is.
        stature: Stature,
        /// When it began to do this; may be past.
        begin: RunTime,
        /// Until when it does this, unless something else is told before.
        end: RunTime,
        /// What it does.
        doing: MotionState,
        /// How it holds itself meanwhile.
        posture: Posture,
        /// What chance says of it, the same to all that are told: which way somebody falls.
        chance: DrawnValue,
    },
    /// A sensor that it is tied to has spoken.
    Fired,
    /// From now on a resident's heart and lungs are like this.
    Vitals {
        /// Whose they are.
        resident: ResidentId,
        /// Pulse and respiration.
        vitals: Vitals,
    },
}

/// How a device behaves. What does nothing by default, many do not need.
pub trait DeviceModel: Clone {
    /// The device at the beginning of a run, with random numbers of its own, under this sun, its model made by these numbers.
    fn begin(&self, _stream: Stream, _sun: Sun, _numbers: &Numbers) -> Self {
        self.clone()
    }

    /// Whether it wants to be told what bodies do, which they say far more often than what they use.
    fn feels_bodies(&self) -> bool {
        false
    }

    /// Whether it wants to be told what all bodies do, those of cats, too, as it looks at them.
    fn sees_bodies(&self) -> bool {
        false
    }

    /// The names of the sensors whose words it wants to be told of.
    fn woken_by(&self) -> &[String] {
        &[]
    }

    /// Whether it takes pictures now.
    fn is_awake(&self) -> bool {
        false
    }

    /// Something happens at `at`; timers that are due earlier have run out before, those that are due then have not. What
    /// depends on all that happens at this instant waits for a timer that is due now.
    fn on_event(&mut self, _at: RunTime, _change: &Change, _outbox: &mut Outbox) {}

    /// When its timer is due next: after it was told something, now at the earliest; after its timer ran out, later.
    fn timer(&self) -> RunTime {
        RunTime::NEVER
    }

    /// Its timer runs out.
    fn on_timer(&mut self, _at: RunTime, _outbox: &mut Outbox) {}
}

/// What devices say, for the world to send.
#[derive(Clone, Debug, Default)]
pub struct Outbox {
    /// Messages.
    pub said: Vec<(Value, Provenance)>,
    /// Pictures that are kept apart from the messages.
    pub pictures: Vec<Picture>,
}

impl Outbox {
    /// Says something now: whose doing it was, if anybody's, when that began to be noticed, and what kind of cause it
    /// was.
    pub fn say(&mut self, value: Value, resident: Option<ResidentId>, seen_at: RunTime, trigger: Trigger) {
        self.said.push((value, Provenance { resident, seen_at, trigger }));
    }
}

/// A number as a reading: in thousandths, of which there are no more than a reading holds.
pub fn reading(number: f64) -> Value {
    Value::Reading(libm::round(number * 1000.0) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_are_rounded_to_thousandths() {
        assert_eq!([21.5, -0.0004, -3.25, 1e9].map(reading), [21_500, 0, -3_250, i32::MAX].map(Value::Reading));
    }
}
