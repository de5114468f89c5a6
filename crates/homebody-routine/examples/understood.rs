//! The language on sentences of other people: reads files with one a line, as JSON with its `text` or `say`, writes
//! after each the understood part, the remarks and the refusals, and counts them.
//!
//! `cargo run -p homebody-routine --example understood -- [OWN.words] SENTENCES.jsonl`

#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "an example reads files and prints")]

#[path = "../tests/home/mod.rs"]
mod home;

use home::{home, short};
use homebody_routine::language::{KnownNames, routine};
use homebody_routine::routine::{Activity, Routine};
use serde_json::{Value, json};

fn main() {
    let mut known = KnownNames { usual: Activity::OWN_WAYS.to_vec(), ..home() };
    let (words, sentences): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|file| file.ends_with(".words"));
    for file in words {
        let text = std::fs::read_to_string(&file).unwrap_or_else(|fault| panic!("{file}: {fault}"));
        let (lexicon, problems) = known.lexicon.with(&file, &text);
        assert!(problems.is_empty(), "{problems:?}");
        known.lexicon = lexicon;
    }
    let (mut lived, mut remarks, mut hinted, mut unhinted) = (0, 0, 0, 0);
    for file in sentences {
        let text = std::fs::read_to_string(&file).unwrap_or_else(|fault| panic!("{file}: {fault}"));
        for line in text.lines() {
            let line: Value = serde_json::from_str(line).unwrap_or_else(|fault| panic!("{file}: {fault}"));
            let said = line["text"].as_str().or(line["say"].as_str()).unwrap_or_default();
            let (found, problems) = routine("margaret.routine", said, &known);
            let proposes =
                |hint: &String| ["without it: \"", "write \"", "numbers, \""].iter().any(|way| hint.contains(way));
            match problems.is_empty() {
                true if found
                    == (Routine { remarks: found.remarks.clone(), file: found.file.clone(), ..Routine::default() }) =>
                {
                    remarks += 1
                }
                true => lived += 1,
                false if problems.iter().any(|problem| problem.hint.as_ref().is_some_and(proposes)) => hinted += 1,
                false => unhinted += 1,
            }
            let beside: Vec<&String> = found.remarks.iter().map(|remark| &remark.text).collect();
            let told: Vec<String> = problems
                .iter()
                .map(|one| format!("{} | {}", one.what, one.hint.as_deref().unwrap_or("no hint")))
                .collect();
            let shown = if problems.is_empty() { short(&found) } else { String::new() };
            println!(
                "{}",
                json!({"id": line["id"], "text": said, "meaning": line["meaning"], "understood": shown, "remarks": beside, "problems": told})
            );
        }
    }
    println!(
        "{}",
        json!({"lived": lived, "remarks": remarks, "refused, with a sentence that is understood": hinted, "refused, without": unhinted})
    );
}
