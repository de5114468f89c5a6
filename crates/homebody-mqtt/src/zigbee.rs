//! What Zigbee2MQTT says of itself and of its devices, which programs that listen to it read.
//!
//! We say what the documents of Zigbee2MQTT list of `bridge/info`, `bridge/devices` and each device's availability, as far as there
//! is anything to say: no radio and no firmware stands behind it.

use crate::entities::{Entity, Says, Word};
use crate::place::{Place, Placed};
use crate::speech::Message;
use homebody_core::names::capitalised;
use homebody_log::RunInfo;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// Who makes all devices.
const MAKER: &str = "Homebody";

/// What the bridge says once a connection is there.
pub(crate) fn messages(place: &Place, run: &RunInfo) -> Vec<Message> {
    let devices: Vec<Value> =
        std::iter::once(coordinator(place)).chain(place.sensors.iter().map(|sensor| device(place, sensor))).collect();
    let mut messages = vec![
        Message::kept(place.topic("bridge/info"), info(place, run).to_string()),
        Message::kept(place.topic("bridge/devices"), Value::Array(devices).to_string()),
        Message::kept(place.topic("bridge/groups"), "[]"),
    ];
    messages.extend(availability(place, "online"));
    messages
}

/// Whether each device is there.
pub(crate) fn availability<'a>(place: &'a Place, state: &'a str) -> impl Iterator<Item = Message> + 'a {
    place.sensors.iter().map(move |sensor| {
        let topic = place.topic(&format!("{}/availability", sensor.level));
        Message::kept(topic, json!({ "state": state }).to_string())
    })
}

fn info(place: &Place, run: &RunInfo) -> Value {
    json!({
        "version": run.version,
        "commit": "homebody",
        "coordinator": { "ieee_address": address(&place.id), "type": "simulated", "meta": {} },
        "network": { "channel": 11, "pan_id": 6754, "extended_pan_id": "0x0000000000000000" },
        "log_level": "info",
        "permit_join": false,
        "restart_required": false,
        "config": { "mqtt": { "base_topic": place.base }, "devices": {}, "groups": {} },
        "config_schema": { "type": "object", "properties": {} },
    })
}

fn coordinator(place: &Place) -> Value {
    json!({
        "ieee_address": address(&place.id),
        "type": "Coordinator",
        "network_address": 0,
        "supported": true,
        "disabled": false,
        "friendly_name": "Coordinator",
        "definition": null,
        "endpoints": {},
        "interview_completed": true,
        "interview_state": "SUCCESSFUL",
        "interviewing": false,
    })
}

fn device(place: &Place, sensor: &Placed) -> Value {
    let id = format!("{}/{}", place.base, sensor.level);
    let exposes: Vec<Value> = sensor.device.entities.iter().map(exposed).collect();
    json!({
        "ieee_address": address(&id),
        "type": "EndDevice",
        "network_address": u16::from_be_bytes([digest(&id)[8], digest(&id)[9]]),
        "supported": true,
        "disabled": false,
        "friendly_name": sensor.level,
        "description": sensor.name,
        "manufacturer": MAKER,
        "model_id": sensor.kind,
        "definition": {
            "source": "native",
            "version": "0.0.0",
            "model": format!("simulated {}", sensor.kind.replace('_', " ")),
            "vendor": MAKER,
            "description": format!("Simulated {} sensor", sensor.kind.replace('_', " ")),
            "exposes": exposes,
            "options": [],
            "supports_ota": false,
        },
        "power_source": "Battery",
        "endpoints": {},
        "interview_completed": true,
        "interview_state": "SUCCESSFUL",
        "interviewing": false,
    })
}

/// What a device can tell, in Zigbee2MQTT's words; access 1 is that it tells it by itself.
fn exposed(entity: &Entity) -> Value {
    let value = |word: Word| match word {
        Word::Truth(truth) => Value::from(truth),
        Word::Text(text) => text.into(),
    };
    let name = entity.property;
    let mut told = json!({ "name": name, "label": label(name), "property": name, "access": 1 });
    match &entity.says {
        Says::Binary { zigbee: [on, off], .. } => {
            (told["type"], told["value_on"], told["value_off"]) = ("binary".into(), value(*on), value(*off));
        }
        Says::Number { unit } => {
            told["type"] = "numeric".into();
            if let Some(unit) = unit {
                told["unit"] = json!(unit);
            }
        }
        Says::Choice(words) => (told["type"], told["values"]) = ("enum".into(), json!(words)),
        Says::Text => told["type"] = "text".into(),
    }
    told
}

/// A property as people read it: `water_flow` is `Water flow`.
fn label(property: &str) -> String {
    capitalised(&property.replace('_', " "))
}

/// An address as radios have one, the same for the same name.
fn address(name: &str) -> String {
    let hex: String = digest(name).iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    format!("0x{hex}")
}

fn digest(name: &str) -> [u8; 32] {
    Sha256::digest(name.as_bytes()).into()
}
