//! A chart with the words of a sentence, and of what the home and the lexicon say about them.

use super::chart::{Chart, SKIP_COST};
use super::names::{HomeNames, Sort};
use super::tokens::{Tokens, span_of};
use super::value::PhraseValue;
use super::words::{SentenceWord, Token};
use crate::routine::PhaseDay;

/// Largest number of words of an activity that the lexicon does not have (our choice).
const MOST_OWN_WORDS: usize = 5;

pub fn filled_chart<'a>(
    names: &'a HomeNames,
    text: &'a str,
    tokens: &'a Tokens,
    repairs: bool,
    most_steps: usize,
) -> Chart<'a> {
    let words = &tokens.words;
    let grammar = &names.lexicon.grammar;
    let is_word = |list: &str, word: &str| names.lexicon.is_word(list, word);
    let mut chart = Chart::new(grammar, text, words, &tokens.commas, &is_word, most_steps);
    for (at, word) in words.iter().enumerate() {
        match word.token {
            Token::Number(_) | Token::Clock(..) => chart.give_digits(at, &word.token),
            Token::Date(year, month, day) => {
                let date = PhaseDay::Date(year as i16, month.min(99) as u8, day.min(99) as u8);
                chart.give("DATE", at, at + 1, PhraseValue::Moment(date, 1), 0);
            }
            Token::Comma => chart.give("SLIP", at, at + 1, PhraseValue::Unit, 0),
            Token::Word if word.text.starts_with(|c: char| c.is_ascii_digit()) => {
                chart.give("SLIP", at, at + 1, PhraseValue::Unit, 0)
            }
            Token::Word => word_of(&mut chart, names, text, words, at),
        }
        for (length, sort, name) in names.at(words, at) {
            let name = PhraseValue::Name(name.to_owned());
            match sort {
                Sort::Condition => chart.give("CONDITION", at, at + length, name, 0),
                Sort::Room => {
                    chart.give("PLACE", at, at + length, name.clone(), 1);
                    chart.give("ROOM", at, at + length, name, 0);
                }
                Sort::Floor => chart.give("FLOOR", at, at + length, name, 0),
                Sort::Place => chart.give("PLACE", at, at + length, name, 0),
                Sort::Thing => {
                    chart.give("PLACE", at, at + length, name.clone(), 2);
                    chart.give("THING", at, at + length, name, 0);
                }
            }
        }
        match names.person_at(words, at) {
            Some((length, true)) => chart.give("OWNER", at, at + length, PhraseValue::Unit, 0),
            Some((length, false)) => chart.give("PERSON", at, at + length, PhraseValue::Unit, 0),
            None => {}
        }
        if repairs {
            chart.give("LEFTOUT", at, at + 1, PhraseValue::Unit, SKIP_COST);
        }
    }
    chart
}

/// Words that are known by what they are not.
fn word_of(chart: &mut Chart, names: &HomeNames, text: &str, words: &[SentenceWord], at: usize) {
    let grammar = &names.lexicon.grammar;
    let word = &words[at];
    let is_capital = |word: &SentenceWord| {
        text.get(word.span.start..word.span.end).is_some_and(|said| said.starts_with(char::is_uppercase))
    };
    let is_open = |word: &SentenceWord| {
        word.token == Token::Word && word.text.starts_with(char::is_alphabetic) && !grammar.is_closed(&word.text)
    };
    if at == 0 && is_capital(word) && !grammar.is_closed(&word.text) {
        let length = words.iter().take_while(|word| is_capital(word) && is_open(word)).count().clamp(1, 3);
        let span = span_of(&words[..length]);
        let name = text.get(span.start..span.end).unwrap_or_default().to_owned();
        if names.person_at(words, 0).is_none() {
            chart.give("STRANGER", 0, length, PhraseValue::Name(name), 0);
        }
    }
    if !is_open(word) {
        return;
    }
    let is_known = grammar.known_word(&word.text).is_some();
    chart.give("OPEN", at, at + 1, PhraseValue::Unit, 0);
    if !is_known && !names.is_word(&word.text) {
        chart.give("UNKNOWN", at, at + 1, PhraseValue::Unit, 0);
    }
    if at > 0 && is_capital(word) && !is_known {
        chart.give("CAPITAL", at, at + 1, PhraseValue::Unit, 0);
    }
    if !is_known
        && word.text.ends_with('s')
        && !word.text.ends_with("ss")
        && !word.text.ends_with("'s")
        && nearest_verb(names, &word.text).is_none()
    {
        for end in at + 1..=words.len().min(at + MOST_OWN_WORDS) {
            let last = &words[end - 1];
            if end > at + 1 && !is_open(last) && !names.lexicon.is_word("determiners", &last.text) {
                break;
            }
            if is_open(last) {
                chart.give("OWN", at, end, PhraseValue::Unit, 0);
            }
        }
    }
}

/// The known verb that was probably meant.
pub fn nearest_verb<'n>(names: &'n HomeNames, word: &str) -> Option<&'n str> {
    let grammar = &names.lexicon.grammar;
    homebody_core::nearest::nearest(word, grammar.all_words().filter(|known| known.ends_with('s') && known.len() > 3))
}
