//! Text that is not JSON, and JSON that only looks odd.

use super::*;

#[test]
#[rustfmt::skip] // A case a line, where it fits.
fn rejects_invalid_json() {
    check(&[
        ("scenario.json", r#""days": 2,"#, r#""days": 2"#, "5:12: json::missing-comma"),
        ("scenario.json", r#""bob.json"]"#, r#""bob.json",]"#, "8:39: json::trailing-comma"),
        ("scenario.json", r#""days": 2,"#, r#""days": 2, // of March"#, "5:14: json::comment"),
        ("scenario.json", r#""days": 2,"#, r#""days": NaN,"#, "5:11: json::not-a-number"),
        ("scenario.json", r#""days": 2,"#, r#""days": Infinity,"#, "5:11: json::not-a-number"),
        ("scenario.json", r#""days": 2,"#, r#""days": 0x10,"#, "5:11: json::hexadecimal"),
        ("scenario.json", r#""days": 2,"#, r#""days": 07,"#, "5:12: json::leading-zero"),
        ("scenario.json", r#""days": 2,"#, r#""days": .5,"#, "5:11: json::bare-point"),
        ("scenario.json", r#""days": 2,"#, r#""days": ,"#, "5:11: json::extra-comma"),
        ("scenario.json", r#""days": 2,"#, "days: 2,", "5:3: json::unquoted-key"),
        ("scenario.json", r#""days": 2,"#, r#""days": 2,5,"#, "5:13: json::decimal-comma"),
        ("scenario.json", r#""days": 2,"#, "'days': 2,", "5:3: json::single-quotes"),
        ("scenario.json", r#""name": "two rooms","#, r#""name": "two rooms,"#, "2:11: json::unclosed-text"),
        ("scenario.json", r#""name": "two rooms","#, r#""name": "two \rooms \x","#, "2:23: json::invalid-escape"),
        ("scenario.json", r#""name": "two rooms","#, "\"name\": \"two \trooms\",", "2:16: json::control-character"),
        ("scenario.json", r#""name": "two rooms","#, r#""name": "two \ud800 rooms","#, "2:16: json::invalid-escape"),
        ("scenario.json", "\"bob.json\"]\n}", "\"bob.json\"]\n", "1:1: json::unclosed-object"),
        ("scenario.json", "\"bob.json\"]\n}", "\"bob.json\"]\n}}", "9:2: json::text-after-end"),
        ("logger.json", "\"utc\"\n}", "\"utc\"\n} {}", "8:3: json::text-after-end"),
        ("logger.json", r#""time": "utc""#, r#""time""#, "8:1: json::missing-colon"),
    ]);
}

#[test]
fn lines_may_end_as_on_any_system() {
    for end in ["\r\n", "\r", "\n"] {
        let mut files = broken(&[("home.json", r#""name": "sink""#, r#""nam": "sink""#)]);
        for text in files.values_mut() {
            *text = text.replace('\n', end);
        }
        assert_eq!(reported(&files), r#"home.json:23:7: schema::unknown-key "name""#);
    }
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let mut files = good();
    for text in files.values_mut() {
        text.insert(0, '\u{feff}');
    }
    assert_eq!(reported(&files), "");
}

#[test]
fn rejects_an_empty_file() {
    for text in ["", "\u{feff}", " \n "] {
        let mut files = good();
        files.insert("home.json".into(), text.into());
        assert_eq!(reported(&files), "home.json: json::empty");
    }
}

#[test]
fn rejects_a_missing_scenario() {
    assert_eq!(reported(&BTreeMap::new()), "scenario.json: file::not-found");
}

#[test]
fn rejects_deep_nesting() {
    for (open, close) in [("[", "]"), (r#"{ "steps": "#, "}"), (r#"[{ "repeat": "#, "}]")] {
        for depth in [65, 127, 100_000] {
            let mut files = good();
            files.insert("ann.path.json".into(), format!("{}{}", open.repeat(depth), close.repeat(depth)));
            let reported = reported(&files);
            assert!(reported.starts_with("ann.path.json:1:") && reported.ends_with("json::deep-nesting"), "{reported}");
        }
    }
    let mut files = good();
    files.insert("ann.path.json".into(), format!("{}{}", "[".repeat(64), "]".repeat(64)));
    assert_eq!(reported(&files), "ann.path.json:1:1: schema::wrong-type");
}
