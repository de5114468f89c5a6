//! Sentences of people who do not know the language: `untrained_writers.txt` has the result of each, and totals. A reading of
//! words that the language covers refuses most of them; `homebody life from` makes statements of such texts.

use crate::generated;
use crate::home::{home, short};
use homebody_routine::language::{KnownNames, routine};
use homebody_routine::routine::Activity;
use serde_json::Value;
use std::fmt::Write;

const LOOKED_AT: usize = 197;

#[derive(Clone, Copy, PartialEq)]
enum Verdict {
    Lived,
    Remark,
    RefusedWithSentence,
    Refused,
}

const VERDICTS: [(Verdict, &str); 4] = [
    (Verdict::Lived, "lived"),
    (Verdict::Remark, "kept as a remark"),
    (Verdict::RefusedWithSentence, "refused, with a sentence that is understood"),
    (Verdict::Refused, "refused, without"),
];

#[test]
fn the_results_of_other_peoples_sentences_are_listed() {
    let known = KnownNames { usual: Activity::OWN_WAYS.to_vec(), ..home() };
    let (mut text, mut verdicts) = (String::new(), Vec::new());
    for line in include_str!("untrained_writers.jsonl").lines() {
        let line: Value = serde_json::from_str(line).unwrap();
        let (said, meaning) = (line["say"].as_str().unwrap(), line["meaning"].as_str().unwrap());
        let (found, problems) = routine("margaret.routine", said, &known);
        writeln!(text, "{said}\n    meant: {meaning}").unwrap();
        let verdict = match problems.first() {
            None => {
                let beside: Vec<&str> = found.remarks.iter().map(|remark| remark.text.as_str()).collect();
                let shown = short(&found);
                let lived: Vec<&str> = shown.split(" & ").filter(|one| *one != "remark").collect();
                if !lived.is_empty() {
                    writeln!(text, "    lived: {}", lived.join(" & ")).unwrap();
                }
                beside.iter().for_each(|beside| writeln!(text, "    not lived: {beside}").unwrap());
                if lived.is_empty() { Verdict::Remark } else { Verdict::Lived }
            }
            Some(_) => {
                let hints = problems.iter().filter_map(|problem| problem.hint.as_ref());
                let proposes = |hint: &&String| {
                    ["without it: \"", "write \"She ", "write \"He ", "times, \""].iter().any(|way| hint.contains(way))
                };
                let hint = hints.clone().find(proposes);
                writeln!(text, "    refused: {}", hint.or(problems[0].hint.as_ref()).unwrap_or(&problems[0].what))
                    .unwrap();
                if hint.is_some() { Verdict::RefusedWithSentence } else { Verdict::Refused }
            }
        };
        verdicts.push(verdict);
    }
    for (name, of) in [("looked at", &verdicts[..LOOKED_AT]), ("kept aside", &verdicts[LOOKED_AT..])] {
        writeln!(text, "\n{name}, {} sentences", of.len()).unwrap();
        for (verdict, what) in VERDICTS {
            writeln!(text, "    {what}: {}", of.iter().filter(|one| **one == verdict).count()).unwrap();
        }
    }
    generated::is_generated("crates/homebody-routine/tests/untrained_writers.txt", &text);
}
