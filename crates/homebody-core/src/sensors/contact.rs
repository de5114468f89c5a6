//! A contact on a door, a drawer, a cabinet or a fridge.
//!
//! The device is a reed switch on the frame and a magnet on the leaf: it says when they part and when they meet.
//!
//! We assume that it says so at once, and that what it hangs on is closed as a run begins, unless the home has it open.
//!
//! An act that changes the state of its thing is a message. Other acts are not.
//!
//! Left out: bouncing, doors that stand ajar, magnets out of line.

use super::entities::EntityRow;
use super::meaning::{Kind, Meaning};
use super::outbox::{Change, DeviceModel, Outbox};
use crate::event::{Trigger, Value};
use crate::ids::ThingId;
use crate::sensors::form::{Bearer, Colour, KindRow, Mount, ReportedInstant, SensorForm, Shape, Site};
use crate::time::RunTime;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "contact",
    label: "contact",
    mount: Mount::Thing(&[Bearer::Door, Bearer::Furniture]),
    unit: None,
    values: &[Value::Open, Value::Close],
    shape: Shape::Gap,
    colour: Colour::Orange,
    casas: "D",
    meaning: Meaning::Is(Kind::Contact),
    entities: &[EntityRow::CONTACT],
};

/// A contact on a door or a piece of furniture. Its events are `OPEN` and `CLOSE`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "contact sensor")]
pub struct ContactFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Door or piece of furniture that the contact is on.
    pub on: String,
}

impl SensorForm for ContactFile {
    fn on(&self) -> Option<&str> {
        Some(&self.on)
    }

    fn moment(&self) -> Option<ReportedInstant<'_>> {
        Some(ReportedInstant::Used(&self.on))
    }
}

/// A contact sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    thing: ThingId,
    open: bool,
}

impl Contact {
    /// A sensor on the thing of this site.
    pub fn new(_file: &ContactFile, site: &Site) -> Contact {
        Contact { thing: site.thing, open: site.is_open }
    }
}

impl DeviceModel for Contact {
    fn on_event(&mut self, at: RunTime, change: &Change, outbox: &mut Outbox) {
        if let Change::Use { resident, thing, on } = *change
            && thing == self.thing
            && on != self.open
        {
            self.open = on;
            outbox.send(if on { Value::Open } else { Value::Close }, resident, at, Trigger::Use(thing));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::ResidentId;

    #[test]
    fn only_a_change_is_a_message() {
        let mut contact = Contact { thing: ThingId(3), open: false };
        let mut outbox = Outbox::default();
        for (at, thing, on) in [(1, 3, false), (2, 3, true), (3, 4, true), (4, 3, true), (5, 3, false)] {
            contact.on_event(
                RunTime::from_micros(at),
                &Change::Use { resident: Some(ResidentId(0)), thing: ThingId(thing), on },
                &mut outbox,
            );
        }
        let values: Vec<Value> = outbox.messages.iter().map(|(value, _)| *value).collect();
        assert_eq!(values, [Value::Open, Value::Close]);
    }
}
