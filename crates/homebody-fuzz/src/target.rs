//! Targets, and the files of their cases.

use crate::choices::Choices;
use crate::mutate::{bytes, json};
use std::collections::BTreeMap;
use std::path::Path;

pub type CaseFiles = BTreeMap<String, Vec<u8>>;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReadVerdict {
    Accepted,
    /// It refused them, with place and reason.
    Refused,
}

#[derive(Clone, Copy)]
pub struct Target {
    pub name: &'static str,
    /// Largest number of mutants in a run of its test.
    pub cases: u32,
    /// Its seeds: valid files, and files that once failed. Mutants are made of them.
    pub seeds: fn() -> Vec<CaseFiles>,
    pub mutate: fn(&mut CaseFiles, &[CaseFiles], &mut Choices),
    /// Exercises the program with the files in an empty folder.
    ///
    /// # Errors
    ///
    /// The invariant that does not hold.
    pub run: fn(&CaseFiles, &Path) -> Result<ReadVerdict, String>,
}

impl Target {
    pub fn mutant(&self, seeds: &[CaseFiles], bytes: &[u8]) -> CaseFiles {
        let mut choices = Choices::new(bytes);
        let mut files = choices.one(seeds).clone();
        (self.mutate)(&mut files, seeds, &mut choices);
        files
    }
}

/// The text of a file; empty if it is not UTF-8.
pub(crate) fn text<'f>(files: &'f CaseFiles, name: &str) -> &'f str {
    files.get(name).and_then(|bytes| str::from_utf8(bytes).ok()).unwrap_or_default()
}

/// All files as texts; invalid UTF-8 is replaced.
pub(crate) fn texts(files: &CaseFiles) -> BTreeMap<String, String> {
    let text = |bytes: &Vec<u8>| String::from_utf8_lossy(bytes).into_owned();
    files.iter().map(|(name, bytes)| (name.clone(), text(bytes))).collect()
}

/// Changes one file of a case by a mutator of texts, with a file of another case as a source of parts.
pub(crate) fn change(
    files: &mut CaseFiles,
    seeds: &[CaseFiles],
    choices: &mut Choices,
    by: impl Fn(&str, &mut String, &[&str], &mut Choices),
) {
    let names: Vec<String> = files.keys().cloned().collect();
    if names.is_empty() {
        return;
    }
    for _ in 0..choices.size(2) {
        let name = choices.one(&names);
        let other = choices.one(seeds);
        let others: Vec<&str> = other.values().filter_map(|bytes| str::from_utf8(bytes).ok()).collect();
        let Some(bytes) = files.get_mut(name) else { continue };
        match (str::from_utf8(bytes).map(str::to_owned), choices.is(0.2)) {
            (Ok(mut text), false) => {
                by(name, &mut text, &others, choices);
                *bytes = text.into_bytes();
            }
            _ => {
                let more = other.values().next().map(Vec::as_slice).unwrap_or_default();
                bytes::bytes(bytes, more, choices);
            }
        }
    }
}

/// The same with JSON.
pub(crate) fn change_json(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    change(files, seeds, choices, |_, text, others, choices| {
        json::json(text, others, choices);
    });
}
