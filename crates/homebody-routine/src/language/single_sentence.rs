//! A sentence read by itself, to try whether it is understood.

use super::draft::RoutineDraft;
use super::faults::Faults;
use super::reader::{HomeNames, SentenceReader};
use super::sentence;
use super::words::SentenceWord;
use crate::routine::Routine;

pub fn read_alone(names: &HomeNames, draft: &RoutineDraft, text: &str, words: &[SentenceWord]) -> Option<Routine> {
    let mut faults = Faults::of_trial();
    let mut alone = draft.anew(text);
    let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text, part: None };
    sentence::sentence(&mut reader, &mut alone, None);
    (faults.count() == 0).then_some(alone.routine)
}
