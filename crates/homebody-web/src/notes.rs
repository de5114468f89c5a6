//! Notes about episodes and days, and days of a new reference, stored with the run, so that every browser shows them.
//!
//! They are a small JSON file in the folder of the run, or next to the copy of a located log. A note replaces another only if the
//! page has seen that one.

use crate::folders::HomeFolders;
use crate::messages::PageMessage;
use crate::request_error::{RequestError, failed, no_run, unprocessable};
use crate::wire::{NoteChange, NoteSubject, NoteView};
use crate::write_locks::WriteLocks;
use axum::http::StatusCode;
use homebody_core::scenario::inside::NOTES;
use homebody_log::files::fresh::FreshFile;
use homebody_log::files::plain;
use jiff::Zoned;
use jiff::civil::Date;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Largest number of letters of a note, and of a person's name (our choice).
const LONGEST_NOTE: usize = 500;
const LONGEST_NAME: usize = 100;
/// Largest number of notes of a run (our choice).
const MOST_NOTES: usize = 5000;
/// Largest size of the file of notes (our choice): a note has at most four bytes a letter, and a name.
const LARGEST_BYTES: u64 = 16 << 20;

#[derive(Clone)]
pub struct Notes {
    folders: HomeFolders,
    /// Held while a file is read and replaced, so that no two pages do so at once.
    writing: WriteLocks,
}

#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct NotesFile {
    notes: Vec<StoredNote>,
}

/// A note of the file. In files of earlier versions, a note about an alert has the name of its rule.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredNote {
    day: String,
    #[serde(default, skip_serializing)]
    rule: String,
    about: Option<NoteSubject>,
    seen: bool,
    note: String,
    #[serde(default)]
    who: String,
    #[serde(default)]
    at: String,
}

impl From<StoredNote> for NoteView {
    fn from(stored: StoredNote) -> NoteView {
        let StoredNote { day, rule, about, seen, note, who, at } = stored;
        let words = if rule.is_empty() { note } else { format!("{rule}: {note}") };
        // No episode has the day of an alert, so the day keeps the note.
        NoteView { day, about: about.unwrap_or(NoteSubject::Day), seen, note: words, who, at }
    }
}

impl From<NoteView> for StoredNote {
    fn from(NoteView { day, about, seen, note, who, at }: NoteView) -> StoredNote {
        StoredNote { day, rule: String::new(), about: Some(about), seen, note, who, at }
    }
}

impl Notes {
    pub fn new(folders: HomeFolders) -> Notes {
        Notes { folders, writing: WriteLocks::default() }
    }

    /// The notes of a run, by day.
    pub fn all(&self, run: &str) -> Result<Vec<NoteView>, RequestError> {
        read(&self.place(run)?)
    }

    /// Stores or removes a note, and returns all.
    pub fn note(&self, run: &str, NoteChange { before, note }: NoteChange) -> Result<Vec<NoteView>, RequestError> {
        let letters = |text: &str| text.chars().count();
        if !is_date(&note.day) {
            return Err(unprocessable(PageMessage::NoteDay));
        }
        if letters(&note.note) > LONGEST_NOTE || letters(&note.who) > LONGEST_NAME {
            return Err(unprocessable(PageMessage::NoteLength { limit: LONGEST_NOTE }));
        }
        let place = self.place(run)?;
        let _lock = self.writing.lock(&place).map_err(unprocessable)?;
        let mut notes = read(&place)?;
        let is_there = |other: &NoteView| other.day == note.day && other.about == note.about;
        let there = notes.iter().find(|other| is_there(other)).cloned();
        let is_same = |other: &NoteView| NoteView { at: note.at.clone(), ..other.clone() } == note;
        if there != before && !there.as_ref().is_some_and(is_same) {
            return Err(RequestError::new(StatusCode::CONFLICT, PageMessage::NoteChanged));
        }
        notes.retain(|other| !is_there(other));
        if note.seen || !note.note.is_empty() {
            let at = Zoned::now().strftime("%Y-%m-%dT%H:%M").to_string();
            notes.push(NoteView { at, ..note });
        }
        if notes.len() > MOST_NOTES {
            return Err(unprocessable(PageMessage::TooManyNotes { limit: MOST_NOTES }));
        }
        notes.sort_by(|a, b| (&a.day, a.about).cmp(&(&b.day, b.about)));
        write(&place, &notes)?;
        Ok(notes)
    }

    /// The days on which a new reference begins.
    pub fn references(&self, run: &str) -> Result<Vec<Date>, RequestError> {
        let marks = self.all(run)?.into_iter().filter(|note| note.about == NoteSubject::Reference && note.seen);
        Ok(marks.filter_map(|note| note.day.parse().ok()).collect())
    }

    fn place(&self, run: &str) -> Result<PathBuf, RequestError> {
        let folder =
            self.folders.located_log(run).or_else(|| self.folders.kept_log(run)).or_else(|| self.folders.run(run));
        let folder = folder.ok_or_else(|| no_run(run))?;
        // A link could lead out of the folder.
        let outside = || unprocessable(PageMessage::LinkOutside { file: NOTES.into() });
        plain::within(&folder, Path::new(NOTES)).ok_or_else(outside)
    }
}

fn is_date(text: &str) -> bool {
    let is_so =
        |(place, letter): (usize, u8)| if matches!(place, 4 | 7) { letter == b'-' } else { letter.is_ascii_digit() };
    text.len() == 10 && text.bytes().enumerate().all(is_so)
}

fn read(place: &Path) -> Result<Vec<NoteView>, RequestError> {
    if !place.exists() {
        return Ok(Vec::new());
    }
    let wrong = |error: &dyn std::fmt::Display| {
        unprocessable(PageMessage::NotRead { file: NOTES.into(), why: error.to_string() })
    };
    let text = plain::read_text(place, LARGEST_BYTES).map_err(|error| wrong(&error))?;
    let file: NotesFile = serde_json::from_str(&text).map_err(|error| wrong(&error))?;
    Ok(file.notes.into_iter().map(NoteView::from).collect())
}

fn write(place: &Path, notes: &[NoteView]) -> Result<(), RequestError> {
    let text =
        serde_json::to_string_pretty(&NotesFile { notes: notes.iter().cloned().map(StoredNote::from).collect() })
            .map_err(failed)?
            + "\n";
    let written = FreshFile::write_whole(place, text.as_bytes(), true);
    written.map_err(|error| unprocessable(PageMessage::NotWritten { file: NOTES.into(), why: error.to_string() }))
}

#[cfg(test)]
mod tests {
    use super::NoteSubject::{Day, Episode, Reference};
    use super::*;
    use homebody_log::run::places::RECORDING;
    use std::fs;

    fn notes() -> (tempfile::TempDir, Notes) {
        let folder = tempfile::tempdir().unwrap();
        let runs = folder.path().join("runs");
        fs::create_dir_all(runs.join("a-1")).unwrap();
        fs::write(runs.join("a-1").join(RECORDING), "{}").unwrap();
        let scenario = folder.path().join("a");
        let folders = HomeFolders { scenario, entry: "scenario.json".into(), is_trusted: true, runs };
        (folder, Notes::new(folders))
    }

    fn of(day: &str, about: NoteSubject, seen: bool, note: &str) -> NoteView {
        NoteView { day: day.into(), about, seen, note: note.into(), who: "Ada's son".into(), at: String::new() }
    }

    /// The notes without the times at which they were stored.
    fn timeless(notes: Result<Vec<NoteView>, RequestError>) -> Vec<NoteView> {
        let notes = notes.unwrap();
        assert!(notes.iter().all(|note| note.at.len() == "2009-03-02T14:05".len()), "{notes:?}");
        notes.into_iter().map(|note| NoteView { at: String::new(), ..note }).collect()
    }

    #[test]
    fn stores_changes_and_removes_notes() {
        let (folder, notes) = notes();
        assert_eq!(notes.all("a-1"), Ok(Vec::new()));
        let (cold, sleep) = (of("2009-03-02", Day, false, "a cold"), of("2009-03-01", Episode, true, ""));
        notes.note("a-1", NoteChange { before: None, note: cold.clone() }).unwrap();
        let both = notes.note("a-1", NoteChange { before: None, note: sleep.clone() }).unwrap();
        assert_eq!(timeless(Ok(both.clone())), [sleep.clone(), cold.clone()]);
        // Another server reads the same notes.
        assert_eq!(Notes::new(notes.folders.clone()).all("a-1"), Ok(both.clone()));
        let nothing = of("2009-03-01", Episode, false, "");
        let before = Some(both[0].clone());
        assert_eq!(timeless(notes.note("a-1", NoteChange { before, note: nothing })), [cold]);
        let left: Vec<_> = fs::read_dir(folder.path().join("runs/a-1")).unwrap().collect();
        assert_eq!(left.len(), 2, "the recording and the notes: {left:?}");
    }

    #[test]
    fn keeps_notes_that_the_page_has_not_seen() {
        let (_folder, notes) = notes();
        let first = of("2009-03-02", Episode, true, "she had a cold");
        notes.note("a-1", NoteChange { before: None, note: first.clone() }).unwrap();
        let unseen = NoteChange { before: None, note: of("2009-03-02", Episode, true, "") };
        assert!(matches!(notes.note("a-1", unseen), Err(RequestError { status: StatusCode::CONFLICT, .. })));
        assert_eq!(timeless(notes.all("a-1")), std::slice::from_ref(&first));
        // The same note again changes nothing.
        assert_eq!(timeless(notes.note("a-1", NoteChange { before: None, note: first.clone() })), [first]);
    }

    #[test]
    fn keeps_the_notes_of_earlier_versions() {
        let (folder, notes) = notes();
        let old = r#"{ "notes": [{ "day": "2009-03-02", "rule": "sleep", "seen": true, "note": "a cold" }] }"#;
        fs::write(folder.path().join("runs/a-1").join(NOTES), old).unwrap();
        let read = notes.all("a-1").unwrap();
        assert_eq!((&read[0].note[..], read[0].about, read[0].seen), ("sleep: a cold", Day, true));
    }

    #[test]
    fn a_mark_of_a_reference_counts_until_it_is_taken_back() {
        let (_folder, notes) = notes();
        let mark = NoteView { note: String::new(), ..of("2009-04-20", Reference, true, "") };
        let marked = notes.note("a-1", NoteChange { before: None, note: mark }).unwrap();
        assert_eq!(notes.references("a-1"), Ok(vec![jiff::civil::date(2009, 4, 20)]));
        let back = NoteView { seen: false, ..marked[0].clone() };
        notes.note("a-1", NoteChange { before: Some(marked[0].clone()), note: back }).unwrap();
        assert_eq!(notes.references("a-1"), Ok(Vec::new()));
    }

    #[test]
    fn rejects_invalid_notes_and_keeps_an_invalid_file() {
        let (folder, notes) = notes();
        let refused = |note: NoteView| notes.note("a-1", NoteChange { before: None, note }).is_err();
        assert!(refused(of("yesterday", Day, true, "")) && refused(of("2009-03-02", Day, true, &"ä".repeat(501))));
        assert!(!refused(of("2009-03-02", Day, true, &"ä".repeat(500))));
        for run in ["b-1", "..", "a-1/..", ""] {
            assert!(matches!(notes.all(run), Err(RequestError { status: StatusCode::NOT_FOUND, .. })), "{run}");
        }
        let file = folder.path().join("runs/a-1").join(NOTES);
        fs::write(&file, "[broken").unwrap();
        assert!(notes.all("a-1").is_err() && refused(of("2009-03-03", Day, true, "")));
        assert_eq!(fs::read_to_string(file).unwrap(), "[broken");
    }

    #[cfg(unix)]
    #[test]
    fn follows_no_link_out_of_the_folder() {
        let (folder, notes) = notes();
        let other = folder.path().join("other.json");
        fs::write(&other, r#"{ "notes": [] }"#).unwrap();
        std::os::unix::fs::symlink(&other, folder.path().join("runs/a-1").join(NOTES)).unwrap();
        assert!(notes.all("a-1").is_err());
        assert!(notes.note("a-1", NoteChange { before: None, note: of("2009-03-03", Day, true, "") }).is_err());
        assert_eq!(fs::read_to_string(other).unwrap(), r#"{ "notes": [] }"#);
    }
}
