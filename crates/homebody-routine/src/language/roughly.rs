//! What is not said exactly: "when the weather is fine", "until all hours". It is lived as the lexicon has it, on a share of the
//! days or until some hour, and the words themselves are told as not lived.

use super::activities::fits;
use super::faults::Faults;
use super::lexicon::words_of;
use super::reader::{Names, Reader};
use super::words::{Span, Word};

/// What is so on fewer than half of the days would be lived too often without these words.
const SELDOM: [&str; 3] = ["sometimes", "rarely", "on 30 % of days"];

/// A sentence that is not exact.
pub struct Rough {
    /// The sentence with what is lived instead of what is not exact.
    pub lived: Vec<Word>,
    /// The sentence without either, where that is so on most days.
    pub without: Option<Vec<Word>>,
    /// What is not exact.
    pub told: Vec<Span>,
}

/// How a sentence is lived that is not exact; nothing where all of it is.
pub fn roughly(names: &Names, text: &str, words: &[Word]) -> Option<Rough> {
    let lexicon = names.lexicon.clone();
    let mut faults = Faults::of_trial();
    let mut reader = Reader { words, at: 0, names, faults: &mut faults, text, part: None };
    let (mut lived, mut without, mut told) = (Vec::new(), Vec::new(), Vec::new());
    let mut is_usual = true;
    while let Some(word) = words.get(reader.at) {
        let ways = lexicon.roughly(&word.text).filter_map(|(way, meant)| Some((fits(&reader, way)?, meant)));
        let Some((end, meant)) = ways.max_by_key(|(end, _)| *end) else {
            lived.push(word.clone());
            without.push(word.clone());
            reader.at += 1;
            continue;
        };
        let span = reader.span(reader.at).to(words[end - 1].span);
        lived.extend(words_of(meant, &Word { span, ..word.clone() }));
        is_usual &= !SELDOM.iter().any(|seldom| meant.starts_with(seldom));
        told.push(span);
        reader.at = end;
    }
    (!told.is_empty()).then_some(Rough { lived, without: is_usual.then_some(without), told })
}
