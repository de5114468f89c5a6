//! What becomes of stored runs: they are called something, noted about, put aside and fetched back.
//!
//! What somebody calls a run is a small file of JSON in its folder.

use crate::aside::{self, Unmoved};
use crate::messages::PageMessage;
use crate::refusal::{Refusal, damaged, failed, unknown};
use crate::shelf::Shelf;
use crate::wire::{PutAside, RunAbout};
use homebody_core::problem::readable;
use homebody_core::scenario::inside::ABOUT;
use homebody_log::files::fresh::FreshFile;
use homebody_log::files::plain;
use homebody_tracking::located_folder::SIMULATED_RUN;
use std::io;
use std::path::{Path, PathBuf};

/// Largest numbers of letters of a title, and of a note (our choice).
const LONGEST_TITLE: usize = 100;
const LONGEST_NOTE: usize = 2000;
/// Largest size of such a file: a letter has at most four bytes, and six as JSON escapes it.
const LARGEST_BYTES: u64 = 32 << 10;

fn no_run(run: &str) -> Refusal {
    unknown(PageMessage::NoRun { run: readable(run.to_owned()) })
}

/// Where that is kept; a link may lead to what its author was never to see.
fn place(shelf: &Shelf, run: &str) -> Result<PathBuf, Refusal> {
    let folder = shelf.run(run).ok_or_else(|| no_run(run))?;
    let outside = || damaged(PageMessage::LinkOutside { file: ABOUT.into() });
    plain::within(&folder, Path::new(ABOUT)).ok_or_else(outside)
}

/// What a run is called; nothing where nobody has said, or where that cannot be read.
pub fn about(shelf: &Shelf, run: &str) -> RunAbout {
    let read = |place: PathBuf| plain::read_text(&place, LARGEST_BYTES).ok();
    let text = place(shelf, run).ok().filter(|place| place.is_file()).and_then(read);
    text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
}

/// Calls a run something.
pub fn call(shelf: &Shelf, run: &str, about: RunAbout) -> Result<RunAbout, Refusal> {
    let letters = |text: &str| text.chars().count();
    if letters(&about.title) > LONGEST_TITLE || letters(&about.note) > LONGEST_NOTE {
        return Err(damaged(PageMessage::TitleLength { title: LONGEST_TITLE, note: LONGEST_NOTE }));
    }
    let place = place(shelf, run)?;
    let text = serde_json::to_string_pretty(&about).map_err(failed)? + "\n";
    let written = FreshFile::write_whole(&place, text.as_bytes(), true);
    written.map_err(|error| damaged(PageMessage::NotWritten { file: ABOUT.into(), why: error.to_string() }))?;
    Ok(about)
}

/// Puts a run aside; of a log that was walked back all that was made of it.
pub fn put_aside(shelf: &Shelf, run: &str) -> Result<PutAside, Refusal> {
    let name = shelf
        .run(run)
        .map(|_| run.strip_suffix(SIMULATED_RUN).and_then(|folder| folder.strip_suffix('/')).unwrap_or(run));
    let name = name.ok_or_else(|| no_run(run))?;
    let key = aside::put(&shelf.runs, name);
    let undeleted = |error: io::Error| damaged(PageMessage::NotDeleted { name: name.into(), why: error.to_string() });
    key.map(|key| PutAside { key }).map_err(undeleted)
}

/// Fetches back what was put aside under a key, and says which run it is.
pub fn fetch_back(shelf: &Shelf, key: &str) -> Result<String, Refusal> {
    aside::fetch_back(&shelf.runs, key).map_err(|why| match why {
        Unmoved::Unknown => unknown(PageMessage::NothingDeleted { kind: "run", key: readable(key.to_owned()) }),
        Unmoved::Taken(name) => damaged(PageMessage::NameTaken { kind: "run", name }),
        Unmoved::Failed(error) => damaged(PageMessage::NotRestored { key: key.into(), why: error.to_string() }),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_log::run::places::RECORDING;
    use std::fs;

    fn shelf(runs: &[&str]) -> (tempfile::TempDir, Shelf) {
        let folder = tempfile::tempdir().unwrap();
        let shelf = Shelf {
            scenario: folder.path().join("a"),
            entry: "scenario.json".into(),
            is_trusted: true,
            runs: folder.path().join("runs"),
        };
        for run in runs {
            fs::create_dir_all(shelf.runs.join(run)).unwrap();
            fs::write(shelf.runs.join(run).join(RECORDING), run).unwrap();
        }
        (folder, shelf)
    }

    #[test]
    fn a_run_is_called_something_and_what_is_too_long_is_refused() {
        let (_folder, shelf) = shelf(&["a-1"]);
        let called = RunAbout { title: "with pets".into(), note: "the cat was let out".into() };
        assert_eq!(about(&shelf, "a-1"), RunAbout::default());
        call(&shelf, "a-1", called.clone()).unwrap();
        assert_eq!(about(&shelf, "a-1"), called);
        assert!(call(&shelf, "a-1", RunAbout { title: "ä".repeat(101), ..called.clone() }).is_err());
        assert!(matches!(call(&shelf, "..", called.clone()), Err(Refusal::Unknown(_))));
        assert_eq!(about(&shelf, "a-1"), called);
    }

    #[test]
    fn a_run_that_is_put_aside_is_fetched_back_as_it_was() {
        let (_folder, shelf) = shelf(&["a-1", "cohort-1/0001"]);
        for run in ["a-1", "cohort-1/0001"] {
            let PutAside { key } = put_aside(&shelf, run).unwrap();
            assert!(!shelf.runs().contains(&run.to_owned()));
            assert!(matches!(put_aside(&shelf, run), Err(Refusal::Unknown(_))));
            assert_eq!(fetch_back(&shelf, &key), Ok(run.to_owned()));
            assert_eq!(fs::read_to_string(shelf.runs.join(run).join(RECORDING)).unwrap(), run);
            assert!(matches!(fetch_back(&shelf, &key), Err(Refusal::Unknown(_))));
        }
    }

    #[test]
    fn what_has_taken_its_name_meanwhile_is_not_replaced() {
        let (_folder, shelf) = shelf(&["a-1"]);
        let PutAside { key } = put_aside(&shelf, "a-1").unwrap();
        fs::create_dir_all(shelf.runs.join("a-1")).unwrap();
        assert!(matches!(fetch_back(&shelf, &key), Err(Refusal::Damaged(_))));
        for key in ["..", "", "../a-1~1", "b~1"] {
            assert!(fetch_back(&shelf, key).is_err(), "{key}");
        }
    }
}
