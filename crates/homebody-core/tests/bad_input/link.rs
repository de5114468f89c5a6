//! Links: sensors, spans and faults that cannot be.

use crate::good::good;
use crate::*;

/// A fault of each kind.
const LINK: &str = r#"{
  "preset": "x10",
  "delay_s": [0, 0.2], "loss": 0.02, "duplicates": 0.001, "corruption": 0.0001,
  "misses": 0.01, "false_fires_per_h": 0.05,
  "radio": { "copies": 9, "frame_s": 0.07, "gap_s": 0.05 },
  "sensors": { "bed": { "delay_s": [1, 2], "loss": 0.2 } },
  "faults": [
    { "sensor": "bed", "kind": "battery", "from_day": 1, "fading_days": 0.5, "days": 2 },
    { "sensor": "bed", "kind": "stuck", "from_day": 4, "days": 1, "every_s": 30 },
    { "sensor": "bed", "kind": "falls_off", "from_day": 6 },
    { "sensor": "bedroom motion", "kind": "moved", "from_day": 0.1, "at": [4.1, 2.5], "facing_deg": 0 },
    { "sensor": "bed", "kind": "drift", "ppm": 40, "offset_s": -1 },
    { "sensor": "bed", "kind": "false_fires", "per_h": 2, "between": ["10:00", "15:30"] },
    { "sensor": "kitchen motion", "kind": "bad_link", "loss": 0.3, "days": 1.5 },
    { "kind": "outage", "from_day": 1, "at": "13:00", "hours": 5 }
  ]
}
"#;

/// The good scenario with a link.
pub fn linked() -> BTreeMap<String, String> {
    let mut files = changed(good(), &[("scenario.json", "\"bob.json\"]", "\"bob.json\"],\n  \"link\": \"link.json\"")]);
    files.insert("link.json".into(), LINK.into());
    files
}

fn check(cases: &[Case]) {
    for (file, old, new, expected) in cases {
        let files = changed(linked(), &[(file, old, new)]);
        assert_eq!(said(&files), *expected, "after {new:?} for {old:?} in {file}");
    }
}

#[test]
fn a_good_link_is_nothing_to_speak_of() {
    assert_eq!(said(&linked()), "");
    assert_eq!(Scenario::load(&linked(), "scenario.json").unwrap().sources, linked());
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn the_shape_of_a_link() {
    check(&[
        ("link.json", r#""preset": "x10""#, r#""preset": "x11""#,
            r#"link.json:2:13: "preset" cannot be "x11"; did you mean "x10"?"#),
        ("link.json", r#""loss": 0.02"#, r#""loss": 1.5"#,
            r#"link.json:3:32: "loss" must be from 0 to 1, but is 1.5"#),
        ("link.json", r#""loss": 0.02"#, r#""los": 0.02"#,
            r#"link.json:3:24: "los" is no key of a link; did you mean "loss"?"#),
        ("link.json", r#""copies": 9"#, r#""copies": 0"#,
            r#"link.json:5:24: "copies" must be from 1 to 100, but is 0"#),
        ("link.json", r#""kind": "battery""#, r#""kind": "batery""#,
            r#"link.json:8:32: "batery" is no kind of fault; did you mean "battery"?"#),
        ("link.json", r#""facing_deg": 0"#, r#""days": 3"#,
            "link.json:11:5: a moved fault needs the key \"facing_deg\"; Direction of the lens from then on: 0 is east, 90 is north\n\
            link.json:11:87: \"days\" is no key of a moved fault; its keys are \"kind\", \"sensor\", \"from_day\", \"at\", \"facing_deg\""),
        ("link.json", r#""at": [4.1, 2.5], "#, "",
            r#"link.json:11:5: a moved fault needs the key "at"; Position from then on"#),
        ("link.json", r#""hours": 5"#, r#""hours": -5"#,
            r#"link.json:15:64: "hours" must be from 0.0001 to 876600, but is -5"#),
        ("scenario.json", r#""link.json""#, r#""logger.json""#,
            r#"scenario.json:9:11: "logger.json" is a logger, but a link is needed here"#),
        ("scenario.json", r#""link.json""#, r#""lnk.json""#,
            r#"scenario.json:9:11: "lnk.json" cannot be read: there is no such file; did you mean "link.json"?"#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn sensors_and_times_of_a_link() {
    check(&[
        ("link.json", r#""delay_s": [0, 0.2]"#, r#""delay_s": [0.3, 0.2]"#,
            r#"link.json:3:14: the least of "delay_s", 0.3, is more than its most, 0.2; write [0.2, 0.3]"#),
        ("link.json", r#""delay_s": [1, 2]"#, r#""delay_s": [3, 2]"#,
            r#"link.json:6:36: the least of "delay_s", 3, is more than its most, 2; write [2, 3]"#),
        ("link.json", r#""sensors": { "bed""#, r#""sensors": { "bad""#,
            r#"link.json:6:16: the home has no sensor "bad"; did you mean "bed"?"#),
        ("link.json", r#""sensor": "kitchen motion""#, r#""sensor": "kitchen""#,
            r#"link.json:14:17: the home has no sensor "kitchen"; there are "kitchen motion", "bedroom motion", "bed""#),
        ("link.json", r#""sensor": "bedroom motion""#, r#""sensor": "bedroom notion""#,
            r#"link.json:11:17: the home has no sensor "bedroom notion"; did you mean "bedroom motion"?"#),
        ("link.json", r#""10:00", "15:30""#, r#""10:60", "half past three""#,
            "link.json:13:71: \"10:60\" is no time of day; write it as \"07:30\" or \"07:30:15.5\", from \"00:00\" to \"23:59:59.999999\"\n\
            link.json:13:80: \"half past three\" is no time of day; write it as \"07:30\" or \"07:30:15.5\", from \"00:00\" to \"23:59:59.999999\""),
        ("link.json", r#""10:00", "15:30""#, r#""10:00", "10:00""#,
            r#"link.json:13:70: nothing is between "10:00" and "10:00"; leave "between" out if it is at any time"#),
        ("link.json", r#""at": "13:00""#, r#""at": "25:00""#,
            r#"link.json:15:46: "25:00" is no time of day; write it as "07:30" or "07:30:15.5", from "00:00" to "23:59:59.999999""#),
        ("link.json", r#""sensor": "bedroom motion""#, r#""sensor": "bed""#,
            r#"link.json:11:17: "bed" cannot be moved: only motion sensors on walls can"#),
        ("link.json", r#"[4.1, 2.5]"#, r#"[4.1, 12.5]"#,
            r#"link.json:11:75: the sensor "bedroom motion" at (4.1, 12.5) is outside the home; mount it on the surface, on the side from which it should see"#),
        ("link.json", r#""facing_deg": 0"#, r#""facing_deg": 180"#, ""),
        ("link.json", r#"[4.1, 2.5], "facing_deg": 0"#, r#"[4.06, 2.5], "facing_deg": 180"#,
            r#"link.json:11:102: the sensor "bedroom motion" faces into the wall between "bedroom" and "kitchen"; 0 is east, 90 north, 180 west, 270 south"#),
    ]);
}

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn faults_that_cannot_be_at_once() {
    check(&[
        ("link.json", r#""from_day": 4, "days": 1"#, r#""from_day": 2.5, "days": 1"#,
            r#"link.json:9:5: "bed" cannot be "stuck" from day 2.5 to 3.5: it is "battery" from day 1 to 3; let one end before the other begins"#),
        ("link.json", r#""fading_days": 0.5, "days": 2"#, r#""fading_days": 0.5"#,
            "link.json:9:5: \"bed\" cannot be \"stuck\" from day 4 to 5: it is \"battery\" from day 1 on; \
            a fault without \"days\" never ends: say how long it lasts\n\
            link.json:10:5: \"bed\" cannot be \"falls_off\" from day 6 on: it is \"battery\" from day 1 on; \
            a fault without \"days\" never ends: say how long it lasts"),
        ("link.json", r#"{ "sensor": "bed", "kind": "falls_off", "from_day": 6 }"#,
            r#"{ "sensor": "bedroom motion", "kind": "falls_off" }"#,
            r#"link.json:11:5: "bedroom motion" cannot be "moved" on day 0.1: it is "falls_off" from day 0 on; a fault without "days" never ends: say how long it lasts"#),
        ("link.json", r#"{ "sensor": "bed", "kind": "falls_off", "from_day": 6 }"#,
            r#"{ "sensor": "bedroom motion", "kind": "moved", "at": [4.1, 2], "facing_deg": 0, "from_day": 0.1 }"#,
            r#"link.json:11:5: "bedroom motion" is moved twice on day 0.1; keep the one that is meant"#),
        ("link.json", r#"{ "sensor": "bed", "kind": "falls_off", "from_day": 6 }"#,
            r#"{ "sensor": "bedroom motion", "kind": "falls_off", "from_day": 6 }"#, ""),
        ("link.json", r#"{ "sensor": "bed", "kind": "falls_off", "from_day": 6 }"#,
            r#"{ "sensor": "bed", "kind": "drift", "ppm": 1 }"#,
            r#"link.json:12:5: "bed" has but one clock, and its drift is given twice; keep the one that is meant"#),
    ]);
}

#[test]
fn what_is_no_motion_sensor_does_not_fire_for_no_reason() {
    let contact = r#"{ "name": "bed", "kind": "contact", "on": "bedroom door" }"#;
    let mut files = changed(linked(), &[("link.json", r#""loss": 0.2 }"#, r#""false_fires_per_h": 1 }"#)]);
    let home = &files["home.json"];
    let start = home.find(r#"{ "name": "bed", "kind": "ceiling_motion""#).unwrap();
    let home = format!("{}{contact}\n  ]\n}}\n", &home[..start]);
    files.insert("home.json".into(), home);
    let expected = "link.json:6:65: \"bed\" is no motion sensor: it does not fire for no reason\n\
        link.json:13:17: \"bed\" is no motion sensor: it does not fire for no reason";
    assert_eq!(said(&files), expected);
}

#[test]
fn places_that_sensors_are_moved_to_count_as_sensors() {
    let with = |moves: usize| {
        let mut files = linked();
        let sensor = |index: usize| {
            format!(r#"{{ "name": "s{index}", "kind": "motion", "at": [1, 1], "facing_deg": 0, "beams": 1 }},"#)
        };
        let more: String = (0..900).map(sensor).collect();
        let home = files["home.json"].replace(r#""sensors": ["#, &format!(r#""sensors": [{more}"#));
        files.insert("home.json".into(), home);
        let moved = |index: usize| {
            format!(
                r#"{{ "sensor": "bedroom motion", "kind": "moved", "from_day": {index}, "at": [4.1, 2.5], "facing_deg": 0 }}"#
            )
        };
        let moves: Vec<String> = (0..moves).map(moved).collect();
        files.insert("link.json".into(), format!("{{ \"faults\": [\n{}\n] }}\n", moves.join(",\n")));
        said(&files)
    };
    assert_eq!(with(121), "");
    assert_eq!(with(122), "link.json:123:1: the sensors and the places they are moved to are more than 1024");
}
