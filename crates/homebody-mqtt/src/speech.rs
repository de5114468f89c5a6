//! Turns rows into messages.

use crate::address::Style;
use crate::entities::{EntityType, EntityValue};
use crate::messages::BrokerMessage;
use crate::place::{HomeTopics, SensorTopics};
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::RunTime;
use homebody_log::table::InstantWriter;
use homebody_log::{LogError, RunInfo};
use serde_json::{Map, Value, json};
use std::collections::HashMap;
use std::fmt::Write;
use std::sync::Arc;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Message {
    pub topic: Arc<str>,
    pub payload: Arc<str>,
    /// Whether the broker retains it for later listeners.
    pub retain: bool,
    /// Of what passes by itself, such as a motion sensor's ON: what is true again some seconds later.
    pub then: Option<Arc<str>>,
}

impl Message {
    pub fn kept(topic: impl Into<Arc<str>>, payload: impl Into<Arc<str>>) -> Message {
        Message { topic: topic.into(), payload: payload.into(), retain: true, then: None }
    }
}

/// Turns rows into messages.
pub(crate) struct Speech {
    run: String,
    clock: InstantWriter,
    place: Arc<HomeTopics>,
    /// Sensors by what the log calls them.
    by_id: HashMap<String, usize>,
    topics: Vec<Vec<Arc<str>>>,
    /// Of Zigbee2MQTT: by sensor, all that it has said last, in its order.
    last: Vec<Map<String, Value>>,
    line: String,
}

impl Speech {
    pub fn new(run: &RunInfo, place: Arc<HomeTopics>) -> Speech {
        let by_id = place.sensors.iter().enumerate().map(|(index, sensor)| (sensor.in_log.clone(), index));
        let topics =
            place.sensors.iter().map(|sensor| sensor.topics.iter().map(|topic| topic.as_str().into()).collect());
        Speech {
            run: run.id.to_string(),
            clock: InstantWriter::new(&run.calendar, TimeFormat::LocalOffset),
            by_id: by_id.collect(),
            topics: topics.collect(),
            last: place.sensors.iter().map(|sensor| unknown(&place, sensor)).collect(),
            place,
            line: String::new(),
        }
    }

    pub fn message(&mut self, seq: i64, at: RunTime, sensor: &str, said: &str) -> Result<Message, LogError> {
        let Some(&index) = self.by_id.get(sensor) else {
            let unknown = BrokerMessage::UnknownSensor { sensor: sensor.into() };
            return Err(LogError::destination(&self.place.base, unknown));
        };
        Ok(self.said(index, seq, at, said))
    }

    /// From now on it speaks for this run of a home of the same kind; what its devices have said last is changed for what is in
    /// `last`.
    pub fn turn_to(&mut self, run: i64, last: &mut Vec<Map<String, Value>>) {
        self.run.clear();
        // A string takes whatever is written to it.
        let _ = write!(self.run, "{run}");
        if self.place.style == Style::Zigbee2Mqtt {
            if last.is_empty() {
                *last = self.place.sensors.iter().map(|sensor| unknown(&self.place, sensor)).collect();
            }
            std::mem::swap(&mut self.last, last);
        }
    }

    /// The message of a sensor, by its number.
    pub fn said(&mut self, index: usize, seq: i64, at: RunTime, said: &str) -> Message {
        let place = self.place.clone();
        let placed = &place.sensors[index];
        let (entity, heard) = placed.device.hears(said);
        self.line.clear();
        match place.style {
            Style::HomeAssistant => self.home_assistant(&heard, said),
            Style::Plain => self.plain(placed, said),
            Style::Zigbee2Mqtt => self.zigbee(index, entity, &heard),
        }
        let _ = write!(self.line, ",\"run\":\"{}\",\"seq\":{seq},\"sim_time\":\"{}\"}}", self.run, self.clock.text(at));
        let momentary = placed.is_momentary(entity) && heard == EntityValue::Switched(true);
        Message {
            topic: self.topics[index][entity].clone(),
            payload: self.line.as_str().into(),
            retain: !momentary,
            then: momentary.then(|| clear(place.style, placed).into()),
        }
    }

    fn home_assistant(&mut self, heard: &EntityValue, said: &str) {
        let _ = match heard {
            EntityValue::Switched(on) => write!(self.line, "{{\"state\":\"{}\",\"said\":{}", on_off(*on), quoted(said)),
            EntityValue::Number(number) => write!(self.line, "{{\"state\":{number},\"said\":{}", quoted(said)),
            EntityValue::Word(word) => write!(self.line, "{{\"state\":{},\"said\":{}", quoted(word), quoted(said)),
        };
    }

    fn plain(&mut self, placed: &SensorTopics, said: &str) {
        let number = said.parse::<f64>().ok().filter(|number| number.is_finite());
        let value = number.map_or_else(|| quoted(said), |number| number.to_string());
        let _ = write!(self.line, "{{\"sensor\":{},\"value\":{value}", quoted(&placed.name));
        if let (Some(unit), Some(_)) = (&placed.unit, number) {
            let _ = write!(self.line, ",\"unit\":{}", quoted(unit));
        }
    }

    /// A device's JSON has all that it has said last, not only what has changed.
    fn zigbee(&mut self, sensor: usize, entity: usize, heard: &EntityValue) {
        let entity = &self.place.sensors[sensor].device.entities[entity];
        self.last[sensor].insert(entity.property.into(), zigbee_value(&entity.says, heard));
        let all = Value::Object(self.last[sensor].clone()).to_string();
        self.line.push_str(all.trim_end_matches('}'));
    }
}

/// The properties of a device of Zigbee2MQTT before its first row: all unknown.
fn unknown(place: &HomeTopics, sensor: &SensorTopics) -> Map<String, Value> {
    let properties = sensor.device.entities.iter().filter(|_| place.is_discovered);
    properties.map(|entity| (entity.property.to_owned(), Value::Null)).collect()
}

/// The resting state of a motion sensor that sends ON alone.
pub(crate) fn clear(style: Style, placed: &SensorTopics) -> String {
    match style {
        Style::HomeAssistant => r#"{"state":"OFF"}"#.into(),
        Style::Zigbee2Mqtt => r#"{"occupancy":false}"#.into(),
        Style::Plain => json!({ "sensor": placed.name, "value": "OFF" }).to_string(),
    }
}

fn on_off(on: bool) -> &'static str {
    if on { "ON" } else { "OFF" }
}

fn zigbee_value(says: &EntityType, heard: &EntityValue) -> Value {
    match (heard, says) {
        (EntityValue::Switched(on), EntityType::Binary { zigbee, .. }) => zigbee[usize::from(!on)].into(),
        (EntityValue::Switched(on), _) => (*on).into(),
        (EntityValue::Number(number), _) if number.fract() == 0.0 && number.abs() < 1e15 => (*number as i64).into(),
        (EntityValue::Number(number), _) => (*number).into(),
        (EntityValue::Word(word), _) => (*word).into(),
    }
}

fn quoted(text: &str) -> String {
    Value::from(text).to_string()
}
