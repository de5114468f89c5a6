//! Lists of profiles, of which cohorts are made.

use super::{life, told};
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::tables;
use crate::target::{self, Files, Target, Verdict};
use homebody_kit::{OpenScenario, template};
use std::path::Path;
use std::sync::OnceLock;

pub const TARGET: Target =
    Target { name: "profile", about: "lists of profiles for cohorts", cases: 1_000, corpus, mutate, run };

const FILE: &str = "people.csv";

fn corpus() -> Vec<Files> {
    let texts = corpus::of(TARGET.name).into_iter().flat_map(Files::into_values);
    texts.map(|text| Files::from([(FILE.to_owned(), text)])).collect()
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    target::change(files, corpus, dice, |_, text, _, dice| tables::table(text, dice));
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    static BASE: OnceLock<OpenScenario> = OnceLock::new();
    let base = BASE.get_or_init(|| template("older-adult").expect("it comes with the program, and is tested"));
    let texts = target::texts(files);
    let Some(table) = texts.get(FILE) else { return Ok(Verdict::Refused) };
    match base.profiles_of(FILE, table, &[]) {
        Ok(profiles) => {
            let first = profiles.into_iter().take(1).collect();
            let cohort = base.cohort_of(first).days(0.01).start().map_err(|error| error.to_string())?;
            let _ = cohort.progress();
            life::live(base, folder).map(|()| Verdict::Accepted)
        }
        Err(error) => told::error(&error, &texts).map(|()| Verdict::Refused),
    }
}
