//! Logs in files that are no text: Parquet, Arrow IPC, and texts that are packed.

use super::log;
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::bytes;
use crate::target::{Files, Target, Verdict};
use homebody_log::elsewhere::install;
use std::path::Path;

pub const TARGET: Target = Target {
    name: "columns",
    about: "logs in Parquet and Arrow IPC, and packed texts",
    cases: 5_000,
    corpus,
    mutate,
    run,
};

fn corpus() -> Vec<Files> {
    let all = corpus::of(TARGET.name).into_iter().flat_map(Files::into_values);
    all.map(|file| Files::from([(log::FILE.to_owned(), file)])).collect()
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    let other = dice.one(corpus).get(log::FILE).cloned().unwrap_or_default();
    if let Some(file) = files.get_mut(log::FILE) {
        bytes::bytes(file, &other, dice);
    }
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    install(vec![homebody_arrow::ELSEWHERE]);
    log::read_and_analyse(files, folder)
}
