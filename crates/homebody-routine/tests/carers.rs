//! Sentences of care plans in their own words, compared with equivalent sentences of the language.
//!
//! `carers.jsonl` has one per line: the sentence, and its meaning. "remark": it has no effect. "refused": it is rejected
//! with a hint.

#![allow(clippy::disallowed_methods, reason = "a test may read files; the crate may not")]

mod home;

use home::{home, short};
use homebody_core::problem::{Problem, Problems};
use homebody_routine::language::{KnownNames, routine};
use homebody_routine::routine::{Activity, Routine};
use serde_json::Value;

fn known() -> KnownNames {
    KnownNames { usual: Activity::OWN_WAYS.to_vec(), ..home() }
}

fn read(text: &str) -> (Routine, Vec<Problem>) {
    routine("margaret.routine", text, &known())
}

fn lines() -> Vec<(String, String)> {
    let text = include_str!("carers.jsonl");
    let text_of = |line: &Value, key: &str| line[key].as_str().unwrap().to_owned();
    let lines = text.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    lines
        .filter(|line| line.get("skip").is_none())
        .map(|line| (text_of(&line, "say"), text_of(&line, "means")))
        .collect()
}

/// The habits of a meaning, without remarks.
fn lived(shown: &str) -> Vec<&str> {
    shown.split(" & ").filter(|one| *one != "remark").collect()
}

#[test]
fn sentences_of_carers_have_their_listed_meaning() {
    let mut wrong = Vec::new();
    for (said, means) in lines() {
        let (found, problems) = read(&said);
        let shown = if problems.is_empty() { short(&found) } else { Problems(problems.clone()).to_string() };
        let is_right = match means.as_str() {
            "refused" => !problems.is_empty(),
            "remark" => problems.is_empty() && !found.remarks.is_empty() && lived(&shown).is_empty(),
            _ => {
                let (meant, faults) = read(&means);
                assert!(faults.is_empty(), "{means}: {}", Problems(faults));
                problems.is_empty() && lived(&shown) == lived(&short(&meant))
            }
        };
        if !is_right {
            let meant = short(&read(&means).0);
            wrong.push(format!("{said}\n  meant {means}: {meant}\n  found {shown}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), lines().len(), wrong.join("\n"));
}
