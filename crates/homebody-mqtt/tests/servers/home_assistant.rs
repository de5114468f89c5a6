//! Home Assistant's own code checks our discovery messages, where it is installed, as in `checks/homeassistant/README.md`.

use crate::servers::broker::{Broker, live, repository};
use serde_json::json;
use std::fs;
use std::process::Command;

#[test]
fn home_assistant_accepts_all_messages() {
    let python = std::env::var("HOMEBODY_HOMEASSISTANT").unwrap_or_else(|_| "python3".into());
    let import = ["-c", "import homeassistant.components.mqtt"];
    let is_there = Command::new(&python).args(import).output().is_ok_and(|output| output.status.success());
    if !is_there {
        println!("skipped: {python} has no homeassistant; HOMEBODY_HOMEASSISTANT names one that has");
        return;
    }
    let Some(broker) = Broker::start() else { return };
    for style in [
        "homeassistant",
        "homeassistant&discovery=entity",
        "zigbee2mqtt&discovery=device",
        "zigbee2mqtt&discovery=entity",
    ] {
        live(&broker.url(&format!("homebody?style={style}")), 16);
        let kept = broker.kept();
        let file = broker.folder.path().join("kept.jsonl");
        let lines =
            kept.iter().map(|heard| json!({ "topic": heard.topic, "payload": heard.payload }).to_string() + "\n");
        fs::write(&file, lines.collect::<String>()).unwrap();
        let script = repository().join("checks/homeassistant/schemas.py");
        let output = Command::new(&python).arg(script).arg(&file).output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        println!("{style}: {said}");
        assert!(output.status.success(), "{style}: {said}");
        kept.iter().for_each(|heard| broker.say(&heard.topic, "", &["-r"]));
    }
}
