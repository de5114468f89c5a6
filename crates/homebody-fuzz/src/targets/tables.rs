//! Truths whose tables are files: comma-separated values, JSON Lines, Parquet and Arrow IPC.

use super::told;
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::bytes;
use crate::target::{Files, Target, Verdict};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::SECOND;
use homebody_kit::{Destinations, Source, Url};
use homebody_log::elsewhere::install;
use homebody_log::examine::{Asked, examine};
use homebody_log::{How, RunClock, Transfer, label, lives, survey};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

pub const TARGET: Target = Target {
    name: "tables",
    about: "truths in CSV, JSON Lines, Parquet and Arrow IPC: lives, labels, what is wrong with them",
    cases: 5_000,
    corpus,
    mutate,
    run,
};

/// Kinds of places that have a file for each table, by how these end.
const ENDINGS: [&str; 4] = ["csv", "jsonl", "parquet", "arrow"];

const LOG: &str = "log.csv";

/// A log, and the tables that label it, in each of the forms: some minutes in the flat.
fn corpus() -> Vec<Files> {
    install(vec![homebody_arrow::ELSEWHERE]);
    ENDINGS.iter().filter_map(|ending| lived(ending)).collect()
}

fn lived(ending: &str) -> Option<Files> {
    let texts: BTreeMap<String, String> =
        corpus::flat().into_iter().filter_map(|(name, bytes)| Some((name, String::from_utf8(bytes).ok()?))).collect();
    let folder = tempfile::tempdir().ok()?;
    let scenario = Source::of_texts(texts, "scenario.json").open().ok()?;
    let at = |name: &str, ending: &str| format!("{ending}:{}", folder.path().join(name).display()).parse::<Url>().ok();
    let destinations = Destinations {
        log: vec![at(LOG, "csv")?],
        truth: Some(at(&format!("truth.{ending}"), ending)?),
        ..Destinations::default()
    };
    let run = scenario.run().length(180 * SECOND).start().ok()?;
    run.store(&destinations, |_| ()).ok()?;
    let files = fs::read_dir(folder.path()).ok()?.flatten();
    let read = |entry: fs::DirEntry| Some((entry.file_name().into_string().ok()?, fs::read(entry.path()).ok()?));
    Some(files.filter_map(read).collect())
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    let names: Vec<String> = files.keys().filter(|name| *name != LOG).cloned().collect();
    for _ in 0..dice.size(2) {
        let name = dice.one(&names);
        let other = dice.one(corpus).values().nth(dice.below(8)).cloned().unwrap_or_default();
        match (files.get_mut(name), dice.is(0.05)) {
            (Some(_), true) => drop(files.remove(name)),
            (Some(file), false) => bytes::bytes(file, &other, dice),
            _ => {}
        }
    }
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    install(vec![homebody_arrow::ELSEWHERE]);
    for (name, bytes) in files {
        fs::write(folder.join(name), bytes).map_err(|error| error.to_string())?;
    }
    let is = |ending: &&&str| files.keys().any(|name| name != LOG && name.ends_with(**ending));
    let ending = ENDINGS.iter().find(is).ok_or("there is no truth")?;
    let url = |text: String| text.parse::<Url>().map_err(|error| error.to_string());
    let truth = url(format!("{ending}:{}", folder.join(format!("truth.{ending}")).display()))?;
    let as_told = RunClock::as_told();
    let mut verdict = Verdict::Accepted;
    if let Err(error) = lives(&truth, &as_told) {
        told::message(&error.to_string())?;
        verdict = Verdict::Refused;
    }
    let mapping = LoggerFile::default();
    let log = homebody_log::Source::from(&url(format!("csv:{}", folder.join(LOG).display()))?);
    let about = survey(&log, &mapping).map_err(|error| format!("the log was not changed: {error}"))?;
    let to = url(format!("csv:{}", folder.join("labelled.csv").display()))?;
    let transfer = Transfer { from: &log, mapping: &mapping, to: &to, name: "flat", zone: "UTC", how: How::Replace };
    match label(&transfer, &about, &truth, &as_told, |_| ()) {
        Ok(labelled) if labelled.rows != about.rows => {
            return Err(format!("of {} rows {} are labelled", about.rows, labelled.rows));
        }
        Ok(_) => {}
        Err(error) => told::message(&error.to_string())?,
    }
    // Each table as a place of its own, too.
    for name in files.keys().filter(|name| *name != LOG) {
        let place = url(format!("{ending}:{}", folder.join(name).display()))?;
        let checks =
            examine(&place, &Asked { mapping: &mapping, may_write: false }).map_err(|error| error.to_string())?;
        checks.iter().try_for_each(|check| told::message(&check.says))?;
    }
    Ok(verdict)
}
