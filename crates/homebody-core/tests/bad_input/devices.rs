//! Impossible sensors on things and in rooms.

use super::*;

/// Checks the messages about the good home with its first sensor replaced by each of these, from its line on.
fn check_sensors(cases: &[(&str, &str)]) {
    const FIRST: &str = r#"{ "name": "kitchen motion", "kind": "motion", "at": [0.05, 1.5], "facing_deg": 0 }"#;
    for (sensor, expected) in cases {
        check(&[("home.json", FIRST, &format!(r#"{{ "name": "kitchen motion", {sensor} }}"#), expected)]);
    }
}

#[test]
fn accepts_devices_on_existing_parts() {
    let sound = [
        r#""kind": "contact", "on": "front door""#,
        r#""kind": "bed", "on": "bed""#,
        r#""kind": "bed", "on": "bed", "levels_s": [1], "still_s": 0"#,
        r#""kind": "stove_temperature", "on": "table", "readings_every_s": 60"#,
        r#""kind": "pressure", "on": "bed", "delay_s": 3"#,
        r#""kind": "pressure", "area": [[1, 1], [2, 1], [2, 2]]"#,
        r#""kind": "power", "on": "table", "watts": 90, "standby_watts": 0.4, "readings_every_s": 60"#,
        r#""kind": "power", "on": "kitchen""#,
        r#""kind": "flow", "on": "table", "runs_s": 60"#,
        r#""kind": "light", "room": "kitchen", "daylight_lux": 0"#,
        r#""kind": "temperature", "room": "bedroom", "step_c": 1"#,
    ];
    check_sensors(&sound.map(|sensor| (sensor, "")));
}

#[test]
fn rejects_devices_on_missing_parts() {
    check_sensors(&[
        (r#""kind": "contact", "on": "font door""#, r#"27:58: sensor::unknown-part "front door""#),
        (r#""kind": "bed", "on": "bad""#, r#"27:54: sensor::unknown-part "bed""#),
        (r#""kind": "bed", "on": "table""#, "27:54: sensor::not-enterable"),
        (r#""kind": "pressure", "on": "table""#, "27:59: sensor::not-enterable"),
        (r#""kind": "stove_temperature", "on": "stove""#, "27:68: sensor::unknown-part"),
        (r#""kind": "power", "on": "bedrom""#, r#"27:56: sensor::unknown-part "bedroom""#),
        (r#""kind": "flow", "on": "front door""#, "27:55: sensor::unknown-part"),
        (r#""kind": "light", "room": "kitchn""#, r#"27:58: sensor::unknown-part "kitchen""#),
        (r#""kind": "temperature", "room": "attic""#, "27:64: sensor::unknown-part"),
        (r#""kind": "light", "on": "kitchen""#, "27:5: schema::missing-key\n27:50: schema::unknown-key"),
    ]);
}

#[test]
fn rejects_limits_in_a_wrong_order() {
    check_sensors(&[
        (r#""kind": "bed", "on": "bed", "levels_s": [0, 3, 3, 9]"#, "27:80: sensor::levels-order"),
        (r#""kind": "bed", "on": "bed", "levels_s": []"#, "27:73: schema::wrong-count"),
        (r#""kind": "bed", "on": "bed", "pulse_bpm": [100, 30]"#, "27:74: sensor::vital-limits"),
        (r#""kind": "stove_temperature", "on": "table", "on_above_c": 30"#, "27:91: sensor::limit-order"),
        (r#""kind": "stove_temperature", "on": "table", "hot_c": 40"#, "27:86: sensor::limit-order"),
        (r#""kind": "stove_temperature", "on": "table", "off_below_c": 20"#, "27:92: schema::out-of-range"),
        (r#""kind": "power", "on": "table", "readings_every_s": 60"#, "27:85: sensor::without-watts"),
        (r#""kind": "power", "on": "table", "watts": 3, "standby_watts": 4"#, "27:94: sensor::standby-too-large"),
    ]);
}

#[test]
fn rejects_impossible_mats() {
    check_sensors(&[
        (r#""kind": "pressure""#, "27:5: sensor::no-place"),
        (r#""kind": "pressure", "on": "bed", "area": [[1, 1], [2, 1], [2, 2]]"#, "27:74: sensor::two-places"),
        (r#""kind": "pressure", "area": [[1, 1], [2, 1], [1.2, 1.2], [1, 2]]"#, "27:61: home::not-convex"),
        (r#""kind": "pressure", "area": [[1, 1], [2, 1], [3, 1]]"#, "27:61: home::no-area"),
        (r#""kind": "pressure", "area": [[1, -1], [2, -1], [2, 2]]"#, "27:61: home::reaches-out"),
    ]);
}
