//! A check reports all problems at once, in order, and can show each in its source.

use super::good::good;
use super::{broken, listed, problems, reported};
use homebody_core::scenario::load::{ResidentDriver, Scenario};
use homebody_core::time::RunTime;

#[test]
fn loads_the_good_scenario() {
    let scenario = Scenario::load(&good(), "scenario.json").unwrap();
    assert_eq!(scenario.sources, good());
    assert_eq!(scenario.home.sensors.len(), 3);
    let [ann, bob] = &scenario.residents[..] else { panic!("two residents live there") };
    assert!(matches!(&ann.driver, ResidentDriver::Path(path) if path.steps.len() == 2));
    assert!(matches!(&bob.driver, ResidentDriver::Live { input, start } if input.keys.len() == 2 && start.x == 5.0));
    assert_eq!(scenario.calendar.local(RunTime::START).to_string(), "2009-03-02T00:00:00-06:00[America/Chicago]");
}

#[test]
fn loads_its_own_sources_again() {
    let scenario = Scenario::load(&good(), "scenario.json").unwrap();
    assert_eq!(Scenario::load(&scenario.sources, "scenario.json").unwrap(), scenario);
}

#[test]
#[rustfmt::skip] // A problem a line.
fn reports_ten_mistakes_in_three_files_at_once() {
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
        "home.json:16:37: schema::wrong-type",
        r#"home.json:19:62: schema::unknown-key "height_m""#,
        "home.json:29:24: schema::duplicate-key",
        "logger.json:2:27: place::invalid",
        "logger.json:4:24: logger::sql-name",
        "ann.path.json:5:26: time::invalid-time-of-day",
        "ann.path.json:7:68: path::two-tempos",
        "ann.path.json:9:67: path::long-stir",
        "ann.path.json:11:41: path::two-durations",
        "ann.path.json:12:28: time::invalid-time-of-day",
    ];
    assert_eq!(reported(&files), expected.join("\n"));
}

#[test]
#[rustfmt::skip] // A problem a line.
fn checks_the_files_that_a_wrong_file_links() {
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
    let reported = reported(&files);
    assert_eq!(reported.lines().count(), expected.len(), "{reported}");
    for (line, expected) in reported.lines().zip(expected) {
        assert!(line.starts_with(expected), "{line} does not start with {expected}");
    }
}

#[test]
fn reports_the_problems_of_a_shared_file_once() {
    let mut files = broken(&[("ann.path.json", r#""stir": { "every_s": 20, "for_s": 2 }"#, r#""stir": {}"#)]);
    let once = reported(&files);
    let bob = files["ann.json"].replace("Ann", "Bob");
    files.insert("bob.json".into(), bob);
    assert_eq!(reported(&files), once);
    assert_eq!(once.lines().count(), 2, "{once}");
}

#[test]
fn recognises_a_home_in_place_of_a_scenario() {
    let problems = Scenario::load(&good(), "home.json").unwrap_err();
    assert_eq!(listed(&problems), "home.json: file::wrong-kind");
}

#[test]
fn shows_a_problem_with_its_line_and_a_caret() {
    let files = broken(&[("home.json", r#""height_m": 2.1"#, r#""heigt_m": 2.1"#)]);
    let expected = r#"home.json:28:69: error[schema::unknown-key]: "heigt_m" is not a key of a motion sensor
   28 |     { "name": "bedroom motion", "kind": "motion", "at": [7.9, 0.1], "heigt_m": 2.1, "facing_deg": 135,
      |                                                                     ^
  hint: did you mean "height_m"?
"#;
    assert_eq!(problems(&files).render(), expected);
}

#[test]
fn cuts_a_long_line_around_the_problem() {
    let files = broken(&[("scenario.json", r#""days": 2"#, &format!("{}\"dais\": 2", " ".repeat(5000)))]);
    let rendered = problems(&files).render();
    assert!(rendered.lines().all(|line| line.len() < 140), "{rendered}");
    let lines: Vec<&str> = rendered.lines().collect();
    assert_eq!(lines[1].find("\"dais\""), lines[2].find('^'), "{rendered}");
}

#[test]
fn shows_the_first_problems_of_each_file() {
    let many = "\"sink\", ".repeat(500) + "\"sink\"";
    let files = broken(&[
        ("ann.path.json", r#"[[5, 1.5], "sink"]"#, &format!("[{}]", many.replace("sink", "sin"))),
        ("bob.keys.json", r#""at_s": 2.5"#, r#""at_s": 0.5"#),
    ]);
    let reported = reported(&files);
    assert_eq!(reported.lines().count(), 102);
    assert!(reported.contains("ann.path.json: problems::more\nbob.keys.json:4:15: input::backward-time"));
}

/// A misspelt key hides nothing: the rest is read with the intended key.
#[test]
#[rustfmt::skip] // A problem a line.
fn checks_the_meaning_of_files_with_misspelt_keys() {
    let files = broken(&[
        ("home.json", r#""height_m": 0.7"#, r#""heigth_m": 0.7, "colour": "red""#),
        ("home.json", r#""name": "front door", "from": [1, 0]"#, r#""name": "front door", "form": [1, 0]"#),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [50, 1.5]"#),
    ]);
    let expected = [
        r#"home.json:16:29: schema::unknown-key "from""#,
        r#"home.json:19:62: schema::unknown-key "height_m""#,
        "home.json:19:79: schema::unknown-key",
        "home.json:27:57: sensor::outside-home",
    ];
    assert_eq!(reported(&files), expected.join("\n"));
}

/// Also where the value behind it is wrong: that is reported, and nothing that follows from it.
#[test]
#[rustfmt::skip] // A problem a line.
fn checks_the_value_of_a_misspelt_key() {
    let files = broken(&[
        ("home.json", r#""facing_deg": 0 }"#, r#""facing_deg": 0, "beam": -3 }"#),
        ("home.json", r#""at": [7.9, 0.1]"#, r#""at": [79, 0.1]"#),
        ("ann.path.json", r#""until": "07:30""#, r#""untill": 7.3"#),
        ("ann.path.json", r#""for_s": 600"#, r#""for": 1e300"#),
    ]);
    let expected = [
        r#"home.json:27:87: schema::unknown-key "beams""#,
        "home.json:27:95: schema::out-of-range",
        r#"ann.path.json:5:17: schema::unknown-key "until""#,
        "ann.path.json:5:27: schema::wrong-type",
        r#"ann.path.json:9:19: schema::unknown-key "for_s""#,
        "ann.path.json:9:26: schema::out-of-range",
    ];
    assert_eq!(reported(&files), expected.join("\n"));
    // A time of day behind a misspelt key is one of meaning.
    let files = broken(&[("ann.path.json", r#""until": "07:30""#, r#""untill": "7.30""#)]);
    let expected = [
        r#"ann.path.json:5:17: schema::unknown-key "until""#,
        "ann.path.json:5:27: time::invalid-time-of-day",
    ];
    assert_eq!(reported(&files), expected.join("\n"));
}

#[test]
#[rustfmt::skip] // A problem a line.
fn follows_a_misspelt_link() {
    let files = broken(&[
        ("scenario.json", r#""home": "#, r#""hom": "#),
        ("scenario.json", r#""residents": ["ann.json", "bob.json"]"#, r#""residentes": ["ann.json", "rob.json"]"#),
        ("home.json", r#""at": [0.05, 1.5]"#, r#""at": [50, 1.5]"#),
        ("ann.json", r#""driver": "#, r#""drivr": "#),
        ("ann.path.json", r#""for_s": 2 }"#, r#""for_s": 30 }"#),
    ]);
    let expected = [
        r#"scenario.json:6:3: schema::unknown-key "home""#,
        r#"scenario.json:8:3: schema::unknown-key "residents""#,
        r#"scenario.json:8:30: file::not-found "bob.json""#,
        "home.json:27:57: sensor::outside-home",
        r#"ann.json:1:35: schema::unknown-key "driver""#,
        "ann.path.json:9:67: path::long-stir",
    ];
    assert_eq!(reported(&files), expected.join("\n"));
}
