//! Truths with a file for each table, in all forms that have one.

use super::messages;
use crate::choices::Choices;
use crate::mutate::bytes;
use crate::seeds;
use crate::target::{CaseFiles, ReadVerdict, Target};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{Scheme, SchemeRow};
use homebody_core::time::{MINUTE, TimeScale};
use homebody_log::examine::{CheckOptions, examine};
use homebody_log::label;
use homebody_log::read_timeline;
use homebody_log::registry::{Registry, install};
use homebody_log::{Transfer, WriteMode, survey};
use homebody_simulation::{Destinations, ScenarioSource, Url};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

pub const TARGET: Target = Target { name: "tables", cases: 5_000, seeds, mutate, run };

const LOG: &str = "log.csv";

/// A log, and the tables of its labels, in each of the forms: some minutes in the flat.
fn seeds() -> Vec<CaseFiles> {
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    SchemeRow::with_files_of_tables().filter_map(tables).collect()
}

/// A place of this kind for a truth.
fn truth(row: &SchemeRow, folder: &Path) -> Url {
    Url::new(row.scheme, folder.join(format!("truth.{}", row.extensions[0])))
}

fn tables(row: &SchemeRow) -> Option<CaseFiles> {
    let texts: BTreeMap<String, String> =
        seeds::flat().into_iter().filter_map(|(name, bytes)| Some((name, String::from_utf8(bytes).ok()?))).collect();
    let folder = tempfile::tempdir().ok()?;
    let scenario = ScenarioSource::from_texts(texts, "scenario.json").open().ok()?;
    let destinations = Destinations {
        log: vec![Url::new(Scheme::Csv, folder.path().join(LOG))],
        truth: Some(truth(row, folder.path())),
        ..Destinations::default()
    };
    let run = scenario.run().length(3 * MINUTE).start().ok()?;
    run.store(&destinations, |_| ()).ok()?;
    let files = fs::read_dir(folder.path()).ok()?.flatten();
    let read = |entry: fs::DirEntry| Some((entry.file_name().into_string().ok()?, fs::read(entry.path()).ok()?));
    Some(files.filter_map(read).collect())
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    let names: Vec<String> = files.keys().filter(|name| *name != LOG).cloned().collect();
    for _ in 0..choices.size(2) {
        let name = choices.one(&names);
        let other = choices.one(seeds).values().nth(choices.below(8)).cloned().unwrap_or_default();
        match (files.get_mut(name), choices.is(0.05)) {
            (Some(_), true) => drop(files.remove(name)),
            (Some(file), false) => bytes::bytes(file, &other, choices),
            _ => {}
        }
    }
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    for (name, bytes) in files {
        fs::write(folder.join(name), bytes).map_err(|error| error.to_string())?;
    }
    let is_form = |row: &&SchemeRow| files.keys().any(|name| name != LOG && name.ends_with(row.extensions[0]));
    let row = SchemeRow::with_files_of_tables().find(is_form).ok_or("there is no truth")?;
    let truth = truth(row, folder);
    let scale = TimeScale::one();
    let mut verdict = ReadVerdict::Accepted;
    if let Err(error) = read_timeline(&truth, &scale) {
        messages::refusal(&error)?;
        verdict = ReadVerdict::Refused;
    }
    let mapping = LoggerFile::default();
    let log = homebody_log::LogSource::from(&Url::new(Scheme::Csv, folder.join(LOG)));
    let about = survey(&log, &mapping).map_err(|error| format!("the log was not changed: {error}"))?;
    let to = Url::new(Scheme::Csv, folder.join("labelled.csv"));
    let transfer =
        Transfer { from: &log, mapping: &mapping, to: &to, name: "flat", zone: "UTC", how: WriteMode::Overwrite };
    match label(&transfer, &about, &truth, &scale, |_| ()) {
        Ok(labelled) if labelled.rows != about.rows => {
            return Err(format!("of {} rows {} are labelled", about.rows, labelled.rows));
        }
        Ok(_) => {}
        Err(error) => messages::refusal(&error)?,
    }
    // Each table by itself, too.
    for name in files.keys().filter(|name| *name != LOG) {
        let checks =
            examine(&Url::new(row.scheme, folder.join(name)), &CheckOptions { mapping: &mapping, may_write: false })
                .map_err(|error| error.to_string())?;
        checks.iter().try_for_each(|check| messages::message(&check.says))?;
    }
    Ok(verdict)
}
