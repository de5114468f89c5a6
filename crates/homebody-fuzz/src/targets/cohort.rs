//! The list of a cohort's members, by which a cohort goes on.

use super::told;
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::json;
use crate::target::{self, Files, Target, Verdict};
use homebody_core::time::SECOND;
use homebody_kit::{CohortList, LIST, NamedLog, UnfinishedCohort, template};
use std::fs;
use std::path::Path;

pub const TARGET: Target =
    Target { name: "cohort", about: "lists of cohorts to go on with", cases: 500, corpus, mutate, run };

fn corpus() -> Vec<Files> {
    let own = [made(2), made(2).map(unfinished)].into_iter().flatten();
    corpus::of(TARGET.name).into_iter().chain(own).collect()
}

/// The list of a cohort of so many who live for some seconds.
fn made(members: u32) -> Option<Files> {
    let folder = tempfile::tempdir().ok()?;
    let cohort = template("studio").ok()?.cohort(members).length(10 * SECOND).start().ok()?;
    let lived = cohort.store_in(folder.path(), |_| ()).ok()?;
    let text = fs::read(lived.folder.join(LIST)).ok()?;
    Some(Files::from([(LIST.to_owned(), text)]))
}

fn unfinished(mut files: Files) -> Files {
    let mut list: serde_json::Value = serde_json::from_str(target::text(&files, LIST)).unwrap_or_default();
    list["members"] = serde_json::json!([]);
    files.insert(LIST.to_owned(), list.to_string().into_bytes());
    files
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    target::change(files, corpus, dice, |_, text, others, dice| {
        json::json(text, others, dice);
    });
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    fs::write(folder.join(LIST), files.get(LIST).map(Vec::as_slice).unwrap_or_default())
        .map_err(|error| error.to_string())?;
    if let Err(error) = NamedLog::find(&folder.to_string_lossy()) {
        told::message(&error.to_string())?;
    }
    let _ = serde_json::from_str::<CohortList>(target::text(files, LIST));
    match UnfinishedCohort::open(folder) {
        Ok(cohort) => {
            let _ = cohort.progress();
            Ok(Verdict::Accepted)
        }
        Err(error) => told::error(&error, &target::texts(&Files::new())).map(|()| Verdict::Refused),
    }
}
