//! Why a sentence is refused: the words that nothing covers, and sentences that keep the rest.

use super::activities::all_phrases;
use super::builder::{Built, Context};
use super::chart::{Chart, MOST_STEPS};
use super::filled_chart::is_read;
use super::messages::{SentenceMessage, WordMessage};
use super::names::{HomeNames, Sort};
use super::productions::arguments::said;
use super::statement::statements;
use super::tokens::{Tokens, span_of};
use super::words::{SentenceWord, TextSpan, Token, is_determiner};
use crate::routine::Routine;
use homebody_core::nearest::nearest;
use homebody_core::problem::{Advice, Diagnostic};
use std::cmp::Reverse;
use std::ops::Range;

/// Largest number of sentences that a refusal offers (our choice).
const MOST_OFFERS: usize = 3;
/// Words that deny, limit or ask for something: a sentence without them says something else.
const DENIALS: [&str; 17] = [
    "not", "no", "never", "cannot", "hardly", "barely", "scarcely", "nor", "neither", "only", "unless", "except",
    "without", "instead", "stops", "if", "when",
];
/// Parts of words for times.
const TIMES: [&str; 14] =
    ["night", "day", "morn", "even", "noon", "week", "month", "year", "hour", "time", "late", "early", "dawn", "dusk"];
/// Verbs of conditions alone.
const SHOWS: [&str; 4] = ["shows", "show", "develops", "develop"];
const WHERE: [&str; 6] = ["in", "on", "at", "by", "near", "beside"];

type Faults = Vec<(TextSpan, Diagnostic)>;

/// The words that the best readings leave out.
/// Each with its number of other problems.
pub fn left_out(names: &HomeNames, context: Context, tokens: &Tokens, skipped: &[(u64, usize)]) -> Faults {
    let first = skipped[0].0;
    let least = first.count_ones();
    let mut offers: Vec<String> = Vec::new();
    for (skipped, _) in skipped.iter().filter(|(skipped, faults)| skipped.count_ones() == least && *faults == 0) {
        if let Some(offer) = offer(names, context, tokens, *skipped)
            && !offers.contains(&offer)
            && offers.len() < MOST_OFFERS
        {
            offers.push(offer);
        }
    }
    // Without what is denied, the rest is not what was said.
    if let Some(denial) = (0..tokens.words.len()).find(|at| first & 1 << at != 0 && denies(&tokens.words[*at].text)) {
        let span = span_of(&tokens.words[denial..]);
        let ends = ["not", "no", "never", "stops"].contains(&tokens.words[denial].text.as_str());
        let help = "to end a new activity, write until when it happens: \"until week 12 she whittles in the armchair for 1 hour\"";
        let text = said(context.text, span);
        return vec![(span, WordMessage::NotUnderstood { text, help: ends.then(|| help.into()) }.into())];
    }
    let mut faults = Vec::new();
    let mut at = 0;
    while at < tokens.words.len() {
        if first & 1 << at == 0 {
            at += 1;
            continue;
        }
        let length = (at..tokens.words.len()).take_while(|at| first & 1 << at != 0).count();
        faults.push(uncovered(names, context, &tokens.words[at..at + length], &offers));
        at += length;
    }
    faults
}

fn uncovered(names: &HomeNames, context: Context, words: &[SentenceWord], offers: &[String]) -> (TextSpan, Diagnostic) {
    let span = span_of(words);
    let text = said(context.text, span);
    let rest = words.iter().position(|word| !WHERE.contains(&word.text.as_str()) && !is_determiner(&word.text));
    if let (true, Some(rest)) = (WHERE.contains(&words[0].text.as_str()), rest) {
        let span = span_of(&words[rest..]);
        let text = said(context.text, span);
        let help = known_or_nearest(&text, names.of(&[Sort::Place, Sort::Room, Sort::Thing]));
        return (span, WordMessage::UnknownPlaceOrTime { text, help }.into());
    }
    let near = match words {
        [word]
            if word.text.starts_with(char::is_alphabetic) && names.lexicon.grammar.known_word(&word.text).is_none() =>
        {
            nearest(&word.text, names.lexicon.grammar.all_words())
        }
        _ => None,
    };
    let help = match (near, offers) {
        (Some(near), _) => Some(Advice::meant(near)),
        (None, []) => None,
        (None, offers) => Some(format!("without it: {}", quoted(offers)).into()),
    };
    (span, WordMessage::NotUnderstood { text, help }.into())
}

/// The sentence without the words left out, if it keeps who does what, when, and what is denied.
fn offer(names: &HomeNames, context: Context, tokens: &Tokens, skipped: u64) -> Option<String> {
    let mut offer = String::new();
    for (at, word) in tokens.words.iter().enumerate() {
        if skipped & 1 << at != 0 {
            if matters(names, context.text, &tokens.words, at) {
                return None;
            }
            continue;
        }
        if !offer.is_empty() {
            offer += if tokens.commas[at] { ", " } else { " " };
        }
        offer += context.text.get(word.span.start..word.span.end).unwrap_or(&word.text);
    }
    let capital: String = offer.chars().take(1).flat_map(char::to_uppercase).collect();
    let rest: String = offer.chars().skip(1).collect();
    Some(format!("{capital}{rest}."))
}

fn denies(word: &str) -> bool {
    DENIALS.contains(&word) || word.ends_with("n't")
}

/// Whether a word is a verb, a number, a time, a person or a denial.
fn matters(names: &HomeNames, text: &str, words: &[SentenceWord], at: usize) -> bool {
    let word = &words[at];
    let (said, grammar) = (word.text.as_str(), &names.lexicon.grammar);
    let is_capital =
        at > 0 && text.get(word.span.start..word.span.end).is_some_and(|said| said.starts_with(char::is_uppercase));
    let is_verb = said.ends_with("ing") || said.ends_with("ed") || said.ends_with('s') && !said.ends_with("ss");
    let is_time = TIMES.iter().any(|time| said.contains(time));
    let is_word_of_grammar = grammar.is_closed(said) && !is_determiner(said) && !WHERE.contains(&said);
    word.token != Token::Word || is_time || denies(said) || is_capital || is_verb || is_word_of_grammar
}

/// A sentence of which not even a part is a statement.
pub fn without_reading(names: &HomeNames, context: Context, chart: &Chart) -> Faults {
    let words = chart.words;
    let whole = span_of(words);
    let text = context.text;
    let is_visitor = chart.phrases("Visitor").any(|item| item.skipped == 0 && item.start == 0);
    let doing = chart.phrases("Does").map(|item| chart.span(item.start, item.end)).next();
    if let (true, Some(span)) = (is_visitor, doing) {
        let help = "a sentence about a visitor describes a visit: \"her daughter visits on Sunday for 2 hours\"";
        return vec![(span, WordMessage::NotUnderstood { text: said(text, span), help: Some(help.into()) }.into())];
    }
    let subject = chart
        .phrases("Subject")
        .filter(|item| item.skipped == 0)
        .map(|item| (item.start as usize, item.end as usize))
        .min();
    let starts_part = |at: usize| chart.phrases("Part").any(|item| item.start as usize == at && item.skipped == 0);
    if let Some((_, end)) = subject.filter(|(_, end)| *end < words.len()) {
        let mut verb = end;
        while let Some(item) = chart
            .phrases("Part")
            .filter(|item| item.start as usize == verb && item.skipped == 0)
            .max_by_key(|item| item.end)
        {
            verb = item.end as usize;
        }
        if verb >= words.len() {
            return vec![(whole, SentenceMessage::Unfinished.into())];
        }
        // "No longer flies": a denial goes with the verb.
        let least = if denies(&words[verb].text) || words[verb].text == "does" { verb + 3 } else { verb + 1 };
        let stop = (least..words.len())
            .find(|at| starts_part(*at) || chart.phrases("Verb").any(|item| item.start as usize == *at));
        let doing = &words[verb..stop.unwrap_or(words.len())];
        let span = span_of(doing);
        let spoken = said(text, span).to_lowercase();
        if chart.most_steps < MOST_STEPS {
            return vec![(span, WordMessage::UnknownVerb { text: spoken, help: None }.into())];
        }
        if let (true, [rest @ .., last]) = (SHOWS.contains(&words[verb].text.as_str()), &doing[1..]) {
            let named =
                rest.iter().rfind(|word| names.lexicon.grammar.known_word(&word.text).is_none()).unwrap_or(last);
            let text = said(text, named.span);
            let help = known_or_nearest(&text, names.of(&[Sort::Condition]));
            return vec![(named.span, WordMessage::UnknownCondition { text, help }.into())];
        }
        let offers = || quoted(&similar(names, context, words, verb..verb + doing.len()));
        let can_be_new = chart.phrases("OWN").any(|item| item.start as usize == verb);
        let help = slip(names, doing, &spoken)
            .map(|meant| Advice::meant(&meant))
            .or_else(|| {
                Some(offers()).filter(|offers| !offers.is_empty()).map(|offers| format!("write {offers}").into())
            })
            .or_else(|| help_for(doing, &spoken, can_be_new));
        return vec![(span, WordMessage::UnknownVerb { text: spoken, help }.into())];
    }
    if subject.is_some() {
        return vec![(whole, SentenceMessage::Unfinished.into())];
    }
    if chart.phrases("Rest").any(|item| item.skipped == 0 && item.start == 0) {
        let help = "write who does it, such as \"she reads\"".to_owned();
        return vec![(span_of(&words[..1.min(words.len())]), WordMessage::NoSubject { help }.into())];
    }
    vec![(whole, WordMessage::NotAPerson { text: said(text, whole) }.into())]
}

/// The sentence with known activities of the same verb in place of an unknown one, where nothing else is lost.
fn similar(names: &HomeNames, context: Context, words: &[SentenceWord], doing: Range<usize>) -> Vec<String> {
    let verb = words[doing.start].text.as_str();
    let is_said = |word: &str| words[doing.clone()].iter().any(|said| said.text == word);
    let mut near: Vec<(Reverse<usize>, usize, &str)> = Vec::new();
    for phrase in all_phrases().iter().filter(|phrase| phrase.split(' ').next() == Some(verb)) {
        let shared = phrase.split(' ').skip(1).filter(|word| is_said(word) && !is_preposition(word)).count();
        let count = phrase.split(' ').count();
        let loses = words[doing.clone()].iter().any(|word| {
            let is_kept = phrase.split(' ').any(|kept| kept == word.text);
            !is_kept && (word.token != Token::Word || denies(&word.text) || TIMES.contains(&word.text.as_str()))
        });
        if (shared > 0 || count == 1) && !loses {
            near.push((Reverse(shared), count, phrase));
        }
    }
    near.sort_unstable();
    let text = |at: Range<usize>| said_of(context.text, &words[at]);
    let sentences = near.into_iter().take(MOST_OFFERS).map(|(.., phrase)| {
        [text(0..doing.start), phrase.to_owned(), text(doing.end..words.len())]
            .into_iter()
            .filter(|part| !part.is_empty())
            .collect::<Vec<_>>()
            .join(" ")
            + "."
    });
    sentences.filter(|sentence| is_read(names, context, sentence)).collect()
}

fn quoted(sentences: &[String]) -> String {
    sentences.iter().map(|sentence| format!("\"{sentence}\"")).collect::<Vec<_>>().join(" or ")
}

fn is_preposition(word: &str) -> bool {
    WHERE.contains(&word) || ["to", "of", "for", "with", "from", "up", "out", "off"].contains(&word)
}

fn said_of(text: &str, words: &[SentenceWord]) -> String {
    if words.is_empty() { String::new() } else { said(text, span_of(words)) }
}

/// The words that were probably meant: one of them is nearly a known word.
fn slip(names: &HomeNames, doing: &[SentenceWord], spoken: &str) -> Option<String> {
    /// In a longer phrase, an unknown word is hardly a slip.
    const MOST_NEAR: usize = 5;
    let grammar = &names.lexicon.grammar;
    let is_known = |word: &str| grammar.known_word(word).is_some() || is_determiner(word) || names.is_word(word);
    let slip = doing.iter().find(|word| word.token == Token::Word && !is_known(&word.text));
    let slip = slip.filter(|_| doing.len() <= MOST_NEAR)?;
    let meant = |near: &str| spoken.replace(&slip.text, near);
    let of_home = nearest(&slip.text, names.of(&[Sort::Place, Sort::Room, Sort::Thing, Sort::Condition]));
    let begins_known = |said: &String| all_phrases().iter().any(|phrase| said.starts_with(phrase.as_str()));
    let near = || nearest(&slip.text, grammar.all_words().filter(|word| word.len() > 3)).map(meant);
    of_home.map(meant).or_else(|| near().filter(begins_known))
}

/// A hint that names what the sentence lacks.
fn help_for(doing: &[SentenceWord], spoken: &str, can_be_new: bool) -> Option<Advice> {
    const FEW: usize = 4;
    let verb = doing[0].text.as_str();
    if ["goes", "walks", "drives", "visits"].contains(&verb) {
        return Some("for what is outside, write \"she goes out at 10:00 for 2 hours\"".into());
    }
    let begins = format!("{verb} ");
    let known = all_phrases().iter().filter(|phrase| phrase.starts_with(&begins));
    let quoted: Vec<String> = known.take(FEW).map(|phrase| format!("{phrase:?}")).collect();
    if !quoted.is_empty() {
        return Some(format!("known activities are {}, ...", quoted.join(", ")).into());
    }
    // A new activity is neither denied nor nearly a known word.
    if !can_be_new || doing.iter().any(|word| denies(&word.text)) {
        return None;
    }
    Some(format!("a new activity needs a place and a duration: \"she {spoken} in the armchair for 20 minutes\"").into())
}

/// Both meanings as sentences.
pub fn two_meanings(first: &Built, second: &Built) -> Diagnostic {
    let printed = |built: &Built| {
        let routine = Routine {
            habits: built.habits.iter().map(|(habit, _)| habit.clone()).collect(),
            rules: built.rules.iter().map(|(rule, ..)| rule.clone()).collect(),
            changes: built.changes.clone(),
            ..Routine::default()
        };
        let sentences = statements(&routine).into_iter().flat_map(|(_, statement)| statement.sentences());
        sentences.collect::<Vec<_>>().join(" ")
    };
    SentenceMessage::TwoMeanings { first: printed(first), second: printed(second) }.into()
}

fn known_or_nearest<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> Option<Advice> {
    super::faults::did_you_mean(&name.to_lowercase(), known)
}
