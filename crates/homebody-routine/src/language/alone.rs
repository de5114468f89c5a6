//! A sentence read by itself, to try whether it is understood.

use super::draft::Draft;
use super::faults::Faults;
use super::reader::{Names, Reader};
use super::sentence;
use super::words::Word;
use crate::routine::Routine;

/// What these words by themselves say, if all of them are understood: nothing, of a heading.
pub fn read_alone(names: &Names, draft: &Draft, text: &str, words: &[Word]) -> Option<Routine> {
    let mut faults = Faults::of_trial();
    let mut alone = draft.anew(text);
    let mut reader = Reader { words, at: 0, names, faults: &mut faults, text, part: None };
    sentence::sentence(&mut reader, &mut alone, None);
    (faults.count() == 0).then_some(alone.routine)
}
