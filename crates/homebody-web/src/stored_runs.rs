//! Titles and notes of stored runs, and their deletion.
//!
//! The title and the note of a run are a small JSON file in its folder.

use crate::folders::HomeFolders;
use crate::messages::PageMessage;
use crate::request_error::{RequestError, failed, no_run, unprocessable};
use crate::trash;
use crate::wire::{DeletedKey, RunAbout};
use homebody_core::scenario::inside::ABOUT;
use homebody_log::files::fresh::FreshFile;
use homebody_log::files::plain;
use homebody_tracking::located_folder::SIMULATED_RUN;
use std::path::{Path, PathBuf};

/// Largest numbers of letters of a title, and of a note (our choice).
const LONGEST_TITLE: usize = 100;
const LONGEST_NOTE: usize = 2000;
/// Largest size of such a file: a letter has at most four bytes, and six as JSON escapes it.
const LARGEST_BYTES: u64 = 32 << 10;

/// The file of the title. A link could lead out of the folder of the run.
fn about_file(folders: &HomeFolders, run: &str) -> Result<PathBuf, RequestError> {
    let folder = folders.run(run).ok_or_else(|| no_run(run))?;
    let outside = || unprocessable(PageMessage::LinkOutside { file: ABOUT.into() });
    plain::within(&folder, Path::new(ABOUT)).ok_or_else(outside)
}

/// Empty if the file is missing or cannot be read.
pub fn about(folders: &HomeFolders, run: &str) -> RunAbout {
    let read = |place: PathBuf| plain::read_text(&place, LARGEST_BYTES).ok();
    let text = about_file(folders, run).ok().filter(|place| place.is_file()).and_then(read);
    text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
}

pub fn set_about(folders: &HomeFolders, run: &str, about: RunAbout) -> Result<RunAbout, RequestError> {
    let letters = |text: &str| text.chars().count();
    if letters(&about.title) > LONGEST_TITLE || letters(&about.note) > LONGEST_NOTE {
        return Err(unprocessable(PageMessage::TitleLength { title: LONGEST_TITLE, note: LONGEST_NOTE }));
    }
    let place = about_file(folders, run)?;
    let text = serde_json::to_string_pretty(&about).map_err(failed)? + "\n";
    let written = FreshFile::write_whole(&place, text.as_bytes(), true);
    written.map_err(|error| unprocessable(PageMessage::NotWritten { file: ABOUT.into(), why: error.to_string() }))?;
    Ok(about)
}

/// Deletes a run; if its log was located, with everything that was made of the log.
pub fn delete(folders: &HomeFolders, run: &str) -> Result<DeletedKey, RequestError> {
    let name = folders
        .run(run)
        .map(|_| run.strip_suffix(SIMULATED_RUN).and_then(|folder| folder.strip_suffix('/')).unwrap_or(run));
    let name = name.ok_or_else(|| no_run(run))?;
    trash::delete(&folders.runs, name).map(|key| DeletedKey { key })
}

/// Restores a deleted run, and returns its name.
pub fn restore(folders: &HomeFolders, key: &str) -> Result<String, RequestError> {
    trash::restore(&folders.runs, "run", key)
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::StatusCode;
    use homebody_log::run::places::RECORDING;
    use std::fs;

    fn folders(runs: &[&str]) -> (tempfile::TempDir, HomeFolders) {
        let folder = tempfile::tempdir().unwrap();
        let folders = HomeFolders {
            scenario: folder.path().join("a"),
            entry: "scenario.json".into(),
            is_trusted: true,
            runs: folder.path().join("runs"),
        };
        for run in runs {
            fs::create_dir_all(folders.runs.join(run)).unwrap();
            fs::write(folders.runs.join(run).join(RECORDING), run).unwrap();
        }
        (folder, folders)
    }

    #[test]
    fn rejects_long_titles() {
        let (_folder, folders) = folders(&["a-1"]);
        let called = RunAbout { title: "with pets".into(), note: "the cat was let out".into() };
        assert_eq!(about(&folders, "a-1"), RunAbout::default());
        set_about(&folders, "a-1", called.clone()).unwrap();
        assert_eq!(about(&folders, "a-1"), called);
        assert!(set_about(&folders, "a-1", RunAbout { title: "ä".repeat(101), ..called.clone() }).is_err());
        assert!(matches!(
            set_about(&folders, "..", called.clone()),
            Err(RequestError { status: StatusCode::NOT_FOUND, .. })
        ));
        assert_eq!(about(&folders, "a-1"), called);
    }

    #[test]
    fn restores_deleted_runs() {
        let (_folder, folders) = folders(&["a-1", "cohort-1/0001"]);
        for run in ["a-1", "cohort-1/0001"] {
            let DeletedKey { key } = delete(&folders, run).unwrap();
            assert!(!folders.runs().contains(&run.to_owned()));
            assert!(matches!(delete(&folders, run), Err(RequestError { status: StatusCode::NOT_FOUND, .. })));
            assert_eq!(restore(&folders, &key), Ok(run.to_owned()));
            assert_eq!(fs::read_to_string(folders.runs.join(run).join(RECORDING)).unwrap(), run);
            assert!(matches!(restore(&folders, &key), Err(RequestError { status: StatusCode::NOT_FOUND, .. })));
        }
    }

    #[test]
    fn replaces_no_run_of_the_same_name() {
        let (_folder, folders) = folders(&["a-1"]);
        let DeletedKey { key } = delete(&folders, "a-1").unwrap();
        fs::create_dir_all(folders.runs.join("a-1")).unwrap();
        assert!(matches!(restore(&folders, &key), Err(RequestError { status: StatusCode::UNPROCESSABLE_ENTITY, .. })));
        for key in ["..", "", "../a-1~1", "b~1"] {
            assert!(restore(&folders, key).is_err(), "{key}");
        }
    }
}
