//! Files of the right shape with impossible values.

use super::*;

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_wrong_values_of_a_scenario() {
    check(&[
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""2 March 2009""#, "3:12: time::invalid-start"),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""2009-02-30T00:00:00""#, "3:12: time::invalid-start"),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""2009-03-02T00:00:00-06:00""#, "3:12: time::zone-in-start"),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""0009-03-02T00:00:00""#, "3:12: time::year"),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""-009999-01-01T00:00:00""#, "3:12: time::year"),
        ("scenario.json", r#""2009-03-02T00:00:00""#, r#""2009-03-08T02:30:00""#, "3:12: time::skipped"),
        ("scenario.json", r#""America/Chicago""#, r#""America/Chicgo""#,
            r#"4:16: time::unknown-zone "America/Chicago""#),
        ("scenario.json", r#""America/Chicago""#, r#""here""#, "4:16: time::unknown-zone"),
        ("scenario.json", "\"2009-03-02T00:00:00\",\n  \"time_zone\": \"America/Chicago\"",
            "\"noon\",\n  \"time_zone\": \"Chicago\"",
            "3:12: time::invalid-start\n4:16: time::unknown-zone \"America/Chicago\""),
        ("scenario.json", r#""home.json""#, r#""hom.json""#, r#"6:11: file::not-found "home.json""#),
        ("scenario.json", r#""home.json""#, r#""../home.json""#, "6:11: file::outside-folder"),
        ("scenario.json", r#""home.json""#, r#""/etc/passwd""#, "6:11: file::outside-folder"),
        ("scenario.json", r#""home.json""#, r#""C:home.json""#, "6:11: file::outside-folder"),
        ("scenario.json", r#""home.json""#, r#""""#, "6:11: file::empty-name"),
        ("scenario.json", r#""home.json""#, r#""ann.json""#, "6:11: file::wrong-kind"),
        ("scenario.json", r#""home.json""#, r#""scenario.json""#, "6:11: file::two-uses"),
        ("scenario.json", r#"["ann.json", "bob.json"]"#, r#"["ann.json", "ann.json"]"#, "8:29: file::linked-twice"),
        ("scenario.json", r#"["ann.json", "bob.json"]"#, r#"["ann.json", "ann.path.json"]"#, "8:29: file::two-uses"),
        ("scenario.json", r#"["ann.json", "bob.json"]"#, r#"["ann.json", "bob.keys.json"]"#, "8:29: file::wrong-kind"),
        ("scenario.json", r#""name": "two rooms""#, r#""name": " ""#, "2:11: name::blank"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_impossible_rooms_walls_and_doors() {
    check(&[
        ("home.json", r#""to": [8, 0] }"#, r#""to": [0, 0] }"#, "8:29: home::wall-without-length"),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[2, 0], [4, 0]]", "4:37: home::no-area"),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 3], [4, 0], [0, 3]]", "4:37: home::crosses-itself"),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 0], [4, 3], [0, 3], [0, 0]]", "4:70: home::repeated-corner"),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 0], [4, 0], [4, 3], [0, 3]]", "4:54: home::repeated-corner"),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 0], [4, 3], [4, 5], [4, 3], [0, 3]]",
            "4:37: home::crosses-itself"),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4.5, 0], [4.5, 3], [0, 3]]", "5:37: home::rooms-overlap"),
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4, 0]]", "4:37: schema::wrong-count"),
        ("home.json", r#""to": [8, 3] }"#, r#""to": [8, 3000] }"#, "9:29: home::too-large"),
        ("home.json", r#""from": [4, 1], "to": [4, 2]"#, r#""from": [4.5, 1], "to": [4.2, 2]"#,
            "15:39: home::door-off-wall"),
        ("home.json", r#""from": [4, 1], "to": [4, 2]"#, r#""from": [4, 1], "to": [4, 1]"#,
            "15:53: home::door-without-width"),
        ("home.json", r#""from": [4, 1], "to": [4, 2]"#, r#""from": [4, 1], "to": [5, 0]"#,
            "15:39: home::door-off-wall"),
        ("home.json", r#""name": "front door", "from": [1, 0], "to": [2, 0]"#,
            r#""name": "front door", "from": [4, 1.9], "to": [4, 2.5]"#,
            "16:37: home::doors-overlap"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_impossible_furniture() {
    check(&[
        ("home.json", r#""height_m": 0.7 }"#, r#""height_m": 0.7, "role": "bed" }"#, "19:87: home::not-enterable"),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8]"#, r#""at": [2, 2.2]"#, "19:5: home::incomplete-form"),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8], "h"#, r#""size_m": [1.2, 0.8], "h"#,
            "19:5: home::incomplete-form"),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8], "h"#, r#""h"#, "19:5: home::incomplete-form"),
        ("home.json", r#""size_m": [1.2, 0.8]"#, r#""size_m": [1.2, 0.8], "outline": [[1, 1], [2, 1], [2, 2]]"#,
            "19:73: home::two-forms"),
        ("home.json", r#""size_m": [1.2, 0.8]"#, r#""size_m": [1.2, 0]"#, "19:56: schema::out-of-range"),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8]"#, r#""outline": [[1, 1], [2, 1], [2, 2], [1.8, 1.2]]"#,
            "19:35: home::not-convex"),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8]"#, r#""outline": [[1, 1], [2, 2], [2, 1], [1, 2]]"#,
            "19:35: home::crosses-itself"),
        ("home.json", r#""at": [2, 2.2], "size_m": [1.2, 0.8]"#, r#""outline": [[1, 1], [2, 2], [3, 3]]"#,
            "19:35: home::no-area"),
        ("home.json", r#""at": [2, 2.2]"#, r#""at": [2, 3.2]"#, "19:30: home::reaches-out"),
        ("home.json", r#""at": [2, 2.2]"#, r#""at": [20, 2.2]"#, "19:30: home::reaches-out"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_names_that_are_taken() {
    check(&[
        ("home.json", r#""name": "bedroom","#, r#""name": "kitchen","#, "5:15: home::duplicate-name"),
        ("home.json", r#""name": "bedroom","#, r#""name": " Kitchen","#, "5:15: home::similar-name"),
        ("home.json", r#""name": "front door""#, r#""name": "bedroom door""#, "16:15: home::duplicate-name"),
        ("home.json", r#""name": "table""#, r#""name": "bed""#, "20:15: home::duplicate-name"),
        ("home.json", r#""name": "window""#, r#""name": "SINK""#, "24:15: home::similar-name"),
        ("home.json", r#""name": "window""#, r#""name": "bed""#, "24:15: home::shared-name"),
        ("home.json", r#""name": "window""#, r#""name": "kitchen""#, "24:15: home::shared-name"),
        ("home.json", r#""name": "bed", "outline""#, r#""name": "bedroom", "outline""#,
            "20:15: home::shared-name\nann.path.json:2:12: path::unknown-place\nann.path.json:10:34: path::unknown-place"),
        ("home.json", r#""name": "bedroom motion""#, r#""name": "kitchen motion""#,
            "28:15: home::duplicate-name\nlogger.json:5:36: sensor::unknown"),
        ("home.json", r#""name": "window""#, r#""name": "  ""#, "24:15: name::blank"),
        ("home.json", r#""name": "kitchen", "outline""#, r#""floor": " ", "name": "kitchen", "outline""#,
            "4:16: name::blank"),
        ("home.json", r#""name": "window""#, r#""name": "a\tb""#, "24:15: name::control-character"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_impossible_places_and_sensors() {
    check(&[
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [-0.5, 1.5]"#, "23:29: home::place-outside"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [2, 2.2]"#, "23:29: home::place-blocked"),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [0.02, 1.5]"#, "23:29: home::place-blocked"),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [0, 1.5]"#, "27:57: sensor::inside-solid"),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [-0.05, 1.5]"#, "27:57: sensor::outside-home"),
        ("home.json", r#""at": [0.05, 1.5], "facing_deg": 0"#, r#""at": [0.05, 1.5], "facing_deg": 180"#,
            "27:84: sensor::faces-solid"),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#,
            r#""area": [[6, 1.5], [7.9, 1.5], [6.5, 1.8], [6, 2.9]]"#,
            "30:56: home::not-convex"),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#,
            r#""area": [[6, 1.5], [7, 1.5], [7.9, 1.5]]"#,
            "30:56: home::no-area"),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#,
            r#""area": [[6, 1.5], [9, 1.5], [9, 2.9], [6, 2.9]]"#,
            "30:56: home::reaches-out"),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#, r#""area": [[6, 1.5], [7.9, 1.5]]"#,
            "30:56: schema::wrong-count"),
        ("home.json", r#""refire_s": [6, 8]"#, r#""refire_s": [8, 6]"#, "31:19: range::reversed"),
        ("home.json", r#""refire_s": [6, 8]"#, r#""refire_s": [0.5, 8]"#, "31:42: sensor::persist-too-long"),
        ("home.json", r#""persist_s": 1"#, r#""persist_s": 7"#, "31:40: sensor::persist-too-long"),
        ("home.json", r#""refire_s": [6, 8], "persist_s": 1"#, r#""refire_s": [0.5, 8]"#,
            "31:19: sensor::persist-too-long"),
        ("home.json", r#""refire_s": [6, 8]"#, r#""first_fire_s": [2, 1]"#, "31:23: range::reversed"),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 135, "field_deg": [100, 200]"#,
            "28:124: sensor::vertical-field"),
        ("home.json", r#"{ "sensitivity": { "threshold_deg": 2 } }"#, r#"{ "zones": { "rows": [0, 0, 0] } }"#,
            "29:54: sensor::no-zones"),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#,
            r#""area": [[3.5, 0.2], [4.5, 0.2], [4.5, 0.8], [3.5, 0.8]]"#, "30:56: sensor::reaches-through"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_wrong_values_of_a_logger() {
    check(&[
        ("logger.json", r#""hold_s": 4"#, r#""hold_s": 4, "lumps": [{ "share": 1, "parts": [1.2, 1] }]"#,
            "6:75: range::reversed"),
        ("logger.json", r#""hold_s": 4"#, r#""hold_s": 4, "lumps": [{ "share": 0, "parts": [1, 1] }]"#,
            "6:51: logger::no-share"),
        ("logger.json", r#""sqlite:log.db""#, r#""sqlit:log.db""#, "2:10: place::invalid"),
        ("logger.json", r#""sqlite:log.db""#, r#""log.txt""#, "2:10: place::invalid"),
        ("logger.json", r#""sqlite:log.db""#, r#""sqlite:""#, "2:10: place::invalid"),
        ("logger.json", r#""sqlite:log.db""#, r#""csv:/srv/start.sh""#, "2:10: file::outside-folder"),
        ("logger.json", r#""sqlite:log.db""#, r#""csv:logs/../../log.csv""#, "2:10: file::outside-folder"),
        ("logger.json", r#""sqlite:log.db""#, r#""csv:log.txt""#, "2:25: file::same-file"),
        ("logger.json", r#""table": "event""#, r#""table": "Event""#, "3:12: logger::sql-name"),
        ("logger.json", r#""table": "event""#, r#""table": "e; drop table x""#, "3:12: logger::sql-name"),
        ("logger.json", r#""table": "event""#, r#""table": "sqlite_x""#, "3:12: logger::sqlite-table"),
        ("logger.json", r#""table": "event""#, r#""table": "run""#, "3:12: logger::reserved-table"),
        ("logger.json", r#""time": "at""#, r#""time": "9at""#, "4:24: logger::sql-name"),
        ("logger.json", r#""time": "at""#, r#""time": "device""#, "4:44: logger::duplicate-column"),
        ("logger.json", r#""time": "at""#, r#""time": "seq""#, "4:24: logger::duplicate-column"),
        ("logger.json", r#""kitchen motion": "A1""#, r#""kitchn motion": "A1""#,
            r#"5:12: sensor::unknown "kitchen motion""#),
        ("logger.json", r#""kitchen motion": "A1""#, r#""a/b~c": "A1""#, "5:12: sensor::unknown"),
        ("logger.json", r#""bedroom motion": "A2""#, r#""bedroom motion": "a1""#, "5:30: logger::duplicate-id"),
        ("logger.json", r#""bedroom motion": "A2""#, r#""bedroom motion": "bed""#, "5:54: logger::duplicate-id"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_impossible_residents() {
    check(&[
        ("bob.json", r#""name": "Bob""#, r#""name": "ann ""#, "2:11: resident::duplicate-name"),
        ("bob.json", r#""start": [5, 1]"#, r#""start": [9, 1]"#, "3:59: resident::start-outside"),
        ("bob.json", r#""start": [5, 1]"#, r#""start": [2, 2.2]"#, "3:59: resident::start-blocked"),
        ("bob.json", r#""start": [5, 1]"#, r#""start": [4.2, 0.5]"#, "3:59: resident::start-too-near"),
        ("bob.json", r#""bob.keys.json""#, r#""bob.json""#, "3:33: file::two-uses"),
        ("bob.json", r#""bob.keys.json""#, r#""ann.path.json""#, "3:33: file::two-uses"),
        ("bob.json", r#""bob.keys.json""#, r#""nothing.json""#, "3:33: file::not-found"),
        ("bob.keys.json", r#""at_s": 2.5"#, r#""at_s": 0.5"#, "4:15: input::backward-time"),
        ("bob.keys.json", r#""up", "fast""#, r#""up", "fast", "up""#, "3:41: input::held-twice"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_impossible_paths() {
    check(&[
        ("ann.path.json", r#""start": "bed""#, r#""start": "bad""#, r#"2:12: path::unknown-place "bed""#),
        ("ann.path.json", r#""start": "bed""#, r#""start": "table""#, "2:12: path::not-enterable"),
        ("ann.path.json", r#""start": "bed""#, r#""start": [2, 2.2]"#, "2:12: path::blocked"),
        ("ann.path.json", r#""start": "bed""#, r#""start": [2, -1]"#, "2:12: path::outside-home"),
        ("ann.path.json", r#""start": "bed""#, r#""start": [4, 0.5]"#, "2:12: path::blocked"),
        ("ann.path.json", r#""start": "bed""#, r#""start": [1.5, 0]"#, "2:12: path::blocked"),
        ("ann.path.json", r#"[[5, 1.5], "sink"]"#, r#"["sink", [2, 7]]"#, "7:32: path::outside-home"),
        ("ann.path.json", r#"[[5, 1.5], "sink"]"#, r#"["window", "sink"]"#, "7:34: path::way-blocked"),
        ("ann.path.json", r#"[[5, 1.5], "sink"]"#, r#"[[5, 1.5], [3, 1.5], [2.8, 2.8], [1, 2.3], "sink"]"#,
            "7:56: path::way-blocked"),
        ("ann.path.json", r#"[[5, 1.5], "bed"]"#, "[[1.5, 1], [1.5, -0.5]]", "10:34: path::outside-home"),
        ("ann.path.json", r#"{ "go": { "to": [[5, 1.5], "bed"], "in_s": 30 } }"#, r#"{ "go": { "to": [[2.5, 0.2]] } }"#,
            "7:24: path::way-blocked"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 1000000, "steps": [{ "wait": { "for_s": 1e-6 } }] } }"#,
            "8:19: path::too-many-moves"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 2, "steps": [{ "go": { "to": ["sink"] } }, { "activity": "idle" }] } }"#,
            "8:19: path::repeat-takes-no-time"),
        ("ann.path.json", r#""sink"], "pace_mps": 0.5"#, r#""sink"], "pace_mps": 0.5, "in_s": 10"#,
            "7:68: path::two-tempos"),
        ("ann.path.json", r#""in_s": 30"#, r#""in_s": 30, "arrive_at": "07:40""#, "10:67: path::two-tempos"),
        ("ann.path.json", r#""in_s": 30"#, r#""in_s": 0.5"#, "10:50: path::too-fast"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "wait": { "until": "09:00" } }, { "wait": { "for_s": 60 } }, { "go": { "to": [[0.5, 0.5]], "arrive_at": "09:00:30" } }"#,
            "8:113: path::too-slow"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "wait": { "until": "09:00" } }, { "go": { "to": [[0.5, 0.5], "sink"], "arrive_at": "09:00:00.1" } }"#,
            "8:92: path::too-fast"),
        ("ann.path.json", r#""in_s": 30"#, r#""arrive_at": "7:40""#, "10:55: time::invalid-time-of-day"),
        ("ann.path.json", r#""08:00:00.5""#, r#""24:00""#, "12:28: time::invalid-time-of-day"),
        ("ann.path.json", r#""08:00:00.5""#, r#""08:00:00.""#, "12:28: time::invalid-time-of-day"),
        ("ann.path.json", r#"{ "for_s": 60 }"#, r#"{ "for_s": 60, "until": "08:00" }"#, "11:41: path::two-durations"),
        ("ann.path.json", r#"{ "for_s": 60 }"#, "{}", "11:17: path::no-duration"),
        ("ann.path.json", r#""until": "07:30", "posture""#, r#""posture""#, "5:15: path::no-duration"),
        ("ann.path.json", r#""every_s": 20, "for_s": 2"#, r#""every_s": 20, "for_s": 21"#, "9:67: path::long-stir"),
        ("ann.path.json", "    ] } }\n  ]", "    ] } },\n    { \"activity\": \"never\" }\n  ]",
            "14:5: path::unreached-step"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "steps": [{ "activity": "breakfast" }] } }"#,
            "8:19: path::repeat-takes-no-time\n9:7: path::unreached-step"),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 4, "steps": [{ "go": { "to": ["sink", "sink"] } }] } }"#,
            "8:19: path::repeat-takes-no-time"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn accepts_unusual_but_valid_values() {
    check(&[
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 4, "steps": [{ "go": { "to": [[1, 1.5], "sink"] } }] } }"#,
            ""),
        ("home.json", r#""facing_deg": 135"#, r#""facing_deg": 1.35e2, "beams": 32.0, "first_fire_s": null"#, ""),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [1.5, 0.05], "height_m": 0.6"#, ""),
        ("home.json", r#""name": "table""#, r#""name": "kitchen""#, ""),
        ("ann.path.json", r#"{ "activity": "breakfast" }"#,
            r#"{ "repeat": { "times": 2, "steps": [{ "go": { "to": [[1, 1.5]] } }, { "repeat": { "times": 1, "steps": [{ "go": { "to": ["sink"] } }] } }] } }"#,
            ""),
        // An area may reach into the wall up to its middle, and through an open door.
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#, r#""area": [[4, 0], [5, 0], [5, 0.8], [4, 0.8]]"#, ""),
        ("home.json", r#""area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]]"#,
            r#""area": [[3.5, 1.0], [4.5, 1.0], [4.5, 2.0], [3.5, 2.0]]"#, ""),
    ]);
}

#[test]
fn a_home_has_at_most_1024_sensors_and_32768_beams() {
    let sensor = |index: usize, beams: usize| {
        format!(r#"{{ "name": "s{index}", "kind": "motion", "at": [1, 1], "facing_deg": 0, "beams": {beams} }}"#)
    };
    let with = |count: usize, beams: usize| {
        let sensors: Vec<String> = (0..count).map(|index| sensor(index, beams)).collect();
        let mut files = good();
        let home = &files["home.json"];
        let start = home.find(r#""sensors": ["#).unwrap() + r#""sensors": ["#.len();
        let home = format!("{}\n{}\n  ]\n}}\n", &home[..start], sensors.join(",\n"));
        files.insert("home.json".into(), home);
        files.insert("logger.json".into(), "{}".into());
        reported(&files)
    };
    assert_eq!(with(1024, 32), "");
    assert_eq!(with(1025, 1), "home.json:26:14: schema::wrong-count");
    assert_eq!(with(129, 256), "home.json:155:1: sensor::too-many-beams");
}

#[test]
fn rejects_live_input_that_starts_in_an_outside_door() {
    let files = broken(&[
        ("home.json", r#""open": false, "outside": true"#, r#""outside": true"#),
        ("bob.json", r#""start": [5, 1]"#, r#""start": [1.5, 0]"#),
    ]);
    let expected = "bob.json:3:59: resident::start-in-door";
    assert_eq!(reported(&files), expected);
}

#[test]
fn rejects_walls_that_are_drawn_many_times() {
    let with = |home: &str, list: &str, more: &[String]| {
        let begin = format!(r#""{list}": ["#);
        home.replacen(&begin, &format!("{begin}{},", more.join(",")), 1)
    };
    let reported = |home: String| {
        let mut files = good();
        files.insert("home.json".into(), home);
        reported(&files)
    };
    let home = &good()["home.json"];
    let walls = |count: usize| with(home, "walls", &vec![r#"{ "from": [0, 0], "to": [8, 0] }"#.to_owned(); count]);
    assert_eq!(reported(walls(150)), "");
    let many = reported(walls(300));
    assert!(many.contains("home::wall-meetings"), "{many}");
    let door = |index: usize| {
        let from = 0.5 + 0.2 * index as f64;
        format!(r#"{{ "name": "door {index}", "from": [{from}, 0], "to": [{}, 0] }}"#, from + 0.1)
    };
    let many = reported(with(&walls(100), "doors", &(0..21).map(door).collect::<Vec<_>>()));
    assert!(many.contains("home::doors-in-walls"), "{many}");
}
