//! Text that is no JSON, and text that only looks odd.

use crate::*;

#[test]
#[rustfmt::skip] // A case is read line by line: the change, then what is said of it.
fn text_that_is_no_json() {
    check(&[
        ("scenario.json", r#""days": 2,"#, r#""days": 2"#,
            "scenario.json:5:12: a comma is missing here"),
        ("scenario.json", r#""bob.json"]"#, r#""bob.json",]"#,
            "scenario.json:8:39: this comma has nothing after it; remove it"),
        ("scenario.json", r#""days": 2,"#, r#""days": 2, // of March"#,
            r#"scenario.json:5:14: JSON has no comments; say it in "about" instead"#),
        ("scenario.json", r#""days": 2,"#, r#""days": NaN,"#,
            "scenario.json:5:11: NaN and Infinity are no numbers of JSON"),
        ("scenario.json", r#""days": 2,"#, r#""days": Infinity,"#,
            "scenario.json:5:11: NaN and Infinity are no numbers of JSON"),
        ("scenario.json", r#""days": 2,"#, r#""days": 0x10,"#,
            "scenario.json:5:11: numbers must be decimal"),
        ("scenario.json", r#""days": 2,"#, r#""days": 07,"#,
            "scenario.json:5:12: a number must not begin with 0"),
        ("scenario.json", r#""days": 2,"#, r#""days": .5,"#,
            "scenario.json:5:11: a number needs a digit on both sides of its point; write 0.5 for .5, 5.0 for 5."),
        ("scenario.json", r#""days": 2,"#, r#""days": ,"#,
            "scenario.json:5:11: this comma has nothing before it; remove it"),
        ("scenario.json", r#""days": 2,"#, "days: 2,",
            r#"scenario.json:5:3: a key must stand in quotes; write "key": value"#),
        ("scenario.json", r#""days": 2,"#, r#""days": 2,5,"#,
            "scenario.json:5:13: a key in quotes must stand here; a number has a point, not a comma: 0.5 for 0,5"),
        ("scenario.json", r#""days": 2,"#, "'days': 2,",
            r#"scenario.json:5:3: text must stand in double quotes; write " instead of '"#),
        ("scenario.json", r#""name": "two rooms","#, r#""name": "two rooms,"#,
            r#"scenario.json:2:11: this text is not closed; close it with " on the same line"#),
        ("scenario.json", r#""name": "two rooms","#, r#""name": "two \rooms \x","#,
            r#"scenario.json:2:23: this text has a \ that means nothing; write \\ for a backslash"#),
        ("scenario.json", r#""name": "two rooms","#, "\"name\": \"two \trooms\",",
            r#"scenario.json:2:16: a text must not hold a control character; write \t for a tab, \u and four digits for others"#),
        ("scenario.json", r#""name": "two rooms","#, r#""name": "two \ud800 rooms","#,
            r#"scenario.json:2:16: this text has a \ that means nothing; write \\ for a backslash"#),
        ("scenario.json", "\"bob.json\"]\n}", "\"bob.json\"]\n",
            "scenario.json:1:1: this { is never closed; add the missing }"),
        ("scenario.json", "\"bob.json\"]\n}", "\"bob.json\"]\n}}",
            "scenario.json:9:2: the file goes on after its end; remove this, or a } or ] before it"),
        ("logger.json", "\"utc\"\n}", "\"utc\"\n} {}",
            "logger.json:8:3: the file goes on after its end; remove this, or a } or ] before it"),
        ("logger.json", r#""time": "utc""#, r#""time""#,
            r#"logger.json:8:1: a key needs a colon and a value after it; write "key": value"#),
    ]);
}

#[test]
fn columns_count_characters() {
    let case = ("home.json", r#""name": "table", "at": [2"#, r#""name": "Tischchen für Öl", "at": ["2""#);
    let expected = r#"home.json:19:42: item 1 of "at" must be a number, but is the text "2"; remove the quotes"#;
    assert_eq!(said(&broken(&[case])), expected);
}

#[test]
fn lines_may_end_as_on_any_system() {
    for end in ["\r\n", "\r", "\n"] {
        let mut files = broken(&[("home.json", r#""name": "sink""#, r#""nam": "sink""#)]);
        for text in files.values_mut() {
            *text = text.replace('\n', end);
        }
        assert_eq!(said(&files), r#"home.json:23:7: "nam" is no key of a place; did you mean "name"?"#);
    }
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let mut files = good();
    for text in files.values_mut() {
        text.insert(0, '\u{feff}');
    }
    assert_eq!(said(&files), "");
}

#[test]
fn an_empty_file_is_said_to_be_empty() {
    for text in ["", "\u{feff}", " \n "] {
        let mut files = good();
        files.insert("home.json".into(), text.into());
        assert_eq!(said(&files), "home.json: the file is empty");
    }
}

#[test]
fn a_missing_scenario_is_said_to_be_missing() {
    assert_eq!(said(&BTreeMap::new()), "scenario.json: cannot be read: there is no such file");
}

#[test]
fn deep_nesting_is_refused_however_deep() {
    for (open, close) in [("[", "]"), (r#"{ "steps": "#, "}"), (r#"[{ "repeat": "#, "}]")] {
        for depth in [65, 127, 100_000] {
            let mut files = good();
            files.insert("ann.path.json".into(), format!("{}{}", open.repeat(depth), close.repeat(depth)));
            let said = said(&files);
            assert!(said.starts_with("ann.path.json:1:") && said.ends_with("nested more than 64 deep"), "{said}");
        }
    }
    let mut files = good();
    files.insert("ann.path.json".into(), format!("{}{}", "[".repeat(64), "]".repeat(64)));
    assert_eq!(
        said(&files),
        "ann.path.json:1:1: the file must be an object { ... }, but is a list; A path: the steps that a resident follows"
    );
}
