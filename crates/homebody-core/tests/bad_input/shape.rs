//! Files that do not have the shape of their schema.

use super::*;
use homebody_core::sensors::kinds::KINDS;

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_unknown_and_missing_keys() {
    check(&[
        ("home.json", r#""height_m": 2.1"#, r#""heigt_m": 2.1"#, r#"28:69: schema::unknown-key "height_m""#),
        ("home.json", r#""height_m": 2.1"#, r#""height": 2.1"#, r#"28:69: schema::unknown-key "height_m""#),
        ("home.json", r#""height_m": 2.1"#, r#""colour": "red""#, "28:69: schema::unknown-key"),
        ("home.json", r#""height_m": 0.7"#, r#""heigth_m": 0.7"#, r#"19:62: schema::unknown-key "height_m""#),
        ("home.json", r#", "height_m": 0.7"#, "", "19:5: schema::missing-key"),
        ("home.json", r#", "facing_deg": 0"#, "", "27:5: schema::missing-key"),
        ("home.json", r#""kind": "motion", "at": [0.05"#, r#""at": [0.05"#, "27:5: schema::missing-key"),
        ("home.json", r#""height_m": 2.1"#, r#""height_m": 2.1, "height_m": 2"#, "28:86: schema::duplicate-key"),
        ("scenario.json", r#""days": 2,"#, "\"days\": 2,\n  \"name\": \"again\",", "6:3: schema::duplicate-key"),
        ("logger.json", r#""kitchen motion": "A1""#, r#""kitchen motion": "A1", "kitchen motion": "A3""#,
            "5:36: schema::duplicate-key"),
        ("scenario.json", r#""days": 2,"#, "", "1:1: schema::missing-key"),
        ("ann.json", r#""name": "Ann", "#, "", "1:1: schema::missing-key"),
        ("ann.path.json", r#""start": "bed","#, "", "1:1: schema::missing-key"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#, r#"{ "activty": "breakfast" }"#,
            r#"8:9: schema::unknown-kind "activity""#),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#, r#"{ "activity": "breakfast", "wait": { "for_s": 1 } }"#,
            "8:7: schema::one-key"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#, "{}", "8:7: schema::one-key"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_wrong_types() {
    check(&[
        ("scenario.json", r#""days": 2,"#, r#""days": "2","#, "5:11: schema::wrong-type"),
        ("scenario.json", r#""days": 2,"#, r#""days": null,"#, "5:11: schema::wrong-type"),
        ("scenario.json", r#""home": "home.json""#, r#""home": ["home.json"]"#, "6:11: schema::wrong-type"),
        ("scenario.json", r#""home": "home.json""#, r#""home": null"#, "6:11: schema::wrong-type"),
        ("scenario.json", r#"["ann.json", "bob.json"]"#, r#""ann.json""#, "8:16: schema::wrong-type"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.5]"#, "23:29: schema::wrong-count"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": { "x": 0.5, "y": 1.5 }"#, "23:29: schema::wrong-type"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.5, "1.5"]"#, "23:35: schema::wrong-type"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0,5, 1,5]"#, "23:29: schema::wrong-count"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.5, "1,5"]"#, "23:35: schema::wrong-type"),
        ("home.json", r#""open": false"#, r#""open": "no""#, "16:67: schema::wrong-type"),
        ("home.json", r#"{ "name": "sink", "at": [0.5, 1.5] }"#, r#"["sink", [0.5, 1.5]]"#, "23:5: schema::wrong-type"),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": 2"#,
            "29:33: schema::wrong-type"),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": ["zones"]"#,
            "29:33: schema::wrong-type"),
        ("ann.path.json", r#""sink""#, "7", "7:34: schema::wrong-type"),
        ("ann.path.json", r#""to": [[5, 1.5], "sink"]"#, r#""to": "sink""#, "7:23: schema::wrong-type"),
        ("ann.path.json", r#""stir": { "every_s": 20, "for_s": 2 }"#, r#""stir": true"#, "9:41: schema::wrong-type"),
        ("ann.json", r#"{ "path": "ann.path.json" }"#, r#""ann.path.json""#, "1:45: schema::wrong-type"),
        // Columns count characters.
        ("home.json", r#""name": "table", "at": [2"#, r#""name": "Tischchen für Öl", "at": ["2""#, "19:42: schema::wrong-type"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_numbers_out_of_range() {
    check(&[
        ("home.json", r#""height_m": 2.1"#, r#""height_m": -2"#, "28:81: schema::out-of-range"),
        ("home.json", r#""height_m": 2.1"#, r#""height_m": 0"#, "28:81: schema::out-of-range"),
        ("home.json", r#""height_m": 2.1"#, r#""height_m": 1e308"#, "28:81: schema::out-of-range"),
        ("home.json", r#""height_m": 2.1"#, r#""height_m": 1e999"#, "28:81: schema::number-too-large"),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 1350"#, "28:100: schema::out-of-range"),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "beams": 1.5"#, "28:114: schema::not-whole"),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "beams": 0"#, "28:114: schema::out-of-range"),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "field_deg": [145, 0]"#,
            "28:124: schema::out-of-range"),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "field_deg": [145, 270]"#,
            "28:124: sensor::vertical-field"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.5, 1e308]"#, "23:35: schema::out-of-range"),
        ("scenario.json", r#""days": 2"#, r#""days": 0"#, "5:11: schema::out-of-range"),
        ("scenario.json", r#""days": 2"#, r#""days": 2, "seed": -1"#, "5:22: schema::out-of-range"),
        ("scenario.json", r#""days": 2"#, r#""days": 2, "seed": 18446744073709551616"#, "5:22: schema::out-of-range"),
        ("scenario.json", r#""days": 2"#, r#""days": 2, "seed": 0.5"#, "5:22: schema::not-whole"),
        ("home.json", r#""refire_s": [6, 8]"#, r#""refire_s": [0, 8]"#, "31:20: schema::out-of-range"),
        ("home.json", r#""persist_s": 1"#, r#""persist_s": -1"#, "31:40: schema::out-of-range"),
        ("ann.path.json", r#""for_s": 600"#, r#""for_s": 1e-308"#, "9:28: schema::out-of-range"),
        ("ann.path.json", r#""in_s": 30"#, r#""in_s": -30"#, "10:50: schema::out-of-range"),
        ("bob.keys.json", r#""at_s": 1"#, r#""at_s": -1"#, "3:15: schema::out-of-range"),
        ("ann.json", r#""pace_mps": 0.6"#, r#""pace_mps": 60"#, "1:30: schema::out-of-range"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_unknown_names_of_a_choice() {
    check(&[
        ("home.json", r#""preset": "hue""#, r#""preset": "hew""#, "29:17: schema::unknown-name"),
        ("home.json", r#""preset": "hue""#, r#""preset": "philips""#, "29:17: schema::unknown-name"),
        ("home.json", r#""ceiling_motion""#, r#""ceiling""#, r#"30:30: schema::unknown-kind "ceiling_motion""#),
        ("home.json", r#""ceiling_motion""#, r#""celing_motion""#, r#"30:30: schema::unknown-kind "ceiling_motion""#),
        ("home.json", r#""ceiling_motion""#, "3", "30:30: schema::wrong-type"),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": "zones""#,
            "29:33: schema::name-alone"),
        ("home.json", r#""height_m": 0.7 }"#, r#""height_m": 0.7, "role": "dining_seet" }"#,
            r#"19:87: schema::unknown-name "dining_seat""#),
        ("home.json", r#""height_m": 0.7 }"#, r#""height_m": 0.7, "role": 3 }"#, "19:87: schema::wrong-type"),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": "papr""#,
            r#"29:33: schema::unknown-name "paper""#),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": { "zone": {} }"#,
            r#"29:35: schema::unknown-kind "zones""#),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#,
            r#""level": { "zones": {}, "sensitivity": {} }"#,
            "29:33: schema::one-key"),
        ("logger.json", r#""time": "utc""#, r#""time": "UTC""#, r#"7:11: schema::unknown-name "utc""#),
        ("ann.path.json", r#""posture": "lying","#, r#""posture": "laying","#, r#"3:14: schema::unknown-name "lying""#),
        ("bob.keys.json", r#""fast""#, r#""faster""#, r#"3:33: schema::unknown-name "fast""#),
        ("ann.json", r#""path": "ann.path.json""#, r#""patch": "ann.path.json""#,
            r#"1:47: schema::unknown-kind "path""#),
        ("logger.json", r#""messages": { "on_off": { "hold_s": 4 } }"#, r#""messages": "on_off""#,
            "6:15: schema::name-alone"),
        ("scenario.json", r#""name": "two rooms""#, r#""name": """#, "2:11: schema::empty-text"),
    ]);
}

#[test]
fn lists_the_kinds_of_sensors_for_a_missing_kind() {
    let files = broken(&[("home.json", r#""kind": "motion", "at": [0.05"#, r#""at": [0.05"#)]);
    let kinds: Vec<&str> = KINDS.iter().map(|kind| kind.key).collect();
    assert_eq!(problems(&files).0[0].data["known"], serde_json::json!(kinds));
}
