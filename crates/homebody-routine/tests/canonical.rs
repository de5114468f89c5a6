//! Canonical sentences: the language reads each back as the statement that it was printed from.

#![allow(clippy::disallowed_methods, reason = "a test may read and write files; the crate may not")]

use crate::home::{home, understood};
use homebody_core::problem::Problems;
use homebody_routine::language::routine;
use homebody_routine::routine::Routine;
use homebody_routine::statement::{Statement, statements, text};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Without the words that a statement was read from.
pub fn meaning(routine: &Routine) -> Value {
    fn strip(value: &mut Value) {
        match value {
            Value::Object(fields) => {
                fields.remove("remarks");
                fields.values_mut().for_each(strip);
            }
            Value::Array(values) => values.iter_mut().for_each(strip),
            _ => {}
        }
    }
    let mut value = serde_json::to_value(routine).unwrap();
    strip(&mut value);
    value
}

#[test]
fn canonical_sentences_of_all_forms_keep_their_meaning() {
    const OTHERS: &str = "She gets up at 06:45. She prepares breakfast, then eats. She eats lunch. She eats dinner. \
                          She takes a shower. She takes her pills. She watches television. She does the laundry. \
                          She leaves the apartment for 1 to 12 hours.\n";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/forms.txt");
    let table = fs::read_to_string(path).unwrap();
    let mut lost = Vec::new();
    for line in table.lines().filter(|line| !line.is_empty() && !line.starts_with(['#', ' '])) {
        let with_others = format!("{OTHERS}{}", line.replace(" | ", "\n"));
        let needs = ["after", "before", "with", "henever", "If", "home", "during", "while", "over b", "at b"];
        let written =
            if needs.iter().any(|word| line.contains(word)) { with_others } else { line.replace(" | ", "\n") };
        let read = understood(&written);
        let printed = text(statements(&read).iter().map(|(_, statement)| statement));
        let (again, problems) = routine("margaret.routine", &printed, &home());
        if !problems.is_empty() {
            lost.push(format!(
                "{line}\n  {}\n  {}",
                printed.lines().last().unwrap_or_default(),
                Problems(problems).render()
            ));
        } else if meaning(&again) != meaning(&read) {
            lost.push(format!(
                "{line}\n  {}\n  {}\n  {}",
                printed.lines().last().unwrap_or_default(),
                meaning(&read),
                meaning(&again)
            ));
        }
    }
    assert!(lost.is_empty(), "{} lost\n{}", lost.len(), lost.join("\n"));
}

#[test]
fn a_share_has_as_few_digits_as_it_was_written_with() {
    for percent in ["3.3", "0.1", "7", "12.7", "33.3", "99.9"] {
        let read = understood(&format!("On {percent} % of days, she reads at 10:00."));
        let printed = text(statements(&read).iter().map(|(_, statement)| statement));
        assert!(printed.contains(&format!("n {percent} % of days")), "{percent}: {printed}");
        assert_eq!(meaning(&understood(&printed)), meaning(&read));
    }
}

#[test]
fn statements_survive_json() {
    let read = understood(
        "Margaret is 82. She walks at about 0.65 m/s. From day 40, over 14 days, until 2009-06-01, fading over 3 days, \
         on Tuesday and Friday in May she reads in the armchair at 07:30, give or take 10 minutes, for 30 to 40 minutes.\n\
         She goes to bed at 22:30 in the bed. She goes out on 30 % of days. Her daughter visits on the first Monday of the \
         month at 14:00. She falls out of bed once a month. She walks 10 % slower. She forgets the stove on 5 % of \
         occasions. Whenever the stove has been on for 20 minutes and she is not in the kitchen, she turns it off. She prepares \
         lunch at 12:00.",
    );
    let all: Vec<Statement> = statements(&read).into_iter().map(|(_, statement)| statement).collect();
    let json = serde_json::to_string_pretty(&all).unwrap();
    let again: Vec<Statement> = serde_json::from_str(&json).unwrap();
    let kinds: Vec<Value> = serde_json::from_str::<Vec<Value>>(&json).unwrap();
    let kinds: Vec<&str> = kinds.iter().filter_map(|statement| statement["kind"].as_str()).collect();
    assert_eq!(kinds, ["person", "habit", "sleep", "away", "visit", "event", "change", "thing", "rule", "habit"]);
    assert_eq!((text(&again), serde_json::to_string_pretty(&again).unwrap()), (text(&all), json));
    let read_again = understood(&text(&again));
    assert_eq!(meaning(&read_again), meaning(&read));
    let wrong = r#"[{"kind": "habit", "activity": "reading", "palce": "armchair"}]"#;
    let error = serde_json::from_str::<Vec<Statement>>(wrong).unwrap_err().to_string();
    assert!(error.contains("palce"), "{error}");
}

#[test]
fn the_schema_of_statements_is_generated() {
    let schema = serde_json::to_string_pretty(&Statement::list_schema().1).unwrap() + "\n";
    crate::generated::is_generated("schemas/statements.schema.json", &schema);
}
