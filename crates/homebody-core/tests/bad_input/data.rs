//! The values that problems carry for programs.

use super::*;
use serde_json::{Value, json};

#[test]
#[rustfmt::skip] // A case takes two lines: the change, then the problem.
fn carries_the_values_of_a_problem_as_data() {
    let cases: [(&str, &str, &str, &str, Value); 8] = [
        ("home.json", "[4, 0], [4, 3], [0, 3]]", "[4.5, 0], [4.5, 3], [0, 3]]",
            "home::rooms-overlap", json!({ "a": "kitchen", "b": "bedroom", "area_m2": 1.5 })),
        ("home.json", r#""at": [0.5, 1.5]"#, r#""at": [-0.5, 1.5]"#,
            "home::place-outside", json!({ "place": "sink", "at": [-0.5, 1.5] })),
        ("home.json", r#""persist_s": 1"#, r#""persist_s": 7"#,
            "sensor::persist-too-long", json!({ "persist_s": 7.0, "least_refire_s": 6.0 })),
        ("scenario.json", r#""days": 2"#, r#""days": 0"#,
            "schema::out-of-range", json!({ "subject": "\"days\"", "bounds": "from 0.00001 to 36525", "written": "0" })),
        ("logger.json", r#""kitchen motion": "A1""#, r#""x": "A1""#,
            "sensor::unknown", json!({ "sensor": "x", "nearest": null, "known": ["kitchen motion", "bedroom motion", "bed"] })),
        ("ann.path.json", r#""in_s": 30"#, r#""in_s": 30, "arrive_at": "07:40""#,
            "path::two-tempos", json!({ "first": "in_s", "second": "arrive_at" })),
        ("bob.keys.json", r#""at_s": 2.5"#, r#""at_s": 0.5"#,
            "input::backward-time", json!({ "before_s": 1.0, "after_s": 0.5 })),
        ("scenario.json", r#""home.json""#, r#""ann.json""#,
            "file::wrong-kind", json!({ "name": "ann.json", "found": "a resident", "wanted": "a home" })),
    ];
    for (file, old, new, code, data) in cases {
        let problem = &problems(&broken(&[(file, old, new)])).0[0];
        assert_eq!((problem.code, Value::Object(problem.data.clone())), (code, data), "{new}");
    }
}

#[test]
fn suggests_names_in_hints() {
    let hint = |new: &str| problems(&broken(&[("ann.path.json", r#""start": "bed""#, new)])).0[0].hint.clone();
    assert_eq!(hint(r#""start": "bad""#).unwrap(), "did you mean \"bed\"?");
    let known = hint(r#""start": "somewhere""#).unwrap();
    assert!(known.starts_with("the known names are") && known.contains("\"sink\""), "{known}");
}
