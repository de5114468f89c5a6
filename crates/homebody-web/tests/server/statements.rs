//! The statements of a routine, and the sentences of a statement that a form makes.

use super::drafts::{all_files, draft};
use super::served::Served;
use serde_json::{Value, json};
use std::fs;

const FILE: &str = "walter.routine";

struct Form {
    served: Served,
}

impl Form {
    fn new() -> Form {
        Form { served: Served::scenario("studio") }
    }

    fn statements(&self, text: &str) -> Vec<Value> {
        let told = self.served.told("/api/statements", &json!({ "draft": draft(FILE, text), "file": FILE }));
        assert_eq!(told["problems"], json!([]));
        told["statements"].as_array().unwrap().clone()
    }

    fn written(&self, text: &str, statement: &Value, instead: Option<usize>, line: usize) -> Value {
        let opened = |number: usize| self.statements(text).get(number).map(|one| one["statement"].clone());
        let instead = instead.map(|number| json!({ "number": number, "statement": opened(number) }));
        self.replaced(text, statement, &json!(instead), line)
    }

    /// In the place of a statement as a form was opened with it.
    fn replaced(&self, text: &str, statement: &Value, instead: &Value, line: usize) -> Value {
        let asked = json!({ "draft": draft(FILE, text), "file": FILE, "statement": statement, "instead": instead, "line": line });
        self.served.told("/api/statement", &asked)
    }

    /// The text with a statement in it.
    fn with(&self, text: &str, statement: &Value, instead: Option<usize>, line: usize) -> String {
        let told = self.written(text, statement, instead, line);
        assert_eq!((&told["problems"], &told["faults"]), (&json!([]), &json!([])), "{told:#}");
        edited(text, &told["edits"])
    }
}

/// A text after the changes of an answer.
fn edited(text: &str, edits: &Value) -> String {
    let offset = |line: &Value, column: &Value| {
        let (line, column) = (line.as_u64().unwrap() as usize, column.as_u64().unwrap() as usize);
        let before: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
        before + text[before..].chars().take(column - 1).map(char::len_utf8).sum::<usize>()
    };
    let mut fresh = text.to_owned();
    for edit in edits.as_array().unwrap().iter().rev() {
        let range = offset(&edit["line"], &edit["column"])..offset(&edit["to_line"], &edit["to_column"]);
        fresh.replace_range(range, edit["insert"].as_str().unwrap());
    }
    fresh
}

fn visit() -> Value {
    json!({ "kind": "visit", "visitor": "daughter", "activity": "visit", "when": { "days": { "weekdays": ["sunday"] },
        "time": { "at": { "low": 50100, "from": 50400, "to": 50400, "high": 50700 } },
        "lasts_s": { "low": 6480, "from": 7200, "to": 7200, "high": 7920 } } })
}

#[test]
fn statements_have_the_places_of_their_sentences() {
    let form = Form::new();
    let text = "Walter is 79. He walks at 0.6 m/s. # as measured\n\nOn Monday:\n  he gets up at 07:00\n\
                He prepares lunch at 12:00 for 20 minutes, then eats for 20 minutes.\nNote: hums a lot\n";
    let all = form.statements(text);
    let kinds: Vec<&str> = all.iter().map(|one| one["statement"]["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["person", "sleep", "habit", "habit", "note"]);
    let place = |line: u32, column: u32, length: u32| json!({ "line": line, "column": column, "length": length });
    assert_eq!(all[0]["places"], json!([place(1, 1, 13), place(1, 15, 20)]));
    assert_eq!(all[1]["places"], json!([place(4, 3, 19)]));
    assert_eq!(all[2]["places"], all[3]["places"]);
    assert_eq!(all[4]["places"], json!([place(6, 1, 16)]));
}

#[test]
fn a_new_statement_becomes_a_line_and_changes_no_other() {
    let form = Form::new();
    let before = all_files(form.served.folder.path());
    let text = "Walter is 79.\nHe reads at 10:00 for 1 hour.\nThen he naps for 20 minutes.\n";
    let sentence = "On Sunday, his daughter visits at 14:00 for 2 hours.";
    let told = form.written(text, &visit(), None, 1);
    assert_eq!(told["sentences"], json!([sentence]));
    assert_eq!(told["meaning"][0]["what"], "daughter visits");
    assert_eq!(form.with(text, &visit(), None, 1), text.replacen('\n', &format!("\n{sentence}\n"), 1));
    // A sentence with "then" stays behind the one before it.
    assert_eq!(form.with(text, &visit(), None, 2), format!("{text}{sentence}\n"));
    assert_eq!(form.with(text, &visit(), None, 4), format!("{text}{sentence}"));
    // A block keeps its heading.
    let block = "On Monday:\n  he gets up at 07:00\n  he reads at 10:00 for 1 hour\nHe naps at 14:00.\n";
    assert_eq!(form.with(block, &visit(), None, 2), block.replacen("He naps", &format!("{sentence}\nHe naps"), 1));
    assert_eq!(all_files(form.served.folder.path()), before, "nothing is written");
}

#[test]
fn an_edited_statement_replaces_its_sentence_and_nothing_else() {
    let form = Form::new();
    let text = fs::read_to_string(form.served.file("studio", FILE)).unwrap();
    for (number, one) in form.statements(&text).iter().enumerate() {
        let told = form.written(&text, &one["statement"], Some(number), 1);
        assert_eq!((&told["edits"], &told["problems"], &told["faults"]), (&json!([]), &json!([]), &json!([])), "{one}");
    }
    let text = "Walter is 79. # the age\nHe gets up at 07:00. He reads at 10:00 for 1 hour.\n";
    let mut habit = form.statements(text)[2]["statement"].clone();
    habit["place"] = "armchair".into();
    assert_eq!(
        form.with(text, &habit, Some(2), 1),
        text.replace("He reads at 10:00", "He reads in the armchair at 10:00")
    );
    // The days of a heading are those of its sentences, too.
    let block = "On Monday:\n  he gets up at 07:00\nHe naps at 14:00.\n";
    let mut up = form.statements(block)[0]["statement"].clone();
    up["when"]["time"]["at"] = json!({ "low": 28500, "from": 28800, "to": 28800, "high": 29100 });
    assert_eq!(
        form.with(block, &up, Some(0), 1),
        block.replace("he gets up at 07:00", "On Monday, he gets up at 08:00")
    );
    up["when"].as_object_mut().unwrap().remove("days");
    let told = form.written(block, &up, Some(0), 1);
    assert_eq!(told["faults"][0]["field"], "/when/days", "{told:#}");
}

#[test]
fn several_statements_of_a_sentence_get_sentences_of_their_own() {
    let form = Form::new();
    let text = "He prepares lunch at 12:00 for 20 minutes, then eats for 20 minutes. He naps at 14:00.\n";
    let mut eats = form.statements(text)[1]["statement"].clone();
    eats["when"]["lasts_s"] = json!({ "low": 1620, "from": 1800, "to": 1800, "high": 1980 });
    let fresh = form.with(text, &eats, Some(1), 1);
    assert_eq!(
        fresh,
        "He prepares lunch at 12:00 for 20 minutes. Then, he eats lunch for 30 minutes. He naps at 14:00.\n"
    );
}

#[test]
fn a_person_of_several_sentences_changes_in_the_sentence_of_the_fact() {
    let form = Form::new();
    let text = "Walter is 79.\nHe reads at 10:00 for 1 hour.\nWalter walks at 0.6 m/s.\n";
    let person = form.statements(text)[0]["statement"].clone();
    let with = |key: &str, value: Value| {
        let mut person = person.clone();
        person[key] = value;
        form.with(text, &person, Some(0), 1)
    };
    assert_eq!(with("age_years", 80.into()), text.replace("Walter is 79.", "Walter is 80 years old."));
    assert_eq!(with("pace_mps", Value::Null), text.replace("Walter walks at 0.6 m/s.\n", ""));
    let rests = json!({ "after_m": 30, "lasts_s": { "low": 54, "from": 60, "to": 60, "high": 66 } });
    assert_eq!(with("rests", rests), format!("{text}Walter rests after 30 m for 1 minute.\n"));
    let told = form.written(text, &person, None, 1);
    assert_eq!(told["problems"][0]["code"], "desk::second-person");
}

#[test]
fn all_faults_of_a_statement_are_named_with_their_fields() {
    let form = Form::new();
    let text = "Walter is 79.\n";
    let faults = |statement: Value| -> Vec<String> {
        let told = form.written(text, &statement, None, 1);
        assert_eq!(told["edits"], json!([]));
        let faults = told["faults"].as_array().unwrap().iter();
        faults.map(|fault| fault["field"].as_str().unwrap().to_owned()).collect()
    };
    let wrong = json!({ "kind": "habit", "activity": 7, "colour": "red", "when": { "days": { "weekdays": ["someday"] },
        "times": [1, "x"], "phase": { "from": "soon" }, "lasts_s": { "low": 1 } } });
    let found = faults(wrong);
    for field in ["/activity", "/colour", "/when/days/weekdays/0", "/when/times/1", "/when/phase/from", "/when/lasts_s"]
    {
        assert!(found.iter().any(|one| one == field), "{field} is not in {found:?}");
    }
    assert_eq!(faults(json!({ "kind": "dance" })), ["/kind"]);
    assert_eq!(faults(json!([1])), [""]);
    assert_eq!(faults(json!({ "kind": "habit" })), [""]);
}

#[test]
fn problems_of_the_sentence_come_with_their_hints() {
    let form = Form::new();
    let text = "Walter is 79.\nHe gest up.\n";
    let mut nowhere = visit();
    nowhere["kind"] = "habit".into();
    nowhere.as_object_mut().unwrap().remove("visitor");
    nowhere["activity"] = "reading".into();
    nowhere["place"] = "armchiar".into();
    let told = form.written(text, &nowhere, None, 1);
    assert_eq!(told["problems"].as_array().unwrap().len(), 1, "the problem of another line is not of the statement");
    assert!(told["problems"][0]["hint"].as_str().unwrap().contains("armchair"), "{told:#}");
    assert_eq!(told["edits"], json!([]));
    // A sentence that would run into the next, and one in another language.
    let note = json!({ "kind": "note", "text": "a\nHe reads at 10:00." });
    assert_eq!(form.written(text, &note, None, 1)["problems"][0]["code"], "desk::changes-others");
    let german = form.written("Sprache: Deutsch\n", &visit(), None, 1);
    assert_eq!(german["problems"][0]["code"], "desk::other-language");
    let empty = form.written(text, &json!({ "kind": "note", "text": " " }), None, 1);
    assert_eq!(empty["problems"][0]["code"], "desk::nothing-said");
    let gone = form.written(text, &visit(), Some(9), 1);
    assert_eq!(gone["problems"][0]["code"], "desk::no-statement");
}

#[test]
fn days_a_week_need_no_probability() {
    let form = Form::new();
    let mut weekly = visit();
    weekly["when"]["days"] = json!({});
    weekly["when"]["chance"] = json!({ "days_a_week": 3 });
    let fresh = form.with("Walter is 79.\nHe naps at 14:00.\n", &weekly, None, 1);
    assert!(fresh.contains("\n3 times a week, his daughter visits at 14:00 for 2 hours.\n"), "{fresh}");
    // A value that no sentence says is named, with its field.
    weekly["when"]["lasts_s"]["high"] = 9000.into();
    let told = form.written("Walter is 79.\n", &weekly, None, 1);
    let fields: Vec<&Value> = told["faults"].as_array().unwrap().iter().map(|fault| &fault["field"]).collect();
    assert_eq!(
        (fields, told["faults"][0]["what"].as_str().unwrap().is_empty()),
        (vec![&json!("/when/lasts_s/high")], false)
    );
}

#[test]
fn hostile_statements_break_nothing() {
    let form = Form::new();
    let text = "Walter is 79.\n";
    for number in [json!(1e308), json!(-1e308), json!(0), json!(u64::MAX)] {
        let fuzzy = json!({ "low": number, "from": number, "to": number, "high": number });
        let days = json!({ "weekdays": ["monday"], "of_month": [255, 255], "every": u32::MAX });
        let when =
            json!({ "days": days, "lasts_s": fuzzy, "until_s": fuzzy, "time": { "at": fuzzy }, "nights": u32::MAX });
        for activity in ["", " ", "\u{202e}x\n", "reading"] {
            let habit = json!({ "kind": "habit", "activity": activity, "place": "\"", "when": when });
            form.written(text, &habit, None, 1);
            let rule = json!({ "kind": "rule", "whenever": { "doing": activity }, "response": { "do": { "activity": activity, "place": null, "lasts": null } } });
            form.written(text, &rule, Some(0), u32::MAX as usize);
        }
    }
}

#[test]
fn a_sentence_that_moved_since_the_form_was_opened_is_not_replaced() {
    let form = Form::new();
    let text = "Walter is 79.\nHe reads at 10:00 for 1 hour.\nHe naps at 14:00.\n";
    let mut nap = form.statements(text)[2]["statement"].clone();
    let instead = json!({ "number": 2, "statement": nap });
    nap["place"] = "armchair".into();
    let told = form.replaced(text, &nap, &instead, 3);
    assert_eq!(edited(text, &told["edits"]), text.replace("He naps", "He naps in the armchair"));
    // Two sentences more above: the number is that of another statement.
    let moved = format!("He wakes up at 06:00.\nHe eats breakfast at 08:00.\n{text}");
    let told = form.replaced(&moved, &nap, &instead, 3);
    assert_eq!((&told["edits"], &told["problems"][0]["code"]), (&json!([]), &json!("desk::no-statement")));
}

#[test]
fn a_statement_that_is_read_as_another_one_is_not_written() {
    let form = Form::new();
    let text = "Walter is 79.\n";
    let reading = |activity: &str, place: &str| json!({ "kind": "habit", "activity": activity, "place": place, "when": { "time": { "at": { "low": 35700, "from": 36000, "to": 36000, "high": 36300 } } } });
    for wrong in [reading("reads # comment", "armchair"), reading("reading", "armchair on Sunday")] {
        let told = form.written(text, &wrong, None, 1);
        assert_eq!(told["edits"], json!([]), "{told:#}");
        assert_ne!((&told["faults"], &told["problems"]), (&json!([]), &json!([])), "{told:#}");
    }
    for right in [reading("reading", "ARMCHAIR"), reading("reading", " armchair ")] {
        form.with(text, &right, None, 1);
    }
    let mut often = reading("reading", "armchair");
    often["when"]["chance"] = json!({ "probability": 1.005 });
    let told = form.written(text, &often, None, 1);
    assert_eq!((&told["edits"], &told["faults"][0]["field"]), (&json!([]), &json!("/when/chance/probability")));
}

#[test]
fn a_time_after_midnight_is_on_the_next_day() {
    let form = Form::new();
    let reading = |to: u32| json!({ "kind": "habit", "activity": "reading", "when": { "time": { "at": { "low": 82800, "from": 82800, "to": to, "high": to } } } });
    let fresh = form.with("Walter is 79.\n", &reading(90_000), None, 1);
    assert!(fresh.contains("between 23:00 and 01:00"), "{fresh}");
    let told = form.written("Walter is 79.\n", &reading(3600), None, 1);
    assert_eq!(told["edits"], json!([]), "{told:#}");
}

#[test]
fn statements_that_a_form_begins_with_have_no_fault() {
    let form = Form::new();
    let text = "Walter is 79.\nWhenever the stove has been on for 20 minutes, he turns it off.\nHe reads at 10:00 for 1 hour.\n";
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../web/src/testing/first-statements.json");
    let all: Vec<Value> = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    assert!(all.len() > 20);
    let mut wrong = Vec::new();
    for statement in &all {
        let (text, line) = if statement["kind"] == "person" { ("He reads at 10:00.\n", 1) } else { (text, 2) };
        let told = form.written(text, statement, None, line);
        if told["edits"] == json!([]) {
            wrong.push(format!("{statement}: {} {}", told["faults"], told["problems"]));
        }
    }
    assert_eq!(wrong, Vec::<String>::new(), "{wrong:#?}");
}
