//! Files that do not have the shape of their schema.

use crate::*;
use homebody_core::sensors::kinds::KINDS;

/// The kinds of sensors as messages list them.
fn kinds() -> String {
    KINDS.iter().map(|kind| format!("{:?}", kind.key)).collect::<Vec<_>>().join(", ")
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn keys() {
    check(&[
        ("home.json", r#""height_m": 2.1"#, r#""heigt_m": 2.1"#,
            r#"home.json:28:69: "heigt_m" is no key of a motion sensor; did you mean "height_m"?"#),
        ("home.json", r#""height_m": 2.1"#, r#""height": 2.1"#,
            r#"home.json:28:69: "height" is no key of a motion sensor; did you mean "height_m"?"#),
        ("home.json", r#""height_m": 2.1"#, r#""colour": "red""#,
            r#"home.json:28:69: "colour" is no key of a motion sensor; its keys are "kind", "name", "at", "height_m", "facing_deg", "tilt_deg", "field_deg", "reach_m", "beams", "level", "preset", "notice", "first_fire_s", "refire_s", "persist_s""#),
        ("home.json", r#""height_m": 0.7"#, r#""heigth_m": 0.7"#,
            r#"home.json:19:62: "heigth_m" is no key of a piece of furniture; did you mean "height_m"?"#),
        ("home.json", r#", "height_m": 0.7"#, "",
            r#"home.json:19:5: a piece of furniture needs the key "height_m"; Height of the piece"#),
        ("home.json", r#", "facing_deg": 0"#, "",
            r#"home.json:27:5: a motion sensor needs the key "facing_deg"; Direction of the lens: 0 is east, 90 is north"#),
        ("home.json", r#""kind": "motion", "at": [0.05"#, r#""at": [0.05"#,
            &format!(r#"home.json:27:5: a sensor needs the key "kind"; it is one of {}"#, kinds())),
        ("home.json", r#""height_m": 2.1"#, r#""height_m": 2.1, "height_m": 2"#,
            r#"home.json:28:86: "height_m" is given twice; it is already given on line 28"#),
        ("scenario.json", r#""days": 2,"#, "\"days\": 2,\n  \"name\": \"again\",",
            r#"scenario.json:6:3: "name" is given twice; it is already given on line 2"#),
        ("logger.json", r#""kitchen motion": "A1""#, r#""kitchen motion": "A1", "kitchen motion": "A3""#,
            r#"logger.json:5:36: "kitchen motion" is given twice; it is already given on line 5"#),
        ("scenario.json", r#""days": 2,"#, "",
            r#"scenario.json:1:1: a scenario needs the key "days"; Length of a run, unless "--for" gives another"#),
        ("ann.json", r#""name": "Ann", "#, "",
            r#"ann.json:1:1: a resident needs the key "name"; Name of the resident in the truth and in messages, unique in the scenario"#),
        ("ann.path.json", r#""start": "bed","#, "",
            r#"ann.path.json:1:1: a path needs the key "start"; Position of the resident at the start"#),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#, r#"{ "activty": "breakfast" }"#,
            r#"ann.path.json:8:9: "activty" is no kind of step; did you mean "activity"?"#),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#, r#"{ "activity": "breakfast", "wait": { "for_s": 1 } }"#,
            r#"ann.path.json:8:7: a step must have exactly one key, but has 2; its key is one of "go", "wait", "repeat", "activity", "away""#),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#, "{}",
            r#"ann.path.json:8:7: a step must have exactly one key, but has 0; its key is one of "go", "wait", "repeat", "activity", "away""#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn types() {
    check(&[
        ("scenario.json", r#""days": 2,"#, r#""days": "2","#,
            r#"scenario.json:5:11: "days" must be a number, but is the text "2"; remove the quotes"#),
        ("scenario.json", r#""days": 2,"#, r#""days": null,"#,
            r#"scenario.json:5:11: "days" must be a number, but is null; Length of a run, unless "--for" gives another"#),
        ("scenario.json", r#""home": "home.json""#, r#""home": ["home.json"]"#,
            r#"scenario.json:6:11: "home" must be a text, but is a list; File that describes the home"#),
        ("scenario.json", r#""home": "home.json""#, r#""home": null"#,
            r#"scenario.json:6:11: "home" must be a text, but is null; File that describes the home"#),
        ("scenario.json", r#"["ann.json", "bob.json"]"#, r#""ann.json""#,
            r#"scenario.json:8:16: "residents" must be a list, but is the text "ann.json"; write ["ann.json"]"#),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.5]"#,
            r#"home.json:23:29: "at" must have exactly 2 items, but has 1; Position of the point on the floor"#),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": { "x": 0.5, "y": 1.5 }"#,
            r#"home.json:23:29: "at" must be a list of 2 numbers, but is an object; Position of the point on the floor"#),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.5, "1.5"]"#,
            r#"home.json:23:35: item 2 of "at" must be a number, but is the text "1.5"; remove the quotes"#),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0,5, 1,5]"#,
            r#"home.json:23:29: "at" must have exactly 2 items, but has 4; a number has a point, not a comma: 0.5 for 0,5"#),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.5, "1,5"]"#,
            r#"home.json:23:35: item 2 of "at" must be a number, but is the text "1,5"; without quotes, a number has a point, not a comma: 0.5 for 0,5"#),
        ("home.json", r#""open": false"#, r#""open": "no""#,
            r#"home.json:16:67: "open" must be true or false, but is the text "no"; Whether the door is open"#),
        ("home.json", r#"{ "name": "sink", "at": [0.5, 1.5] }"#, r#"["sink", [0.5, 1.5]]"#,
            r#"home.json:23:5: item 1 of "places" must be an object { ... }, but is a list; A named point that a path can go to, such as "sink" or "armchair""#),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": 2"#,
            r#"home.json:29:33: "level" must be a text or an object { ... }, but is the number 2; Model of detection of a wall sensor"#),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": ["zones"]"#,
            r#"home.json:29:33: "level" must be a text or an object { ... }, but is a list; Model of detection of a wall sensor"#),
        ("ann.path.json", r#""sink""#, "7",
            r#"ann.path.json:7:34: item 2 of "to" must be a list of 2 numbers or a text, but is the number 7; A point in metres, or the name of a place in the home"#),
        ("ann.path.json", r#""to": [[5, 1.5], "sink"]"#, r#""to": "sink""#,
            r#"ann.path.json:7:23: "to" must be a list, but is the text "sink"; write ["sink"]"#),
        ("ann.path.json", r#""stir": { "every_s": 20, "for_s": 2 }"#, r#""stir": true"#,
            r#"ann.path.json:9:41: "stir" must be an object { ... }, but is true; Small movements during the stay"#),
        ("ann.json", r#"{ "path": "ann.path.json" }"#, r#""ann.path.json""#,
            r#"ann.json:1:45: "driver" must be an object { ... }, but is the text "ann.path.json"; How the resident's movements and acts are decided"#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn numbers() {
    check(&[
        ("home.json", r#""height_m": 2.1"#, r#""height_m": -2"#,
            r#"home.json:28:81: "height_m" must be more than 0 and at most 10, but is -2"#),
        ("home.json", r#""height_m": 2.1"#, r#""height_m": 0"#,
            r#"home.json:28:81: "height_m" must be more than 0 and at most 10, but is 0"#),
        ("home.json", r#""height_m": 2.1"#, r#""height_m": 1e308"#,
            r#"home.json:28:81: "height_m" must be more than 0 and at most 10, but is 1e308"#),
        ("home.json", r#""height_m": 2.1"#, r#""height_m": 1e999"#,
            r#"home.json:28:81: "height_m" is too large a number"#),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 1350"#,
            r#"home.json:28:100: "facing_deg" must be from -360 to 360, but is 1350"#),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "beams": 1.5"#,
            r#"home.json:28:114: "beams" must be a whole number, but is 1.5"#),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "beams": 0"#,
            r#"home.json:28:114: "beams" must be from 1 to 256, but is 0"#),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "field_deg": [145, 0]"#,
            r#"home.json:28:124: item 2 of "field_deg" must be from 0.1 to 360, but is 0"#),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "field_deg": [145, 270]"#,
            "home.json:28:124: the vertical angle of view must be at most 180, but is 270"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.5, 1e308]"#,
            r#"home.json:23:35: item 2 of "at" must be from -10000 to 10000, but is 1e308"#),
        ("scenario.json", r#""days": 2"#, r#""days": 0"#,
            r#"scenario.json:5:11: "days" must be from 0.00001 to 36525, but is 0"#),
        ("scenario.json", r#""days": 2"#, r#""days": 2, "seed": -1"#,
            r#"scenario.json:5:22: "seed" must be from 0 to 9007199254740991, but is -1"#),
        ("scenario.json", r#""days": 2"#, r#""days": 2, "seed": 18446744073709551616"#,
            r#"scenario.json:5:22: "seed" must be from 0 to 9007199254740991, but is 18446744073709551616"#),
        ("scenario.json", r#""days": 2"#, r#""days": 2, "seed": 0.5"#,
            r#"scenario.json:5:22: "seed" must be a whole number, but is 0.5"#),
        ("home.json", r#""refire_s": [6, 8]"#, r#""refire_s": [0, 8]"#,
            r#"home.json:31:20: item 1 of "refire_s" must be from 0.01 to 86400, but is 0"#),
        ("home.json", r#""persist_s": 1"#, r#""persist_s": -1"#,
            r#"home.json:31:40: "persist_s" must be from 0 to 86400, but is -1"#),
        ("ann.path.json", r#""for_s": 600"#, r#""for_s": 1e-308"#,
            r#"ann.path.json:9:28: "for_s" must be from 0.000001 to 3200000000, but is 1e-308"#),
        ("ann.path.json", r#""in_s": 30"#, r#""in_s": -30"#,
            r#"ann.path.json:10:50: "in_s" must be from 0.000001 to 3200000000, but is -30"#),
        ("bob.keys.json", r#""at_s": 1"#, r#""at_s": -1"#,
            r#"bob.keys.json:3:15: "at_s" must be from 0 to 3200000000, but is -1"#),
        ("ann.json", r#""pace_mps": 0.6"#, r#""pace_mps": 60"#,
            r#"ann.json:1:30: "pace_mps" must be from 0.01 to 5, but is 60"#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn names_of_a_list() {
    check(&[
        ("home.json", r#""preset": "hue""#, r#""preset": "hew""#,
            r#"home.json:29:17: "preset" cannot be "hew"; it is one of "paper", "x10_ms16a", "casas_pulse", "casas_follow", "aqara", "hue", "aqara_p1", "fibaro", "aeotec""#),
        ("home.json", r#""preset": "hue""#, r#""preset": "philips""#,
            r#"home.json:29:17: "preset" cannot be "philips"; it is one of "paper", "x10_ms16a", "casas_pulse", "casas_follow", "aqara", "hue", "aqara_p1", "fibaro", "aeotec""#),
        ("home.json", r#""ceiling_motion""#, r#""ceiling""#,
            r#"home.json:30:30: "ceiling" is no kind of sensor; did you mean "ceiling_motion"?"#),
        ("home.json", r#""ceiling_motion""#, r#""celing_motion""#,
            r#"home.json:30:30: "celing_motion" is no kind of sensor; did you mean "ceiling_motion"?"#),
        ("home.json", r#""ceiling_motion""#, "3",
            &format!(r#"home.json:30:30: "kind" must be a text, but is the number 3; it is one of {}"#, kinds())),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": "zones""#,
            r#"home.json:29:33: "zones" needs more than its name; write { "zones": ... }"#),
        ("home.json", r#""height_m": 0.7 }"#, r#""height_m": 0.7, "role": "dining_seet" }"#,
            r#"home.json:19:87: "role" cannot be "dining_seet"; did you mean "dining_seat"?"#),
        ("home.json", r#""height_m": 0.7 }"#, r#""height_m": 0.7, "role": 3 }"#,
            r#"home.json:19:87: "role" must be a text, but is the number 3; Role of the piece, whatever its name"#),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": "papr""#,
            r#"home.json:29:33: "level" cannot be "papr"; did you mean "paper"?"#),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#, r#""level": { "zone": {} }"#,
            r#"home.json:29:35: "zone" is no kind of level; did you mean "zones"?"#),
        ("home.json", r#""level": { "sensitivity": { "threshold_deg": 2 } }"#,
            r#""level": { "zones": {}, "sensitivity": {} }"#,
            r#"home.json:29:33: a level must have exactly one key, but has 2; its key is one of "sensitivity", "zones""#),
        ("logger.json", r#""time": "utc""#, r#""time": "UTC""#,
            r#"logger.json:7:11: "time" cannot be "UTC"; did you mean "utc"?"#),
        ("ann.path.json", r#""posture": "lying","#, r#""posture": "laying","#,
            r#"ann.path.json:3:14: "posture" cannot be "laying"; did you mean "lying"?"#),
        ("bob.keys.json", r#""fast""#, r#""faster""#,
            r#"bob.keys.json:3:33: item 2 of "held" cannot be "faster"; did you mean "fast"?"#),
        ("ann.json", r#""path": "ann.path.json""#, r#""patch": "ann.path.json""#,
            r#"ann.json:1:47: "patch" is no kind of driver; did you mean "path"?"#),
        ("logger.json", r#""messages": { "on_off": { "hold_s": 4 } }"#, r#""messages": "on_off""#,
            r#"logger.json:6:15: "on_off" needs more than its name; write { "on_off": ... }"#),
        ("scenario.json", r#""name": "two rooms""#, r#""name": """#,
            r#"scenario.json:2:11: "name" must not be empty"#),
    ]);
}
