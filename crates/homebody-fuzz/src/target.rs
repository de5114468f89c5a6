//! What a target is, and what its cases are made of.

use crate::dice::Dice;
use crate::mutate::bytes;
use std::collections::BTreeMap;
use std::path::Path;

/// The files of a case, by name.
pub type Files = BTreeMap<String, Vec<u8>>;

/// What became of a case that went well.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It was read, and all was done with it.
    Accepted,
    /// It was refused, in words that say where and why.
    Refused,
}

/// Something that is fuzzed.
#[derive(Clone, Copy)]
pub struct Target {
    /// What it is called on the command line, and in the names of its cases' random numbers.
    pub name: &'static str,
    /// What is read, in a few words.
    pub about: &'static str,
    /// How many cases it has unless something else is said.
    pub cases: u64,
    /// What is good, or was once too much: the first cases are these, all others mutants of them.
    pub corpus: fn() -> Vec<Files>,
    /// Makes a mutant of one of the corpus; all of it is there to take from.
    pub mutate: fn(&mut Files, &[Files], &mut Dice),
    /// Does with the files all that the program does; the folder is empty, and all of it may be used.
    ///
    /// # Errors
    ///
    /// An invariant does not hold: which, and how.
    pub run: fn(&Files, &Path) -> Result<Verdict, String>,
}

impl Target {
    /// The files of a case: one of the corpus, as long as there are any, then mutants.
    pub fn case(&self, corpus: &[Files], seed: u64, number: u64) -> Files {
        if let Some(files) = usize::try_from(number).ok().and_then(|number| corpus.get(number)) {
            return files.clone();
        }
        let mut dice = Dice::of(self.name, seed, number);
        let mut files = dice.one(corpus).clone();
        (self.mutate)(&mut files, corpus, &mut dice);
        files
    }
}

/// The text of a file of a case; empty where it is no text.
pub(crate) fn text<'f>(files: &'f Files, name: &str) -> &'f str {
    files.get(name).and_then(|bytes| str::from_utf8(bytes).ok()).unwrap_or_default()
}

/// All files of a case as texts: what is no text in UTF-8 is made one.
pub(crate) fn texts(files: &Files) -> BTreeMap<String, String> {
    let text = |bytes: &Vec<u8>| String::from_utf8_lossy(bytes).into_owned();
    files.iter().map(|(name, bytes)| (name.clone(), text(bytes))).collect()
}

/// Changes one file of a case by a mutator of texts, and that of another case's file of any name to take from.
pub(crate) fn change(
    files: &mut Files,
    corpus: &[Files],
    dice: &mut Dice,
    by: impl Fn(&str, &mut String, &[&str], &mut Dice),
) {
    let names: Vec<String> = files.keys().cloned().collect();
    if names.is_empty() {
        return;
    }
    for _ in 0..dice.size(2) {
        let name = dice.one(&names);
        let other = dice.one(corpus);
        let others: Vec<&str> = other.values().filter_map(|bytes| str::from_utf8(bytes).ok()).collect();
        let Some(bytes) = files.get_mut(name) else { continue };
        match (str::from_utf8(bytes).map(str::to_owned), dice.is(0.2)) {
            (Ok(mut text), false) => {
                by(name, &mut text, &others, dice);
                *bytes = text.into_bytes();
            }
            _ => {
                let more = other.values().next().map(Vec::as_slice).unwrap_or_default();
                bytes::bytes(bytes, more, dice);
            }
        }
    }
}
