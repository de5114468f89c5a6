//! Discovery messages, by which Home Assistant adds the home's devices.
//!
//! Each sensor is a device in the area of its room, reached by the device of the home. State and attributes are in one message: with a
//! topic of its own for attributes, Home Assistant would count each ON of a motion sensor twice, because `force_update` counts each
//! message.

use crate::address::{BrokerAddress, Discovery, Style};
use crate::entities::{Entity, EntityType};
use crate::place::{HomeTopics, SensorTopics};
use crate::speech::Message;
use homebody_core::names::capitalised;
use homebody_log::RunInfo;
use serde_json::{Map, Value, json};

const MAKER: &str = "Homebody";

/// One device, with its entities by their ids.
struct DiscoveredDevice {
    id: String,
    device: Value,
    /// By id: what kind of entity it is, and its configuration.
    entities: Vec<(String, &'static str, Map<String, Value>)>,
}

pub(crate) fn messages(address: &BrokerAddress, place: &HomeTopics, run: &RunInfo, takes_orders: bool) -> Vec<Message> {
    let sensors = place.sensors.iter().map(|sensor| discovered(address, place, run, sensor));
    let devices = std::iter::once(home(place, run, takes_orders)).chain(sensors);
    match address.discovery {
        Discovery::Off => Vec::new(),
        Discovery::Device => devices.map(|device| whole(address, run, device)).collect(),
        Discovery::Entity => devices.flat_map(|device| single(address, run, device)).collect(),
    }
}

/// One message for a device.
fn whole(
    address: &BrokerAddress,
    run: &RunInfo,
    DiscoveredDevice { id, device, entities }: DiscoveredDevice,
) -> Message {
    let component = |(id, platform, mut config): (String, &str, Map<String, Value>)| {
        config.insert("platform".into(), platform.into());
        (id, Value::Object(config))
    };
    let components: Map<String, Value> = entities.into_iter().map(component).collect();
    let payload = json!({ "device": device, "origin": origin(run), "qos": 1, "components": components });
    Message::kept(format!("{}/device/{id}/config", address.discovery_prefix), payload.to_string())
}

/// One message for each entity of a device.
fn single(
    address: &BrokerAddress,
    run: &RunInfo,
    DiscoveredDevice { device, entities, .. }: DiscoveredDevice,
) -> Vec<Message> {
    let message = |(id, platform, mut config): (String, &str, Map<String, Value>)| {
        config.insert("device".into(), device.clone());
        config.insert("origin".into(), origin(run));
        config.insert("qos".into(), 1.into());
        let topic = format!("{}/{platform}/{id}/config", address.discovery_prefix);
        Message::kept(topic, Value::Object(config).to_string())
    };
    entities.into_iter().map(message).collect()
}

fn origin(run: &RunInfo) -> Value {
    json!({ "name": MAKER, "sw_version": run.version })
}

fn home(place: &HomeTopics, run: &RunInfo, takes_orders: bool) -> DiscoveredDevice {
    let name = run.home.as_ref().unwrap_or(&run.scenario);
    let device = json!({
        "identifiers": [place.id],
        "name": format!("{} (simulated)", capitalised(name)),
        "manufacturer": MAKER,
        "model": "simulated home",
        "sw_version": run.version,
    });
    let (topic, [online, offline]) = place.status();
    let id = format!("status-of-{}", place.id);
    let connected = json!({
        "unique_id": id,
        "name": "Connected",
        "device_class": "connectivity",
        "entity_category": "diagnostic",
        "state_topic": topic,
        "payload_on": online,
        "payload_off": offline,
    });
    let mut entities = vec![(id, "binary_sensor", object(connected))];
    if takes_orders {
        let id = format!("running-of-{}", place.id);
        let mut running = object(json!({
            "unique_id": id,
            "name": "Running",
            "entity_category": "config",
            "command_topic": place.command(),
            "payload_on": r#"{"do":"resume"}"#,
            "payload_off": r#"{"do":"pause"}"#,
            "state_topic": place.topic("running"),
            "state_on": "ON",
            "state_off": "OFF",
        }));
        running.extend(availability(place, None));
        entities.push((id, "switch", running));
    }
    DiscoveredDevice { id: place.id.clone(), device, entities }
}

fn discovered(address: &BrokerAddress, place: &HomeTopics, run: &RunInfo, sensor: &SensorTopics) -> DiscoveredDevice {
    let id = format!("{}-in-{}", sensor.level, place.id);
    let mut device = object(json!({
        "identifiers": [id],
        "name": capitalised(&sensor.name),
        "manufacturer": MAKER,
        "model": format!("simulated {} sensor", sensor.kind.replace('_', " ")),
        "sw_version": run.version,
        "via_device": place.id,
    }));
    if let Some(room) = &sensor.room {
        device.insert("suggested_area".into(), capitalised(room).into());
    }
    let entity = |(index, entity): (usize, &Entity)| {
        let id = if entity.key.is_empty() { id.clone() } else { format!("{}-of-{id}", entity.key) };
        let (platform, config) = entity_of(address, place, sensor, index, entity, &id);
        (id, platform, config)
    };
    let entities = sensor.device.entities.iter().enumerate().map(entity).collect();
    DiscoveredDevice { id, device: Value::Object(device), entities }
}

/// The configuration of one entity, and its kind.
fn entity_of(
    address: &BrokerAddress,
    place: &HomeTopics,
    sensor: &SensorTopics,
    index: usize,
    entity: &Entity,
    id: &str,
) -> (&'static str, Map<String, Value>) {
    let topic = &sensor.topics[index];
    let value = match place.style {
        Style::Zigbee2Mqtt => format!("{{{{ value_json.{} }}}}", entity.property),
        Style::HomeAssistant | Style::Plain => "{{ value_json.state }}".into(),
    };
    let mut config = object(json!({
        "unique_id": id,
        "name": entity.name,
        "state_topic": topic,
        "value_template": value,
        "json_attributes_topic": topic,
    }));
    config.extend(availability(place, Some(sensor)));
    let mut add = |key: &str, value: Value| drop(config.insert(key.into(), value));
    if let Some(class) = entity.class {
        add("device_class", class.into());
    }
    let platform = match &entity.says {
        EntityType::Binary { on_only, zigbee } => {
            let [on, off] = match place.style {
                Style::Zigbee2Mqtt => zigbee.map(Value::from),
                Style::HomeAssistant | Style::Plain => ["ON".into(), "OFF".into()],
            };
            add("payload_on", on);
            add("payload_off", off);
            if *on_only {
                add("force_update", true.into());
                add("off_delay", address.off_delay_s.into());
            }
            "binary_sensor"
        }
        EntityType::Number { unit } => {
            add("state_class", "measurement".into());
            if let Some(unit) = unit {
                add("unit_of_measurement", unit.as_str().into());
            }
            "sensor"
        }
        EntityType::Choice(words) => {
            add("options", json!(words));
            "sensor"
        }
        EntityType::Text => "sensor",
    };
    (platform, config)
}

fn availability(place: &HomeTopics, sensor: Option<&SensorTopics>) -> Map<String, Value> {
    let (topic, _) = place.status();
    match (place.style, sensor) {
        (Style::Zigbee2Mqtt, sensor) => {
            let mut topics = vec![topic];
            topics.extend(sensor.map(|sensor| place.topic(&format!("{}/availability", sensor.level))));
            let state = |topic: String| json!({ "topic": topic, "value_template": "{{ value_json.state }}" });
            let all: Vec<Value> = topics.into_iter().map(state).collect();
            object(json!({ "availability": all, "availability_mode": "all" }))
        }
        (Style::HomeAssistant | Style::Plain, _) => object(json!({ "availability_topic": topic })),
    }
}

fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(object) => object,
        _ => Map::new(),
    }
}
