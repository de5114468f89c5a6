//! The link: the fate of messages between their sensors and the logger.

mod faults;
mod invariants;
mod statistics;

use homebody_core::event::{Events, Fact, Firing, Loss, Provenance, Trigger, Value};
use homebody_core::ids::{ResidentId, SensorId};
use homebody_core::link::Link;
use homebody_core::link::form::LinkFile;
use homebody_core::numbers::Numbers;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::time::{DAY, HOUR, RunTime, SECOND, Span};
use serde_json::json;

/// A link as its file says it.
fn link_file(file: serde_json::Value) -> LinkFile {
    serde_json::from_value(file).unwrap()
}

/// Motion sensors of these names.
fn motion_sensors(names: &[&str]) -> Vec<SensorFile> {
    let sensor = |name: &&str| json!({ "kind": "motion", "name": name, "at": [0, 0], "facing_deg": 0 });
    names.iter().map(|name| serde_json::from_value(sensor(name)).unwrap()).collect()
}

/// Messages of devices: instant, sensor, value.
fn said(messages: &[(RunTime, u32, Value)]) -> Events {
    let firing = |(seq, &(at, sensor, value)): (usize, &(RunTime, u32, Value))| Firing {
        seq: seq as u64,
        at,
        sensor: SensorId(sensor),
        value,
    };
    let provenance = |(seq, &(at, ..)): (usize, &(RunTime, u32, Value))| {
        let provenance =
            Provenance { resident: Some(ResidentId(0)), seen_at: at - Span::MICROSECOND, trigger: Trigger::Movement };
        Fact::Provenance { seq: seq as u64, provenance }
    };
    Events {
        firings: messages.iter().enumerate().map(firing).collect(),
        facts: messages.iter().enumerate().map(provenance).collect(),
        ..Events::default()
    }
}

/// The messages that the logger gets, in a run of this length that begins at midnight.
fn carried(
    file: serde_json::Value,
    sensors: &[SensorFile],
    messages: &[(RunTime, u32, Value)],
    length: Span,
) -> Events {
    let mut link = Link::new(&link_file(file), sensors, &Numbers::default(), Span::ZERO, 1);
    let mut events = Events::default();
    link.carry(&mut said(messages), RunTime::START + length, &mut events);
    events
}

/// A firing of one sensor every so often, from `every` on.
fn regular(sensor: u32, every: Span, count: i64) -> Vec<(RunTime, u32, Value)> {
    (1..=count).map(|index| (RunTime::START + index * every, sensor, Value::Fire)).collect()
}

/// The lost messages: instant, sensor, cause.
fn lost(events: &Events) -> Vec<(RunTime, u32, Loss)> {
    let lost = |fact: &Fact| match *fact {
        Fact::Lost { at, sensor, loss, .. } => Some((at, sensor.0, loss)),
        _ => None,
    };
    events.facts.iter().filter_map(lost).collect()
}

/// The share of so many messages that were lost in this way.
fn share(events: &Events, loss: Loss, messages: usize) -> f64 {
    lost(events).iter().filter(|(_, _, other)| *other == loss).count() as f64 / messages as f64
}

/// When firings came, in seconds.
fn times(events: &Events) -> Vec<f64> {
    events.firings.iter().map(|firing| firing.at.seconds()).collect()
}

/// The causes of the firings, in their order.
fn causes(events: &Events) -> Vec<Provenance> {
    let provenance = |fact: &Fact| match *fact {
        Fact::Provenance { provenance, .. } => Some(provenance),
        _ => None,
    };
    events.facts.iter().filter_map(provenance).collect()
}
