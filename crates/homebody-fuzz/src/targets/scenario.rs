//! Scenarios: their files of each kind, checked together, and simulated.

use super::simulation;
use crate::choices::Choices;
use crate::mutate::{json, sentences};
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use std::path::Path;

pub const TARGET: Target = Target { name: "scenario", cases: 10_000, seeds, mutate, run };

fn seeds() -> Vec<CaseFiles> {
    seeds::named(TARGET.name).into_iter().chain(seeds::scenarios()).collect()
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    if choices.is(0.03) {
        links(files, choices);
    }
    target::change(files, seeds, choices, |name, text, others, choices| {
        if name.ends_with(".routine") {
            sentences::lines(text, choices);
        } else {
            json::json(text, others, choices);
        }
    });
}

/// Files that are missing, replace each other, or link each other.
fn links(files: &mut CaseFiles, choices: &mut Choices) {
    let names: Vec<String> = files.keys().cloned().collect();
    let (one, other) = (choices.one(&names), choices.one(&names));
    match choices.below(3) {
        0 => drop(files.remove(one)),
        1 => drop(files.insert(one.clone(), files[other].clone())),
        _ => {
            let root = String::from_utf8_lossy(&files["scenario.json"]).replace(one.as_str(), other);
            files.insert("scenario.json".to_owned(), root.into_bytes());
        }
    }
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    simulation::check_and_simulate(&target::texts(files), folder)
}
