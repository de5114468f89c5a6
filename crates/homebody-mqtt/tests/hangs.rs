//! A broker that stops answering, as by a half-open connection. The run notices it, all rows are heard once the broker answers again, and
//! the run ends when it is stopped.

use crate::hanging::{SOON, ended, outlived, stopped};
use crate::servers::broker::{Broker, Listener, REMEMBERS, firings, run, wait_for};
use crate::stalling::Stalling;
use homebody_log::{Destination, Policy};
use homebody_mqtt::{MqttSink, policy};
use std::collections::BTreeSet;
use std::net::TcpStream;
use std::time::Duration;

const ROWS: u64 = 60_000;

/// A proxy before a broker, and a destination there.
fn behind(broker: &Broker) -> (Stalling, Destination) {
    let port = broker.port;
    let proxy = Stalling::before(move || TcpStream::connect(("127.0.0.1", port)));
    let url = format!("mqtt://127.0.0.1:{}/homebody", proxy.port).parse().unwrap();
    (proxy, Destination::own("mqtt", MqttSink::in_real_time(&url), policy()))
}

#[test]
fn rows_of_a_hanging_broker_are_spooled_and_arrive() {
    let Some(broker) = Broker::with(REMEMBERS) else { return };
    let listener = Listener::lasting(&broker, "homebody/#");
    let (proxy, to) = behind(&broker);
    let rows = outlived(to, run(), &firings(ROWS), |is_stalled| proxy.stall(is_stalled));
    wait_for("the last row", || (listener.rows() == rows).then_some(()));
    let heard: Vec<u64> = listener.heard().iter().filter_map(|heard| Some(heard.row()?.1)).collect();
    let known: BTreeSet<u64> = heard.iter().copied().collect();
    println!("{} heard again", heard.len() - known.len());
    assert!(known.into_iter().eq(0..rows), "none is lost");
    assert!(heard.len() as u64 - rows <= 2000, "what was on its way comes again, and nothing else");
}

#[test]
fn a_hanging_broker_ends_a_run_without_retries() {
    let Some(broker) = Broker::start() else { return };
    let (proxy, to) = behind(&broker);
    let to = Destination { policy: Policy { retry_for: Duration::ZERO, ..policy() }, ..to };
    let (error, took) = ended(to, run(), &firings(ROWS), |is_stalled| proxy.stall(is_stalled));
    assert!(["mqtt::no-acknowledgement", "mqtt::no-answer", "log::no-answer"].contains(&error.code()), "{error}");
    assert!(took < SOON / 2, "{took:?}");
}

#[test]
fn a_stopped_run_does_not_wait_for_a_hanging_broker() {
    let Some(broker) = Broker::start() else { return };
    let (proxy, to) = behind(&broker);
    stopped(to, run(), &firings(ROWS), |is_stalled| proxy.stall(is_stalled));
}
