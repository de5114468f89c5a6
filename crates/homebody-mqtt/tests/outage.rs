//! A broker stops while 1,000 rows come a second: they go into a spool, and the listener gets all of them later.
//!
//! `HOMEBODY_OUTAGE_S` says for how many seconds; the figures in `docs/how-to/mqtt-and-home-assistant.md` are those of 60.

use crate::alone::is_alone;
use crate::outages::{MOST_MIB, Outage, most_mib};
use crate::servers::broker::{Broker, Listener, REMEMBERS, firings, run, wait_for};
use homebody_log::Destination;
use homebody_mqtt::{MqttSink, policy};
use std::collections::BTreeSet;

/// Longer than a broker is waited for before rows are put aside.
const USUAL_S: u64 = 7;

#[test]
fn a_broker_that_is_stopped_while_a_thousand_rows_come_a_second_is_told_all() {
    if !is_alone("outage::a_broker_that_is_stopped_while_a_thousand_rows_come_a_second_is_told_all", &[]) {
        return;
    }
    let Some(mut broker) = Broker::with(REMEMBERS) else { return };
    let outage = Outage::of(USUAL_S);
    let listener = Listener::lasting(&broker, "homebody/#");
    let to = Destination::own("mqtt", MqttSink::in_real_time(&broker.url("homebody")), policy());
    let rows = outage.rows();
    let turn = |is_back| if is_back { broker.begin() } else { broker.stop() };
    let most_aside = outage.live(to, run(), &firings(rows), turn);
    wait_for("the last row", || (listener.rows() == rows).then_some(()));
    let heard: Vec<u64> = listener.heard().iter().filter_map(|heard| Some(heard.row()?.1)).collect();
    let known: BTreeSet<u64> = heard.iter().copied().collect();
    println!(
        "stopped for {} s: {rows} rows, {} missing, {} heard again; {} kB put aside, {} MiB at most, with what was heard",
        outage.seconds,
        rows as usize - known.len(),
        heard.len() - known.len(),
        most_aside / 1000,
        most_mib()
    );
    assert!(known.into_iter().eq(0..rows), "none is lost");
    // Only rows in flight at the stop of the broker may come twice, with their numbers.
    assert!(heard.len() as u64 - rows <= 1000, "{} are heard again", heard.len() as u64 - rows);
    // This test keeps the messages, which after half an hour outweigh all else.
    assert!(outage.seconds > 60 || most_mib() <= MOST_MIB, "{} MiB", most_mib());
}
