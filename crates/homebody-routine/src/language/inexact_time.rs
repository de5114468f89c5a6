//! Inexact times: "when the weather is fine", "until all hours". The lexicon gives them a share of days or an hour, and a
//! message names the words.

use super::activities::fits;
use super::faults::Faults;
use super::lexicon::words_of;
use super::reader::{HomeNames, SentenceReader};
use super::words::{SentenceWord, TextSpan};

const SELDOM: [&str; 3] = ["sometimes", "rarely", "on 30 % of days"];

pub struct Rough {
    pub lived: Vec<SentenceWord>,
    pub without: Option<Vec<SentenceWord>>,
    pub told: Vec<TextSpan>,
}

pub fn roughly(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Option<Rough> {
    let lexicon = names.lexicon.clone();
    let mut faults = Faults::of_trial();
    let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text, part: None };
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
        lived.extend(words_of(meant, &SentenceWord { span, ..word.clone() }));
        is_usual &= !SELDOM.iter().any(|seldom| meant.starts_with(seldom));
        told.push(span);
        reader.at = end;
    }
    (!told.is_empty()).then_some(Rough { lived, without: is_usual.then_some(without), told })
}
