//! What is said in other words is put in words that are known, before the sentence is read.

use super::activities::fits;
use super::faults::Faults;
use super::lexicon::words_of;
use super::reader::{Names, Reader};
use super::words::{Span, Word};

/// The sentence in known words; each stands in the place of those that were written.
pub fn reworded(names: &Names, text: &str, words: &[Word]) -> Vec<Word> {
    let lexicon = names.lexicon.clone();
    let mut faults = Faults::default();
    let mut reader = Reader { words, at: 0, names, faults: &mut faults, text, part: None };
    let mut found: Vec<Word> = Vec::with_capacity(words.len());
    while let Some(word) = words.get(reader.at) {
        let ways = lexicon.meaning(&word.text).filter_map(|(way, meant)| Some((fits(&reader, way)?, meant)));
        let Some((end, meant)) = ways.max_by_key(|(end, _)| *end) else {
            found.push(word.clone());
            reader.at += 1;
            continue;
        };
        let span: Span = reader.span(reader.at).to(words[end - 1].span);
        found.extend(words_of(meant, &Word { span, ..word.clone() }));
        reader.at = end;
    }
    found
}
