//! The routine language: habits, rules and changes in sentences that a nurse can read aloud.
//!
//! In reading order: `words` splits text into sentences of words; a `reader` steps through them and knows the names of the
//! home; `adverbs` reads times, lengths and frequencies, in any order, and `meaning` evaluates them; the `lexicon` holds the
//! words of activities. A `clause` combines subject, predicate and adverbs, a `conjunction` joins it with others by "and"
//! or "or"; `shape` completes notes; `build` makes habits and changes, `rules` makes rules; `sentence` reads clause by
//! clause into the `draft`; `check` finds contradictions. `faults` collects all problems and reports them together.

mod words;
mod faults;
pub(crate) mod messages;
mod known_names;
pub mod lexicon;
mod reader;
pub mod amounts;
mod calendar;
mod clock;
pub mod times;
mod frequency;
mod adverbs;
mod days;
mod day_kind;
mod meaning;
pub mod activities;
mod measures;
mod visits;
mod person_word;
mod subjects;
mod predicate;
mod clause;
mod falling;
mod predicates;
mod indirect;
mod unknown_word;
mod draft;
mod circumstances;
mod predicate_tail;
mod absence;
mod build;
mod triggers;
mod rules;
mod help;
mod remarks;
mod set_aside;
mod modifiers;
mod parts;
mod synonym;
mod inexact_time;
mod shape;
mod conjunction;
mod simplification;
mod unknown_name;
mod day_sentence;
mod sentence;
mod single_sentence;
mod check;
#[cfg(test)]
mod tests;

use crate::routine::{Quote, Routine};
use adverbs::Adverbs;
pub use calendar::LAST_WEEK;
use draft::RoutineDraft;
use faults::Faults;
use homebody_core::problem::Problem;
pub use known_names::KnownNames;
pub use lexicon::Lexicon;
use messages::SentenceMessage;
use modifiers::skim;
use reader::{HomeNames, SentenceReader};
use set_aside::set_aside;
use std::ops::Range;
use words::{Sentence, SentenceWord, TextSpan};

/// Largest length of a line.
pub const LONGEST_LINE: usize = 2_000;
/// Number of problems of a text after which no meanings of sentences are searched for, because this takes time (our
/// choice).
const MOST_MENDED: usize = 10;

/// Largest number of words of a text that are read freely if they are not understood as written, because this takes
/// time (our choice).
const MOST_FREE_WORDS: usize = 600;

/// Largest number of sentences.
pub const MOST_SENTENCES: usize = 2_000;

pub fn routine(file: &str, text: &str, known: &KnownNames) -> (Routine, Vec<Problem>) {
    read(file, text, known, false)
}

pub fn condition(file: &str, text: &str, known: &KnownNames) -> (Routine, Vec<Problem>) {
    let known = KnownNames { person: None, ..known.clone() };
    read(file, text, &known, true)
}

pub fn place(said: &Quote, text: &str) -> Range<usize> {
    let line = words::lines(text)[said.line as usize - 1];
    let before: usize = line.text.chars().take(said.column as usize - 1).map(char::len_utf8).sum();
    line.start + before..line.start + before + said.text.len()
}

pub fn severities() -> impl Iterator<Item = &'static str> + Clone {
    predicates::SEVERITIES.iter().flat_map(|(words, _)| words.split('|'))
}

struct Heading {
    adverbs: Adverbs,
    span: TextSpan,
    is_used: bool,
}

fn read(file: &str, text: &str, known: &KnownNames, is_condition: bool) -> (Routine, Vec<Problem>) {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut draft = RoutineDraft {
        routine: Routine { file: file.into(), ..Routine::default() },
        is_condition,
        name: None,
        habit_spans: Vec::new(),
        finders: Vec::new(),
        rule_spans: Vec::new(),
        first_date: known.first_date,
        usual: known.usual.clone(),
        text,
        lines: words::lines(text),
        is_trial: false,
        freely_read: 0,
    };
    let (mut names, mut faults) = (HomeNames::new(known), Faults::default());
    let (mut heading, mut count): (Option<Heading>, usize) = (None, 0);
    for line in draft.lines.clone() {
        if line.text.chars().nth(LONGEST_LINE).is_some() {
            let span = TextSpan { start: line.start, end: line.start };
            faults.add(span, SentenceMessage::LongLine { most: LONGEST_LINE });
            continue;
        }
        // Below a heading, a sentence that says nothing is one too: one that was taken out leaves its full stop.
        if let Some(heading) = heading.as_mut().filter(|_| line.is_indented() && line.text.trim().starts_with('.')) {
            heading.is_used = true;
        }
        let sentences = words::sentences(line);
        for (at, sentence) in sentences.iter().enumerate() {
            count += 1;
            if count > MOST_SENTENCES {
                faults.add(sentence.span(), SentenceMessage::TooManySentences { most: MOST_SENTENCES });
                return finish(draft, faults);
            }
            if let Some(before) = at.checked_sub(1).map(|before| &sentences[before]).filter(|_| sentence.goes_on)
                && let Some(days) = days_in_front(&draft, &names, before)
                && days_in_front(&draft, &names, sentence).is_none()
            {
                let text = text[days.start..days.end].to_owned();
                faults.add(sentence.span(), SentenceMessage::AfterSemicolon { text });
                continue;
            }
            one(&mut draft, &mut names, &mut faults, &mut heading, sentence);
        }
    }
    close(&mut faults, heading.take());
    check::check(&draft, &mut faults);
    finish(draft, faults)
}

fn days_in_front(draft: &RoutineDraft, names: &HomeNames, sentence: &Sentence) -> Option<TextSpan> {
    let mut faults = Faults::of_trial();
    let words = synonym::reworded(names, draft.text, &sentence.words);
    let mut reader = SentenceReader { words: &words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    let mut adverbs = Adverbs::default();
    adverbs.all(&mut reader);
    conjunction::days_span(&adverbs)
}

fn finish(draft: RoutineDraft, faults: Faults) -> (Routine, Vec<Problem>) {
    let problems = faults.problems(&draft.routine.file, &draft.lines);
    (draft.routine, problems)
}

fn one(
    draft: &mut RoutineDraft,
    names: &mut HomeNames,
    faults: &mut Faults,
    heading: &mut Option<Heading>,
    sentence: &Sentence,
) {
    if !sentence.indented {
        close(faults, heading.take());
    } else if let Some(heading) = heading.as_mut() {
        heading.is_used = true;
    } else {
        faults.add(sentence.span(), SentenceMessage::Indented);
    }
    let above = heading.as_ref().map(|heading| &heading.adverbs);
    let part = above.and_then(|above| above.part.as_ref()).map(|part| part.value);
    // Of a text in which nearly nothing is understood nobody asks what is beside the point.
    let reading = match faults.count() >= MOST_MENDED || draft.freely_read >= MOST_FREE_WORDS {
        true => None,
        false => understood(draft, names, &sentence.words),
    };
    if !matches!(&reading, Some(Reading::Whole(_, left_out)) if left_out.is_empty()) {
        draft.freely_read += sentence.words.len();
    }
    let (shaped, words) = match reading {
        Some(Reading::Parts(parts)) => return in_parts(draft, names, faults, (heading, sentence), parts),
        Some(Reading::Whole(words, left_out)) => {
            left_out.into_iter().for_each(|span| draft.routine.remarks.push(draft.said(span)));
            (sentence.words.clone(), words)
        }
        None => shape::in_shape(names, draft, &sentence.words),
    };
    let mut reader = SentenceReader { words: &words, at: 0, names, faults, text: draft.text, part };
    let before = reader.faults.count();
    let Some(adverbs) = sentence::sentence(&mut reader, draft, above) else {
        simplification::hints(faults, before, names, draft, &shaped);
        if let Some(name) = draft.name.as_ref().filter(|_| names.person.is_none()) {
            names.is_about(Some(name));
        }
        return;
    };
    simplification::hints(faults, before, names, draft, &shaped);
    let failed = faults.count() > before;
    if sentence.indented && !failed {
        faults.add(sentence.span(), SentenceMessage::NothingDone);
    }
    if !sentence.indented {
        *heading = Some(Heading { adverbs, span: sentence.span(), is_used: failed });
    }
}

enum Reading {
    Whole(Vec<SentenceWord>, Vec<TextSpan>),
    Parts(parts::SentenceParts),
}

fn understood(draft: &RoutineDraft, names: &HomeNames, words: &[SentenceWord]) -> Option<Reading> {
    let exactly = |words: &[SentenceWord], leaves_out: bool| {
        let (shaped, reworded) = shape::in_shape(names, draft, words);
        if single_sentence::read_alone(names, draft, draft.text, &reworded).is_some() {
            return Some(Reading::Whole(reworded, Vec::new()));
        }
        if let Some(aside) = set_aside(names, draft, &shaped) {
            return Some(Reading::Whole(synonym::reworded(names, draft.text, &aside.words), aside.left_out));
        }
        if let Some(aside) = skim(names, draft, &shaped) {
            return Some(Reading::Whole(aside.words, aside.left_out));
        }
        parts::in_parts(names, draft, words, leaves_out).map(Reading::Parts)
    };
    let roughly = |leaves_out: bool| {
        let inexact_time::Rough { lived, without, told } = inexact_time::roughly(names, draft.text, words)?;
        Some(match exactly(&lived, leaves_out).or_else(|| exactly(&without?, leaves_out))? {
            Reading::Whole(words, left_out) => Reading::Whole(words, [left_out, told].concat()),
            Reading::Parts(parts) => {
                Reading::Parts(parts::SentenceParts { remarks: [parts.remarks, told].concat(), ..parts })
            }
        })
    };
    let read = |leaves_out: bool| exactly(words, leaves_out).or_else(|| roughly(leaves_out));
    read(false).or_else(|| read(true)).or_else(|| parts::attitude(names, draft, words).map(Reading::Parts))
}

fn in_parts(
    draft: &mut RoutineDraft,
    names: &HomeNames,
    faults: &mut Faults,
    (heading, sentence): (&mut Option<Heading>, &Sentence),
    parts: parts::SentenceParts,
) {
    for remark in parts.remarks {
        draft.routine.remarks.push(draft.said(remark));
    }
    let above = heading.as_ref().map(|heading| &heading.adverbs);
    let part = above.and_then(|above| above.part.as_ref()).map(|part| part.value);
    for words in parts.lived {
        let mut reader = SentenceReader { words: &words, at: 0, names, faults: &mut *faults, text: draft.text, part };
        sentence::sentence(&mut reader, draft, above);
    }
    if !sentence.indented {
        *heading = None;
    }
}

fn close(faults: &mut Faults, heading: Option<Heading>) {
    if let Some(heading) = heading.filter(|heading| !heading.is_used) {
        faults.add(heading.span, SentenceMessage::EmptyHeading);
    }
}
