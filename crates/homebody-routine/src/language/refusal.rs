//! Why a sentence is refused: the words that nothing covers, and sentences that keep the rest.

use super::activities::all_phrases;
use super::builder::{Built, Context};
use super::chart::{Chart, MOST_STEPS};
use super::messages::{SentenceMessage, WordMessage};
use super::names::{HomeNames, Sort};
use super::offers::{NOTE, denies, kept, note, offer};
use super::productions::arguments::said;
use super::statement::statements;
use super::tokens::{Tokens, span_of};
use super::words::{SentenceWord, TextSpan, Token};
use crate::routine::Routine;
use homebody_core::problem::{Advice, Diagnostic};
use std::collections::BTreeSet;

/// Largest number of sentences that a refusal offers (our choice).
const MOST_OFFERS: usize = 3;
/// How hints begin that do without the words of the sentence.
const GENERAL: [&str; 4] =
    ["a sentence says who does what", "there are ", "known activities are ", "write who does it"];

type Faults = Vec<(TextSpan, Diagnostic)>;

/// The words that the best readings leave out.
/// Each with its number of other problems.
pub fn left_out(
    names: &HomeNames,
    context: Context,
    tokens: &Tokens,
    chart: &Chart,
    skipped: &[(u64, usize)],
) -> Faults {
    let first = skipped[0].0;
    let least = first.count_ones();
    let mut offers: Vec<String> = Vec::new();
    for (skipped, _) in skipped.iter().filter(|(skipped, faults)| skipped.count_ones() == least && *faults == 0) {
        if let Some(offer) = kept(names, context.text, tokens, chart, *skipped)
            && !offers.contains(&offer)
            && offers.len() < MOST_OFFERS
        {
            offers.push(offer);
        }
    }
    // Without what is denied, the rest is not what was said.
    if let Some(denial) =
        (0..tokens.words.len()).find(|at| first & 1 << at != 0 && denies(&names.lexicon, &tokens.words[*at].text))
    {
        let span = span_of(&tokens.words[denial..]);
        let is_new =
            |word: &SentenceWord| word.token == Token::Word && names.lexicon.grammar.known_word(&word.text).is_none();
        let ends = ["not", "no", "never", "stops"].contains(&tokens.words[denial].text.as_str())
            && tokens.words.iter().skip(denial + 1).take(2).any(is_new);
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
    let lexicon = &names.lexicon;
    let is_where = |word: &SentenceWord| lexicon.is_word("where", &word.text);
    let rest = words.iter().position(|word| !is_where(word) && !lexicon.is_word("determiners", &word.text));
    if let (true, Some(rest)) = (is_where(&words[0]), rest) {
        let span = span_of(&words[rest..]);
        let text = said(context.text, span);
        let help = known_or_nearest(&text, names.of(&[Sort::Place, Sort::Room, Sort::Thing]));
        return (span, WordMessage::UnknownPlaceOrTime { text, help }.into());
    }
    let near = match words {
        [word]
            if word.text.starts_with(char::is_alphabetic) && names.lexicon.grammar.known_word(&word.text).is_none() =>
        {
            slip_of(names, &word.text, names.lexicon.grammar.all_words())
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

/// A sentence of which not even a part is a statement.
pub fn without_reading(names: &HomeNames, context: Context, chart: &Chart) -> Faults {
    let (words, text) = (chart.words, context.text);
    let whole = span_of(words);
    if let Some(fault) = of_visitor(context, chart) {
        return vec![fault];
    }
    let subjects = chart.phrases("Subject").filter(|item| item.skipped == 0);
    let subject = subjects.map(|item| (item.start as usize, item.end as usize)).min();
    if let Some((_, end)) = subject.filter(|(_, end)| *end < words.len()) {
        return vec![unknown_verb(names, context, chart, behind_parts(chart, end))];
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

/// An activity of a visitor other than a visit.
fn of_visitor(context: Context, chart: &Chart) -> Option<(TextSpan, Diagnostic)> {
    chart.phrases("Visitor").find(|item| item.skipped == 0 && item.start == 0)?;
    let doing = chart.phrases("Does").next()?;
    let span = chart.span(doing.start, doing.end);
    let help = "a sentence about a visitor describes a visit: \"her daughter visits on Sunday for 2 hours\"";
    Some((span, WordMessage::NotUnderstood { text: said(context.text, span), help: Some(help.into()) }.into()))
}

/// The word behind the parts that begin at a word.
fn behind_parts(chart: &Chart, mut at: usize) -> usize {
    let part = |at: usize| chart.phrases("Part").filter(move |item| item.start as usize == at && item.skipped == 0);
    while let Some(item) = part(at).max_by_key(|item| item.end) {
        at = item.end as usize;
    }
    at
}

/// The words behind a subject name no known activity.
fn unknown_verb(names: &HomeNames, context: Context, chart: &Chart, verb: usize) -> (TextSpan, Diagnostic) {
    let (words, text, lexicon) = (chart.words, context.text, &names.lexicon);
    if verb >= words.len() {
        return (span_of(words), SentenceMessage::Unfinished.into());
    }
    // "No longer flies": a denial goes with the verb.
    let least = if denies(lexicon, &words[verb].text) || words[verb].text == "does" { verb + 3 } else { verb + 1 };
    let begins = |at: usize| {
        let starts = |category| chart.phrases(category).filter(move |item| item.start as usize == at);
        starts("Verb").next().is_some() || starts("Part").any(|item| item.skipped == 0)
    };
    let stop = (least..words.len()).find(|at| begins(*at));
    let doing = &words[verb..stop.unwrap_or(words.len())];
    let span = span_of(doing);
    let spoken = said(text, span).to_lowercase();
    if chart.most_steps < MOST_STEPS {
        return (span, WordMessage::UnknownVerb { text: spoken, help: None }.into());
    }
    if let (true, [rest @ .., last]) = (lexicon.is_word("shows", &words[verb].text), &doing[1..]) {
        let named = rest.iter().rfind(|word| lexicon.grammar.known_word(&word.text).is_none()).unwrap_or(last);
        let text = said(text, named.span);
        let help = known_or_nearest(&text, names.of(&[Sort::Condition]));
        return (named.span, WordMessage::UnknownCondition { text, help }.into());
    }
    let can_be_new = chart.phrases("OWN").any(|item| item.start as usize == verb);
    let help = slip(names, doing, &spoken).map(|meant| Advice::meant(&meant));
    let help = help.or_else(|| help_for(names, doing, &spoken, can_be_new));
    (span, WordMessage::UnknownVerb { text: spoken, help }.into())
}

/// The words that were probably meant: one of them is nearly a known word.
fn slip(names: &HomeNames, doing: &[SentenceWord], spoken: &str) -> Option<String> {
    /// In a longer phrase, an unknown word is hardly a slip.
    const MOST_NEAR: usize = 5;
    let lexicon = &names.lexicon;
    let is_known = |word: &str| {
        lexicon.grammar.known_word(word).is_some() || lexicon.is_word("determiners", word) || names.is_word(word)
    };
    let slip = doing.iter().find(|word| word.token == Token::Word && !is_known(&word.text));
    let slip = slip.filter(|_| doing.len() <= MOST_NEAR)?;
    let meant = |near: &str| spoken.replace(&slip.text, near);
    let of_home = slip_of(names, &slip.text, names.of(&[Sort::Place, Sort::Room, Sort::Thing, Sort::Condition]));
    let begins_known = |said: &String| all_phrases().iter().any(|phrase| said.starts_with(phrase.as_str()));
    let near = || slip_of(names, &slip.text, lexicon.grammar.all_words().filter(|word| word.len() > 3)).map(meant);
    of_home.map(meant).or_else(|| near().filter(begins_known))
}

/// The known word that was meant: it has the same first letter, and one letter is wrong, missing, too many or in the wrong place. Words
/// of rewritings count as known.
fn slip_of<'a>(names: &HomeNames, word: &str, mut known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    /// Shortest word that is taken for a slip (our choice): of shorter ones, too many are one letter apart.
    const SHORTEST: usize = 4;
    let is_own = word.chars().count() < SHORTEST || names.lexicon.rewritings.iter().any(|one| one.has(word));
    let near = |known: &&str| known.chars().next() == word.chars().next() && is_slip(known, word);
    if is_own { None } else { known.find(near) }
}

/// Whether two words have one letter more, less or other, or two neighbours in the other order.
fn is_slip(one: &str, other: &str) -> bool {
    // The distance is at least the difference of the lengths.
    one.chars().count().abs_diff(other.chars().count()) <= 1 && strsim::osa_distance(one, other) == 1
}

/// A hint that names what the sentence lacks.
fn help_for(names: &HomeNames, doing: &[SentenceWord], spoken: &str, can_be_new: bool) -> Option<Advice> {
    const FEW: usize = 4;
    let verb = doing[0].text.as_str();
    if ["goes", "walks", "drives", "visits"].contains(&verb) {
        return Some("for what is outside, write \"she goes out at 10:00 for 2 hours\"".into());
    }
    // Phrases that begin with the same verb help if they have another word of the sentence.
    let begins = format!("{verb} ");
    let has = |phrase: &str| phrase.split(' ').skip(1).any(|word| doing[1..].iter().any(|said| said.text == word));
    let known: BTreeSet<&str> =
        all_phrases().iter().map(String::as_str).filter(|phrase| phrase.starts_with(&begins) && has(phrase)).collect();
    let quoted: Vec<String> = known.into_iter().take(FEW).map(|phrase| format!("{phrase:?}")).collect();
    if !quoted.is_empty() && !names.lexicon.is_word("light", verb) {
        return Some(format!("known activities are {}", quoted.join(", ")).into());
    }
    // A new activity is neither denied nor nearly a known word.
    let is_part = doing.last().is_some_and(|last| {
        names.lexicon.grammar.is_closed(&last.text) || names.lexicon.is_word("determiners", &last.text)
    });
    let is_known = ["light", "no-deeds"].iter().any(|list| names.lexicon.is_word(list, verb))
        || names.lexicon.rewritings.iter().any(|one| one.has(verb));
    if !can_be_new || is_known || is_part || doing.iter().any(|word| denies(&names.lexicon, &word.text)) {
        return None;
    }
    Some(format!("a new activity needs a place and a duration: \"she {spoken} in the armchair for 20 minutes\"").into())
}

/// The problems with an offer in the hint of the first, and the steps that finding it took.
pub fn with_offer(names: &HomeNames, context: Context, tokens: &Tokens, mut faults: Faults) -> (Faults, usize) {
    let has_sentence =
        |(_, fault): &(TextSpan, Diagnostic)| fault.hint.as_ref().is_some_and(|hint| hint.contains("without it: \""));
    if faults.iter().any(has_sentence) {
        return (faults, 0);
    }
    let (found, steps) = offer(names, context, tokens);
    let Some((_, first)) = faults.first_mut() else { return (faults, steps) };
    // Names that are known, and how any sentence is built, help less than the sentence itself.
    let is_general = first.hint.as_ref().is_none_or(|hint| GENERAL.iter().any(|begin| hint.starts_with(begin)));
    let words = match found {
        Some(offer) => offer.words(),
        None if is_general => note(names, context, tokens).words(),
        None => return (faults, steps),
    };
    first.hint = Some(match first.hint.take().filter(|_| !is_general || words.contains(NOTE)) {
        Some(hint) => format!("{hint}; or {words}"),
        None => words,
    });
    first.fix = first.fix.take().filter(|_| !is_general);
    (faults, steps)
}

fn quoted(sentences: &[String]) -> String {
    sentences.iter().map(|sentence| format!("{sentence:?}")).collect::<Vec<_>>().join(" or ")
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
