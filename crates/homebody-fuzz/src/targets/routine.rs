//! Routines and conditions: read, explained, completed, and lived in a home where there is all that they speak of.

use super::{life, told};
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::sentences;
use crate::target::{self, Files, Target, Verdict};
use homebody_core::problem::Problem;
use homebody_kit::Template;
use homebody_routine::completion::words;
use homebody_routine::explain::explain;
use homebody_routine::household::CONDITIONS;
use homebody_routine::language::{Known, condition, routine};
use std::collections::BTreeMap;
use std::path::Path;

pub const TARGET: Target = Target {
    name: "routine",
    about: "routines and conditions, explained and lived",
    cases: 5_000,
    corpus,
    mutate,
    run,
};

/// The file of a case.
const FILE: &str = "margaret.routine";

fn corpus() -> Vec<Files> {
    let of = |text: &[u8]| Files::from([(FILE.to_owned(), text.to_vec())]);
    let own = corpus::of(TARGET.name).into_iter().chain(corpus::scenarios());
    let own =
        own.flat_map(|files| files.into_iter().filter(|(name, _)| name.ends_with(".routine")).collect::<Vec<_>>());
    own.map(|(_, text)| of(&text)).chain(CONDITIONS.iter().map(|(_, text)| of(text.as_bytes()))).collect()
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    if dice.is(0.5) {
        files.insert(FILE.to_owned(), sentences::routine(dice).into_bytes());
        return;
    }
    target::change(files, corpus, dice, |_, text, _, dice| sentences::lines(text, dice));
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    let text = target::texts(files).remove(FILE).unwrap_or_default();
    let known = known();
    let texts = BTreeMap::from([(FILE.to_owned(), text.clone())]);
    for (understood, problems) in [routine(FILE, &text, &known), condition(FILE, &text, &known)] {
        // What is told of each problem, whatever was understood.
        problems.iter().try_for_each(|problem: &Problem| told::told(problem, &texts))?;
        let _ = explain(&understood).to_text();
    }
    let begun: String = text.chars().take(200).collect();
    let _ = words(&known, &begun);
    let template = Template::named("tigerplace").map_err(|error| error.to_string())?;
    let mut lived: BTreeMap<String, String> = template.files().collect();
    lived.insert(FILE.to_owned(), text);
    life::check_and_live(&lived, folder)
}

fn known() -> Known {
    let list = |names: &str| names.split(", ").map(str::to_owned).collect();
    Known {
        person: Some("Margaret".into()),
        places: list("armchair, sofa, bed, stove, living room window"),
        things: list("stove, fridge, front door, television"),
        rooms: list("bedroom, bathroom, kitchen, living room"),
        conditions: list("depression, heart-failure"),
        first_date: Some((2009, 3, 2)),
        ..Known::default()
    }
}
