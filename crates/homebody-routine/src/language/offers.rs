//! Sentences that keep what a refused one says, as far as the language can say it.

use super::build::build;
use super::builder::Context;
use super::chart::Chart;
use super::filled_chart::filled_chart;
use super::lexicon::LexiconWords;
use super::names::HomeNames;
use super::rewriting::RewritingWord;
use super::tokens::{Tokens, span_of};
use super::value::{PhraseValue, SpokenStatement};
use super::words::{self, SentenceWord, TextSpan, Token};
use homebody_core::problem::Diagnostic;

/// Largest number of sentences that are tried for a refusal (our choice).
const MOST_TRIES: usize = 32;
/// Steps that the reading of one of them takes (our choice).
const MOST_STEPS_OF_TRY: usize = 12_000;
/// Steps that all of them take (our choice), which bounds the time.
const MOST_STEPS_OF_ALL: usize = 60_000;
/// Steps that giving the words of one to a chart counts as, by its time (our choice).
const STEPS_OF_WORDS: usize = 2_000;
/// Largest number of rewritings of a sentence (our choice).
const MOST_REWRITINGS: usize = 16;
/// Of so many words, at most one is left out (our choice).
const LEAST_SHARE_KEPT: usize = 3;

/// Within so many words, a clause of its own has its subject (our choice).
const OWN_SUBJECT: usize = 3;

/// Sentences that together say what the refused one says.
#[derive(Clone, Debug, PartialEq)]
pub struct SentenceOffer {
    pub sentences: Vec<String>,
    /// Whether a number in them is an example.
    pub assumes: bool,
    /// The words that they leave out.
    pub without: Vec<String>,
}

impl SentenceOffer {
    /// "write ..."
    pub fn words(&self) -> String {
        let (notes, read): (Vec<&String>, Vec<&String>) =
            self.sentences.iter().partition(|sentence| sentence.starts_with(NOTE));
        if let ([_, ..], [_, ..]) = (&notes[..], &read[..]) {
            let read = SentenceOffer { sentences: read.into_iter().cloned().collect(), ..self.clone() };
            let notes: Vec<String> = notes.into_iter().map(|note| format!("{note:?}")).collect();
            return format!("{}, and on a line of its own {}", read.words(), notes.join(", "));
        }
        let said = self.sentences.join(" ");
        let without: Vec<String> = self.without.iter().map(|words| format!("{words:?}")).collect();
        let without =
            if without.is_empty() { String::new() } else { format!(", which leaves out {}", without.join(" and ")) };
        match (self.sentences[0].starts_with(NOTE), self.assumes) {
            (true, _) if self.sentences.len() == 1 => format!("to keep it without an effect, write {said:?}"),
            (_, true) => format!("write, with the right times, {said:?}{without}"),
            (_, false) => format!("write {said:?}{without}"),
        }
    }
}

pub const NOTE: &str = "Note: ";
/// The code of a time that may be of either half of the day.
const AMBIGUOUS_TIME: &str = "routine::ambiguous-time";

struct Search<'a> {
    names: &'a HomeNames,
    context: Context<'a>,
    tries: usize,
    steps: usize,
    who: String,
    assumes: bool,
    without: Vec<String>,
}

/// Sentences for a refused one.
/// With the steps that finding them took.
pub fn offer(names: &HomeNames, context: Context, tokens: &Tokens) -> (Option<SentenceOffer>, usize) {
    let said = pieces(names, context.text, tokens);
    let (meant, assumes) = rewritten(&names.lexicon, said.clone());
    let lexicon = &names.lexicon;
    let is_he = said.iter().any(|piece| lexicon.is_word("he", &piece.text));
    let who = lexicon.words_of(if is_he { "he-says" } else { "she" }).next().unwrap_or_default().to_owned();
    let mut search = Search { names, context, tries: MOST_TRIES, steps: 0, who, assumes, without: Vec::new() };
    let sentences = search.whole(&meant).map(|one| vec![one]).or_else(|| search.clauses(&meant));
    let same = sentence_of(&said);
    let sentences = sentences.filter(|sentences| sentences[..] != [same.as_str()]);
    let Search { assumes, without, steps, .. } = search;
    (sentences.map(|sentences| SentenceOffer { sentences, assumes, without }), steps)
}

/// The refused sentence as one that is kept without an effect.
pub fn note(names: &HomeNames, context: Context, tokens: &Tokens) -> SentenceOffer {
    let rest =
        said_as_written(context.text, tokens).unwrap_or_else(|| sentence_of(&pieces(names, context.text, tokens)));
    SentenceOffer { sentences: vec![format!("{NOTE}{rest}")], assumes: false, without: Vec::new() }
}

/// The sentence without rewritings.
fn said_as_written(text: &str, tokens: &Tokens) -> Option<String> {
    let span = span_of(&tokens.words);
    text.get(span.start..span.end).map(as_sentence)
}

fn as_sentence(said: &str) -> String {
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    let capital: String = said.chars().take(1).flat_map(char::to_uppercase).collect();
    let rest: String = said.chars().skip(1).collect();
    format!("{capital}{rest}.")
}

fn pieces(names: &HomeNames, text: &str, tokens: &Tokens) -> Vec<RewritingWord> {
    let piece = |(at, word): (usize, &SentenceWord)| {
        let shown = text.get(word.span.start..word.span.end).filter(|shown| shown.to_lowercase() == word.text);
        let lexicon = &names.lexicon;
        let counts = word.token != Token::Word
            || denies(lexicon, &word.text)
            || is_time(lexicon, &word.text)
            || lexicon.is_word("hours", &word.text);
        let shown = shown.unwrap_or(&word.text).to_owned();
        RewritingWord { text: word.text.clone(), shown, comma: tokens.commas[at], counts, span: Some(word.span) }
    };
    tokens.words.iter().enumerate().map(piece).collect()
}

fn rewritten(lexicon: &LexiconWords, mut pieces: Vec<RewritingWord>) -> (Vec<RewritingWord>, bool) {
    let (mut assumes, mut left) = (false, MOST_REWRITINGS);
    let is_word = |list: &str, word: &str| lexicon.is_word(list, word);
    for rewriting in &lexicon.rewritings {
        while let Some(meant) =
            rewriting.apply(&pieces, &lexicon.grammar, &is_word).filter(|meant| left > 0 && *meant != pieces)
        {
            (pieces, left) = (meant, left - 1);
            assumes |= rewriting.assumes;
        }
    }
    (pieces, assumes)
}

impl Search<'_> {
    /// One sentence for all of the words. It gets a subject if it has none.
    fn whole(&mut self, pieces: &[RewritingWord]) -> Option<String> {
        self.one(pieces, &[])
    }

    fn one(&mut self, pieces: &[RewritingWord], front: &[RewritingWord]) -> Option<String> {
        let without_commas: Vec<RewritingWord> =
            pieces.iter().map(|piece| RewritingWord { comma: false, ..piece.clone() }).collect();
        let who = [RewritingWord {
            text: self.who.to_lowercase(),
            shown: self.who.clone(),
            comma: false,
            counts: false,
            span: None,
        }];
        let has_commas = pieces.iter().any(|piece| piece.comma);
        for pieces in [pieces, &without_commas].into_iter().take(1 + usize::from(has_commas)) {
            // Behind a subject, a word that began the sentence has a small letter.
            let mut behind = pieces.to_vec();
            if let Some(first) =
                behind.first_mut().filter(|first| self.names.lexicon.grammar.known_word(&first.text).is_some())
            {
                first.shown = first.text.clone();
            }
            for said in [[front, pieces].concat(), [front, &who, &behind].concat()] {
                if let Some(found) = self.read(&said) {
                    return Some(found);
                }
            }
        }
        None
    }

    /// A sentence for each clause. The words before the first subject are about all of them.
    fn clauses(&mut self, pieces: &[RewritingWord]) -> Option<Vec<String>> {
        let lexicon = &self.names.lexicon;
        let joins = |piece: &RewritingWord| lexicon.is_word("joins", &piece.text);
        let breaks: Vec<usize> =
            (1..pieces.len()).filter(|at| pieces[*at].comma || joins(&pieces[*at])).chain([pieces.len()]).collect();
        let is_subject = |piece: &RewritingWord| lexicon.is_word("subjects", &piece.text);
        let subject = pieces.iter().position(is_subject).unwrap_or(0);
        let verb = pieces.get(subject + 1).cloned();
        let (mut start, mut found) = (0, Vec::new());
        while start < pieces.len() {
            if joins(&pieces[start]) {
                start += 1;
                continue;
            }
            let front = if start > subject { &pieces[..subject] } else { &[] };
            let ends: Vec<usize> = breaks.iter().rev().copied().filter(|end| *end > start).collect();
            let next = ends.into_iter().find_map(|end| {
                if start == 0 && end == pieces.len() {
                    return None;
                }
                let clause = &pieces[start..end];
                let found = self.one(clause, front).or_else(|| {
                    let verb = verb.clone().filter(|_| start > subject)?;
                    let who = RewritingWord {
                        text: self.who.to_lowercase(),
                        shown: self.who.clone(),
                        comma: false,
                        counts: false,
                        span: None,
                    };
                    self.read(&[front, &[who, verb], clause].concat())
                })?;
                Some((end, found))
            });
            // An unread clause becomes a note.
            let (end, sentence) = match next {
                Some(next) => next,
                None if lexicon.is_word("conditions", &pieces[start].text) => return None,
                None => {
                    let end = breaks.iter().copied().find(|end| *end > start).unwrap_or(pieces.len());
                    let clause = &pieces[start..end];
                    if !stands_alone(lexicon, clause) {
                        return None;
                    }
                    (end, format!("{NOTE}{}", self.as_written(clause)))
                }
            };
            found.push(sentence);
            start = end;
        }
        let is_read = found.iter().any(|sentence| !sentence.starts_with(NOTE));
        (found.len() > 1 && is_read).then_some(found)
    }

    /// The clause without rewritings.
    fn as_written(&self, clause: &[RewritingWord]) -> String {
        let span = clause.iter().filter_map(|piece| piece.span).reduce(TextSpan::to);
        let said = span.and_then(|span| self.context.text.get(span.start..span.end));
        said.map_or_else(|| sentence_of(clause), as_sentence)
    }

    /// The sentence, if it is read, if need be without words that change nothing.
    fn read(&mut self, said: &[RewritingWord]) -> Option<String> {
        self.tries = self.tries.checked_sub(1).filter(|_| self.steps < MOST_STEPS_OF_ALL)?;
        let text = sentence_of(said);
        let words = words::of_name(&text);
        let tokens = Tokens::new(&words);
        let span = span_of(&tokens.words);
        let context = Context { text: &text, ..self.context };
        let mut chart = filled_chart(self.names, &text, &tokens, true, MOST_STEPS_OF_TRY);
        let mut found = chart.readings("Statement");
        self.steps += chart.steps + STEPS_OF_WORDS;
        found.retain(|item| item.skipped.count_ones() as usize * LEAST_SHARE_KEPT <= tokens.words.len());
        found.sort_by_key(|item| item.cost);
        for item in found {
            let PhraseValue::Statement(statement) = item.value.as_ref() else { continue };
            if matches!(statement.as_ref(), SpokenStatement::Heading(_)) {
                continue;
            }
            let built = build(context, statement, span);
            let faults: Vec<_> = item.faults.iter().flat_map(|faults| faults.iter()).chain(&built.faults).collect();
            let is_open = |fault: &Diagnostic| fault.code == AMBIGUOUS_TIME;
            if let [(span, _), ..] = faults[..] {
                if !faults.iter().all(|(_, fault)| is_open(fault)) {
                    continue;
                }
                let closed = closed(&text, *span);
                self.assumes = true;
                let words = words::of_name(&closed);
                let tokens = Tokens::new(&words);
                return self.read(&pieces(self.names, &closed, &tokens));
            }
            if let Some(kept) = kept(self.names, &text, &tokens, &chart, item.skipped) {
                self.without.extend(left_out_words(self.names, &text, &tokens, item.skipped));
                return Some(kept);
            }
        }
        None
    }
}

/// Whether a clause says something of its own, or nothing that counts: without it, the others still say what they say.
fn stands_alone(lexicon: &LexiconWords, clause: &[RewritingWord]) -> bool {
    let is = |list: &str, piece: &RewritingWord| lexicon.is_word(list, &piece.text);
    let [first, rest @ ..] = clause else { return true };
    let is_denied_verb = first.text == "never" && !rest.iter().any(|piece| piece.counts);
    let is_verb = first.text.ends_with('s') && !first.counts && !is("adverbs", first) && rest.len() > 1;
    let has_subject = is("determiners", first)
        || !first.counts && first.shown.starts_with(char::is_uppercase)
        || clause.iter().take(OWN_SUBJECT).any(|piece| is("other-subjects", piece));
    let depends = clause.iter().any(|piece| piece.counts || is("conditions", piece));
    !depends || is_denied_verb || is_verb || has_subject && !is("prepositions", first)
}

/// Hours that are of the morning where a time leaves the half of the day open: mornings begin at seven (our choice).
const MORNINGS: [&str; 12] = ["7", "8", "9", "10", "11", "12", "seven", "eight", "nine", "ten", "eleven", "twelve"];

/// The sentence with one of the halves of the day behind a time that leaves it open.
fn closed(text: &str, span: TextSpan) -> String {
    let said = &text[span.start..span.end];
    let is_early = said.split_whitespace().last().is_some_and(|hour| MORNINGS.contains(&hour));
    format!(
        "{said_before} {half}{rest}",
        said_before = &text[..span.end],
        half = if is_early { "am" } else { "pm" },
        rest = &text[span.end..]
    )
}

/// A bit for each word of a person, a place outside, a day or a time.
fn important(chart: &Chart) -> u64 {
    let categories = ["OUTSIDE", "PEOPLE", "RELATIVES", "PET", "Weekday", "Month", "Clock"];
    let phrases = categories.iter().flat_map(|category| chart.phrases(category));
    phrases.flat_map(|item| item.start..item.end).fold(0, |bits, at| bits | 1 << at)
}

/// The sentence without the words left out, if it keeps who does what, when, and what is denied.
pub fn kept(names: &HomeNames, text: &str, tokens: &Tokens, chart: &Chart, skipped: u64) -> Option<String> {
    if skipped & important(chart) != 0 {
        return None;
    }
    let mut pieces = Vec::new();
    for (at, word) in tokens.words.iter().enumerate() {
        if skipped & 1 << at == 0 {
            let shown = text.get(word.span.start..word.span.end).filter(|shown| shown.to_lowercase() == word.text);
            let shown = shown.unwrap_or(&word.text).to_owned();
            pieces.push(RewritingWord {
                text: word.text.clone(),
                shown,
                comma: tokens.commas[at],
                counts: false,
                span: None,
            });
        } else if matters(names, text, &tokens.words, at) {
            return None;
        }
    }
    Some(sentence_of(&pieces))
}

/// The words left out, as far as they say something.
fn left_out_words(names: &HomeNames, text: &str, tokens: &Tokens, skipped: u64) -> Vec<String> {
    let lexicon = &names.lexicon;
    let is_out = |at: &usize| skipped & 1 << *at != 0;
    let says = |word: &SentenceWord| {
        !lexicon.grammar.is_closed(&word.text)
            && !["determiners", "prepositions", "joins"].iter().any(|list| lexicon.is_word(list, &word.text))
    };
    let (mut runs, mut at) = (Vec::new(), 0);
    while at < tokens.words.len() {
        let length = (at..tokens.words.len()).take_while(is_out).count();
        let words = &tokens.words[at..at + length];
        if words.iter().any(says) {
            let span = span_of(words);
            runs.extend(text.get(span.start..span.end).map(str::to_owned));
        }
        at += length.max(1);
    }
    runs
}

fn sentence_of(pieces: &[RewritingWord]) -> String {
    let mut text = String::new();
    for piece in pieces {
        if !text.is_empty() {
            text += if piece.comma { ", " } else { " " };
        }
        text += &piece.shown;
    }
    as_sentence(&text)
}

pub fn denies(lexicon: &LexiconWords, word: &str) -> bool {
    lexicon.is_word("denials", word) || word.ends_with("n't")
}

fn is_time(lexicon: &LexiconWords, word: &str) -> bool {
    lexicon.words_of("times").any(|time| word.contains(time))
}

/// Whether a word is a verb, a number, a time, a person or a denial.
fn matters(names: &HomeNames, text: &str, words: &[SentenceWord], at: usize) -> bool {
    let word = &words[at];
    let (said, lexicon) = (word.text.as_str(), &names.lexicon);
    let grammar = &lexicon.grammar;
    let is_capital =
        at > 0 && text.get(word.span.start..word.span.end).is_some_and(|said| said.starts_with(char::is_uppercase));
    let ends_as_verb = lexicon.words_of("verb-ends").any(|end| said.ends_with(end)) && !said.ends_with("ss");
    // Behind "her" or "of" stands a noun.
    let is_noun = at > 0 && {
        let before = words[at - 1].text.as_str();
        lexicon.is_word("determiners", before) || lexicon.is_word("prepositions", before)
    };
    // Behind "she" or "and" may stand a verb.
    let is_verb = at > 0 && {
        let before = words[at - 1].text.as_str();
        let is_open = !lexicon.is_word("determiners", said) && !lexicon.is_word("prepositions", said);
        is_open && (lexicon.is_word("subjects", before) || lexicon.is_word("joins", before))
    };
    let is_word_of_grammar =
        grammar.is_closed(said) && !lexicon.is_word("determiners", said) && !lexicon.is_word("prepositions", said);
    // Behind "to", a word that is neither a place nor a person is done for a purpose, if it is not what is done.
    let is_purpose =
        at > 0 && words[at - 1].text == "to" && !lexicon.is_word("determiners", said) && !names.is_word(said);
    word.token != Token::Word
        || is_purpose
        || lexicon.is_word("other-persons", said)
        || lexicon.is_word("months", said)
        || is_time(lexicon, said)
        || denies(lexicon, said)
        || is_capital
        || is_verb
        || ends_as_verb && !is_noun
        || is_word_of_grammar
}
