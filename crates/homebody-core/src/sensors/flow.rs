//! A flow sensor in a water pipe.
//!
//! The device is a small wheel that the water turns: it says when water begins to flow and when it ceases.
//!
//! We assume that it says so at once, and that water flows while a tap is open. Into a cistern it flows for a time by itself
//! after each flush, about a minute.
//!
//! An act that changes the state of its thing is a message. If water runs by itself, each act that turns it on is a
//! flush, after which it flows for its time, and acts that turn it off send no message.
//!
//! Left out: how much flows, whether it is warm, other taps on the same pipe.

use super::entities::EntityRow;
use super::meaning::Meaning;
use super::outbox::{Change, DeviceModel, Outbox};
use crate::event::{Trigger, Value};
use crate::ids::{ResidentId, ThingId};
use crate::sensors::form::{Bearer, Colour, KindRow, Mount, ReportedInstant, SensorForm, Shape, Site};
use crate::time::{RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "flow",
    label: "flow",
    mount: Mount::Thing(&[Bearer::Furniture]),
    unit: None,
    values: &[Value::On, Value::Off],
    shape: Shape::Drop,
    colour: Colour::Sky,
    casas: "I",
    meaning: Meaning::UseOrReading,
    entities: &[EntityRow::switch("running", "water_flow")],
};

/// A flow sensor in a water pipe. Its events are `ON` and `OFF`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "flow sensor")]
pub struct FlowFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Piece of furniture that the pipe leads to.
    pub on: String,
    /// Time that the water runs by itself, as into a cistern (about 60 s). Without it, water runs until it is turned
    /// off.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.001, max = 86_400))]
    pub runs_s: Option<f64>,
}

impl SensorForm for FlowFile {
    fn on(&self) -> Option<&str> {
        Some(&self.on)
    }

    fn moment(&self) -> Option<ReportedInstant<'_>> {
        Some(ReportedInstant::Used(&self.on))
    }
}

/// A flow sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    thing: ThingId,
    runs: Option<Span>,
    flows: bool,
    ceases: RunTime,
    by: Option<ResidentId>,
    since: RunTime,
}

impl Flow {
    /// A sensor in the pipe to the thing of this site.
    pub fn new(file: &FlowFile, site: &Site) -> Flow {
        Flow {
            thing: site.thing,
            runs: file.runs_s.map(Span::from_seconds),
            flows: false,
            ceases: RunTime::NEVER,
            by: None,
            since: RunTime::START,
        }
    }
}

impl DeviceModel for Flow {
    fn on_event(&mut self, at: RunTime, change: &Change, outbox: &mut Outbox) {
        let Change::Use { resident, thing, on } = *change else { return };
        if thing != self.thing || (self.runs.is_some() && !on) {
            return;
        }
        // A flush as the last one ends is another.
        self.on_timer(at, outbox);
        if on != self.flows {
            self.flows = on;
            outbox.send(if on { Value::On } else { Value::Off }, resident, at, Trigger::Use(thing));
        }
        if let Some(runs) = self.runs {
            (self.ceases, self.by, self.since) = (at + runs, resident, at);
        }
    }

    fn timer(&self) -> RunTime {
        self.ceases
    }

    fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
        if self.ceases <= at {
            (self.flows, self.ceases) = (false, RunTime::NEVER);
            outbox.send(Value::Off, self.by, self.since, Trigger::Use(self.thing));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensors::outbox::testing::says;
    use crate::time::SECOND;

    fn at(seconds: i64) -> RunTime {
        RunTime::START + seconds * SECOND
    }

    fn outbox(json: serde_json::Value, acts: &[(RunTime, bool)]) -> Vec<(RunTime, Value)> {
        let mut flow =
            Flow::new(&serde_json::from_value(json).unwrap(), &Site { thing: ThingId(7), ..Site::default() });
        says(&mut flow, ThingId(7), acts, at(3600)).into_iter().map(|(at, value, _)| (at, value)).collect()
    }

    #[test]
    fn a_tap_flows_while_it_is_open() {
        let messages =
            outbox(serde_json::json!({ "name": "f", "on": "sink" }), &[(at(5), true), (at(6), true), (at(9), false)]);
        assert_eq!(messages, [(at(5), Value::On), (at(9), Value::Off)]);
    }

    #[test]
    fn a_cistern_fills_by_itself() {
        let toilet = serde_json::json!({ "name": "f", "on": "toilet", "runs_s": 60 });
        let on = Value::On;
        assert_eq!(outbox(toilet.clone(), &[(at(0), true), (at(1), false)]), [(at(0), on), (at(60), Value::Off)]);
        // A flush while it fills makes it longer; one as it ends is another.
        let twice = [(at(0), true), (at(30), true)];
        assert_eq!(outbox(toilet.clone(), &twice), [(at(0), on), (at(90), Value::Off)]);
        let after = [(at(0), on), (at(60), Value::Off), (at(60), on), (at(120), Value::Off)];
        assert_eq!(outbox(toilet, &[(at(0), true), (at(60), true)]), after);
    }
}
