//! A home that gets commands.

use crate::servers::broker::{Broker, Heard, Listener, firings, logger, store, wait_for};
use homebody_core::time::{MINUTE, RunTime};
use homebody_log::WriteMode;
use homebody_mqtt::{MqttSink, Order, Reply, TakesOrders};
use serde_json::{Value, json};
use std::sync::mpsc::{Receiver, channel};

/// Obeys all orders but the opening of things, after one minute of the run.
fn obedient() -> (TakesOrders, Receiver<Order>) {
    let (say, orders) = channel();
    let takes = move |order: Order, reply: Reply| {
        match &order {
            Order::Open { .. } => return reply.refused("nobody can open anything in this run", "close it"),
            Order::Fault { .. } | Order::Fall { .. } => reply.done_at(RunTime::START + MINUTE),
            _ => reply.done(),
        }
        say.send(order).unwrap();
    };
    (Box::new(takes), orders)
}

#[test]
fn obeys_orders_or_answers_with_the_reason() {
    let Some(broker) = Broker::start() else { return };
    let (takes, orders) = obedient();
    let sink = MqttSink::in_real_time(&broker.url("homebody")).with_orders(takes);
    let logger = logger(sink, WriteMode::Create).unwrap();
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
    let dead = say(json!({ "do": "fault", "sensor": "bed", "kind": "dead" }));
    assert_eq!((&dead["ok"], dead["sim_time"].as_str().map(str::len)), (&json!(true), Some(32)), "{dead}");
    assert_eq!(say(json!({ "do": "fall", "resident": "margaret", "minutes": 5 }))["ok"], true);
    assert_eq!(say(json!({ "do": "speed", "times": 1 }))["ok"], true);
    assert_eq!(say(json!({ "do": "open", "thing": "front door" }))["hint"], "close it");
    for (order, why) in [
        (json!({ "do": "open", "thing": "front door" }), "nobody can open anything"),
        (json!({ "do": "open", "thing": "front dor" }), "did you mean \"front door\"?"),
        (json!({ "do": "fall", "resident": "bob" }), "no resident"),
        (json!({ "do": "fall", "resident": "margaret", "minutes": -1 }), "no number from 0.02"),
        (json!({ "do": "fault", "sensor": "bed", "kind": "ill" }), "unknown variant"),
        (json!({ "do": "fault", "sensor": "bed", "kind": "dead", "minutes": 0 }), "no number above 0"),
        (json!({ "do": "fault", "sensor": "bed", "kind": "dead", "loss": 0.5 }), "of a bad_link"),
        (json!({ "do": "fault", "sensor": "../#", "kind": "dead" }), "no sensor"),
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

/// Each of many simultaneous orders is answered or counted in an answer, rows continue, and hostile names stay inside.
#[test]
fn answers_a_flood_of_orders_while_rows_continue() {
    const ORDERS: usize = 3000;
    let Some(broker) = Broker::start() else { return };
    let (takes, orders) = obedient();
    let sink = MqttSink::in_real_time(&broker.url("homebody")).with_orders(takes);
    let mut logger = logger(sink, WriteMode::Create).unwrap();
    let listener = Listener::to(&broker, "#");
    let kinds = [
        json!({ "do": "fall", "resident": "margaret", "id": "x" }).to_string(),
        json!({ "do": "open", "thing": "../../#/+/$SYS", "id": "homebody/other/command" }).to_string(),
        "{\"do\":".to_owned(),
    ];
    let lines: String = (0..ORDERS).map(|number| format!("{}\n", kinds[number % 3])).collect();
    broker.say_lines("homebody/the_studio/command", &lines);
    store(&mut logger, &firings(100));
    let answered = |heard: &Heard| -> usize {
        if !heard.topic.ends_with("/result") {
            return 0;
        }
        let (answer, among) = (heard.json(), " orders came faster");
        let many = answer["why"].as_str().unwrap_or_default().split_once(among).map(|(many, _)| many.parse().unwrap());
        many.unwrap_or(1)
    };
    wait_for("all answers", || {
        let answers = listener.heard().iter().map(answered).sum::<usize>();
        assert!(answers <= ORDERS);
        (answers == ORDERS).then_some(())
    });
    logger.finish().unwrap();
    assert_eq!(orders.try_iter().count(), ORDERS / 3);
    let heard = wait_for("all rows", || {
        let heard = listener.heard();
        (heard.iter().filter(|heard| heard.row().is_some()).count() == 100).then_some(heard)
    });
    let outside = |topic: &str| !topic.starts_with("homebody/the_studio/") && !topic.starts_with("homeassistant/");
    // But for what the listener itself has said.
    assert!(heard.iter().all(|heard| heard.topic == "probe" || !outside(&heard.topic)), "something got out");
}

#[test]
fn ignores_retained_messages_and_orders_to_others() {
    let Some(broker) = Broker::start() else { return };
    let order = r#"{"do":"stop"}"#;
    broker.say("homebody/the_studio/command", order, &["-r"]);
    let (takes, orders) = obedient();
    let logger = logger(MqttSink::in_real_time(&broker.url("homebody")).with_orders(takes), WriteMode::Create).unwrap();
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
    let logger = logger(MqttSink::in_real_time(&broker.url("homebody")), WriteMode::Create).unwrap();
    let listener = Listener::to(&broker, "#");
    broker.say("homebody/the_studio/command", r#"{"do":"pause"}"#, &[]);
    listener.wait("homebody/the_studio/command/result", "takes no orders");
    assert!(!broker.kept().iter().any(|heard| heard.payload.contains("command_topic")));
    logger.finish().unwrap();
}
