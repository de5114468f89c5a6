//! What somebody notes about alerts and days, kept beside the run that it is about: another browser sees it, too.
//!
//! It is a small file of JSON in the run's folder; of a log that was walked back it lies beside the copy of that log. A note takes
//! the place of another only if the page has seen that one.

use crate::messages::PageMessage;
use crate::refusal::{Refusal, damaged, failed, unknown};
use crate::shelf::Shelf;
use crate::turns::Turns;
use crate::wire::{NoteIt, NoteView};
use homebody_core::problem::readable;
use homebody_core::scenario::inside::NOTES;
use homebody_log::files::fresh::FreshFile;
use homebody_log::files::plain;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Largest number of letters of a note, and of a rule's name (our choice).
const LONGEST_NOTE: usize = 500;
/// Largest number of notes of a run (our choice).
const MOST_NOTES: usize = 5000;
/// Largest size of the file of notes (our choice): a note has at most four bytes a letter, and a name.
const LARGEST_BYTES: u64 = 16 << 20;

/// The notes of a shelf's runs. A clone is the same.
#[derive(Clone)]
pub struct Notes {
    shelf: Shelf,
    /// Held while a file is read and replaced, so that no two pages do so at once.
    writing: Turns,
}

/// Why nothing was noted.
#[derive(Debug, PartialEq, Eq)]
pub enum Unnoted {
    Refused(Refusal),
    /// The note has changed since the page read it.
    Changed(PageMessage),
}

#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct NotesFile {
    notes: Vec<NoteView>,
}

impl Notes {
    pub fn new(shelf: Shelf) -> Notes {
        Notes { shelf, writing: Turns::default() }
    }

    /// All notes of a run, by day.
    pub fn of(&self, run: &str) -> Result<Vec<NoteView>, Refusal> {
        read(&self.place(run)?)
    }

    /// Keeps a note, and returns all of them.
    pub fn note(&self, run: &str, NoteIt { before, note }: NoteIt) -> Result<Vec<NoteView>, Unnoted> {
        let refused = |message: PageMessage| Unnoted::Refused(damaged(message));
        let letters = |text: &str| text.chars().count();
        if !is_date(&note.day) {
            return Err(refused(PageMessage::NoteDay));
        }
        if letters(&note.note) > LONGEST_NOTE || letters(&note.rule) > LONGEST_NOTE {
            return Err(refused(PageMessage::NoteLength { limit: LONGEST_NOTE }));
        }
        let place = self.place(run).map_err(Unnoted::Refused)?;
        let _turn = self.writing.take(&place).map_err(|error| Unnoted::Refused(damaged(error)))?;
        let mut notes = read(&place).map_err(Unnoted::Refused)?;
        let is_there = |other: &NoteView| other.day == note.day && other.rule == note.rule;
        let there = notes.iter().find(|other| is_there(other)).cloned();
        if there != before && there.as_ref() != Some(&note) {
            return Err(Unnoted::Changed(PageMessage::NoteChanged));
        }
        notes.retain(|other| !is_there(other));
        if note.seen || !note.note.is_empty() {
            notes.push(note);
        }
        if notes.len() > MOST_NOTES {
            return Err(refused(PageMessage::TooManyNotes { limit: MOST_NOTES }));
        }
        notes.sort_by(|a, b| (&a.day, &a.rule).cmp(&(&b.day, &b.rule)));
        write(&place, &notes).map_err(Unnoted::Refused)?;
        Ok(notes)
    }

    /// Where the notes of a run are, or are going to be.
    fn place(&self, run: &str) -> Result<PathBuf, Refusal> {
        let folder = self.shelf.walked(run).or_else(|| self.shelf.kept_log(run)).or_else(|| self.shelf.run(run));
        let folder = folder.ok_or_else(|| unknown(PageMessage::NoRun { run: readable(run.to_owned()) }))?;
        // A link may lead to what its author was never to see.
        let outside = || damaged(PageMessage::LinkOutside { file: NOTES.into() });
        plain::within(&folder, Path::new(NOTES)).ok_or_else(outside)
    }
}

/// Whether a text is written as a date is.
fn is_date(text: &str) -> bool {
    let is_so =
        |(place, letter): (usize, u8)| if matches!(place, 4 | 7) { letter == b'-' } else { letter.is_ascii_digit() };
    text.len() == 10 && text.bytes().enumerate().all(is_so)
}

fn read(place: &Path) -> Result<Vec<NoteView>, Refusal> {
    if !place.exists() {
        return Ok(Vec::new());
    }
    let wrong =
        |error: &dyn std::fmt::Display| damaged(PageMessage::NotRead { file: NOTES.into(), why: error.to_string() });
    let text = plain::read_text(place, LARGEST_BYTES).map_err(|error| wrong(&error))?;
    let file: NotesFile = serde_json::from_str(&text).map_err(|error| wrong(&error))?;
    Ok(file.notes)
}

fn write(place: &Path, notes: &[NoteView]) -> Result<(), Refusal> {
    let text = serde_json::to_string_pretty(&NotesFile { notes: notes.to_vec() }).map_err(failed)? + "\n";
    let written = FreshFile::write_whole(place, text.as_bytes(), true);
    written.map_err(|error| damaged(PageMessage::NotWritten { file: NOTES.into(), why: error.to_string() }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_log::run::places::RECORDING;
    use std::fs;

    fn notes() -> (tempfile::TempDir, Notes) {
        let folder = tempfile::tempdir().unwrap();
        let runs = folder.path().join("runs");
        fs::create_dir_all(runs.join("a-1")).unwrap();
        fs::write(runs.join("a-1").join(RECORDING), "{}").unwrap();
        let scenario = folder.path().join("a");
        let shelf = Shelf { scenario, entry: "scenario.json".into(), is_trusted: true, runs };
        (folder, Notes::new(shelf))
    }

    fn of(day: &str, rule: &str, seen: bool, note: &str) -> NoteView {
        NoteView { day: day.into(), rule: rule.into(), seen, note: note.into() }
    }

    #[test]
    fn a_note_is_kept_changed_and_taken_back() {
        let (folder, notes) = notes();
        assert_eq!(notes.of("a-1"), Ok(Vec::new()));
        let (cold, sleep) = (of("2009-03-02", "", false, "a cold"), of("2009-03-01", "sleep", true, ""));
        notes.note("a-1", NoteIt { before: None, note: cold.clone() }).unwrap();
        let both = notes.note("a-1", NoteIt { before: None, note: sleep.clone() }).unwrap();
        assert_eq!(both, [sleep.clone(), cold.clone()]);
        // Another server, and so another browser, sees them.
        assert_eq!(Notes::new(notes.shelf.clone()).of("a-1"), Ok(both));
        let nothing = of("2009-03-01", "sleep", false, "");
        assert_eq!(notes.note("a-1", NoteIt { before: Some(sleep), note: nothing }), Ok(vec![cold]));
        let left: Vec<_> = fs::read_dir(folder.path().join("runs/a-1")).unwrap().collect();
        assert_eq!(left.len(), 2, "the recording and the notes: {left:?}");
    }

    #[test]
    fn what_the_page_has_not_seen_is_not_replaced() {
        let (_folder, notes) = notes();
        let first = of("2009-03-02", "sleep", true, "she had a cold");
        notes.note("a-1", NoteIt { before: None, note: first.clone() }).unwrap();
        let unseen = NoteIt { before: None, note: of("2009-03-02", "sleep", true, "") };
        assert!(matches!(notes.note("a-1", unseen), Err(Unnoted::Changed(_))));
        assert_eq!(notes.of("a-1"), Ok(vec![first.clone()]));
        // Who notes the same twice has not changed anything.
        assert_eq!(notes.note("a-1", NoteIt { before: None, note: first.clone() }), Ok(vec![first]));
    }

    #[test]
    fn what_is_no_note_and_no_run_is_refused_and_a_file_that_is_none_is_left_alone() {
        let (folder, notes) = notes();
        let refused = |note: NoteView| notes.note("a-1", NoteIt { before: None, note }).is_err();
        assert!(refused(of("yesterday", "", true, "")) && refused(of("2009-03-02", "", true, &"ä".repeat(501))));
        assert!(!refused(of("2009-03-02", "", true, &"ä".repeat(500))));
        for run in ["b-1", "..", "a-1/..", ""] {
            assert!(matches!(notes.of(run), Err(Refusal::Unknown(_))), "{run}");
        }
        let file = folder.path().join("runs/a-1").join(NOTES);
        fs::write(&file, "[broken").unwrap();
        assert!(notes.of("a-1").is_err() && refused(of("2009-03-03", "", true, "")));
        assert_eq!(fs::read_to_string(file).unwrap(), "[broken");
    }

    #[cfg(unix)]
    #[test]
    fn notes_are_not_written_along_a_link_out_of_the_folder() {
        let (folder, notes) = notes();
        let other = folder.path().join("other.json");
        fs::write(&other, r#"{ "notes": [] }"#).unwrap();
        std::os::unix::fs::symlink(&other, folder.path().join("runs/a-1").join(NOTES)).unwrap();
        assert!(notes.of("a-1").is_err());
        assert!(notes.note("a-1", NoteIt { before: None, note: of("2009-03-03", "", true, "") }).is_err());
        assert_eq!(fs::read_to_string(other).unwrap(), r#"{ "notes": [] }"#);
    }
}
