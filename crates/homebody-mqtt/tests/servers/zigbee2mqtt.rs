//! A home in the style of Zigbee2MQTT, read as its listeners read it: by the bridge's description of its devices. Its own code is asked
//! too, if it is installed as `checks/zigbee2mqtt/README.md` describes.

use crate::servers::broker::{Broker, Heard, firings, live, repository};
use serde_json::{Value, json};
use std::fs;
use std::process::Command;

fn kept(broker: &Broker) -> Vec<Heard> {
    live(&broker.url("zigbee2mqtt?style=zigbee2mqtt"), firings(16).len() as u64);
    broker.kept()
}

const BASE: &str = "zigbee2mqtt/the_studio";

fn fits(expose: &Value, said: &Value) -> bool {
    match expose["type"].as_str().unwrap() {
        "binary" => *said == expose["value_on"] || *said == expose["value_off"],
        "numeric" => said.is_number(),
        "enum" => expose["values"].as_array().unwrap().contains(said),
        _ => said.is_string(),
    }
}

#[test]
fn zigbee2mqtt_listeners_understand_our_devices() {
    let Some(broker) = Broker::start() else { return };
    let kept = kept(&broker);
    let said = |topic: &str| -> Value {
        let heard = kept.iter().find(|heard| heard.topic == format!("{BASE}/{topic}"));
        heard.unwrap_or_else(|| panic!("nothing on {topic}")).json()
    };
    assert_eq!(said("bridge/state"), json!({ "state": "offline" }), "the run is over");
    assert_eq!(said("bridge/info")["config"]["mqtt"]["base_topic"], BASE);
    let devices = said("bridge/devices");
    let (mut told, mut values) = (0, 0);
    let mut addresses = Vec::new();
    for device in devices.as_array().unwrap() {
        let address = device["ieee_address"].as_str().unwrap();
        assert!(address.len() == 18 && address.starts_with("0x"), "{address}");
        addresses.push(address);
        if device["type"] == "Coordinator" {
            continue;
        }
        for key in ["supported", "interview_completed"] {
            assert_eq!(device[key], true, "{device}");
        }
        let name = device["friendly_name"].as_str().unwrap();
        assert_eq!(said(&format!("{name}/availability")), json!({ "state": "offline" }));
        let last = kept.iter().find(|heard| heard.topic == format!("{BASE}/{name}")).map(Heard::json);
        for expose in device["definition"]["exposes"].as_array().unwrap() {
            assert!(expose["label"].is_string() && expose["access"] == 1, "{expose}");
            let value = last.as_ref().map_or(&Value::Null, |last| &last[expose["property"].as_str().unwrap()]);
            assert!(value.is_null() || fits(expose, value), "{name}: {expose} and {value}");
            told += 1;
            values += u32::from(!value.is_null());
        }
    }
    assert!(told >= 12 && values >= 10, "{told} properties, of which {values} have a value");
    addresses.sort_unstable();
    addresses.dedup();
    assert_eq!(addresses.len(), devices.as_array().unwrap().len(), "each has an address of its own");
    // The control: a contact that says what it is as the log does would not be understood.
    let contact = json!({ "type": "binary", "value_on": false, "value_off": true });
    assert!(fits(&contact, &json!(false)) && !fits(&contact, &json!("OPEN")));
}

#[test]
fn zigbee2mqtt_accepts_our_messages() {
    let Ok(modules) = std::env::var("HOMEBODY_ZIGBEE2MQTT") else {
        println!("skipped: HOMEBODY_ZIGBEE2MQTT names no node_modules with zigbee2mqtt");
        return;
    };
    let Some(broker) = Broker::start() else { return };
    let file = broker.folder.path().join("kept.jsonl");
    let line = |heard: &Heard| json!({ "topic": heard.topic, "payload": heard.payload }).to_string() + "\n";
    let kept: String = kept(&broker).iter().map(line).collect();
    let judged = |kept: &str| {
        fs::write(&file, kept).unwrap();
        let script = repository().join("checks/zigbee2mqtt/check.mjs");
        let output = Command::new("node").arg(script).arg(&modules).arg(&file).arg(BASE).output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        (output.status.success(), said)
    };
    let (agrees, said) = judged(&kept);
    println!("{said}");
    assert!(agrees, "{said}");
    // The control: other words, kinds and keys are found.
    for (ours, others) in [
        (r#"\"contact\":true"#, r#"\"contact\":\"CLOSE\""#),
        (r#"\"unit\":\"lx\""#, r#"\"unit\":\"lux\""#),
        (r#"\"interview_state\":\"SUCCESSFUL\""#, r#"\"interview_state\":\"DONE\""#),
    ] {
        assert!(kept.contains(ours), "{ours}");
        assert!(!judged(&kept.replace(ours, others)).0, "{others} is taken");
    }
}
