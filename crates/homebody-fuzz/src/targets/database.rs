//! Logs in databases, ours and others'.

use super::log;
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::sql;
use crate::target::{self, Files, Target, Verdict};
use std::path::Path;

pub const TARGET: Target =
    Target { name: "database", about: "logs in SQLite, mapped by logger.json", cases: 2_000, corpus, mutate, run };

/// What a database of the corpus is made of.
const SCRIPT: &str = "script.sql";

fn corpus() -> Vec<Files> {
    scripts(TARGET.name, log::FILE)
}

/// The databases that the scripts of a target's corpus make, as the file of this name, each with its script.
pub fn scripts(target: &str, file: &str) -> Vec<Files> {
    let made = |script: Vec<u8>| {
        let database = sql::plain(&String::from_utf8_lossy(&script));
        Files::from([(SCRIPT.to_owned(), script), (file.to_owned(), database)])
    };
    corpus::of(target).into_iter().flat_map(Files::into_values).map(made).collect()
}

/// Makes another database of a case's script.
pub fn remade(files: &mut Files, file: &str, dice: &mut Dice) {
    let database = sql::database(target::text(files, SCRIPT), dice);
    files.insert(file.to_owned(), database);
}

fn mutate(files: &mut Files, _: &[Files], dice: &mut Dice) {
    remade(files, log::FILE, dice);
    if dice.is(0.3) {
        let mut mapping = String::new();
        log::mapping(&mut mapping, dice);
        files.insert(log::MAPPING.to_owned(), mapping.into_bytes());
    }
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    log::read_and_analyse(files, folder)
}
