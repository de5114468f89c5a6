//! Every row arrives, whatever happens to the broker, with its run and its number.

use crate::servers::broker::{Broker, Listener, REMEMBERS, firings, live, logger, run, store, wait_for};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::{Destination, Logger, Watermark, WriteMode};
use homebody_mqtt::{MqttSink, policy};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// The number of kills; `HOMEBODY_KILLS` overrides it.
const KILLS: u64 = 3;

fn kills() -> u64 {
    std::env::var("HOMEBODY_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(KILLS)
}

#[test]
fn every_row_arrives_once_and_in_order() {
    let Some(broker) = Broker::start() else { return };
    for style in ["homeassistant", "zigbee2mqtt", "plain"] {
        let listener = Listener::to(&broker, &format!("as-{style}/#"));
        live(&broker.url(&format!("as-{style}?style={style}")), 2000);
        let rows = wait_for("all rows", || {
            let rows: Vec<u64> = listener.heard().iter().filter_map(|heard| Some(heard.row()?.1)).collect();
            (rows.len() >= 2000).then_some(rows)
        });
        assert_eq!(rows, (0..2000).collect::<Vec<_>>(), "{style}");
        let runs: BTreeSet<String> = listener.heard().iter().filter_map(|heard| Some(heard.row()?.0)).collect();
        assert_eq!(runs, BTreeSet::from([run().id.to_string()]));
    }
}

/// The broker remembers its listeners. It passes a row on before it acknowledges it, as far as listeners take it, so it is killed only
/// while one listens.
#[test]
fn every_row_arrives_despite_killed_brokers() {
    let Some(mut broker) = Broker::with(REMEMBERS) else { return };
    let listener = Listener::lasting(&broker, "homebody/#");
    let mut logger = logger(MqttSink::in_real_time(&broker.url("homebody")), WriteMode::Create).unwrap();
    let all = firings(10_000_000);
    let mut steps = all.chunks(10);
    let mut rows = 0;
    let mut step = |logger: &mut homebody_log::Logger| {
        let firings = steps.next().expect("enough rows for all kills");
        store(logger, firings);
        rows += firings.len() as u64;
        thread::sleep(Duration::from_millis(10));
        rows
    };
    for kill in 0..kills() {
        // Once a row of before is heard, the listener is back; once one of since then is, it has all that was kept for it while it
        // was away. Then the kill, at any moment.
        let since = Instant::now();
        for _ in ["it is back", "it has all"] {
            let begun = step(&mut logger);
            while listener.rows() <= begun {
                step(&mut logger);
                assert!(since.elapsed() < crate::servers::broker::SOON, "rows are heard again");
            }
        }
        let heard = Instant::now();
        while heard.elapsed() < Duration::from_millis(kill * 7919 % 400) {
            step(&mut logger);
        }
        broker.kill();
        (0..3 + kill % 5).for_each(|_| assert!(step(&mut logger) > 0));
        broker.begin();
    }
    let rows = step(&mut logger);
    logger.finish().unwrap();
    wait_for("the last row", || (listener.rows() == rows).then_some(()));
    let heard = heard_rows(&listener);
    let missing: Vec<u64> = (0..rows).filter(|row| !heard.contains_key(row)).collect();
    let all: usize = listener.heard().iter().filter(|heard| heard.row().is_some()).count();
    println!("{} kills, {rows} rows, {} missing, {} heard again", kills(), missing.len(), all - heard.len());
    assert!(missing.is_empty(), "the first of them: {:?}", &missing[..missing.len().min(10)]);
    assert!(heard.values().all(|said| said.len() == 1), "what is heard again is the same");
}

/// By number, the topic and text.
fn heard_rows(listener: &Listener) -> BTreeMap<u64, BTreeSet<(String, String)>> {
    let mut rows: BTreeMap<u64, BTreeSet<(String, String)>> = BTreeMap::new();
    for heard in listener.heard() {
        if let Some((_, seq)) = heard.row() {
            rows.entry(seq).or_default().insert((heard.topic, heard.payload));
        }
    }
    rows
}

#[test]
fn a_row_is_durable_once_it_is_acknowledged_and_not_before() {
    let Some(mut broker) = Broker::start() else { return };
    let mut logger = logger(MqttSink::in_real_time(&broker.url("homebody")), WriteMode::Create).unwrap();
    let all = firings(400);
    store(&mut logger, &all[..200]);
    logger.make_durable().unwrap();
    logger.wait_durable().unwrap();
    assert_eq!(logger.durable(), Watermark(vec![200]));
    broker.kill();
    store(&mut logger, &all[200..]);
    logger.make_durable().unwrap();
    thread::sleep(Duration::from_millis(500));
    assert_eq!(logger.durable(), Watermark(vec![200]), "nobody has acknowledged more");
    broker.begin();
    logger.wait_durable().unwrap();
    assert_eq!(logger.durable(), Watermark(vec![400]));
    logger.finish().unwrap();
}

/// Confirmed rows are noted in a folder, if there is one, as in that of a run.
#[test]
fn a_resumed_run_sends_unacknowledged_rows_or_all() {
    let Some(broker) = Broker::start() else { return };
    for (prefix, folder, again) in [("kept", Some(broker.folder.path()), 200..300), ("forgotten", None, 0..300)] {
        let url = broker.url(prefix);
        let logger = |how| {
            let to = Destination::own("mqtt", MqttSink::in_real_time(&url), policy());
            let to = match folder {
                Some(folder) => to.remembered_in(folder),
                None => to,
            };
            Logger::open(vec![to], &LoggerFile::default(), &Arc::new(run()), how).unwrap()
        };
        let mut first = logger(WriteMode::Create);
        store(&mut first, &firings(200));
        first.finish().unwrap();
        let listener = Listener::to(&broker, "#");
        let mut second = logger(WriteMode::Resume);
        store(&mut second, &firings(300));
        second.finish().unwrap();
        wait_for("the end", || {
            listener.heard().iter().any(|heard| !heard.is_kept && heard.payload == "offline").then_some(())
        });
        let base = listener.heard();
        let mut rows: Vec<u64> =
            base.iter().filter(|heard| !heard.is_kept).filter_map(|heard| Some(heard.row()?.1)).collect();
        rows.dedup();
        assert_eq!(rows, again.collect::<Vec<_>>());
    }
}
