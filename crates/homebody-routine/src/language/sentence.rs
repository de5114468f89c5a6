//! One sentence: its words into the chart, and the best of its readings.

use super::build::{Built, Context, build};
use super::chart::{Chart, FAULT_COST, Item, MOST_STEPS, MOST_WORDS, SKIP_COST};
use super::lexicon::LexiconWords;
use super::messages::SentenceMessage;
use super::names::{HomeNames, Sort, is_determiner};
use super::parts::Parts;
use super::refusal;
use super::value::{Range, Statement, Value};
use super::words::{self, SentenceWord, TextSpan, Token};
use crate::routine::PhaseDay;
use homebody_core::problem::Diagnostic;
use std::sync::Arc;

/// Largest number of words of an activity that the lexicon does not have (our choice).
const MOST_OWN_WORDS: usize = 5;

/// A sentence without its commas.
pub struct Tokens {
    pub words: Vec<SentenceWord>,
    /// Whether a comma stands before each word.
    pub commas: Vec<bool>,
}

impl Tokens {
    pub fn new(words: &[SentenceWord]) -> Tokens {
        let mut tokens = Tokens { words: Vec::new(), commas: Vec::new() };
        let mut comma = false;
        for (at, word) in words.iter().enumerate() {
            let before = tokens.words.last();
            let is_glued = |to: Option<&SentenceWord>| to.is_some_and(|to| to.span.start == word.span.end);
            let digit = |text: &str| text.contains(|c: char| c.is_ascii_digit());
            let follows = before.is_some_and(|before| before.span.end == word.span.start && digit(&before.text));
            let is_sign = word.token == Token::Comma;
            // A slip within a time is one word: "7;40", "7:4o".
            let joins_digits = is_sign
                && follows
                && is_glued(words.get(at + 1))
                && words.get(at + 1).is_some_and(|next| digit(&next.text));
            let is_slip = !is_sign
                && follows
                && before.is_some_and(|before| before.token == Token::Comma || is_odd(before, word));
            if joins_digits || is_slip {
                if let Some(last) = tokens.words.last_mut() {
                    last.text += &word.text;
                    last.span.end = word.span.end;
                    last.token = Token::Comma;
                }
                continue;
            }
            if is_sign && !["(", ")"].contains(&word.text.as_str()) {
                comma = true;
                continue;
            }
            tokens.words.push(word.clone());
            tokens.commas.push(std::mem::take(&mut comma) && tokens.words.len() > 1);
        }
        tokens
    }
}

/// Whether a word stands right behind a number or a time, and is no unit.
fn is_odd(before: &SentenceWord, word: &SentenceWord) -> bool {
    match before.token {
        Token::Clock(_, minutes) => minutes == u32::MAX || word.token != Token::Word,
        Token::Number(_) => {
            word.text.len() == 1 && "ol".contains(&word.text)
                || word.text.starts_with('h')
                    && word.text.len() > 1
                    && word.text[1..].bytes().all(|byte| byte.is_ascii_digit())
        }
        _ => false,
    }
}

/// A sentence that is understood, or its problems.
pub enum Reading {
    Heading(Parts),
    Meaning(Box<Built>),
    Refused(Vec<(TextSpan, Diagnostic)>),
}

/// The steps that a text may take for sentences that are refused. Beyond them, no words are left out to find offers.
pub struct Budget {
    pub left: usize,
}

/// Steps for a refused sentence of a text that has used up its budget (our choice).
const FEW_STEPS: usize = 10_000;
/// Steps that the search for what was meant counts as, by its time (our choice).
const STEPS_OF_HINTS: usize = 5_000;

pub fn read(
    names: &HomeNames,
    context: Context,
    words: &[SentenceWord],
    is_indented: bool,
    budget: &mut Budget,
) -> Reading {
    let (reading, steps) = with_steps(names, context, words, is_indented, budget);
    if let Reading::Refused(_) = &reading {
        budget.left = budget.left.saturating_sub(steps + STEPS_OF_HINTS);
    }
    reading
}

fn with_steps(
    names: &HomeNames,
    context: Context,
    words: &[SentenceWord],
    is_indented: bool,
    budget: &Budget,
) -> (Reading, usize) {
    let tokens = Tokens::new(words);
    let span = span_of(&tokens.words);
    if tokens.words.len() > MOST_WORDS {
        return (Reading::Refused(vec![(span, SentenceMessage::TooManyWords { most: MOST_WORDS }.into())]), 0);
    }
    let most_steps = if budget.left > 0 { MOST_STEPS } else { FEW_STEPS };
    let mut chart = chart(names, context.text, &tokens, budget.left > 0, most_steps);
    let reading = best(names, context, &tokens, &mut chart, is_indented);
    (reading, chart.steps)
}

fn best(names: &HomeNames, context: Context, tokens: &Tokens, chart: &mut Chart, is_indented: bool) -> Reading {
    let span = span_of(&tokens.words);
    let found = chart.readings("Statement");
    let mut best: Vec<(usize, u32, Arc<Item>, Built)> = Vec::new();
    for item in found {
        let Value::Statement(statement) = item.value.as_ref() else { continue };
        let built = build(context, statement, span);
        let faults = built.faults.len() + item.faults.as_ref().map_or(0, |faults| faults.len());
        best.push((faults, item.cost, item, built));
    }
    best.sort_by_key(|(faults, cost, ..)| (*cost >= SKIP_COST, *faults, *cost));
    let Some((faults, cost, item, built)) = best.first() else {
        return Reading::Refused(refusal::without_reading(names, context, chart));
    };
    if item.skipped != 0 {
        let skipped: Vec<(u64, usize)> = best.iter().map(|(faults, _, item, _)| (item.skipped, *faults)).collect();
        let mut all = refusal::left_out(names, context, tokens, &skipped);
        all.extend(item.faults.iter().flat_map(|faults| faults.iter().cloned()));
        all.sort_by_key(|(span, _)| span.start);
        return Reading::Refused(all);
    }
    if *faults > 0 {
        let mut all: Vec<(TextSpan, Diagnostic)> =
            item.faults.iter().flat_map(|faults| faults.iter().cloned()).collect();
        all.extend(built.faults.iter().cloned());
        return Reading::Refused(all);
    }
    if let Value::Statement(statement) = item.value.as_ref()
        && let Statement::Heading(parts) = statement.as_ref()
    {
        return match is_indented {
            true => Reading::Refused(vec![(span, SentenceMessage::NothingDone.into())]),
            false => Reading::Heading(parts.clone()),
        };
    }
    let other = best.iter().skip(1).find(|(faults, other, _, other_built)| {
        *faults == 0 && *other < FAULT_COST && other == cost && !other_built.is_same(built)
    });
    if let Some((.., other)) = other {
        let message = refusal::two_meanings(built, other);
        return Reading::Refused(vec![(span, message)]);
    }
    let (_, _, _, built) = best.swap_remove(0);
    Reading::Meaning(Box::new(built))
}

/// Whether a sentence of the same routine has a meaning.
pub fn is_read(names: &HomeNames, context: Context, text: &str) -> bool {
    let words = words::of_name(text);
    let tokens = Tokens::new(&words);
    let span = span_of(&tokens.words);
    let mut chart = chart(names, text, &tokens, false, MOST_STEPS);
    chart.readings("Statement").iter().any(|item| match item.value.as_ref() {
        Value::Statement(statement) if item.faults.is_none() => {
            build(Context { text, ..context }, statement, span).faults.is_empty()
        }
        _ => false,
    })
}

pub fn span_of(words: &[SentenceWord]) -> TextSpan {
    match (words.first(), words.last()) {
        (Some(first), Some(last)) => first.span.to(last.span),
        _ => TextSpan::default(),
    }
}

fn chart<'a>(names: &'a HomeNames, text: &'a str, tokens: &'a Tokens, repairs: bool, most_steps: usize) -> Chart<'a> {
    let words = &tokens.words;
    let grammar = &names.lexicon.grammar;
    let mut chart = Chart::new(grammar, text, words, &tokens.commas, &is_determiner, most_steps);
    for (at, word) in words.iter().enumerate() {
        match word.token {
            Token::Number(number) => chart.give("NUMBER", at, at + 1, Value::Number(number), 0),
            Token::Clock(hours, minutes) => {
                let range = Range { from: f64::from(hours), to: f64::from(minutes), about: false };
                chart.give("CLOCK", at, at + 1, Value::Range(range), 0);
            }
            Token::Date(year, month, day) => {
                let date = PhaseDay::Date(year as i16, month.min(99) as u8, day.min(99) as u8);
                chart.give("DATE", at, at + 1, Value::Moment(date, 1), 0);
            }
            Token::Comma => chart.give("SLIP", at, at + 1, Value::Unit, 0),
            Token::Word if word.text.starts_with(|c: char| c.is_ascii_digit()) => {
                chart.give("SLIP", at, at + 1, Value::Unit, 0)
            }
            Token::Word => word_of(&mut chart, names, text, words, at),
        }
        for (length, sort, name) in names.at(words, at) {
            let name = Value::Name(name.to_owned());
            match sort {
                Sort::Condition => chart.give("CONDITION", at, at + length, name, 0),
                Sort::Room => {
                    chart.give("PLACE", at, at + length, name.clone(), 1);
                    chart.give("ROOM", at, at + length, name, 0);
                }
                Sort::Place => chart.give("PLACE", at, at + length, name, 0),
                Sort::Thing => {
                    chart.give("PLACE", at, at + length, name.clone(), 2);
                    chart.give("THING", at, at + length, name, 0);
                }
            }
        }
        match names.person_at(words, at) {
            Some((length, true)) => chart.give("OWNER", at, at + length, Value::Unit, 0),
            Some((length, false)) => chart.give("PERSON", at, at + length, Value::Unit, 0),
            None => {}
        }
        if repairs {
            chart.give("LEFTOUT", at, at + 1, Value::Unit, SKIP_COST);
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
            chart.give("STRANGER", 0, length, Value::Name(name), 0);
        }
    }
    if !is_open(word) {
        return;
    }
    let is_known = grammar.known_word(&word.text).is_some();
    chart.give("OPEN", at, at + 1, Value::Unit, 0);
    if !is_known && !names.is_word(&word.text) {
        chart.give("UNKNOWN", at, at + 1, Value::Unit, 0);
    }
    if at > 0 && is_capital(word) && !is_known {
        chart.give("CAPITAL", at, at + 1, Value::Unit, 0);
    }
    if !is_known
        && word.text.ends_with('s')
        && !word.text.ends_with("ss")
        && !word.text.ends_with("'s")
        && nearest_verb(names, &word.text).is_none()
    {
        for end in at + 1..=words.len().min(at + MOST_OWN_WORDS) {
            let last = &words[end - 1];
            if end > at + 1 && !is_open(last) && !is_determiner(&last.text) {
                break;
            }
            if is_open(last) {
                chart.give("OWN", at, end, Value::Unit, 0);
            }
        }
    }
}

/// The known verb that was probably meant.
pub fn nearest_verb<'n>(names: &'n HomeNames, word: &str) -> Option<&'n str> {
    let grammar = &names.lexicon.grammar;
    homebody_core::nearest::nearest(word, grammar.all_words().filter(|known| known.ends_with('s') && known.len() > 3))
}

/// The value of words that a lexicon gives as the meaning of others: a part of a sentence, or what is done.
pub fn meaning_of(lexicon: &LexiconWords, text: &str) -> Option<Value> {
    let words = words::of_name(text);
    let tokens = Tokens::new(&words);
    for category in ["Parts", "Does"] {
        let grammar = &lexicon.grammar;
        let mut chart = Chart::new(grammar, text, &tokens.words, &tokens.commas, &is_determiner, MOST_STEPS);
        for (at, word) in tokens.words.iter().enumerate() {
            match word.token {
                Token::Number(number) => chart.give("NUMBER", at, at + 1, Value::Number(number), 0),
                Token::Clock(hours, minutes) => {
                    let range = Range { from: f64::from(hours), to: f64::from(minutes), about: false };
                    chart.give("CLOCK", at, at + 1, Value::Range(range), 0);
                }
                _ => {}
            }
        }
        let found = chart.readings(category);
        if let Some(item) = found.iter().find(|item| item.faults.is_none()) {
            return Some(Value::clone(&item.value));
        }
    }
    None
}
