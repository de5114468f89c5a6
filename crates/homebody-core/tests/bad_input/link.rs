//! Links with impossible sensors, spans and faults.

use super::good::good;
use super::*;

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
        assert_eq!(reported(&files), with_file(file, expected), "after {new:?} for {old:?} in {file}");
    }
}

#[test]
fn accepts_a_good_link() {
    assert_eq!(reported(&linked()), "");
    assert_eq!(Scenario::load(&linked(), "scenario.json").unwrap().sources, linked());
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_a_link_of_wrong_form() {
    check(&[
        ("link.json", r#""preset": "x10""#, r#""preset": "x11""#, r#"2:13: schema::unknown-name "x10""#),
        ("link.json", r#""loss": 0.02"#, r#""loss": 1.5"#, "3:32: schema::out-of-range"),
        ("link.json", r#""loss": 0.02"#, r#""los": 0.02"#, r#"3:24: schema::unknown-key "loss""#),
        ("link.json", r#""copies": 9"#, r#""copies": 0"#, "5:24: schema::out-of-range"),
        ("link.json", r#""kind": "battery""#, r#""kind": "batery""#, r#"8:32: schema::unknown-kind "battery""#),
        ("link.json", r#""facing_deg": 0"#, r#""days": 3"#, "11:5: schema::missing-key\n11:87: schema::unknown-key"),
        ("link.json", r#""at": [4.1, 2.5], "#, "", "11:5: schema::missing-key"),
        ("link.json", r#""hours": 5"#, r#""hours": -5"#, "15:64: schema::out-of-range"),
        ("scenario.json", r#""link.json""#, r#""logger.json""#, "9:11: file::wrong-kind"),
        ("scenario.json", r#""link.json""#, r#""lnk.json""#, r#"9:11: file::not-found "link.json""#),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_unknown_sensors_and_times_of_a_link() {
    check(&[
        ("link.json", r#""delay_s": [0, 0.2]"#, r#""delay_s": [0.3, 0.2]"#, "3:14: range::reversed"),
        ("link.json", r#""delay_s": [1, 2]"#, r#""delay_s": [3, 2]"#, "6:36: range::reversed"),
        ("link.json", r#""sensors": { "bed""#, r#""sensors": { "bad""#, r#"6:16: sensor::unknown "bed""#),
        ("link.json", r#""sensor": "kitchen motion""#, r#""sensor": "kitchen""#, "14:17: sensor::unknown"),
        ("link.json", r#""sensor": "bedroom motion""#, r#""sensor": "bedroom notion""#,
            r#"11:17: sensor::unknown "bedroom motion""#),
        ("link.json", r#""10:00", "15:30""#, r#""10:60", "half past three""#,
            "13:71: time::invalid-time-of-day\n13:80: time::invalid-time-of-day"),
        ("link.json", r#""10:00", "15:30""#, r#""10:00", "10:00""#, "13:70: link::empty-interval"),
        ("link.json", r#""at": "13:00""#, r#""at": "25:00""#, "15:46: time::invalid-time-of-day"),
        ("link.json", r#""sensor": "bedroom motion""#, r#""sensor": "bed""#, "11:17: link::cannot-move"),
        ("link.json", r#"[4.1, 2.5]"#, r#"[4.1, 12.5]"#, "11:75: sensor::outside-home"),
        ("link.json", r#""facing_deg": 0"#, r#""facing_deg": 180"#, ""),
        ("link.json", r#"[4.1, 2.5], "facing_deg": 0"#, r#"[4.06, 2.5], "facing_deg": 180"#,
            "11:102: sensor::faces-solid"),
    ]);
}

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_faults_that_exclude_each_other() {
    check(&[
        ("link.json", r#""from_day": 4, "days": 1"#, r#""from_day": 2.5, "days": 1"#, "9:5: link::faults-overlap"),
        ("link.json", r#""fading_days": 0.5, "days": 2"#, r#""fading_days": 0.5"#,
            "9:5: link::faults-overlap\n10:5: link::faults-overlap"),
        ("link.json", r#"{ "sensor": "bed", "kind": "falls_off", "from_day": 6 }"#,
            r#"{ "sensor": "bedroom motion", "kind": "falls_off" }"#,
            "11:5: link::faults-overlap"),
        ("link.json", r#"{ "sensor": "bed", "kind": "falls_off", "from_day": 6 }"#,
            r#"{ "sensor": "bedroom motion", "kind": "moved", "at": [4.1, 2], "facing_deg": 0, "from_day": 0.1 }"#,
            "11:5: link::moved-twice"),
        ("link.json", r#"{ "sensor": "bed", "kind": "falls_off", "from_day": 6 }"#,
            r#"{ "sensor": "bedroom motion", "kind": "falls_off", "from_day": 6 }"#,
            ""),
        ("link.json", r#"{ "sensor": "bed", "kind": "falls_off", "from_day": 6 }"#,
            r#"{ "sensor": "bed", "kind": "drift", "ppm": 1 }"#,
            "12:5: link::two-drifts"),
    ]);
}

#[test]
fn rejects_false_firings_of_other_sensors() {
    let contact = r#"{ "name": "bed", "kind": "contact", "on": "bedroom door" }"#;
    let mut files = changed(linked(), &[("link.json", r#""loss": 0.2 }"#, r#""false_fires_per_h": 1 }"#)]);
    let home = &files["home.json"];
    let start = home.find(r#"{ "name": "bed", "kind": "ceiling_motion""#).unwrap();
    let home = format!("{}{contact}\n  ]\n}}\n", &home[..start]);
    files.insert("home.json".into(), home);
    let expected = "link.json:6:65: link::not-a-motion-sensor\nlink.json:13:17: link::not-a-motion-sensor";
    assert_eq!(reported(&files), expected);
}

#[test]
fn counts_places_of_moved_sensors_as_sensors() {
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
        reported(&files)
    };
    assert_eq!(with(121), "");
    assert_eq!(with(122), "link.json:123:1: link::too-many-places");
}
