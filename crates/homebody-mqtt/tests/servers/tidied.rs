//! A broker is tidied up: of our homes nothing stays, and of others all does.

use crate::broker::{Broker, live};
use homebody_mqtt::clean;

#[test]
fn removes_only_messages_of_our_homes() {
    let Some(broker) = Broker::start() else { return };
    let others = [
        ("homebody/notes", "mine"),
        ("homebody/other/run", r#"{"program":"other"}"#),
        ("homeassistant/sensor/kitchen/config", "{}"),
        ("homeassistant/device/studio-in-homebody2/config", "{}"),
        ("elsewhere/the_studio/run", r#"{"program":"homebody"}"#),
    ];
    others.iter().for_each(|(topic, payload)| broker.say(topic, payload, &["-r"]));
    live(&broker.url("homebody"), 16);
    live(&broker.url("homebody/north?style=zigbee2mqtt&discovery=entity"), 16);
    let before = broker.kept().len();
    let looked = clean(&broker.url("homebody"), true).unwrap();
    assert_eq!(broker.kept().len(), before, "who only looks removes nothing");
    let cleaned = clean(&broker.url("homebody"), false).unwrap();
    assert_eq!(cleaned, looked);
    assert_eq!(cleaned.homes, ["homebody/north/the_studio", "homebody/the_studio"]);
    assert_eq!((cleaned.topics.len(), cleaned.others), (before - others.len(), 2));
    let mut left: Vec<String> = broker.kept().into_iter().map(|heard| heard.topic).collect();
    left.sort();
    let mut wanted = others.map(|(topic, _)| topic.to_owned());
    wanted.sort();
    assert_eq!(left, wanted);
    assert!(clean(&broker.url("homebody"), false).unwrap().topics.is_empty());
}
