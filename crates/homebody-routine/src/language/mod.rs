//! The routine language: a life in sentences that a nurse can read aloud.
//!
//! In reading order: text becomes sentences of words (`words`); a `reader` goes through them and knows the names of
//! the home; `adverbs` reads when, how long and how often, in any order around the rest, and `meaning` says what those
//! come to; the words for what is done are those of the `lexicon`. A `clause` is who does what with all of that, `joined` by
//! "and" or "or" with others; `shape` completes notes; `build` makes habits and changes of it, `rules` rules;
//! `sentence` reads a sentence from clause to clause into the `draft`; `check` finds sentences that contradict each
//! other. Whatever is wrong is collected in `faults` and told all at once.

mod words;
mod faults;
pub(crate) mod messages;
mod known;
pub mod lexicon;
mod reader;
pub mod amounts;
mod calendar;
mod clock;
pub mod times;
mod often;
mod adverbs;
mod days;
mod lively;
mod meaning;
pub mod activities;
mod measures;
mod visits;
mod called;
mod subjects;
mod said;
mod clause;
mod falling;
mod predicates;
mod roundabout;
mod unknown;
mod draft;
mod circumstances;
mod tail;
mod staying;
mod build;
mod triggers;
mod rules;
mod helping;
mod remarks;
mod aside;
mod skim;
mod parts;
mod rewording;
mod roughly;
mod shape;
mod joined;
mod simpler;
mod strangers;
mod which_days;
mod sentence;
mod alone;
mod check;
#[cfg(test)]
mod tests;

use crate::routine::{Quote, Routine};
use adverbs::Adverbs;
use aside::set_aside;
pub use calendar::LAST_WEEK;
use draft::Draft;
use faults::Faults;
use homebody_core::problem::Problem;
pub use known::Known;
pub use lexicon::Lexicon;
use messages::SentenceMessage;
use reader::{Names, Reader};
use skim::skim;
use std::ops::Range;
use words::{Sentence, Span, Word};

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

/// Reads a person's routine: all that was understood, and all that is wrong, in the order of places.
pub fn routine(file: &str, text: &str, known: &Known) -> (Routine, Vec<Problem>) {
    read(file, text, known, false)
}

/// Reads a condition: the same language, but about nobody in particular.
pub fn condition(file: &str, text: &str, known: &Known) -> (Routine, Vec<Problem>) {
    let known = Known { person: None, ..known.clone() };
    read(file, text, &known, true)
}

/// Where in a text, which begins with no byte order mark, stands what was understood from it.
pub fn place(said: &Quote, text: &str) -> Range<usize> {
    let line = words::lines(text)[said.line as usize - 1];
    let before: usize = line.text.chars().take(said.column as usize - 1).map(char::len_utf8).sum();
    line.start + before..line.start + before + said.text.len()
}

/// The words for how severe a condition is.
pub fn severities() -> impl Iterator<Item = &'static str> + Clone {
    predicates::SEVERITIES.iter().flat_map(|(words, _)| words.split('|'))
}

/// The heading above indented lines.
struct Heading {
    adverbs: Adverbs,
    span: Span,
    is_used: bool,
}

fn read(file: &str, text: &str, known: &Known, is_condition: bool) -> (Routine, Vec<Problem>) {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut draft = Draft {
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
    let (mut names, mut faults) = (Names::new(known), Faults::default());
    let (mut heading, mut count): (Option<Heading>, usize) = (None, 0);
    for line in draft.lines.clone() {
        if line.text.chars().nth(LONGEST_LINE).is_some() {
            let span = Span { start: line.start, end: line.start };
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

/// On which days a sentence is, where it begins with them.
fn days_in_front(draft: &Draft, names: &Names, sentence: &Sentence) -> Option<Span> {
    let mut faults = Faults::of_trial();
    let words = rewording::reworded(names, draft.text, &sentence.words);
    let mut reader = Reader { words: &words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    let mut adverbs = Adverbs::default();
    adverbs.all(&mut reader);
    joined::days_span(&adverbs)
}

fn finish(draft: Draft, faults: Faults) -> (Routine, Vec<Problem>) {
    let problems = faults.problems(&draft.routine.file, &draft.lines);
    (draft.routine, problems)
}

/// Reads one sentence, below the heading if its line is indented.
fn one(draft: &mut Draft, names: &mut Names, faults: &mut Faults, heading: &mut Option<Heading>, sentence: &Sentence) {
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
    let mut reader = Reader { words: &words, at: 0, names, faults, text: draft.text, part };
    let before = reader.faults.count();
    let Some(adverbs) = sentence::sentence(&mut reader, draft, above) else {
        simpler::hints(faults, before, names, draft, &shaped);
        if let Some(name) = draft.name.as_ref().filter(|_| names.person.is_none()) {
            names.is_about(Some(name));
        }
        return;
    };
    simpler::hints(faults, before, names, draft, &shaped);
    let failed = faults.count() > before;
    if sentence.indented && !failed {
        faults.add(sentence.span(), SentenceMessage::NothingDone);
    }
    if !sentence.indented {
        *heading = Some(Heading { adverbs, span: sentence.span(), is_used: failed });
    }
}

/// How a sentence is understood.
enum Reading {
    /// In one: the words that are read, and what is set aside.
    Whole(Vec<Word>, Vec<Span>),
    Parts(parts::Parts),
}

/// Reads a sentence as it stands; or without what is beside the point; or in parts; or with what is lived of it roughly.
fn understood(draft: &Draft, names: &Names, words: &[Word]) -> Option<Reading> {
    let exactly = |words: &[Word], leaves_out: bool| {
        let (shaped, reworded) = shape::in_shape(names, draft, words);
        if alone::read_alone(names, draft, draft.text, &reworded).is_some() {
            return Some(Reading::Whole(reworded, Vec::new()));
        }
        if let Some(aside) = set_aside(names, draft, &shaped) {
            return Some(Reading::Whole(rewording::reworded(names, draft.text, &aside.words), aside.left_out));
        }
        if let Some(aside) = skim(names, draft, &shaped) {
            return Some(Reading::Whole(aside.words, aside.left_out));
        }
        parts::in_parts(names, draft, words, leaves_out).map(Reading::Parts)
    };
    let roughly = |leaves_out: bool| {
        let roughly::Rough { lived, without, told } = roughly::roughly(names, draft.text, words)?;
        Some(match exactly(&lived, leaves_out).or_else(|| exactly(&without?, leaves_out))? {
            Reading::Whole(words, left_out) => Reading::Whole(words, [left_out, told].concat()),
            Reading::Parts(parts) => Reading::Parts(parts::Parts { remarks: [parts.remarks, told].concat(), ..parts }),
        })
    };
    let read = |leaves_out: bool| exactly(words, leaves_out).or_else(|| roughly(leaves_out));
    read(false).or_else(|| read(true)).or_else(|| parts::attitude(names, draft, words).map(Reading::Parts))
}

/// Lives the parts of a sentence that are lived, below the heading, and keeps the others.
fn in_parts(
    draft: &mut Draft,
    names: &Names,
    faults: &mut Faults,
    (heading, sentence): (&mut Option<Heading>, &Sentence),
    parts: parts::Parts,
) {
    for remark in parts.remarks {
        draft.routine.remarks.push(draft.said(remark));
    }
    let above = heading.as_ref().map(|heading| &heading.adverbs);
    let part = above.and_then(|above| above.part.as_ref()).map(|part| part.value);
    for words in parts.lived {
        let mut reader = Reader { words: &words, at: 0, names, faults: &mut *faults, text: draft.text, part };
        sentence::sentence(&mut reader, draft, above);
    }
    if !sentence.indented {
        *heading = None;
    }
}

/// A heading has to have something below it.
fn close(faults: &mut Faults, heading: Option<Heading>) {
    if let Some(heading) = heading.filter(|heading| !heading.is_used) {
        faults.add(heading.span, SentenceMessage::EmptyHeading);
    }
}
