//! Lists of profiles for cohorts.

use super::{messages, simulation};
use crate::choices::Choices;
use crate::mutate::tables;
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_simulation::{OpenScenario, template};
use std::path::Path;
use std::sync::OnceLock;

pub const TARGET: Target = Target { name: "profile", cases: 1_000, seeds, mutate, run };

const FILE: &str = "people.csv";

fn seeds() -> Vec<CaseFiles> {
    seeds::files(TARGET.name, FILE)
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    target::change(files, seeds, choices, |_, text, _, choices| tables::table(text, choices));
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    static BASE: OnceLock<OpenScenario> = OnceLock::new();
    let base = BASE.get_or_init(|| template("older-adult").expect("it comes with the program, and is tested"));
    let texts = target::texts(files);
    let Some(table) = texts.get(FILE) else { return Ok(ReadVerdict::Refused) };
    match base.profiles_from_table(FILE, table, &[]) {
        Ok(profiles) => {
            let first = profiles.into_iter().take(1).collect();
            let cohort = base.cohort_of(first).days(0.01).start().map_err(|error| error.to_string())?;
            let _ = cohort.progress();
            simulation::simulate(base, folder).map(|()| ReadVerdict::Accepted)
        }
        Err(error) => messages::error(&error, &texts).map(|()| ReadVerdict::Refused),
    }
}
