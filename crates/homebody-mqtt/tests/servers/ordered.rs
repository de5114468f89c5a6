//! A home that is told what to do.

use crate::broker::{Broker, Listener, logger};
use homebody_log::How;
use homebody_mqtt::{MqttSink, Order, TakesOrders};
use serde_json::{Value, json};
use std::sync::mpsc::{Receiver, channel};

/// Obeys all but the opening of things.
fn obedient() -> (TakesOrders, Receiver<Order>) {
    let (say, orders) = channel();
    let takes = move |order: &Order| match order {
        Order::Open { .. } => Err("nobody can open anything in this run".into()),
        order => say.send(order.clone()).map_err(|error| error.to_string()),
    };
    (Box::new(takes), orders)
}

#[test]
fn orders_are_obeyed_or_answered_with_why_not() {
    let Some(broker) = Broker::start() else { return };
    let (takes, orders) = obedient();
    let sink = MqttSink::live(&broker.url("homebody")).with_orders(takes);
    let logger = logger(sink, How::New).unwrap();
    let listener = Listener::to(&broker, "homebody/#");
    let mut number = 0;
    let mut say = |mut order: Value| -> Value {
        number += 1;
        order["id"] = number.into();
        broker.say("homebody/the_studio/command", &order.to_string(), &[]);
        listener.wait("homebody/the_studio/command/result", &format!("\"id\":{number},")).json()
    };
    assert_eq!(say(json!({ "do": "pause" })), json!({ "id": 1, "do": "pause", "ok": true }));
    listener.wait("homebody/the_studio/running", "OFF");
    assert_eq!(say(json!({ "do": "fault", "sensor": "bed", "kind": "dead" }))["ok"], true);
    assert_eq!(say(json!({ "do": "fall", "resident": "margaret" }))["ok"], true);
    assert_eq!(say(json!({ "do": "speed", "times": 1 }))["ok"], true);
    for (order, why) in [
        (json!({ "do": "open", "thing": "front door" }), "nobody can open anything"),
        (json!({ "do": "open", "thing": "front dor" }), "did you mean \"front door\"?"),
        (json!({ "do": "fall", "resident": "bob" }), "no resident"),
        (json!({ "do": "speed", "times": 0 }), "no number from 0.1"),
        (json!({ "do": "step" }), "missing field"),
        (json!({ "do": "pause", "now": true }), "unknown field"),
        (json!({ "do": "rm -rf /" }), "unknown variant"),
    ] {
        let answer = say(order.clone());
        assert!(answer["ok"] == false && answer["why"].as_str().unwrap().contains(why), "{order}: {answer}");
    }
    broker.say("homebody/the_studio/command", "pause", &[]);
    listener.wait("homebody/the_studio/command/result", "no JSON");
    broker.say("homebody/the_studio/command", &"x".repeat(10_000), &[]);
    listener.wait("homebody/the_studio/command/result", "longer than 4096 bytes");
    logger.finish().unwrap();
    let obeyed: Vec<Order> = orders.try_iter().collect();
    assert_eq!(obeyed.len(), 4);
    assert_eq!((&obeyed[0], &obeyed[3]), (&Order::Pause {}, &Order::Speed { times: 1.0 }));
}

#[test]
fn what_others_are_told_and_what_the_broker_keeps_is_no_order() {
    let Some(broker) = Broker::start() else { return };
    let order = r#"{"do":"stop"}"#;
    broker.say("homebody/the_studio/command", order, &["-r"]);
    let (takes, orders) = obedient();
    let logger = logger(MqttSink::live(&broker.url("homebody")).with_orders(takes), How::New).unwrap();
    for topic in [
        "homebody/the_studio",
        "homebody/other/command",
        "homebody/the_studio/command/x",
        "homebody/command",
        "other/the_studio/command",
    ] {
        broker.say(topic, order, &[]);
    }
    let listener = Listener::to(&broker, "homebody/#");
    broker.say("homebody/the_studio/command", r#"{"do":"resume"}"#, &[]);
    listener.wait("homebody/the_studio/command/result", "resume");
    logger.finish().unwrap();
    assert_eq!(orders.try_iter().collect::<Vec<_>>(), [Order::Resume {}]);
}

#[test]
fn a_run_that_takes_no_orders_says_so_and_shows_no_switch() {
    let Some(broker) = Broker::start() else { return };
    let logger = logger(MqttSink::live(&broker.url("homebody")), How::New).unwrap();
    let listener = Listener::to(&broker, "#");
    broker.say("homebody/the_studio/command", r#"{"do":"pause"}"#, &[]);
    listener.wait("homebody/the_studio/command/result", "takes no orders");
    assert!(!broker.kept().iter().any(|heard| heard.payload.contains("command_topic")));
    logger.finish().unwrap();
}
