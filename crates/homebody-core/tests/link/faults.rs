//! The effect of each fault on the messages of its sensor, and no effect on others.

use crate::*;
use homebody_core::ids::SensorId;
use homebody_core::time::Interval;

/// Two sensors that fire every ten minutes, the second a minute later, for ten days; only the first has the fault.
fn ten_days(fault: serde_json::Value) -> Events {
    let sensors = motion_sensors(&["hall", "bath"]);
    let second =
        regular(1, 600 * SECOND, 1439).into_iter().map(|(at, sensor, value)| (at + 60 * SECOND, sensor, value));
    let mut messages: Vec<_> = regular(0, 600 * SECOND, 1439).into_iter().chain(second).collect();
    messages.sort_unstable_by_key(|&(at, sensor, _)| (at, sensor));
    let events = carried(json!({ "faults": [fault] }), &sensors, &messages, 11 * DAY);
    let of_other = events.firings.iter().filter(|firing| firing.sensor == SensorId(1)).count();
    assert_eq!(of_other, 1439, "the other sensor is affected");
    events
}

/// On which days the first sensor's messages were lost, first and last, and how many were.
fn loss_days(events: &Events, loss: Loss) -> (f64, f64, usize) {
    let at: Vec<f64> =
        lost(events).iter().filter(|(.., l)| *l == loss).map(|(at, ..)| at.since_zero().ratio(DAY)).collect();
    (at.iter().copied().fold(f64::INFINITY, f64::min), at.iter().copied().fold(0.0, f64::max), at.len())
}

#[test]
fn a_battery_fades_and_is_empty_until_it_is_replaced() {
    let fault = json!({ "kind": "battery", "sensor": "hall", "from_day": 2, "fading_days": 4, "days": 6 });
    let events = ten_days(fault);
    let (first, last, count) = loss_days(&events, Loss::Battery);
    assert!(first >= 2.0 && (7.99..8.0).contains(&last), "from {first} to {last}");
    // Half of those while it fades, all of those while it is empty.
    assert!((288 + 288 - 40..288 + 288 + 40).contains(&count), "{count}");
    let empty = events
        .firings
        .iter()
        .filter(|firing| firing.sensor == SensorId(0) && (6 * DAY..8 * DAY).contains(&firing.at.since_zero()));
    assert_eq!(empty.count(), 0);
}

#[test]
fn a_stuck_sensor_repeats_itself_and_hears_nothing() {
    let events = ten_days(json!({ "kind": "stuck", "sensor": "hall", "from_day": 3, "days": 2, "every_s": 7 }));
    let (first, last, count) = loss_days(&events, Loss::Stuck);
    assert!(first >= 3.0 && last < 5.0 && count == 288, "{count} from {first} to {last}");
    let false_fires = causes(&events)
        .iter()
        .filter(|provenance| provenance.trigger == Trigger::False && provenance.resident.is_none())
        .count();
    assert_eq!(false_fires, (2 * DAY / (7 * SECOND)) as usize + 1);
    let silent = ten_days(json!({ "kind": "stuck", "sensor": "hall", "from_day": 3 }));
    assert_eq!(loss_days(&silent, Loss::Stuck).2, 1439 - 431);
    assert_eq!(silent.firings.len(), 1439 + 431);
}

#[test]
fn a_stuck_contact_repeats_what_it_said_last() {
    let sensors = [serde_json::from_value(json!({ "kind": "contact", "name": "fridge", "on": "fridge" })).unwrap()];
    let fault = |day| json!({ "faults": [{ "kind": "stuck", "sensor": "fridge", "from_day": day, "every_s": 3600 }] });
    let messages = [(RunTime::START + SECOND, 0, Value::Open), (RunTime::START + 2 * DAY, 0, Value::Close)];
    let values = |day| -> Vec<Value> {
        carried(fault(day), &sensors, &messages, 2 * DAY + SECOND).firings.iter().map(|firing| firing.value).collect()
    };
    assert_eq!(values(1.9), [Value::Open; 4]);
    // It has nothing to repeat.
    assert_eq!(values(0.0), []);
}

#[test]
fn a_fallen_sensor_sees_nothing_and_keeps_its_false_firings() {
    let sensors = motion_sensors(&["hall"]);
    let file = json!({ "false_fires_per_h": 1, "faults": [{ "kind": "falls_off", "sensor": "hall", "from_day": 1 }] });
    let events = carried(file, &sensors, &regular(0, 600 * SECOND, 1439), 10 * DAY);
    assert_eq!(loss_days(&events, Loss::Place).2, 1439 - 143);
    let after: Vec<_> =
        events.firings.iter().zip(causes(&events)).filter(|(firing, _)| firing.at >= RunTime::START + DAY).collect();
    assert!((160..270).contains(&after.len()), "{}", after.len());
    assert!(after.iter().all(|(_, provenance)| provenance.trigger == Trigger::False));
}

#[test]
fn an_outage_begins_at_its_time_of_day_and_hears_nothing() {
    let events = ten_days(json!({ "kind": "bad_link", "sensor": "hall", "loss": 0 }));
    assert_eq!(events.firings.len(), 2 * 1439);
    let sensors = motion_sensors(&["hall"]);
    let outage =
        |from_day: f64| json!({ "faults": [{ "kind": "outage", "from_day": from_day, "at": "13:00", "hours": 5 }] });
    for (from_day, day) in [(2.0, 2), (2.5, 2), (2.6, 3)] {
        let events = carried(outage(from_day), &sensors, &regular(0, 600 * SECOND, 1439), 11 * DAY);
        let from = RunTime::START + day * DAY + 13 * HOUR;
        let outage = Interval::starting(from, 5 * HOUR);
        assert_eq!(loss_days(&events, Loss::Outage).2, 30);
        assert!(events.firings.iter().all(|firing| !outage.contains(firing.at)), "from day {from_day}");
    }
}

#[test]
fn a_message_under_way_as_the_logger_stops_is_lost_and_one_that_comes_after_is_not() {
    let sensors = motion_sensors(&["hall"]);
    let file = json!({ "delay_s": [60, 60], "faults": [{ "kind": "outage", "from_day": 0.5, "hours": 1 }] });
    let messages = regular(0, 30 * SECOND, 2000);
    let events = carried(file, &sensors, &messages, DAY);
    let at = |second: i64| RunTime::START + 12 * HOUR + second * SECOND;
    let lost: Vec<RunTime> = lost(&events).iter().map(|(at, ..)| *at).collect();
    assert_eq!((lost[0], lost[lost.len() - 1], lost.len()), (at(-60), at(3600 - 90), 120));
}

#[test]
fn a_clock_of_its_own_gives_its_own_times_in_order() {
    let sensors = motion_sensors(&["hall", "bath"]);
    let messages: Vec<_> =
        (1..40).map(|index| (RunTime::START + index * SECOND, (index % 2) as u32, Value::Fire)).collect();
    let clock = |offset: f64| json!({ "faults": [{ "kind": "drift", "sensor": "hall", "offset_s": offset }] });
    let told = |offset: f64, seconds: i64| {
        let firings = carried(clock(offset), &sensors, &messages, seconds * SECOND).firings;
        firings.into_iter().map(|firing| (firing.at.since_zero() / SECOND, firing.sensor.0)).collect::<Vec<_>>()
    };
    // The hall fires in even seconds; what its clock shows is two and a half seconds less, and more.
    assert_eq!(told(-2.5, 9), [(0, 0), (1, 1), (1, 0), (3, 1), (3, 0), (5, 1), (5, 0)]);
    assert_eq!(told(2.5, 9), [(1, 1), (3, 1), (4, 0), (5, 1), (6, 0), (7, 1), (8, 0)]);
    let gains = json!({ "faults": [{ "kind": "drift", "sensor": "hall", "ppm": 100 }] });
    let days = regular(0, DAY, 30);
    let last = *times(&carried(gains, &sensors, &days, 31 * DAY)).last().unwrap();
    assert!((last - 30.0 * 86_400.0 - 259.2).abs() < 1e-6, "{last}");
}
