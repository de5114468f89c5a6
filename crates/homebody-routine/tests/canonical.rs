//! Canonical sentences: the language reads each back as the statement that it was printed from.

#![allow(clippy::disallowed_methods, reason = "a test may read and write files; the crate may not")]

use crate::home::{home, understood};
use homebody_core::problem::Problems;
use homebody_routine::canonical::sentences;
use homebody_routine::language::routine;
use homebody_routine::routine::Routine;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Without the words that a statement was read from.
pub fn meaning(routine: &Routine) -> Value {
    fn strip(value: &mut Value) {
        match value {
            Value::Object(fields) => {
                for field in ["said", "age_said", "pace_said", "quantifier", "remarks"] {
                    fields.remove(field);
                }
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
        let text = if needs.iter().any(|word| line.contains(word)) { with_others } else { line.replace(" | ", "\n") };
        let read = understood(&text);
        let printed: String = sentences(&read).into_iter().map(|(_, text)| text + "\n").collect();
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
