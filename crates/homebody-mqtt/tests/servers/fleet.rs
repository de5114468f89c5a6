//! Many homes on one connection: each sends the messages of a single home, and is available again after an outage of the broker.

use crate::servers::broker::{Broker, Heard, Listener, firings, run, wait_for};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::UtcTime;
use homebody_log::fleet::{Fleet, FleetEvent, FleetHome, FleetLayout, FleetRow, FleetSink};
use homebody_log::{Destination, Logger, Url, WriteMode};
use homebody_mqtt::{MqttFleet, MqttSink, clean, policy};
use std::sync::Arc;

fn fleet(homes: u32) -> Arc<Fleet> {
    let layout = FleetLayout::new(run(), &LoggerFile::default()).unwrap();
    let home = |number: u32| FleetHome {
        name: format!("home{number:05}"),
        layout: 0,
        run: 1_000 + i64::from(number),
        seed: u64::from(number),
    };
    Arc::new(Fleet { first: 1, layouts: vec![layout], homes: (1..=homes).map(home).collect() })
}

fn rows(fleet: &Fleet, numbers: std::ops::Range<usize>) -> Vec<FleetEvent> {
    let firings = firings(numbers.end as u64);
    let row = |home: usize, number: usize| {
        let firing = &firings[number];
        FleetEvent::Row(FleetRow {
            seq: firing.seq,
            at: firing.at,
            due: UtcTime::EPOCH,
            home: home as u32,
            sensor: firing.sensor,
            value: firing.value,
        })
    };
    numbers.flat_map(|number| (0..fleet.homes.len()).map(move |home| (home, number))).map(|(h, n)| row(h, n)).collect()
}

fn comes(fleet: &Fleet) -> Vec<FleetEvent> {
    (0..fleet.homes.len()).map(|home| FleetEvent::Comes(home as u32)).collect()
}

fn begun(url: &Url, fleet: &Arc<Fleet>) -> MqttFleet {
    let mut sink = MqttFleet::new(url);
    sink.check(false).unwrap();
    assert_eq!(
        sink.begin(fleet, WriteMode::Create, &homebody_log::Deadline::default()).unwrap(),
        vec![0; fleet.homes.len()]
    );
    sink.tell(&comes(fleet)).unwrap();
    sink
}

fn told(listener: &Listener, below: &str) -> Vec<(String, String)> {
    let is_row = |heard: &Heard| heard.row().is_some() && heard.topic.starts_with(below);
    listener.heard().into_iter().filter(is_row).map(|heard| (heard.topic, heard.payload)).collect()
}

#[test]
fn a_home_sends_the_same_in_a_fleet_and_alone() {
    let Some(broker) = Broker::start() else { return };
    for style in ["homeassistant", "zigbee2mqtt", "plain"] {
        let (fleet, prefix) = (fleet(3), format!("many-{style}"));
        let listener = Listener::to(&broker, &format!("{prefix}/#"));
        let mut sink = begun(&broker.url(&format!("{prefix}?style={style}&discovery=off")), &fleet);
        sink.tell(&rows(&fleet, 0..40)).unwrap();
        sink.finish(UtcTime::EPOCH).unwrap();
        wait_for("all rows", || (told(&listener, &prefix).len() >= 120).then_some(()));
        let alone = Listener::to(&broker, &format!("alone-{style}/#"));
        let run = Arc::new(fleet.run_of(1));
        let url = broker.url(&format!("alone-{style}?style={style}&discovery=off"));
        let to = Destination::own("mqtt", MqttSink::in_real_time(&url), policy());
        let mut logger = Logger::open(vec![to], &LoggerFile::default(), &run, WriteMode::Create).unwrap();
        crate::servers::broker::store(&mut logger, &firings(40));
        logger.finish().unwrap();
        let below = format!("alone-{style}/home00002/");
        wait_for("all rows", || (told(&alone, &below).len() >= 40).then_some(()));
        let here = |(topic, text): (String, String)| (topic.replacen(&format!("alone-{style}"), &prefix, 1), text);
        let expected: Vec<_> = told(&alone, &below).into_iter().map(here).collect();
        assert_eq!(told(&listener, &format!("{prefix}/home00002/")), expected, "{style}");
        // The control: another home says it elsewhere, of another run.
        assert_ne!(told(&listener, &format!("{prefix}/home00001/")), expected);
    }
}

#[test]
fn homes_come_and_go_and_are_tidied_up() {
    let Some(broker) = Broker::start() else { return };
    let (fleet, url) = (fleet(2), broker.url("load"));
    let mut sink = begun(&url, &fleet);
    let status = |home: &str| {
        let kept = broker.kept();
        kept.into_iter().find(|heard| heard.topic == format!("load/{home}/status")).map(|heard| heard.payload)
    };
    assert_eq!(status("home00001").as_deref(), Some("online"));
    sink.tell(&[FleetEvent::Goes(0)]).unwrap();
    assert_eq!(status("home00001").as_deref(), Some("offline"));
    assert_eq!(status("home00002").as_deref(), Some("online"));
    assert_eq!(status("fleet00001").as_deref(), Some("online"));
    sink.finish(UtcTime::EPOCH).unwrap();
    assert_eq!(status("home00002").as_deref(), Some("offline"));
    assert_eq!(status("fleet00001").as_deref(), Some("offline"));
    let cleaned = clean(&url, false).unwrap();
    assert_eq!(cleaned.homes, ["load/fleet00001", "load/home00001", "load/home00002"]);
    assert!(broker.kept().is_empty());
    // The broker reports a fleet that dies as offline.
    let sink = begun(&url, &fleet);
    drop(sink);
    wait_for("the broker's word", || (status("fleet00001").as_deref() == Some("offline")).then_some(()));
}

#[test]
fn a_fleet_is_there_again_after_the_broker_was_away() {
    let Some(mut broker) = Broker::start() else { return };
    let fleet = fleet(3);
    let mut sink = begun(&broker.url("load?discovery=off"), &fleet);
    sink.tell(&rows(&fleet, 0..5)).unwrap();
    broker.kill();
    let more = rows(&fleet, 5..10);
    let error = sink.tell(&more).unwrap_err();
    assert!(error.passes(), "{error}");
    broker.begin();
    let listener = Listener::to(&broker, "load/#");
    while let Err(error) = sink.tell(&more) {
        assert!(error.passes(), "{error}");
    }
    wait_for("the rest", || {
        (0..3)
            .all(|home| {
                let rows: Vec<u64> = listener
                    .heard()
                    .iter()
                    .filter(|heard| heard.topic.starts_with(&format!("load/home{:05}/", home + 1)))
                    .filter_map(|heard| Some(heard.row()?.1))
                    .collect();
                (5..10).all(|row| rows.contains(&row))
            })
            .then_some(())
    });
    // It has forgotten all, and gets it again.
    listener.wait("load/home00003/status", "online");
    sink.tell(&rows(&fleet, 10..12)).unwrap();
    sink.finish(UtcTime::EPOCH).unwrap();
}

#[test]
fn refuses_urls_that_a_fleet_cannot_use() {
    let check = |url: &str, is_fast| MqttFleet::new(&url.parse().unwrap()).check(is_fast);
    assert!(check("mqtt://localhost/load", false).is_ok());
    assert!(check("mqtt://localhost/load?allow-fast=true", true).is_ok());
    for (url, is_fast, code) in
        [("mqtt://localhost/load", true, "mqtt-url::too-fast"), ("mqtt://localhost/lo+ad", false, "mqtt-url::topic")]
    {
        assert_eq!(check(url, is_fast).unwrap_err().code(), code);
    }
}
