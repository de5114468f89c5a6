//! Replaces words by known ones before a sentence is read.

use super::activities::fits;
use super::faults::Faults;
use super::lexicon::words_of;
use super::reader::{HomeNames, SentenceReader};
use super::words::{SentenceWord, TextSpan};

pub fn reworded(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Vec<SentenceWord> {
    let lexicon = names.lexicon.clone();
    let mut faults = Faults::default();
    let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text, part: None };
    let mut found: Vec<SentenceWord> = Vec::with_capacity(words.len());
    while let Some(word) = words.get(reader.at) {
        let ways = lexicon.meaning(&word.text).filter_map(|(way, meant)| Some((fits(&reader, way)?, meant)));
        let Some((end, meant)) = ways.max_by_key(|(end, _)| *end) else {
            found.push(word.clone());
            reader.at += 1;
            continue;
        };
        let span: TextSpan = reader.span(reader.at).to(words[end - 1].span);
        found.extend(words_of(meant, &SentenceWord { span, ..word.clone() }));
        reader.at = end;
    }
    found
}
