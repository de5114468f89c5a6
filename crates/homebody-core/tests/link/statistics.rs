//! The frequencies of losses and delays, compared with the settings and with known values.

use super::*;
use homebody_core::ids::SensorId;
use homebody_core::random::{SpanRange, Stream};

/// Sensors that all see a constant movement: each fires every 6 to 8 s, as at TigerPlace.
fn busy(sensors: u32, days: i64) -> Vec<(RunTime, u32, Value)> {
    let mut messages = Vec::new();
    for sensor in 0..sensors {
        let mut stream = Stream::named(7, &format!("busy {sensor}"));
        let mut at = RunTime::START + stream.span(SpanRange { least: Span::ZERO, most: 7 * SECOND });
        while at < RunTime::START + days * DAY {
            messages.push((at, sensor, Value::Fire));
            at += stream.span(SpanRange { least: 6 * SECOND, most: 8 * SECOND });
        }
    }
    messages.sort_unstable_by_key(|&(at, sensor, _)| (at, sensor));
    messages
}

/// The shares of messages that collide, for 1, 2, 3, 4 and 6 sensors that are busy at once.
fn collisions(copies: u32) -> [f64; 5] {
    [1, 2, 3, 4, 6].map(|count| {
        let names: Vec<String> = (0..count).map(|index| format!("sensor {index}")).collect();
        let sensors = motion_sensors(&names.iter().map(String::as_str).collect::<Vec<_>>());
        let messages = busy(count, 4);
        let file = json!({ "radio": { "copies": copies } });
        share(&carried(file, &sensors, &messages, 5 * DAY), Loss::Collision, messages.len())
    })
}

/// The loss table of deterministic frames, reckoned apart from this program by a Monte Carlo of the same frames.
#[test]
fn collisions_of_five_and_of_nine_copies_are_as_often_as_reckoned() {
    let expected = [(5, [0.0, 0.020, 0.044, 0.070, 0.13]), (9, [0.0, 0.020, 0.056, 0.104, 0.21])];
    for (copies, expected) in expected {
        let found = collisions(copies);
        println!("{copies} copies: {found:.4?}");
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() <= 0.08 * expected, "{copies} copies: {found} instead of {expected}");
        }
    }
}

/// The control: sensors that do not share a channel do not collide.
#[test]
fn without_a_channel_nothing_collides() {
    let messages = busy(6, 1);
    let sensors = motion_sensors(&["a", "b", "c", "d", "e", "f"]);
    assert_eq!(carried(json!({}), &sensors, &messages, 2 * DAY).firings.len(), messages.len());
}

#[test]
fn shares_are_what_the_file_says() {
    let sensors = motion_sensors(&["hall"]);
    let messages = regular(0, 10 * SECOND, 100_000);
    let with = |file| carried(file, &sensors, &messages, 20 * DAY);
    let near = |found: f64, expected: f64| {
        let sd = (expected * (1.0 - expected) / 100_000.0).sqrt();
        assert!((found - expected).abs() < 4.0 * sd, "{found} instead of {expected}");
    };
    near(share(&with(json!({ "loss": 0.01 })), Loss::Radio, messages.len()), 0.01);
    near(share(&with(json!({ "misses": 0.02 })), Loss::Miss, messages.len()), 0.02);
    near(share(&with(json!({ "corruption": 0.1 })), Loss::Garbled, messages.len()), 0.1);
    let of_one = json!({ "loss": 0.01, "sensors": { "hall": { "loss": 0.2 } } });
    near(share(&with(of_one), Loss::Radio, messages.len()), 0.2);
    let of_fault = json!({ "loss": 0.1, "faults": [{ "kind": "bad_link", "sensor": "hall", "loss": 0.5 }] });
    near(share(&with(of_fault), Loss::Radio, messages.len()), 0.55);
    let twice = with(json!({ "duplicates": 0.03 }));
    let duplicates = causes(&twice).iter().filter(|provenance| provenance.trigger == Trigger::Duplicate).count();
    near(duplicates as f64 / 100_000.0, 0.03);
    assert_eq!(twice.firings.len(), messages.len() + duplicates);
}

#[test]
fn presets_lose_what_their_sources_say() {
    let sensors = motion_sensors(&["hall"]);
    let messages = regular(0, 10 * SECOND, 100_000);
    let events = ["perfect", "x10", "zigbee", "zwave"]
        .map(|preset| carried(json!({ "preset": preset, "misses": 0 }), &sensors, &messages, 20 * DAY));
    let losses = events.each_ref().map(|events| share(events, Loss::Radio, messages.len()));
    let expected = [0.0, 0.01, 0.003, 0.003];
    for (found, expected) in losses.into_iter().zip(expected) {
        assert!((found - expected).abs() < 0.0012, "{losses:?}");
    }
    // In 278 hours, one false firing in 50.
    let false_fires =
        |events: &Events| causes(events).iter().filter(|provenance| provenance.trigger == Trigger::False).count();
    let found = events.each_ref().map(false_fires);
    assert!(found[0] == 0 && found[1..].iter().all(|count| (1..16).contains(count)), "{found:?}");
}

#[test]
fn delays_are_even_over_their_range_and_messages_may_overtake() {
    let sensors = motion_sensors(&["hall"]);
    let messages = regular(0, SECOND, 50_000);
    let events = carried(json!({ "delay_s": [0.5, 2.5] }), &sensors, &messages, DAY);
    let delays: Vec<f64> = events
        .firings
        .iter()
        .zip(causes(&events))
        .map(|(firing, provenance)| (firing.at - provenance.seen_at - Span::MICROSECOND).seconds())
        .collect();
    assert!(delays.iter().all(|delay| (0.5..=2.5).contains(delay)));
    for decile in 0..10 {
        let from = 0.5 + 0.2 * f64::from(decile);
        let count = delays.iter().filter(|&&delay| (from..from + 0.2).contains(&delay)).count();
        assert!((4_700..5_300).contains(&count), "{count} between {from} and {}", from + 0.2);
    }
    assert!(events.firings.is_sorted_by_key(|firing| firing.at));
    assert!(!causes(&events).is_sorted_by_key(|provenance| provenance.seen_at), "none has overtaken another");
}

#[test]
fn a_greater_loss_loses_the_same_and_more() {
    let sensors = motion_sensors(&["hall", "bath"]);
    let mut messages = [regular(0, 10 * SECOND, 3000), regular(1, 7 * SECOND, 3000)].concat();
    messages.sort_unstable_by_key(|&(at, sensor, _)| (at, sensor));
    let with = |loss: f64| {
        let file = json!({ "preset": "zigbee", "loss": loss, "duplicates": 0.1 });
        carried(file, &sensors, &messages, DAY).firings.into_iter().map(|firing| (firing.at, firing.sensor))
    };
    let more: Vec<_> = with(0.1).collect();
    let fewer: Vec<_> = with(0.3).collect();
    assert!(fewer.len() < more.len() && fewer.iter().all(|firing| more.contains(firing)));
}

#[test]
fn a_damaged_id_is_rarely_the_id_of_another_sensor() {
    let names: Vec<String> = (0..64).map(|index| format!("sensor {index}")).collect();
    let sensors = motion_sensors(&names.iter().map(String::as_str).collect::<Vec<_>>());
    let messages = regular(5, 10 * SECOND, 50_000);
    let events = carried(json!({ "corruption": 1 }), &sensors, &messages, 20 * DAY);
    let others = events.firings.iter().filter(|firing| firing.sensor != SensorId(5)).count();
    assert_eq!(others, events.firings.len());
    // Half of them have a damaged id; as many as there are ids of other sensors out of 255 reach one.
    assert!((4_000..7_000).contains(&others), "{others}");
    assert_eq!(others + lost(&events).len(), messages.len());
}
