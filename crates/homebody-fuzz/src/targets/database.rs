//! Logs in databases, by this program and by others.

use super::log;
use crate::choices::Choices;
use crate::mutate::sql;
use crate::seeds;
use crate::target::{self, CaseFiles, Target};

pub const TARGET: Target = Target { name: "database", cases: 2_000, seeds, mutate, run: log::read_and_analyse };

const SCRIPT: &str = "script.sql";

fn seeds() -> Vec<CaseFiles> {
    scripts(TARGET.name, log::FILE)
}

/// The databases of a target's seeds, each with its script; the database gets this file name.
pub fn scripts(target: &str, file: &str) -> Vec<CaseFiles> {
    let made = |script: Vec<u8>| {
        let database = sql::plain(&String::from_utf8_lossy(&script));
        CaseFiles::from([(SCRIPT.to_owned(), script), (file.to_owned(), database)])
    };
    seeds::named(target).into_iter().flat_map(CaseFiles::into_values).map(made).collect()
}

/// Makes another database from a case's script.
pub fn remade(files: &mut CaseFiles, file: &str, choices: &mut Choices) {
    let database = sql::database(target::text(files, SCRIPT), choices);
    files.insert(file.to_owned(), database);
}

fn mutate(files: &mut CaseFiles, _: &[CaseFiles], choices: &mut Choices) {
    remade(files, log::FILE, choices);
    if choices.is(0.3) {
        let mut mapping = String::new();
        log::mapping(&mut mapping, choices);
        files.insert(log::MAPPING.to_owned(), mapping.into_bytes());
    }
}
