//! A contact on a door, a drawer, a cabinet or a fridge.
//!
//! The device is a reed switch on the frame and a magnet on the leaf: it says when they part and when they meet.
//!
//! We assume that it says so at once, and that what it hangs on is closed as a run begins, unless the home has it open.
//!
//! An act on its thing that changes how the thing is, is a message; one that changes nothing is none.
//!
//! Left out: bouncing, doors that stand ajar, magnets out of line.

use super::outbox::{Change, Outbox};
use crate::event::{Trigger, Value};
use crate::ids::ThingId;
use crate::time::{Micros, NEVER};

/// A contact sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Index into the home's things.
    thing: ThingId,
    open: bool,
}

impl Contact {
    pub fn new(thing: ThingId, open: bool) -> Contact {
        Contact { thing, open }
    }

    pub fn on_event(&mut self, at: Micros, change: &Change, outbox: &mut Outbox) {
        if let Change::Use { resident, thing, on } = *change
            && thing == self.thing
            && on != self.open
        {
            self.open = on;
            outbox.say(if on { Value::Open } else { Value::Close }, Some(resident), at, Trigger::Use(thing));
        }
    }

    pub fn timer(&self) -> Micros {
        NEVER
    }

    pub fn on_timer(&mut self, _at: Micros, _outbox: &mut Outbox) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::ResidentId;

    #[test]
    fn only_a_change_is_a_message() {
        let mut contact = Contact::new(ThingId(3), false);
        let mut outbox = Outbox::default();
        for (at, thing, on) in [(1, 3, false), (2, 3, true), (3, 4, true), (4, 3, true), (5, 3, false)] {
            contact.on_event(at, &Change::Use { resident: ResidentId(0), thing: ThingId(thing), on }, &mut outbox);
        }
        let values: Vec<Value> = outbox.0.iter().map(|(value, _)| *value).collect();
        assert_eq!(values, [Value::Open, Value::Close]);
    }
}
