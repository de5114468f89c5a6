//! Routines and conditions: parsed, explained, completed, and simulated in a home with everything that they need.

use super::{messages, simulation};
use crate::choices::Choices;
use crate::mutate::sentences;
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_core::problem::Problem;
use homebody_routine::completion::words;
use homebody_routine::explain::explain;
use homebody_routine::household::CONDITIONS;
use homebody_routine::language::{KnownNames, condition, routine};
use homebody_simulation::Template;
use std::collections::BTreeMap;
use std::path::Path;

pub const TARGET: Target = Target { name: "routine", cases: 5_000, seeds, mutate, run };

const FILE: &str = "margaret.routine";

fn seeds() -> Vec<CaseFiles> {
    let mut seeds = seeds::with_ending(TARGET.name, ".routine", FILE);
    seeds.extend(CONDITIONS.iter().map(|(_, text)| CaseFiles::from([(FILE.to_owned(), text.as_bytes().to_vec())])));
    seeds
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    if choices.is(0.5) {
        files.insert(FILE.to_owned(), sentences::routine(choices).into_bytes());
        return;
    }
    target::change(files, seeds, choices, |_, text, _, choices| sentences::lines(text, choices));
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let text = target::texts(files).remove(FILE).unwrap_or_default();
    let known = known();
    let texts = BTreeMap::from([(FILE.to_owned(), text.clone())]);
    for (understood, problems) in [routine(FILE, &text, &known), condition(FILE, &text, &known)] {
        // Each problem, also of sentences that were parsed.
        problems.iter().try_for_each(|problem: &Problem| messages::problem(problem, &texts))?;
        let _ = explain(&understood).to_text();
    }
    let begun: String = text.chars().take(200).collect();
    let _ = words(&known, &begun);
    let template = Template::named("tigerplace").map_err(|error| error.to_string())?;
    let mut texts: BTreeMap<String, String> = template.files().collect();
    texts.insert(FILE.to_owned(), text);
    simulation::check_and_simulate(&texts, folder)
}

fn known() -> KnownNames {
    let list = |names: &str| names.split(", ").map(str::to_owned).collect();
    KnownNames {
        person: Some("Margaret".into()),
        places: list("armchair, sofa, bed, stove, living room window"),
        things: list("stove, fridge, front door, television"),
        rooms: list("bedroom, bathroom, kitchen, living room"),
        conditions: list("depression, heart-failure"),
        first_date: Some((2009, 3, 2)),
        ..KnownNames::default()
    }
}
