//! The list of a cohort's members, which resuming a cohort reads.

use super::messages;
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_core::time::SECOND;
use homebody_query::LogRef;
use homebody_simulation::{CohortList, IncompleteCohort, LIST, template};
use std::fs;
use std::path::Path;

pub const TARGET: Target = Target { name: "cohort", cases: 500, seeds, mutate: target::change_json, run };

fn seeds() -> Vec<CaseFiles> {
    let own = [made(2), made(2).map(unfinished)].into_iter().flatten();
    seeds::named(TARGET.name).into_iter().chain(own).collect()
}

/// The list of a cohort with members who are simulated for some seconds.
fn made(members: u32) -> Option<CaseFiles> {
    let folder = tempfile::tempdir().ok()?;
    let cohort = template("studio").ok()?.run().length(10 * SECOND).cohort(members).start().ok()?;
    let stored = cohort.store_in(folder.path(), |_| ()).ok()?;
    let text = fs::read(stored.folder.join(LIST)).ok()?;
    Some(CaseFiles::from([(LIST.to_owned(), text)]))
}

fn unfinished(mut files: CaseFiles) -> CaseFiles {
    let mut list: serde_json::Value = serde_json::from_str(target::text(&files, LIST)).unwrap_or_default();
    list["members"] = serde_json::json!([]);
    files.insert(LIST.to_owned(), list.to_string().into_bytes());
    files
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    fs::write(folder.join(LIST), files.get(LIST).map(Vec::as_slice).unwrap_or_default())
        .map_err(|error| error.to_string())?;
    if let Err(error) = LogRef::find(&folder.to_string_lossy()) {
        messages::refusal(&error)?;
    }
    let _ = serde_json::from_str::<CohortList>(target::text(files, LIST));
    match IncompleteCohort::open(folder) {
        Ok(cohort) => {
            let _ = cohort.progress();
            Ok(ReadVerdict::Accepted)
        }
        Err(error) => messages::error(&error, &target::texts(&CaseFiles::new())).map(|()| ReadVerdict::Refused),
    }
}
