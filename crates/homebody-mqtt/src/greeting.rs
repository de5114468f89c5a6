//! The messages at the start of a connection, and after a restart of Home Assistant: the home, its parts, and that it is online.

use crate::address::{BrokerAddress, Style};
use crate::place::HomeTopics;
use crate::speech::{Message, clear};
use crate::{discovery, zigbee};
use homebody_log::RunInfo;
use serde_json::{Map, Value, json};

/// The mark of homes of Homebody: no other home is ever removed.
pub(crate) const PROGRAM: &str = "homebody";

pub(crate) fn greeting(
    address: &BrokerAddress,
    place: &HomeTopics,
    run: &RunInfo,
    instance: &str,
    takes_orders: bool,
) -> Vec<Message> {
    let mut all = vec![mark(place, run, instance)];
    all.extend(discovery::messages(address, place, run, takes_orders));
    if place.style == Style::Zigbee2Mqtt {
        all.extend(zigbee::messages(place, run));
    }
    if takes_orders {
        // The last message of a paused run comes after the greeting.
        all.push(Message::kept(place.topic("running"), "ON"));
    }
    let (topic, [online, _]) = place.status();
    all.push(Message::kept(topic, online));
    all
}

pub(crate) fn farewell(place: &HomeTopics) -> Vec<Message> {
    let (topic, [_, offline]) = place.status();
    let mut all = match place.style {
        Style::Zigbee2Mqtt => zigbee::availability(place, "offline").collect(),
        Style::HomeAssistant | Style::Plain => Vec::new(),
    };
    all.push(Message::kept(topic, offline));
    all
}

/// The state before the first row: motion sensors that send ON alone are clear.
pub(crate) fn at_rest(place: &HomeTopics) -> Vec<Message> {
    let is_momentary = |sensor: &&crate::place::SensorTopics| sensor.is_momentary(0);
    let at_rest =
        |sensor: &crate::place::SensorTopics| Message::kept(sensor.topics[0].as_str(), clear(place.style, sensor));
    place.sensors.iter().filter(is_momentary).map(at_rest).collect()
}

pub(crate) fn is_of_another(mark: &[u8], instance: &str) -> bool {
    let mark: Option<Value> = serde_json::from_slice(mark).ok();
    let theirs = mark.as_ref().filter(|mark| mark["program"] == PROGRAM).and_then(|mark| mark["instance"].as_str());
    theirs.is_some_and(|theirs| theirs != instance)
}

fn mark(place: &HomeTopics, run: &RunInfo, instance: &str) -> Message {
    let sensors: Map<String, Value> =
        place.sensors.iter().map(|sensor| (sensor.level.clone(), sensor.name.as_str().into())).collect();
    let mark = json!({
        "program": PROGRAM,
        "version": run.version,
        "style": place.style.name(),
        "scenario": run.scenario,
        "home": run.home,
        "run": run.id.to_string(),
        "instance": instance,
        "sensors": sensors,
    });
    Message::kept(place.topic("run"), mark.to_string())
}
