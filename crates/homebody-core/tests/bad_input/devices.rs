//! Sensors on things and in rooms that say what cannot be.

use crate::*;

/// What is said of the good home with its first sensor replaced by this one, from its line on.
fn of(sensor: &str) -> String {
    const FIRST: &str = r#"{ "name": "kitchen motion", "kind": "motion", "at": [0.05, 1.5], "facing_deg": 0 }"#;
    let sensor = format!(r#"{{ "name": "kitchen motion", {sensor} }}"#);
    said(&broken(&[("home.json", FIRST, &sensor)])).replace("home.json:", "")
}

#[test]
fn what_can_be() {
    for sensor in [
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
    ] {
        assert_eq!(of(sensor), "", "of {sensor}");
    }
}

#[test]
fn what_they_are_on_must_be_there() {
    for (sensor, expected) in [
        (
            r#""kind": "contact", "on": "font door""#,
            r#"27:58: the home has no door or piece of furniture "font door"; did you mean "front door"?"#,
        ),
        (r#""kind": "bed", "on": "bad""#, r#"27:54: the home has no piece of furniture "bad"; did you mean "bed"?"#),
        (
            r#""kind": "bed", "on": "table""#,
            r#"27:54: nobody can be where "table" stands, so that this sensor would never feel anybody; write "enterable": true for "table""#,
        ),
        (
            r#""kind": "pressure", "on": "table""#,
            r#"27:59: nobody can be where "table" stands, so that this sensor would never feel anybody; write "enterable": true for "table""#,
        ),
        (
            r#""kind": "stove_temperature", "on": "stove""#,
            r#"27:68: the home has no piece of furniture "stove"; there are "table", "bed""#,
        ),
        (
            r#""kind": "power", "on": "bedrom""#,
            r#"27:56: the home has no piece of furniture or room "bedrom"; did you mean "bedroom"?"#,
        ),
        (
            r#""kind": "flow", "on": "front door""#,
            r#"27:55: the home has no piece of furniture "front door"; there are "table", "bed""#,
        ),
        (r#""kind": "light", "room": "kitchn""#, r#"27:58: the home has no room "kitchn"; did you mean "kitchen"?"#),
        (
            r#""kind": "temperature", "room": "attic""#,
            r#"27:64: the home has no room "attic"; there are "kitchen", "bedroom""#,
        ),
        (
            r#""kind": "light", "on": "kitchen""#,
            "27:5: a light sensor needs the key \"room\"; Room that the sensor is in\n27:50: \"on\" is no key of a light sensor; its keys are \"kind\", \"name\", \"room\", \"daylight_lux\", \"lamp_lux\", \"change_percent\", \"every_s\"",
        ),
    ] {
        assert_eq!(of(sensor), expected, "of {sensor}");
    }
}

#[test]
fn limits_must_be_in_order() {
    for (sensor, expected) in [
        (
            r#""kind": "bed", "on": "bed", "levels_s": [0, 3, 3, 9]"#,
            r#"27:80: each of "levels_s" must be more than the one before, but 3 comes after 3"#,
        ),
        (
            r#""kind": "bed", "on": "bed", "levels_s": []"#,
            r#"27:73: "levels_s" must have 1 to 4 items, but has 0; Duration of a movement that reaches each level of restlessness"#,
        ),
        (
            r#""kind": "bed", "on": "bed", "pulse_bpm": [100, 30]"#,
            r#"27:74: what is low by "pulse_bpm" ends at 100, and what is high must begin above that, not at 30"#,
        ),
        (
            r#""kind": "stove_temperature", "on": "table", "on_above_c": 30"#,
            r#"27:91: "on_above_c" must be more than "off_below_c", but 30 is not more than 38"#,
        ),
        (
            r#""kind": "stove_temperature", "on": "table", "hot_c": 40"#,
            r#"27:86: "hot_c" must be more than "on_above_c", but 40 is not more than 45"#,
        ),
        (
            r#""kind": "stove_temperature", "on": "table", "off_below_c": 20"#,
            r#"27:92: "off_below_c" must be from 22.1 to 1000, but is 20"#,
        ),
        (
            r#""kind": "power", "on": "table", "readings_every_s": 60"#,
            r#"27:85: "readings_every_s" says nothing without "watts"; give what it draws while it is on as "watts""#,
        ),
        (
            r#""kind": "power", "on": "table", "watts": 3, "standby_watts": 4"#,
            r#"27:94: "standby_watts", 4, is more than "watts", 3"#,
        ),
    ] {
        assert_eq!(of(sensor), expected, "of {sensor}");
    }
}

#[test]
fn a_mat_is_convex_in_the_home_and_in_one_place() {
    for (sensor, expected) in [
        (
            r#""kind": "pressure""#,
            r#"27:5: "kitchen motion" is nowhere; give "on", a piece of furniture (a mat if at most 0.05 m high), or "area""#,
        ),
        (
            r#""kind": "pressure", "on": "bed", "area": [[1, 1], [2, 1], [2, 2]]"#,
            r#"27:74: this sensor is given in two places; give either "on" or "area""#,
        ),
        (
            r#""kind": "pressure", "area": [[1, 1], [2, 1], [1.2, 1.2], [1, 2]]"#,
            r#"27:61: the area of "kitchen motion" must be convex; make it of several convex pieces"#,
        ),
        (
            r#""kind": "pressure", "area": [[1, 1], [2, 1], [3, 1]]"#,
            r#"27:61: the area of "kitchen motion" has no area"#,
        ),
        (
            r#""kind": "pressure", "area": [[1, -1], [2, -1], [2, 2]]"#,
            r#"27:61: the area of "kitchen motion" reaches out of the home"#,
        ),
    ] {
        assert_eq!(of(sensor), expected, "of {sensor}");
    }
}
