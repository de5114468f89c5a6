//! A clause that is read from its beginning to its end: who, what is done, and when or where are taken as they come, and words
//! between that tell none of it are passed over, "dusts [the china cabinet] on Fridays [with a soft cloth]". What is passed over is
//! told as not lived.
//!
//! A place that the home does not have is not passed over, either: where it is done would be another.
//!
//! Nothing is passed over that says whether, when, how often or how much, that limits or denies, or that is done as well. What
//! stands right behind the verb may be what is done: it is passed over only where that makes no other thing of it, as of reading.

use super::activities;
use super::adverbs::Adverbs;
use super::calendar::is_weekday;
use super::clause::place;
use super::draft::RoutineDraft;
use super::faults::Faults;
use super::reader::{HomeNames, SentenceReader, denies, is_beginning, is_determiner};
use super::set_aside::{Aside, BEGINNING, TELLING, WHERE, is_one_of, is_slip};
use super::single_sentence::read_alone;
use super::subjects::{self, SentenceSubject};
use super::synonym::reworded;
use super::visits::visits;
use super::words::{SentenceWord, TextSpan, Token};
use crate::routine::{Activity, Routine};

/// Number of words above which a clause is read literally.
const LONGEST: usize = 30;
/// Largest share of the words that are passed over (our choice): beyond it, the sentence has another subject.
const MOST_PASSED: f64 = 0.67;

pub fn skim(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> Option<Aside> {
    if words.len() > LONGEST || words.iter().any(|word| denies(&word.text)) {
        return None;
    }
    let known = reworded(names, draft.text, words);
    let taken = taken(names, draft, &known)?;
    let kept: Vec<SentenceWord> =
        known.iter().zip(&taken).filter(|(_, taken)| **taken).map(|(word, _)| word.clone()).collect();
    let passed = known.len() - kept.len();
    if passed == 0 || passed as f64 > MOST_PASSED * known.len() as f64 || !is_done(names, draft, &kept) {
        return None;
    }
    Some(Aside { words: kept, left_out: passed_over(&known, &taken) })
}

fn taken(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> Option<Vec<bool>> {
    let mut faults = Faults::of_trial();
    let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    let mut taken = vec![false; words.len()];
    let mut take = |from: usize, to: usize| taken[from..to].fill(true);
    let mut adverbs = Adverbs::default();
    adverbs.all(&mut reader);
    take(0, reader.at);
    let who = reader.at;
    let is_visitor = match subjects::subject(&mut reader)? {
        SentenceSubject::Person => false,
        SentenceSubject::Visitor(_) => true,
        _ => return None,
    };
    take(who, reader.at);
    // "She often", "she slowly".
    while !is_deed(&mut reader, is_visitor) {
        let from = reader.at;
        if adverbs.next(&mut reader) {
            take(from, reader.at);
        } else if is_manner(reader.peek(0)) || reader.token(0) == Some(Token::Comma) {
            reader.at += 1;
        } else {
            return None;
        }
    }
    let deed = reader.at;
    let doing =
        if is_visitor { visits(&mut reader).then_some(Activity::Visit)? } else { activities::activity(&mut reader)? };
    take(deed, reader.at);
    let object = reader.at;
    let mut is_object = !is_beginning(reader.peek(0));
    while !reader.is_over() {
        let (from, before) = (reader.at, reader.faults.count());
        let so_far = adverbs.clone();
        let follows_comma = from > 0 && words[from - 1].token == Token::Comma;
        if adverbs.next(&mut reader) && reader.faults.count() == before {
            // "Breakfast, usually porridge": how often is said of what follows.
            let is_of_next = follows_comma && adverbs.chance != so_far.chance && !reader.is_over();
            match is_of_next {
                true => adverbs = so_far,
                false => take(from, reader.at),
            }
            is_object = false;
            continue;
        }
        reader.faults.forget_since(before);
        reader.at = from;
        if reader.attempt(place).is_some() {
            take(from, reader.at);
            is_object = false;
            continue;
        }
        is_object &= !is_beginning(reader.peek(0));
        let is_elsewhere = is_one_of(WHERE, reader.peek(0)) && ["the", "a", "an"].contains(&reader.peek(1));
        let is_wrong_place = is_elsewhere && !matches!(doing, Activity::Leave | Activity::Visit);
        // "Westerns" may be read, but nobody knows what "blorp" is.
        let word = reader.peek(0);
        let is_named = is_determiner(word) || BEGINNING.contains(word) || word.ends_with('s');
        let is_bare = reader.token(0) == Some(Token::Word) && !is_named;
        let is_unknown = is_object && reader.at == object && is_bare && doing != Activity::Leave;
        if is_object && !doing.row().is_some_and(|row| row.takes_object)
            || is_unknown
            || is_wrong_place
            || !may_be_passed(&mut reader)
        {
            return None;
        }
        reader.at += 1;
    }
    Some(taken)
}

fn is_deed(reader: &mut SentenceReader, is_visitor: bool) -> bool {
    reader.ahead(|reader| if is_visitor { visits(reader) } else { activities::activity(reader).is_some() })
}

fn is_manner(word: &str) -> bool {
    const HOW: &str = "still also just even now usually generally happily then sometimes herself himself";
    word.len() > 4 && word.ends_with("ly") && !TELLING.contains(word) || is_one_of(HOW, word) && !TELLING.contains(word)
}

fn may_be_passed(reader: &mut SentenceReader) -> bool {
    let word = reader.peek(0).to_owned();
    let is_plain = match reader.token(0) {
        Some(Token::Comma) => true,
        Some(Token::Word) => word.chars().all(|c| c.is_alphabetic() || c == '\''),
        _ => false,
    };
    let before = reader.at.checked_sub(1).map_or("", |before| reader.words[before].text.as_str()).to_owned();
    let joins = ["and", "but", "then", "so", ","].contains(&before.as_str());
    let goes_on = joins && !is_determiner(&word) && reader.names.lexicon.is_third_person(&word);
    let is_other = ["she", "he", "they", "who", "which"].contains(&word.as_str());
    let is_of_time = matches!(reader.token(1), Some(Token::Number(_) | Token::Clock(..) | Token::Date(..)));
    // "To use the toilet" is done as well.
    let is_purpose = reader.ahead(|reader| reader.eat("to") && activities::activity(reader).is_some());
    is_plain
        && !goes_on
        && !is_other
        && !is_purpose
        && !is_of_time
        && !TELLING.contains(word.as_str())
        && !word.ends_with("n't")
        && !is_weekday(&word)
        && !is_slip(reader, &word)
}

fn passed_over(words: &[SentenceWord], taken: &[bool]) -> Vec<TextSpan> {
    let mut spans: Vec<TextSpan> = Vec::new();
    let mut is_on = false;
    for (word, taken) in words.iter().zip(taken) {
        let is_passed = !taken && word.token != Token::Comma;
        match spans.last_mut().filter(|_| is_on && is_passed) {
            Some(last) => *last = last.to(word.span),
            None if is_passed => spans.push(word.span),
            None => {}
        }
        is_on = is_passed;
    }
    spans
}

fn is_done(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> bool {
    read_alone(names, draft, draft.text, words).is_some_and(|routine| {
        let Routine { habits, changes, rules, .. } = &routine;
        !habits.is_empty() && changes.is_empty() && rules.is_empty()
    })
}
