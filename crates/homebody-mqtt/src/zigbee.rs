//! The messages of Zigbee2MQTT about itself and its devices, which programs that listen to it read.
//!
//! They follow the documents of Zigbee2MQTT for `bridge/info`, `bridge/devices` and each device's availability, as far as possible without
//! radio and firmware.

use crate::entities::{Entity, EntityType};
use crate::place::{HomeTopics, SensorTopics};
use crate::speech::Message;
use homebody_core::names::capitalised;
use homebody_log::RunInfo;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

const MAKER: &str = "Homebody";

/// The messages of the bridge at the start of a connection.
pub(crate) fn messages(place: &HomeTopics, run: &RunInfo) -> Vec<Message> {
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

pub(crate) fn availability<'a>(place: &'a HomeTopics, state: &'a str) -> impl Iterator<Item = Message> + 'a {
    place.sensors.iter().map(move |sensor| {
        let topic = place.topic(&format!("{}/availability", sensor.level));
        Message::kept(topic, json!({ "state": state }).to_string())
    })
}

fn info(place: &HomeTopics, run: &RunInfo) -> Value {
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

fn coordinator(place: &HomeTopics) -> Value {
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

fn device(place: &HomeTopics, sensor: &SensorTopics) -> Value {
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

/// The abilities of a device, in Zigbee2MQTT's words; access 1 means that it reports by itself.
fn exposed(entity: &Entity) -> Value {
    let name = entity.property;
    let mut told = json!({ "name": name, "label": label(name), "property": name, "access": 1 });
    match &entity.says {
        EntityType::Binary { zigbee: [on, off], .. } => {
            (told["type"], told["value_on"], told["value_off"]) = ("binary".into(), (*on).into(), (*off).into());
        }
        EntityType::Number { unit } => {
            told["type"] = "numeric".into();
            if let Some(unit) = unit {
                told["unit"] = json!(unit);
            }
        }
        EntityType::Choice(words) => (told["type"], told["values"]) = ("enum".into(), json!(words)),
        EntityType::Text => told["type"] = "text".into(),
    }
    told
}

/// A property as people read it: `water_flow` is `Water flow`.
fn label(property: &str) -> String {
    capitalised(&property.replace('_', " "))
}

fn address(name: &str) -> String {
    let hex: String = digest(name).iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    format!("0x{hex}")
}

fn digest(name: &str) -> [u8; 32] {
    Sha256::digest(name.as_bytes()).into()
}
