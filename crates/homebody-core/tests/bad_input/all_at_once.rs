//! Everything that is wrong comes at once, in order, and can be shown beside its source.

use crate::good::good;
use crate::{broken, problems, said};
use homebody_core::scenario::load::{Driver, Scenario};

#[test]
fn the_good_scenario_loads() {
    let scenario = Scenario::load(&good(), "scenario.json").unwrap();
    assert_eq!(scenario.sources, good());
    assert_eq!(scenario.home.sensors.len(), 3);
    let [ann, bob] = &scenario.residents[..] else { panic!("two residents live there") };
    assert!(matches!(&ann.driver, Driver::Path(path) if path.steps.len() == 2));
    assert!(matches!(&bob.driver, Driver::Live { input, start } if input.keys.len() == 2 && start.x == 5.0));
    assert_eq!(scenario.calendar.local(0).to_string(), "2009-03-02T00:00:00-06:00[America/Chicago]");
}

#[test]
fn what_was_read_loads_again() {
    let scenario = Scenario::load(&good(), "scenario.json").unwrap();
    assert_eq!(Scenario::load(&scenario.sources, "scenario.json").unwrap(), scenario);
}

#[test]
#[rustfmt::skip] // A problem a line.
fn ten_mistakes_in_three_files_are_reported_at_once() {
    let files = broken(&[
        ("home.json", r#""name": "front door", "from": [1, 0]"#, r#""name": "front door", "from": "here""#),
        ("home.json", r#""height_m": 0.7"#, r#""heigth_m": 0.7"#),
        ("home.json", r#""preset": "hue""#, r#""preset": "hue", "preset": "aqara""#),
        ("logger.json", "casas:log.txt", "casis:log.txt"),
        ("logger.json", r#""time": "at""#, r#""time": "At""#),
        ("ann.path.json", r#""07:30""#, r#""7.30""#),
        ("ann.path.json", r#""pace_mps": 0.5"#, r#""pace_mps": 0.5, "in_s": 20"#),
        ("ann.path.json", r#""for_s": 2 }"#, r#""for_s": 30 }"#),
        ("ann.path.json", r#""for_s": 60 }"#, r#""for_s": 60, "until": "08:00" }"#),
        ("ann.path.json", r#""08:00:00.5""#, r#""08:60""#),
    ]);
    let expected = [
        r#"home.json:16:37: "from" must be a list of 2 numbers, but is the text "here"; One jamb, on the centre line of a wall"#,
        r#"home.json:19:62: "heigth_m" is no key of a piece of furniture; did you mean "height_m"?"#,
        r#"home.json:29:24: "preset" is given twice; it is already given on line 29"#,
        r#"logger.json:2:27: "casis:log.txt" is nowhere a log can go; did you mean "casas:log.txt"?"#,
        r#"logger.json:4:24: "At" cannot be the name of a table or a column; use a to z, 0 to 9 and _, not a digit first, at most 63 characters"#,
        r#"ann.path.json:5:26: "7.30" is no time of day; write it as "07:30" or "07:30:15.5", from "00:00" to "23:59:59.999999""#,
        r#"ann.path.json:7:68: a walk cannot have both "pace_mps" and "in_s"; keep the one that is meant"#,
        r#"ann.path.json:9:67: a stir of 30 s cannot come every 20 s; "for_s" is at most "every_s""#,
        r#"ann.path.json:11:41: "for_s" and "until" cannot both be given; keep the one that is meant"#,
        r#"ann.path.json:12:28: "08:60" is no time of day; write it as "07:30" or "07:30:15.5", from "00:00" to "23:59:59.999999""#,
    ];
    assert_eq!(said(&files), expected.join("\n"));
}

#[test]
#[rustfmt::skip] // A problem a line.
fn what_cannot_be_understood_hides_nothing_that_it_links() {
    let files = broken(&[
        ("scenario.json", r#""days": 2"#, r#""days": "two""#),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [50, 1.5]"#),
        ("logger.json", "casas:log.txt", "casis:log.txt"),
        ("ann.json", r#""pace_mps": 0.6"#, r#""pace_mps": "slow""#),
        ("ann.path.json", r#""for_s": 2 }"#, r#""for_s": 30 }"#),
        ("bob.json", r#""Bob""#, "\"a\\u0007b\""),
        ("bob.keys.json", r#""at_s": 2.5"#, r#""at_s": 0.5"#),
    ]);
    let expected = ["scenario.json:5:", "home.json:27:", "logger.json:2:", "ann.json:1:", "ann.path.json:9:", "bob.json:2:", "bob.keys.json:4:"];
    let said = said(&files);
    assert_eq!(said.lines().count(), expected.len(), "{said}");
    for (line, expected) in said.lines().zip(expected) {
        assert!(line.starts_with(expected), "{line} does not start with {expected}");
    }
}

#[test]
fn what_two_link_is_reported_once() {
    let mut files = broken(&[("ann.path.json", r#""stir": { "every_s": 20, "for_s": 2 }"#, r#""stir": {}"#)]);
    let once = said(&files);
    let bob = files["ann.json"].replace("Ann", "Bob");
    files.insert("bob.json".into(), bob);
    assert_eq!(said(&files), once);
    assert_eq!(once.lines().count(), 2, "{once}");
}

#[test]
fn a_home_in_place_of_a_scenario_is_recognised() {
    let problems = Scenario::load(&good(), "home.json").unwrap_err();
    assert_eq!(problems.to_string(), r#"home.json: "home.json" is a home, but a scenario is needed here"#);
}

#[test]
fn a_problem_is_shown_with_its_line_and_a_caret() {
    let files = broken(&[("home.json", r#""height_m": 2.1"#, r#""heigt_m": 2.1"#)]);
    let expected = r#"home.json:28:69: "heigt_m" is no key of a motion sensor
   28 |     { "name": "bedroom motion", "kind": "motion", "at": [7.9, 0.1], "heigt_m": 2.1, "facing_deg": 135,
      |                                                                     ^
  hint: did you mean "height_m"?
"#;
    assert_eq!(problems(&files).render(), expected);
}

#[test]
fn a_long_line_is_cut_to_where_the_problem_is() {
    let files = broken(&[("scenario.json", r#""days": 2"#, &format!("{}\"dais\": 2", " ".repeat(5000)))]);
    let rendered = problems(&files).render();
    assert!(rendered.lines().all(|line| line.len() < 140), "{rendered}");
    let lines: Vec<&str> = rendered.lines().collect();
    assert_eq!(lines[1].find("\"dais\""), lines[2].find('^'), "{rendered}");
}

#[test]
fn a_file_that_is_wrong_throughout_does_not_bury_the_others() {
    let many = "\"sink\", ".repeat(500) + "\"sink\"";
    let files = broken(&[
        ("ann.path.json", r#"[[5, 1.5], "sink"]"#, &format!("[{}]", many.replace("sink", "sin"))),
        ("bob.keys.json", r#""at_s": 2.5"#, r#""at_s": 0.5"#),
    ]);
    let said = said(&files);
    assert_eq!(said.lines().count(), 102);
    assert!(said.contains("ann.path.json: there are 401 more problems\nbob.keys.json:4:15: time runs backward"));
}

/// A key that is none hides nothing: the rest is understood as it was meant.
#[test]
#[rustfmt::skip] // A problem a line.
fn misspelt_keys_hide_no_mistake_of_meaning() {
    let files = broken(&[
        ("home.json", r#""height_m": 0.7"#, r#""heigth_m": 0.7, "colour": "red""#),
        ("home.json", r#""name": "front door", "from": [1, 0]"#, r#""name": "front door", "form": [1, 0]"#),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [50, 1.5]"#),
    ]);
    let expected = [
        r#"home.json:16:29: "form" is no key of a door; did you mean "from"?"#,
        r#"home.json:19:62: "heigth_m" is no key of a piece of furniture; did you mean "height_m"?"#,
        r#"home.json:19:79: "colour" is no key of a piece of furniture; its keys are "name", "at", "size_m", "turn_deg", "outline", "height_m", "enterable", "role""#,
        r#"home.json:27:57: the sensor "kitchen motion" at (50, 1.5) is outside the home; mount it on the surface, on the side from which it should see"#,
    ];
    assert_eq!(said(&files), expected.join("\n"));
}

/// Also where the value behind it is wrong: that is said, and nothing that follows from it.
#[test]
#[rustfmt::skip] // A problem a line.
fn what_stands_behind_a_misspelt_key_is_looked_at() {
    let files = broken(&[
        ("home.json", r#""facing_deg": 0 }"#, r#""facing_deg": 0, "beam": -3 }"#),
        ("home.json", r#""at": [7.9, 0.1]"#, r#""at": [79, 0.1]"#),
        ("ann.path.json", r#""until": "07:30""#, r#""untill": 7.3"#),
        ("ann.path.json", r#""for_s": 600"#, r#""for": 1e300"#),
    ]);
    let expected = [
        r#"home.json:27:87: "beam" is no key of a motion sensor; did you mean "beams"?"#,
        r#"home.json:27:95: "beam" must be from 1 to 256, but is -3"#,
        r#"ann.path.json:5:17: "untill" is no key of a wait; did you mean "until"?"#,
        r#"ann.path.json:5:27: "untill" must be a text, but is the number 7.3; Time of day at which the stay ends, "07:30" or "07:30:15.5": the next such time"#,
        r#"ann.path.json:9:19: "for" is no key of a wait; did you mean "for_s"?"#,
        r#"ann.path.json:9:26: "for" must be from 0.000001 to 3200000000, but is 1e300"#,
    ];
    assert_eq!(said(&files), expected.join("\n"));
    // A time of day behind a misspelt key is one of meaning.
    let files = broken(&[("ann.path.json", r#""until": "07:30""#, r#""untill": "7.30""#)]);
    let expected = [
        r#"ann.path.json:5:17: "untill" is no key of a wait; did you mean "until"?"#,
        r#"ann.path.json:5:27: "7.30" is no time of day; write it as "07:30" or "07:30:15.5", from "00:00" to "23:59:59.999999""#,
    ];
    assert_eq!(said(&files), expected.join("\n"));
}

#[test]
#[rustfmt::skip] // A problem a line.
fn a_misspelt_link_hides_nothing_behind_it() {
    let files = broken(&[
        ("scenario.json", r#""home": "#, r#""hom": "#),
        ("scenario.json", r#""residents": ["ann.json", "bob.json"]"#, r#""residentes": ["ann.json", "rob.json"]"#),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [50, 1.5]"#),
        ("ann.json", r#""driver": "#, r#""drivr": "#),
        ("ann.path.json", r#""for_s": 2 }"#, r#""for_s": 30 }"#),
    ]);
    let expected = [
        r#"scenario.json:6:3: "hom" is no key of a scenario; did you mean "home"?"#,
        r#"scenario.json:8:3: "residentes" is no key of a scenario; did you mean "residents"?"#,
        r#"scenario.json:8:30: "rob.json" cannot be read: there is no such file; did you mean "bob.json"?"#,
        r#"home.json:27:57: the sensor "kitchen motion" at (50, 1.5) is outside the home; mount it on the surface, on the side from which it should see"#,
        r#"ann.json:1:35: "drivr" is no key of a resident; did you mean "driver"?"#,
        r#"ann.path.json:9:67: a stir of 30 s cannot come every 20 s; "for_s" is at most "every_s""#,
    ];
    assert_eq!(said(&files), expected.join("\n"));
}
