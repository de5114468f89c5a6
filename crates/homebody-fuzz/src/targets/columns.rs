//! Logs in binary files: Parquet, Arrow IPC, and compressed texts.

use super::log;
use crate::choices::Choices;
use crate::mutate::bytes;
use crate::seeds;
use crate::target::{CaseFiles, ReadVerdict, Target};
use homebody_log::registry::{Registry, install};
use std::path::Path;

pub const TARGET: Target = Target { name: "columns", cases: 5_000, seeds, mutate, run };

fn seeds() -> Vec<CaseFiles> {
    seeds::files(TARGET.name, log::FILE)
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    let other = choices.one(seeds).get(log::FILE).cloned().unwrap_or_default();
    if let Some(file) = files.get_mut(log::FILE) {
        bytes::bytes(file, &other, choices);
    }
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    log::read_and_analyse(files, folder)
}
