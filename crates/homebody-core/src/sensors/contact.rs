//! A contact on a door, a drawer, a cabinet or a fridge.
//!
//! The device is a reed switch on the frame and a magnet on the leaf: it says when they part and when they meet.
//!
//! We assume that it says so at once, and that what it hangs on is closed as a run begins, unless the home has it open.
//!
//! An act on its thing that changes how the thing is, is a message; one that changes nothing is none.
//!
//! Left out: bouncing, doors that stand ajar, magnets out of line.

use super::device::{Change, Said};
use crate::event::{Value, Why};
use crate::time::{Micros, NEVER};

/// A contact sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Index into the home's things.
    thing: u32,
    open: bool,
}

impl Contact {
    pub fn new(thing: u32, open: bool) -> Contact {
        Contact { thing, open }
    }

    pub fn told(&mut self, at: Micros, change: &Change, said: &mut Said) {
        if let Change::Act { resident, thing, on } = *change
            && thing == self.thing
            && on != self.open
        {
            self.open = on;
            said.say(if on { Value::Open } else { Value::Close }, Some(resident), at, Why::Act(thing));
        }
    }

    pub fn timer(&self) -> Micros {
        NEVER
    }

    pub fn due(&mut self, _at: Micros, _said: &mut Said) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_change_is_a_message() {
        let mut contact = Contact::new(3, false);
        let mut said = Said::default();
        for (at, thing, on) in [(1, 3, false), (2, 3, true), (3, 4, true), (4, 3, true), (5, 3, false)] {
            contact.told(at, &Change::Act { resident: 0, thing, on }, &mut said);
        }
        let values: Vec<Value> = said.0.iter().map(|(value, _)| *value).collect();
        assert_eq!(values, [Value::Open, Value::Close]);
    }
}
