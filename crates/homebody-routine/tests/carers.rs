//! Sentences of care plans in their own words, compared with equivalent sentences of the language.
//!
//! `carers.jsonl` has one per line: the sentence, and its meaning. "remark": it has no effect. "refused": nothing says its
//! meaning. Most are refused, because the language reads no other words than its own. Of those that it reads, each has its
//! listed meaning.

use crate::home::{home, short};
use homebody_core::problem::Problem;
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

/// Sentences that are read, of all of the file. More is better; fewer is a loss.
const LEAST_READ: usize = 170;

#[test]
fn sentences_of_carers_are_refused_or_have_the_listed_meaning() {
    let (mut wrong, mut accepted) = (Vec::new(), 0);
    for (said, means) in lines() {
        let (found, problems) = read(&said);
        if !problems.is_empty() {
            continue;
        }
        accepted += 1;
        let shown = short(&found);
        let (meant, faults) = read(&means);
        // A meaning in words that the language has no more cannot be compared.
        let is_right = !faults.is_empty() || lived(&shown) == lived(&short(&meant));
        if !is_right || ["remark", "refused"].contains(&means.as_str()) {
            wrong.push(format!("{said}\n  meant {means}: {}\n  found {shown}", short(&meant)));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), lines().len(), wrong.join("\n"));
    assert!(accepted >= LEAST_READ, "{accepted}");
}
