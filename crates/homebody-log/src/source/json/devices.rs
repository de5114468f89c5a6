//! JSON objects in which one device reports several values at once. There are three forms: uplinks of LoRaWAN networks, with readings in
//! an inner object; messages of rtl_433, with a model and its number as the device; and events of Philips Hue, with the reading under the
//! name of its type.

use super::said::{Object, member, text};
use crate::source::columns::is_certain_sensor;
use homebody_core::sensed::{Kind, Meaning, meaning};
use serde_json::Value;

#[derive(Debug, PartialEq)]
pub(crate) struct DeviceReport {
    pub time: Value,
    pub device: String,
    /// The word that it reported as its state.
    pub state: Option<String>,
    pub readings: Object,
}

/// Keys of inner objects with the readings of an uplink, as The Things Network has them, and ChirpStack.
const PAYLOADS: [&str; 4] = ["decoded_payload", "payload_fields", "decodedPayload", "object"];

/// Keys that name the device of an uplink, and the time at which it came; the first known one counts.
const DEVICES: [&str; 7] = ["device_id", "deviceName", "device_name", "dev_id", "devEui", "devEUI", "dev_eui"];
const TIMES: [&str; 4] = ["received_at", "time", "timestamp", "reported_at"];

/// Keys that part devices of one model.
const NUMBERS: [&str; 3] = ["id", "channel", "address"];

/// Keys of a message that are about the radio.
const OF_RADIO: [&str; 7] = ["mic", "mod", "freq", "freq1", "freq2", "protocol", "brand"];

/// The most objects within each other around a reading.
const DEEPEST: usize = 4;

/// The report of a device, if an object is one. `above` finds members of the objects around it.
pub(crate) fn report<'a>(object: &Object, above: &dyn Fn(&str) -> Option<&'a Value>) -> Option<DeviceReport> {
    uplink(object).or_else(|| heard(object)).or_else(|| of_hue(object, above))
}

fn uplink(object: &Object) -> Option<DeviceReport> {
    let payload = find(object, &PAYLOADS, DEEPEST, &|said| said.is_object())?;
    let is_word = |said: &Value| said.is_number() || said.as_str().is_some_and(|text| !text.is_empty());
    Some(DeviceReport {
        time: find(object, &TIMES, DEEPEST, &is_word)?.clone(),
        device: text(find(object, &DEVICES, DEEPEST, &is_word)?).into_owned(),
        state: None,
        readings: payload.as_object()?.clone(),
    })
}

/// The first member of these names that is wanted, the outermost first; within readings none is looked for.
fn find<'o>(
    object: &'o Object,
    names: &[&str],
    deepest: usize,
    is_wanted: &dyn Fn(&Value) -> bool,
) -> Option<&'o Value> {
    let own = names.iter().find_map(|name| object.get(*name).filter(|said| is_wanted(said)));
    own.or_else(|| {
        let inner = object.iter().filter(|(key, _)| deepest > 0 && !PAYLOADS.contains(&key.as_str()));
        inner.filter_map(|(_, said)| said.as_object()).find_map(|inner| find(inner, names, deepest - 1, is_wanted))
    })
}

/// A message as rtl_433 writes it.
fn heard(object: &Object) -> Option<DeviceReport> {
    let model = object.get("model")?.as_str()?;
    let numbers: Vec<String> = NUMBERS.iter().filter_map(|key| member(object, &[key])).collect();
    if numbers.is_empty() || object.keys().any(|key| is_certain_sensor(key) || key == "value") {
        return None;
    }
    let state = object.get("state").and_then(Value::as_str).map(str::to_owned);
    // `{"opened": 1, "state": "open"}` says one thing twice.
    let is_of_state = |key: &str| matches!(meaning(key, ""), Some(Meaning::Is(Kind::Motion | Kind::Contact)));
    let is_again = |key: &str| state.is_some() && (key == "state" || is_of_state(key));
    let is_reading =
        |key: &str| !["time", "model"].contains(&key) && !NUMBERS.contains(&key) && !OF_RADIO.contains(&key);
    let readings = object.iter().filter(|(key, _)| is_reading(key) && !is_again(key));
    Some(DeviceReport {
        time: object.get("time")?.clone(),
        device: format!("{model} {}", numbers.join(" ")),
        readings: readings.map(|(key, said)| (key.clone(), said.clone())).collect(),
        state,
    })
}

/// A service of Hue in an event, whose time stands in the event around it.
fn of_hue<'a>(object: &Object, above: &dyn Fn(&str) -> Option<&'a Value>) -> Option<DeviceReport> {
    let kind = object.get("type")?.as_str()?;
    let report = format!("{kind}_report");
    let reading = [kind, report.as_str()].into_iter().find_map(|key| object.get(key)?.as_object())?;
    let said = [kind, "state", "light_level", "last_event"].into_iter().find_map(|key| reading.get(key));
    Some(DeviceReport {
        time: above("creationtime")?.clone(),
        device: member(object, &["id"])?,
        state: None,
        readings: Object::from_iter([(kind.to_owned(), said?.clone())]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn of(object: &Value) -> Option<(String, Option<String>, Vec<String>)> {
        let report = report(object.as_object()?, &|_| None)?;
        Some((report.device, report.state, report.readings.keys().cloned().collect()))
    }

    #[test]
    fn a_device_is_its_model_and_its_number_and_the_rest_are_readings() {
        let heard =
            json!({"time": "t", "model": "Tower", "id": 7, "channel": "A", "temperature_C": 18.4, "mic": "CRC"});
        assert_eq!(of(&heard), Some(("Tower 7 A".into(), None, vec!["temperature_C".into()])));
        let door = json!({"time": "t", "model": "Door", "id": 7, "cmd": 14, "opened": 1, "state": "open"});
        assert_eq!(of(&door), Some(("Door 7".into(), Some("open".into()), vec!["cmd".into()])));
        // A row names its sensor, and a device without a number is not known.
        for other in [
            json!({"time": "t", "model": "Tower", "id": 7, "sensor": "hall", "value": 1}),
            json!({"time": "t", "model": "Tower", "humidity": 45}),
        ] {
            assert_eq!(of(&other), None);
        }
    }

    #[test]
    fn the_readings_of_an_uplink_are_in_its_payload() {
        let uplink = json!({"end_device_ids": {"device_id": "pir"}, "received_at": "t",
            "uplink_message": {"f_cnt": 1, "decoded_payload": {"motion": 2, "name": "x"}, "rx_metadata": [{"rssi": -64}]}});
        assert_eq!(of(&uplink), Some(("pir".into(), None, vec!["motion".into(), "name".into()])));
        let chirp = json!({"time": "t", "deviceInfo": {"deviceName": "bath"}, "object": {"humidity": 51}});
        assert_eq!(of(&chirp), Some(("bath".into(), None, vec!["humidity".into()])));
        assert_eq!(of(&json!({"time": "t", "object": {"humidity": 51}})), None);
    }

    #[test]
    fn a_service_of_hue_has_its_time_from_around_it() {
        let service = json!({"id": "a1", "type": "motion", "motion": {"motion": true, "motion_valid": true}});
        let time = json!("2022-03-01T06:09:50Z");
        let told = report(service.as_object().unwrap(), &|_| Some(&time)).unwrap();
        assert_eq!((told.device.as_str(), &told.readings["motion"], told.time), ("a1", &json!(true), time.clone()));
        assert_eq!(of(&service), None);
    }
}
