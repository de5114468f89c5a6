//! Scenarios: their files of each kind, checked together, and lived.

use super::life;
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::{json, sentences};
use crate::target::{self, Files, Target, Verdict};
use std::path::Path;

pub const TARGET: Target =
    Target { name: "scenario", about: "scenarios, checked and lived for an hour", cases: 10_000, corpus, mutate, run };

fn corpus() -> Vec<Files> {
    corpus::of(TARGET.name).into_iter().chain(corpus::scenarios()).collect()
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    if dice.is(0.03) {
        links(files, dice);
    }
    target::change(files, corpus, dice, |name, text, others, dice| {
        if name.ends_with(".routine") {
            sentences::lines(text, dice);
        } else {
            json::json(text, others, dice);
        }
    });
}

/// Files that are missing, that stand for others, or link each other.
fn links(files: &mut Files, dice: &mut Dice) {
    let names: Vec<String> = files.keys().cloned().collect();
    let (one, other) = (dice.one(&names), dice.one(&names));
    match dice.below(3) {
        0 => drop(files.remove(one)),
        1 => drop(files.insert(one.clone(), files[other].clone())),
        _ => {
            let root = String::from_utf8_lossy(&files["scenario.json"]).replace(one.as_str(), other);
            files.insert("scenario.json".to_owned(), root.into_bytes());
        }
    }
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    life::check_and_live(&target::texts(files), folder)
}
