//! Messages of MQTT: a topic and a payload. A payload is a word, a number or an object of JSON; each key of an object is a reading.
//!
//! Topics are those of Zigbee2MQTT (`zigbee2mqtt/hall`), Tasmota (`tele/hall/SENSOR`, `stat/hall/POWER`) and any others. Zigbee2MQTT
//! reports `contact` as true while a door is closed. Passed over: messages that ask a device for something, and those of the bridge about itself.

use super::said::{Object, text};
use crate::error::LogError;
use crate::log::SensorInfo;
use crate::source::gathered::Gathered;
use crate::source::instant::LogInstant;
use homebody_core::time::SECOND;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// The value of all sensors of a device that is gone.
const UNAVAILABLE: &str = "unavailable";

/// The value of a closed door and of an open one.
const CLOSED: &str = "CLOSE";
const OPENED: &str = "OPEN";

/// First parts of topics that name no device.
const BASES: [&str; 6] = ["zigbee2mqtt", "z2m", "tele", "stat", "tasmota", "shellies"];

/// Last parts of such topics that name none, in lower case.
const REPORTS: [&str; 4] = ["sensor", "state", "result", "status"];

/// Last parts of topics whose messages ask for something, in lower case.
const REQUESTS: [&str; 3] = ["set", "get", "command"];

/// Keys that tell when a message was made, in lower case.
const TIMES: [&str; 4] = ["time", "timestamp", "ts", "uptime"];

/// Keys whose readings have a unit wherever they come from.
const UNITS: [(&str, &str); 6] = [
    ("battery", "%"),
    ("humidity", "%"),
    ("illuminance", "lx"),
    ("linkquality", "lqi"),
    ("power", "W"),
    ("temperature", "°C"),
];

/// The most objects within each other in a payload.
const DEEPEST: usize = 8;

#[derive(Default)]
pub(crate) struct Payloads {
    devices: BTreeMap<String, BTreeSet<String>>,
    /// The last reading of each sensor whose device reports it under two topics.
    last: BTreeMap<String, (LogInstant, String, String)>,
}

pub(crate) struct GatewayMessage<'m> {
    pub line: u64,
    pub instant: LogInstant,
    pub topic: &'m str,
    pub is_zigbee: bool,
}

impl Payloads {
    /// Takes a message whose payload is a text.
    pub fn text(
        &mut self,
        message: &GatewayMessage<'_>,
        payload: &str,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        match serde_json::from_str::<Object>(payload) {
            Ok(object) => self.object(message, &object, out),
            Err(_) => self.word(message, payload, out),
        }
    }

    /// Takes a message whose payload is a value of JSON.
    pub fn value(
        &mut self,
        message: &GatewayMessage<'_>,
        payload: &Value,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        match payload {
            Value::Object(object) => self.object(message, object, out),
            Value::String(payload) => self.text(message, payload, out),
            other => self.word(message, &text(other), out),
        }
    }

    fn object(
        &mut self,
        message: &GatewayMessage<'_>,
        payload: &Object,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        if is_no_reading(message.topic, out) {
            return Ok(());
        }
        let device = device(message.topic);
        if is_availability(message.topic) {
            let state = payload.get("state").map(text).unwrap_or_default();
            return self.availability(message, &device, &state, out);
        }
        let is_zigbee =
            message.is_zigbee || payload.contains_key("linkquality") || message.topic.starts_with("zigbee2mqtt/");
        let message = GatewayMessage { is_zigbee, ..*message };
        self.readings(&message, &device, payload, out)
    }

    /// Takes the members of an object as readings of a device.
    pub fn readings(
        &mut self,
        message: &GatewayMessage<'_>,
        device: &str,
        members: &Object,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        self.nested(message, (device, ""), members, 0, out)
    }

    fn nested(
        &mut self,
        message: &GatewayMessage<'_>,
        (device, above): (&str, &str),
        members: &Object,
        depth: usize,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        for (key, said) in members {
            let name = if above.is_empty() { key.clone() } else { format!("{above} {key}") };
            match said {
                Value::Object(inner) if depth < DEEPEST => {
                    self.nested(message, (device, &name), inner, depth + 1, out)?
                }
                Value::Object(_) | Value::Array(_) => out.count("lists in payloads that are passed over"),
                Value::Null => out.count("values that are null, which report nothing"),
                _ if TIMES.iter().any(|time| time.eq_ignore_ascii_case(key)) => {}
                said => {
                    let sensor = if device.is_empty() { name.clone() } else { format!("{device} {name}") };
                    let value = match (key.as_str(), said) {
                        ("contact", Value::Bool(is_closed)) if message.is_zigbee => {
                            out.count(
                                "values of contact that Zigbee2MQTT sends as true while a door is closed, read as OPEN and CLOSE",
                            );
                            if *is_closed { CLOSED } else { OPENED }.into()
                        }
                        _ => text(said),
                    };
                    self.reading(message, device, (&sensor, &name), &value, out)?;
                }
            }
        }
        Ok(())
    }

    fn reading(
        &mut self,
        message: &GatewayMessage<'_>,
        device: &str,
        (sensor, name): (&str, &str),
        value: &str,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        if self.is_again(message, sensor, value) {
            out.count("readings that a device sent under a second topic within a second, passed over");
            return Ok(());
        }
        if !out.knows(sensor) {
            out.know(info(sensor, name));
            self.devices.entry(device.to_owned()).or_default().insert(sensor.to_owned());
        }
        out.row(message.line, message.instant, [sensor, value], None)
    }

    /// Whether a reading has come within the second before, under another topic.
    fn is_again(&mut self, message: &GatewayMessage<'_>, sensor: &str, value: &str) -> bool {
        if !message.topic.starts_with("stat/") {
            return false;
        }
        let is_again = self.last.get(sensor).is_some_and(|(at, topic, before)| {
            topic != message.topic && before == value && (message.instant.on_wall() - at.on_wall()).abs() <= SECOND
        });
        self.last.insert(sensor.to_owned(), (message.instant, message.topic.to_owned(), value.to_owned()));
        is_again
    }

    /// Takes a payload that is a word or a number.
    fn word(
        &mut self,
        message: &GatewayMessage<'_>,
        payload: &str,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        let topic = message.topic;
        if is_no_reading(topic, out) {
            return Ok(());
        }
        if is_availability(topic) {
            return self.availability(message, &device(topic), payload, out);
        }
        match topic.strip_prefix("stat/").and_then(|rest| rest.rsplit_once('/')) {
            // So Tasmota writes what the key of an object says, too.
            Some((device, key)) => self.reading(message, device, (&format!("{device} {key}"), key), payload, out),
            None => out.row(message.line, message.instant, [topic, payload], None),
        }
    }

    /// A device that is gone: what its sensors reported is not known any more.
    fn availability(
        &mut self,
        message: &GatewayMessage<'_>,
        device: &str,
        state: &str,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        out.count("messages that a device is there or gone");
        if !state.eq_ignore_ascii_case("offline") {
            return Ok(());
        }
        for sensor in self.devices.get(device).into_iter().flatten() {
            out.row(message.line, message.instant, [sensor, UNAVAILABLE], None)?;
        }
        Ok(())
    }
}

/// Whether messages of a topic ask for something or are the bridge's own.
fn is_no_reading(topic: &str, out: &mut Gathered<'_, '_>) -> bool {
    let parts: Vec<&str> = topic.split('/').collect();
    let last = parts.last().copied().unwrap_or_default();
    let is_request = parts.len() > 1 && REQUESTS.iter().any(|request| request.eq_ignore_ascii_case(last));
    if is_request || parts[0] == "cmnd" {
        out.count("messages that ask a device for something");
        return true;
    }
    let is_tasmota = parts.len() > 1 && ["tele", "stat"].contains(&parts[0]);
    // Those of the other numbers have readings of sensors.
    let is_status = |rest: &str| !["8", "10", "11"].contains(&rest) && rest.bytes().all(|byte| byte.is_ascii_digit());
    let is_info = last.starts_with("INFO") || last.strip_prefix("STATUS").is_some_and(is_status);
    let is_bridge = parts.get(1) == Some(&"bridge") || parts.contains(&"discovery") || parts[0] == "homeassistant";
    let is_about = is_bridge || is_tasmota && is_info;
    if is_about {
        out.count("messages of a bridge or a device about itself");
    }
    is_about
}

fn is_availability(topic: &str) -> bool {
    let last = topic.rsplit('/').next().unwrap_or_default();
    topic.contains('/') && (last.eq_ignore_ascii_case("availability") || last.eq_ignore_ascii_case("lwt"))
}

/// The device that a topic names: without what all topics of its kind begin and end with.
fn device(topic: &str) -> String {
    let mut parts: Vec<&str> = topic.split('/').filter(|part| !part.is_empty()).collect();
    let is_known = parts.len() > 1 && BASES.contains(&parts[0]);
    if is_known {
        parts.remove(0);
    }
    let is_report = |part: &&str| REPORTS.iter().any(|report| report.eq_ignore_ascii_case(part));
    if parts.len() > 1 && (is_availability(topic) || is_known && parts.last().is_some_and(is_report)) {
        parts.pop();
    }
    parts.join("/")
}

/// A sensor by its key: its kind, and its unit if all devices have the same.
fn info(sensor: &str, name: &str) -> SensorInfo {
    let words: Vec<String> = name.split(' ').map(str::to_lowercase).collect();
    // All keys below `update` belong to an update, whatever they are called.
    let kind = words.iter().find(|word| *word == "update").or(words.last()).cloned().unwrap_or_default();
    let unit = UNITS.iter().find(|(key, _)| *key == kind).map(|(_, unit)| (*unit).to_owned());
    SensorInfo { is_motion: kind == "motion" || kind == "occupancy", kind, unit, ..SensorInfo::named(sensor) }
}
