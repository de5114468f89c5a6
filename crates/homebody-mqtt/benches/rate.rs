//! The cost of a log into a broker, compared with a bare loop that publishes as many messages of the same size: both of quality of service
//! 1, to the same mosquitto, in turns.
//!
//! Ends with one line: `RATIO mqtt_vs_bare <median> <min>..<max>`, the rate of the log over that of the loop. A number after `--` is the
//! number of messages.

#[path = "../../homebody-core/benches/measure/spread.rs"]
mod spread;
#[path = "../tests/servers/broker.rs"]
#[allow(dead_code, reason = "tests use all of it")]
mod broker;

use broker::{Broker, firings, logger, store};
use homebody_log::WriteMode;
use homebody_mqtt::MqttSink;
use rumqttc::{Client, Event, MqttOptions, Packet, PublishOptions, QoS};
use spread::Spread;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

const ROUNDS: usize = 7;
const MESSAGES: usize = 20_000;
/// About as long as a row's message is.
const PAYLOAD_BYTES: usize = 112;
const TOPIC: &str = "bare/the_studio/hall_motion/state";

fn main() {
    let asked = std::env::args().skip(1).find_map(|arg| arg.parse().ok());
    let messages = asked.unwrap_or(MESSAGES);
    // As it comes, a broker takes 20 messages at once; with more, what the two sides cost themselves weighs more.
    let Some(broker) = Broker::with("allow_anonymous true\nmax_inflight_messages 100\nlog_type none\n") else { return };
    let mut ratios = Vec::new();
    for round in 0..ROUNDS {
        let bare_s = bare(&broker, messages);
        let log_s = log(&broker, messages);
        println!("{messages} messages: bare loop {bare_s:.2} s, log {log_s:.2} s");
        // The first round warms the machine up.
        if round > 0 {
            ratios.push(bare_s / log_s);
        }
    }
    println!("{}", Spread::of(&ratios).line("mqtt_vs_bare", 2));
}

/// A bare loop; seconds from the first message until all are acknowledged.
fn bare(broker: &Broker, messages: usize) -> f64 {
    let mut options = MqttOptions::new("bare", ("127.0.0.1".to_owned(), broker.port));
    options.set_keep_alive(15);
    let (client, mut connection) = Client::builder(options).capacity(64).build();
    let acknowledged = Arc::new(AtomicUsize::new(0));
    let counts = acknowledged.clone();
    let (say, connected) = std::sync::mpsc::channel();
    let hears = thread::spawn(move || {
        for event in connection.iter() {
            match event {
                Ok(Event::Incoming(Packet::ConnAck(_))) => say.send(()).expect("somebody waits"),
                Ok(Event::Incoming(Packet::PubAck(_))) => drop(counts.fetch_add(1, Ordering::Release)),
                Ok(_) => {}
                Err(_) => break,
            }
        }
    });
    connected.recv().expect("a connection");
    let start = Instant::now();
    for number in 0..messages {
        let mut payload = vec![b'x'; PAYLOAD_BYTES];
        payload[0] = number as u8;
        client.publish(TOPIC, payload, PublishOptions::new(QoS::AtLeastOnce).retained()).expect("a connection");
    }
    while acknowledged.load(Ordering::Acquire) < messages {
        thread::sleep(Duration::from_micros(200));
    }
    let took_s = start.elapsed().as_secs_f64();
    client.disconnect().expect("a connection");
    hears.join().expect("an end");
    took_s
}

/// The same as a log; seconds from the first row until all are durable.
fn log(broker: &Broker, messages: usize) -> f64 {
    let firings = firings(messages as u64);
    let mut logger = logger(MqttSink::in_real_time(&broker.url("homebody")), WriteMode::Create).expect("a broker");
    let start = Instant::now();
    firings.chunks(1000).for_each(|firings| store(&mut logger, firings));
    logger.make_durable().expect("a broker");
    logger.wait_durable().expect("a broker");
    let took_s = start.elapsed().as_secs_f64();
    logger.finish().expect("a broker");
    took_s
}
