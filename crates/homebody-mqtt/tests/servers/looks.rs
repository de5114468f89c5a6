//! Messages in each style, as readable golden texts; `HOMEBODY_REWRITE=1` regenerates them.

use crate::servers::broker::{Broker, Heard, Listener, firings, live, logger, repository, store, wait_for};
use homebody_log::WriteMode;
use homebody_mqtt::MqttSink;
use serde_json::{Value, json};
use std::fs;

/// The messages of a home with each kind of sensor, and those that the broker retains.
fn looks(broker: &Broker, style: &str) -> String {
    let prefix = format!("as-{}", style.split('&').next().unwrap());
    let listener = Listener::to(broker, &format!("{prefix}/#"));
    live(&broker.url(&format!("{prefix}?style={style}&discovery-prefix=found-{prefix}")), 16);
    wait_for("the last word", || listener.heard().iter().any(|heard| heard.payload.contains("offline")).then_some(()));
    let line = |heard: &Heard| format!("{}\n    {}\n", heard.topic, heard.payload);
    let heard = listener.heard();
    let rows: String =
        heard.iter().filter(|heard| heard.row().is_some() && !heard.topic.ends_with("/run")).map(line).collect();
    let mut kept = broker.kept();
    kept.retain(|heard| heard.topic.starts_with(&prefix) || heard.topic.starts_with(&format!("found-{prefix}")));
    kept.sort_by(|a, b| a.topic.cmp(&b.topic));
    let kept: String = kept.iter().map(line).collect();
    // Versions come and go, and each connection has an instance of its own.
    let text = format!("# Rows\n\n{rows}\n# Kept in the end\n\n{kept}").replace(env!("CARGO_PKG_VERSION"), "VERSION");
    let (before, rest) = text.split_once("\"instance\":\"").unwrap();
    format!("{before}\"instance\":\"INSTANCE{}", &rest[rest.find('"').unwrap()..])
}

#[test]
fn messages_look_as_before() {
    let Some(broker) = Broker::start() else { return };
    for style in ["homeassistant", "homeassistant&discovery=entity", "zigbee2mqtt&discovery=device", "plain"] {
        let found = looks(&broker, style);
        let name = style.replace("&discovery=", "-");
        let path = repository().join(format!("crates/homebody-mqtt/tests/looks/{name}.txt"));
        if std::env::var_os("HOMEBODY_REWRITE").is_some() {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, &found).unwrap();
        }
        let wanted = fs::read_to_string(&path).unwrap_or_default();
        assert_eq!(found, wanted, "{}: HOMEBODY_REWRITE=1 writes it anew", path.display());
        broker_forgets(&broker);
    }
}

/// The next style begins with nothing kept.
fn broker_forgets(broker: &Broker) {
    for heard in broker.kept() {
        broker.say(&heard.topic, "", &["-r"]);
    }
}

/// The documented examples of a door contact MCCGQ11LM and a motion sensor RTCGQ11LM: closed is true.
#[test]
fn polarity_is_that_of_each_system() {
    let Some(broker) = Broker::start() else { return };
    let said = |style: &str, topic: &str| -> Vec<Value> {
        let listener = Listener::to(&broker, &format!("as-{style}/#"));
        live(&broker.url(&format!("as-{style}?style={style}")), 16);
        let topic = format!("as-{style}/the_studio/{topic}");
        wait_for("both", || {
            let all: Vec<Value> = listener
                .heard()
                .iter()
                .filter(|heard| heard.topic == topic && heard.row().is_some())
                .map(Heard::json)
                .collect();
            (all.len() >= 2).then_some(all)
        })
    };
    let contact = said("zigbee2mqtt", "front_door");
    assert_eq!([&contact[0]["contact"], &contact[1]["contact"]], [false, true], "OPEN, then CLOSE");
    let door = said("homeassistant", "front_door/state");
    assert_eq!([&door[0]["state"], &door[1]["state"]], ["ON", "OFF"], "OPEN, then CLOSE");
    assert_eq!(door[0]["sim_time"], "2009-03-02T07:12:07.250000-06:00");
    let bed = said("zigbee2mqtt", "bed");
    let last = bed.last().unwrap();
    let told = json!({ "occupancy": last["occupancy"], "restlessness": last["restlessness"], "pulse": last["pulse"] });
    assert_eq!(told, json!({ "occupancy": false, "restlessness": 3, "pulse": "high" }), "all of a device, each time");
}

#[test]
fn retained_messages_are_the_current_state() {
    let Some(broker) = Broker::start() else { return };
    let mut logger = logger(MqttSink::in_real_time(&broker.url("homebody")), WriteMode::Create).unwrap();
    store(&mut logger, &firings(16));
    logger.make_durable().unwrap();
    logger.wait_durable().unwrap();
    let kept = broker.kept();
    let of = |topic: &str| {
        let topic = format!("homebody/the_studio/{topic}");
        kept.iter().find(|heard| heard.topic == topic).unwrap_or_else(|| panic!("{topic} is kept")).payload.clone()
    };
    assert_eq!(of("status"), "online");
    assert!(of("front_door/state").contains("\"OFF\"") && of("bed/pulse/state").contains("\"high\""));
    // A momentary ON is not retained: a later listener would take it for motion.
    assert_eq!(of("hall_motion/state"), r#"{"state":"OFF"}"#);
    drop(logger);
    wait_for("the will", || {
        broker
            .kept()
            .iter()
            .any(|heard| heard.topic.ends_with("the_studio/status") && heard.payload == "offline")
            .then_some(())
    });
}

#[test]
fn a_restarted_home_assistant_gets_all_again() {
    let Some(broker) = Broker::start() else { return };
    let mut logger = logger(MqttSink::in_real_time(&broker.url("homebody")), WriteMode::Create).unwrap();
    store(&mut logger, &firings(16));
    logger.make_durable().unwrap();
    logger.wait_durable().unwrap();
    let listener = Listener::to(&broker, "#");
    let before = listener.count();
    broker.say("homeassistant/status", "online", &[]);
    let heard = wait_for("all of it", || {
        let heard = listener.heard()[before..].to_vec();
        heard.iter().any(|heard| heard.topic.ends_with("bed/state")).then_some(heard)
    });
    let told = |topic: &str| heard.iter().any(|heard| !heard.is_kept && heard.topic == topic);
    assert!(told("homeassistant/device/the_studio-in-homebody/config"));
    assert!(told("homeassistant/device/bed-in-the_studio-in-homebody/config"));
    assert!(told("homebody/the_studio/status") && told("homebody/the_studio/bed/state"));
    logger.finish().unwrap();
}

/// No name of a sensor leads outside the prefix and its discovery.
#[test]
fn names_made_to_get_out_stay_inside() {
    use homebody_core::scenario::logger::LoggerFile;
    use homebody_log::{Destination, Logger, RunInfo};
    use std::sync::Arc;
    let Some(broker) = Broker::start() else { return };
    let names: Vec<&str> = "#,+,../x,a/b,$SYS/broker,\0,command,status,bridge,\u{e9},,a b,a_b,a-b".split(',').collect();
    let mut run = crate::servers::broker::run();
    run.home = Some("$SYS/+/#".into());
    let first = run.sensors[1].clone();
    run.sensors = names
        .iter()
        .map(|name| homebody_log::SensorInfo { name: name.to_string(), id: name.to_string(), ..first.clone() })
        .collect();
    let run: Arc<RunInfo> = Arc::new(run);
    let listener = Listener::to(&broker, "#");
    let to = Destination::own("mqtt", MqttSink::in_real_time(&broker.url("homebody")), homebody_mqtt::policy());
    let mut logger = Logger::open(vec![to], &LoggerFile::default(), &run, WriteMode::Create).unwrap();
    let firings: Vec<_> = (0..names.len() as u32)
        .map(|sensor| homebody_core::event::Firing {
            seq: u64::from(sensor),
            at: homebody_core::time::RunTime::from_micros(i64::from(sensor)),
            sensor: homebody_core::ids::SensorId(sensor),
            value: homebody_core::event::Value::Open,
        })
        .collect();
    store(&mut logger, &firings);
    logger.finish().unwrap();
    let heard = wait_for("the end", || {
        let heard = listener.heard();
        heard.iter().any(|heard| heard.payload == "offline").then_some(heard)
    });
    let of_rows: std::collections::BTreeSet<&str> =
        heard.iter().filter(|heard| heard.row().is_some()).map(|heard| heard.topic.as_str()).collect();
    assert_eq!(of_rows.len(), names.len(), "each has a topic of its own");
    let outside: Vec<&Heard> = heard
        .iter()
        .filter(|heard| heard.topic != "probe" && !heard.topic.starts_with("homebody/-24-SYS-2f--2b--2f--23-/"))
        .filter(|heard| {
            !(heard.topic.starts_with("homeassistant/device/") && heard.topic.contains("-in-homebody/config"))
        })
        .collect();
    assert_eq!(outside, Vec::<&Heard>::new());
}
