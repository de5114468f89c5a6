//! What a broker is told when a connection is there, and when Home Assistant has begun anew: what the home is, what it has, and
//! that it is there.

use crate::address::{Address, Style};
use crate::place::Place;
use crate::speech::{Message, clear};
use crate::{discovery, zigbee};
use homebody_log::RunInfo;
use serde_json::{Map, Value, json};

/// The mark by which a home is known as one of ours: nothing else is ever cleared.
pub(crate) const PROGRAM: &str = "homebody";

/// What is said at each beginning.
pub(crate) fn greeting(
    address: &Address,
    place: &Place,
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
        // Of a run that is paused, what was said of it last comes after the greeting.
        all.push(Message::kept(place.topic("running"), "ON"));
    }
    let (topic, [online, _]) = place.status();
    all.push(Message::kept(topic, online));
    all
}

/// What is said at the end.
pub(crate) fn farewell(place: &Place) -> Vec<Message> {
    let (topic, [_, offline]) = place.status();
    let mut all = match place.style {
        Style::Zigbee2Mqtt => zigbee::availability(place, "offline").collect(),
        Style::HomeAssistant | Style::Plain => Vec::new(),
    };
    all.push(Message::kept(topic, offline));
    all
}

/// What is so before anything is said: motion sensors that only say ON are clear.
pub(crate) fn at_rest(place: &Place) -> Vec<Message> {
    let is_momentary = |sensor: &&crate::place::Placed| sensor.is_momentary(0);
    let at_rest = |sensor: &crate::place::Placed| Message::kept(sensor.topics[0].as_str(), clear(place.style, sensor));
    place.sensors.iter().filter(is_momentary).map(at_rest).collect()
}

/// Whether a mark is of another program than the one of this instance.
pub(crate) fn is_of_another(mark: &[u8], instance: &str) -> bool {
    let mark: Option<Value> = serde_json::from_slice(mark).ok();
    let theirs = mark.as_ref().filter(|mark| mark["program"] == PROGRAM).and_then(|mark| mark["instance"].as_str());
    theirs.is_some_and(|theirs| theirs != instance)
}

fn mark(place: &Place, run: &RunInfo, instance: &str) -> Message {
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
