//! A sentence that is not understood in one is parted where a clause or a side remark begins, and each part is lived, kept as a
//! remark, or lets the whole be refused.
//!
//! Kept are reasons, purposes, what somebody thinks or says, what was, and what is said of others or of things; the first words
//! that tell them are lists of the lexicon. Besides what is lived, a clause of its own may be kept that is not understood, such as
//! "and won't let anyone else touch it": the user is told that it is not lived. Nothing is left out that limits the rest ("except",
//! "if", "only", "until"), that says when another part is, or that would be the whole sentence.

use super::activities;
use super::adverbs::Adverbs;
use super::calendar::is_weekday;
use super::conjunction::days_span;
use super::draft::RoutineDraft;
use super::faults::Faults;
use super::lexicon::third_person;
use super::modifiers::skim;
use super::reader::{HomeNames, SentenceReader, denies, is_determiner};
use super::set_aside::{is_beside_the_point, set_aside};
use super::shape::in_shape;
use super::single_sentence::read_alone;
use super::subjects::{self, SentenceSubject};
use super::synonym::reworded;
use super::words::{SentenceWord, TextSpan, Token};
use crate::routine::{Activity, Routine};
use std::collections::BTreeMap;

/// Largest number of parts of a sentence. A longer one is several sentences.
const MOST_PARTS: usize = 9;
/// Cost of a clause that is not understood, in clauses, and of each of its words (our choice): the fewest words are
/// left out.
const LEFT_OUT: usize = 3;
/// Smallest share of the words that are used (our choice).
const LEAST_LIVED: f64 = 0.34;
/// Largest number of attempts to read a sentence without some of its parts.
const MOST_TRIES: usize = 40;
/// Number of words above which a sentence is read literally.
const LONGEST: usize = 60;

#[derive(Default)]
pub struct SentenceParts {
    pub lived: Vec<Vec<SentenceWord>>,
    pub remarks: Vec<TextSpan>,
}

#[derive(Clone, Debug)]
enum PartKind {
    Lived(Vec<SentenceWord>, Vec<TextSpan>),
    Said,
    Beside,
    LeftOut,
}

pub fn in_parts(
    names: &HomeNames,
    draft: &RoutineDraft,
    words: &[SentenceWord],
    leaves_out: bool,
) -> Option<SentenceParts> {
    if words.len() > LONGEST {
        return None;
    }
    let (bounds, carried) = (bounds(names, words), carried(names, draft, words));
    let parting = Parting { names, draft, words, bounds, carried, leaves_out };
    if parting.bounds.len() > MOST_PARTS + 1 {
        return None;
    }
    let parts = parting.without_remarks().or_else(|| parting.one_by_one());
    parts.filter(|parts| !(leaves_out && parting.lacks_time_of_fall(parts)))
}

pub fn parts_of<'w>(names: &HomeNames, words: &'w [SentenceWord]) -> Vec<&'w [SentenceWord]> {
    let bounds = bounds(names, words);
    bounds.windows(2).map(|part| without_join(trimmed(&words[part[0]..part[1]]))).collect()
}

fn bounds(names: &HomeNames, words: &[SentenceWord]) -> Vec<usize> {
    const JOINS: &str = "and but so because since as although though whereas which who whose whom where to due owing therefore \
        however otherwise yet despite instead rather in given for";
    const WHO: [&str; 5] = ["she", "he", "they", "she's", "he's"];
    let joins = |at: usize| JOINS.split_whitespace().any(|join| join == words[at].text);
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let why_in_front = names.lexicon.list("WHY", text).is_some();
    let begins = |at: &usize| {
        let after_comma = words[*at - 1].token == Token::Comma;
        let begins_why =
            ["WHY", "MINDS"].iter().any(|list| names.lexicon.list(list, |ahead| text(at + ahead)).is_some());
        let begins_clause = joins(*at) && !["to", "in", "for", "given", "rather", "instead"].contains(&text(*at));
        let ends_why = why_in_front && *at > 2 && WHO.contains(&text(*at));
        (words[*at].token == Token::Comma || begins_clause || begins_why || ends_why) && !after_comma
    };
    let inner = (1..words.len()).filter(begins);
    std::iter::once(0).chain(inner).chain(std::iter::once(words.len())).collect()
}

struct CarriedWords {
    days: Vec<SentenceWord>,
    visitor: Vec<SentenceWord>,
}

fn carried(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> CarriedWords {
    let mut faults = Faults::of_trial();
    let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    let mut front = Adverbs::default();
    front.all(&mut reader);
    let from = reader.at;
    let is_visitor = matches!(subjects::subject(&mut reader), Some(SentenceSubject::Visitor(_)));
    let put_in = |words: &[SentenceWord]| -> Vec<SentenceWord> {
        let words = words.iter().filter(|word| word.token != Token::Comma);
        words.cloned().collect()
    };
    CarriedWords {
        days: if days_span(&front).is_some() { put_in(&words[..from]) } else { Vec::new() },
        visitor: if is_visitor { put_in(&words[from..reader.at]) } else { Vec::new() },
    }
}

struct Parting<'a> {
    names: &'a HomeNames,
    draft: &'a RoutineDraft<'a>,
    words: &'a [SentenceWord],
    bounds: Vec<usize>,
    carried: CarriedWords,
    leaves_out: bool,
}

impl Parting<'_> {
    fn without_remarks(&self) -> Option<SentenceParts> {
        let last = self.bounds.len() - 1;
        let pairs = (0..last).flat_map(|from| (from + 1..=last).map(move |to| (from, to)));
        let mut beside: Vec<(usize, usize)> = pairs
            .map(|(from, to)| (self.bounds[from], self.bounds[to]))
            .filter(|&(from, to)| self.is_beside(from, to))
            .collect();
        beside.sort_by_key(|(from, to)| (to - from, *from));
        let one = beside.iter().map(|one| vec![*one]);
        let two = beside.iter().flat_map(|first| {
            let after = beside.iter().filter(|second| first.1 <= second.0);
            after.map(|second| vec![*first, *second])
        });
        one.chain(two).take(MOST_TRIES).find_map(|left_out| {
            let is_left = |at: &usize| !left_out.iter().any(|(from, to)| (*from..*to).contains(at));
            let rest: Vec<SentenceWord> =
                (0..self.words.len()).filter(is_left).map(|at| self.words[at].clone()).collect();
            let Some(PartKind::Lived(lived, aside)) = self.understood(trimmed(&rest)) else { return None };
            let remarks = left_out.iter().map(|&(from, to)| self.span(from, to)).chain(aside).collect();
            Some(SentenceParts { lived: vec![lived], remarks })
        })
    }

    fn one_by_one(&self) -> Option<SentenceParts> {
        let last = self.bounds.len() - 1;
        let mut kinds: BTreeMap<(usize, usize), Option<PartKind>> = BTreeMap::new();
        // Of each bound, the best way to go on from there: what it costs, and where the first part ends.
        let mut best: Vec<Option<(usize, usize)>> = vec![None; last + 1];
        best[last] = Some((0, last));
        for from in (0..last).rev() {
            for to in (from + 1..=last).rev() {
                let Some((more, _)) = best[to] else { continue };
                if best[from].is_some_and(|(cost, _)| cost <= more + 1) {
                    continue;
                }
                let kind = self.kind(self.bounds[from], self.bounds[to]);
                let cost = match kind {
                    Some(PartKind::LeftOut) => LEFT_OUT + self.bounds[to] - self.bounds[from],
                    _ => 1,
                };
                if kind.is_some() && best[from].is_none_or(|(best, _)| more + cost < best) {
                    best[from] = Some((more + cost, to));
                }
                kinds.insert((from, to), kind);
            }
        }
        let (mut found, mut at, mut is_said, mut lived) = (SentenceParts::default(), 0, false, 0);
        let mut is_left_out = false;
        while at < last {
            let (_, to) = best[at]?;
            match kinds.remove(&(at, to))?? {
                PartKind::Lived(words, aside) => {
                    let then =
                        self.words[self.bounds[at]..self.bounds[to]].iter().take(3).find(|word| word.text == "then");
                    let then = then.filter(|_| !found.lived.is_empty()).cloned();
                    let then = then.or_else(|| self.goes_on(at, &found).then(|| word_of("then", &words[0])));
                    lived += self.bounds[to] - self.bounds[at];
                    found.lived.push(then.into_iter().chain(words).collect());
                    found.remarks.extend(aside);
                }
                kind => {
                    is_said |= matches!(kind, PartKind::Said);
                    is_left_out |= matches!(kind, PartKind::LeftOut);
                    found.remarks.push(self.span(self.bounds[at], self.bounds[to]));
                }
            }
            at = to;
        }
        // "She reads and naps or knits" leaves open what goes with what.
        let is_open = found.lived.len() > 1 && self.words.iter().any(|word| word.text == "or");
        (is_said && !is_left_out || !found.lived.is_empty() && !is_open).then_some(())?;
        (!is_left_out || lived as f64 >= LEAST_LIVED * self.words.len() as f64).then_some(())?;
        self.are_of_one_time(&found.lived).then_some(found)
    }

    fn lacks_time_of_fall(&self, parts: &SentenceParts) -> bool {
        let falls = |words: &Vec<SentenceWord>| {
            let routine = read_alone(self.names, self.draft, self.draft.text, words).unwrap_or_default();
            routine.habits.iter().any(|habit| matches!(habit.activity, Activity::Fall | Activity::Stumble))
        };
        let says_time = |span: &TextSpan| {
            let within = |word: &&SentenceWord| span.start <= word.span.start && word.span.end <= span.end;
            !self.says_no_time(&self.words.iter().filter(within).cloned().collect::<Vec<_>>())
        };
        parts.remarks.iter().any(says_time) && parts.lived.iter().any(falls)
    }

    /// "Wakes at 3, makes toast": what has no time of its own, and nobody else who does it, is done then.
    fn goes_on(&self, at: usize, found: &SentenceParts) -> bool {
        let part = without_join(trimmed(&self.words[self.bounds[at]..self.bounds[at + 1]]));
        let begins_verb = part.first().is_some_and(|first| self.names.lexicon.is_third_person(&first.text));
        at > 0 && !found.lived.is_empty() && begins_verb && self.says_no_more_time(part)
    }

    fn kind(&self, from: usize, to: usize) -> Option<PartKind> {
        if self.is_beside(from, to) {
            return Some(PartKind::Beside);
        }
        let part = trimmed(&self.words[from..to]);
        let words = if from == 0 { part } else { without_join(part) };
        let is_fragment = ["and", "or"].contains(&self.words[from].text.as_str())
            && words.first().is_some_and(|first| is_determiner(&first.text))
            && !words.iter().any(|word| self.is_verb(&word.text));
        if is_fragment && !self.follows_what_is_lived(from) {
            return None;
        }
        if let Some(kind) = self.understood(words) {
            return Some(kind);
        }
        let carried = if from == 0 { Vec::new() } else { self.with_carried(words) };
        if !carried.is_empty()
            && let Some(kind) = self.understood(&carried)
        {
            return Some(kind);
        }
        if self.is_past(words) || self.is_of_others(from, to) {
            return Some(PartKind::Beside);
        }
        (self.leaves_out && from > 0 && self.may_be_left_out(words)).then_some(PartKind::LeftOut)
    }

    fn follows_what_is_lived(&self, at: usize) -> bool {
        let before = self.bounds.iter().rev().find(|bound| **bound < at).copied().unwrap_or(0);
        matches!(self.understood(without_join(trimmed(&self.words[before..at]))), Some(PartKind::Lived(..)))
    }

    fn understood(&self, words: &[SentenceWord]) -> Option<PartKind> {
        if words.len() < 2 {
            return None;
        }
        let (said, shaped) = in_shape(self.names, self.draft, words);
        let Some(routine) = read_alone(self.names, self.draft, self.draft.text, &shaped) else {
            if let Some(aside) = set_aside(self.names, self.draft, &said) {
                return Some(PartKind::Lived(reworded(self.names, self.draft.text, &aside.words), aside.left_out));
            }
            let aside = skim(self.names, self.draft, &said)?;
            return Some(PartKind::Lived(aside.words, aside.left_out));
        };
        if is_something(&routine) {
            return Some(PartKind::Lived(shaped, Vec::new()));
        }
        (!routine.remarks.is_empty()).then_some(PartKind::Said)
    }

    fn with_carried(&self, words: &[SentenceWord]) -> Vec<SentenceWord> {
        let Some(first) = words.first() else { return Vec::new() };
        let lexicon = &self.names.lexicon;
        let begins_verb = lexicon.is_third_person(&first.text);
        // "I wake at five, make tea".
        let writes = self.words.iter().find(|word| word.text == "i");
        if let Some(writes) = writes.filter(|_| !begins_verb && lexicon.is_third_person(&third_person(&first.text))) {
            return [std::slice::from_ref(writes), words].concat();
        }
        let visitor: &[SentenceWord] = if begins_verb { &self.carried.visitor } else { &[] };
        [&self.carried.days, visitor, words].concat()
    }

    fn are_of_one_time(&self, lived: &[Vec<SentenceWord>]) -> bool {
        let says_days = |words: &Vec<SentenceWord>| {
            let words = match words.first() {
                Some(first) if first.text == "then" => &words[1..],
                _ => &words[..],
            };
            let routine = read_alone(self.names, self.draft, self.draft.text, words).unwrap_or_default();
            routine.habits.iter().all(|habit| habit.when.days != crate::routine::DaySelection::ALL)
        };
        lived.len() < 2 || lived.iter().all(says_days) || !lived.iter().any(says_days)
    }

    fn is_beside(&self, from: usize, to: usize) -> bool {
        let part = trimmed(&self.words[from..to]);
        let text = |at: usize| part.get(at).map_or("", |word| word.text.as_str());
        let lexicon = &self.names.lexicon;
        let (why, mind) = (lexicon.list("WHY", text), lexicon.list("MINDS", text));
        if why.is_some() || mind.is_some() {
            let is_whole = mind.is_some() || why.is_some_and(|length| part.len() > length);
            return is_whole && !self.holds_clause(from, to) && !self.is_when(part);
        }
        if from > 0 && text(0) == "where" {
            return self.says_no_time(part);
        }
        from > 0 && ["which", "who", "whose", "whom"].contains(&text(0)) && self.is_plain(from, to)
    }

    /// "since March", "as she gets up": from when on, or when.
    fn is_when(&self, part: &[SentenceWord]) -> bool {
        let mut faults = Faults::of_trial();
        let (names, text) = (self.names, self.draft.text);
        let mut reader = SentenceReader { words: part, at: 0, names, faults: &mut faults, text, part: None };
        let goes_with =
            |reader: &mut SentenceReader| reader.eat("as she|he|they") && activities::activity(reader).is_some();
        reader.ahead(goes_with) || Adverbs::default().next(&mut reader)
    }

    fn holds_clause(&self, from: usize, to: usize) -> bool {
        const BEFORE: [&str; 12] =
            ["she", "he", "they", "then", "just", "now", "also", "often", "usually", "sometimes", "always", "rarely"];
        (from + 2..to).any(|at| {
            let is_joined = ["and", "but", "so", "then"].contains(&self.words[at - 1].text.as_str())
                || self.words[at - 1].token == Token::Comma;
            let mut rest = self.words[at..to].iter().skip_while(|word| BEFORE.contains(&word.text.as_str()));
            let begins_verb = rest.next().is_some_and(|word| self.names.lexicon.is_third_person(&word.text));
            let begins_who = from == 0 && at > 2 && ["she", "he", "they"].contains(&self.words[at].text.as_str());
            begins_who
                || is_joined
                    && (begins_verb
                        || !self.says_no_time(&self.words[at..to])
                        || matches!(self.understood(trimmed(&self.words[at..to])), Some(PartKind::Lived(..))))
        })
    }

    fn is_past(&self, words: &[SentenceWord]) -> bool {
        let mut faults = Faults::of_trial();
        let (names, text) = (self.names, self.draft.text);
        let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text, part: None };
        if subjects::subject(&mut reader).is_none() {
            return false;
        }
        while reader.eat("also|still|always|never|once|already|only|just") {}
        let verb = reader.peek(0);
        ["was", "were", "had", "did"].contains(&verb) || names.lexicon.verb_of_past(verb).is_some() && verb != "put"
    }

    fn is_of_others(&self, from: usize, to: usize) -> bool {
        let words = without_join(trimmed(&self.words[from..to]));
        let Some(first) = words.first() else { return false };
        let has_last = |list: &str, word: &SentenceWord| self.names.lexicon.has_last(list, &word.text);
        let is_thing = is_determiner(&first.text)
            && words.len() > 3
            && !words.iter().take(3).any(|word| has_last("PEOPLE", word) || has_last("RELATIVES", word));
        let is_aid = words.iter().take(3).any(|word| has_last("AIDS", word) || has_last("EQUIPMENT", word));
        is_thing && self.is_plain(from, to) || (is_aid || has_last("OTHERS", first)) && self.says_no_time(words)
    }

    fn may_be_left_out(&self, words: &[SentenceWord]) -> bool {
        const LIMITS: [&str; 14] = [
            "except",
            "unless",
            "if",
            "only",
            "instead",
            "rather",
            "until",
            "till",
            "when",
            "whenever",
            "without",
            "apart",
            "excluding",
            "or",
        ];
        const LEAST: usize = 3;
        // "Carer only does the stockings" limits what the carer does.
        let is_other = words.first().is_some_and(|first| {
            ["PEOPLE", "RELATIVES"].iter().any(|list| self.names.lexicon.has_last(list, &first.text))
        });
        let limits = |word: &SentenceWord| LIMITS.contains(&word.text.as_str()) && !(is_other && word.text == "only");
        let is_bare = |word: &SentenceWord| word.token == Token::Word;
        let denies_bare = |word: &SentenceWord| denies(&word.text) && !word.text.ends_with("n't");
        if words.len() < LEAST || words.iter().any(limits) || words.first().is_some_and(denies_bare) {
            return false;
        }
        // "Twice a day, usually in the morning" is said of what stands before it.
        const SAID_MORE: [&str; 14] = [
            "once",
            "usually",
            "mostly",
            "generally",
            "normally",
            "typically",
            "sometimes",
            "perhaps",
            "maybe",
            "round",
            "at",
            "say",
            "especially",
            "particularly",
        ];
        let is_clock = |word: &SentenceWord| !matches!(word.token, Token::Word | Token::Comma);
        let says_more =
            words.first().is_some_and(|first| SAID_MORE.contains(&first.text.as_str())) && !words.iter().any(is_clock);
        let denies_something = words.iter().any(|word| denies(&word.text) || word.text.ends_with("n't"));
        // "Then does not eat" is something that could be lived.
        const DONE: [&str; 12] =
            ["eat", "drink", "sleep", "go", "get", "wash", "bathe", "dress", "take", "leave", "cook", "read"];
        let denies_a_deed = words.windows(2).any(|pair| {
            (denies(&pair[0].text) || pair[0].text.ends_with("n't")) && DONE.contains(&pair[1].text.as_str())
        });
        if denies_a_deed {
            return false;
        }
        let tells_when = !self.says_no_time(words);
        let holds_verb = words.iter().any(|word| is_bare(word) && self.is_verb(&word.text));
        !(tells_when && denies_something) && (holds_verb || says_more || !tells_when)
    }

    fn is_verb(&self, word: &str) -> bool {
        const BE: [&str; 18] = [
            "is", "are", "was", "were", "has", "have", "had", "does", "do", "did", "will", "would", "can", "could",
            "may", "might", "must", "should",
        ];
        BE.contains(&word) || self.names.lexicon.is_third_person(word) || word.ends_with("'s") || word.ends_with("'ll")
    }

    fn says_no_time(&self, words: &[SentenceWord]) -> bool {
        let mut faults = Faults::of_trial();
        let (names, text) = (self.names, self.draft.text);
        let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text, part: None };
        while !reader.is_over() {
            let is_when = reader.token(0) != Some(Token::Word) && reader.token(0) != Some(Token::Comma)
                || reader.ahead(|reader| Adverbs::default().next(reader))
                || is_weekday(reader.peek(0))
                || reader.ahead(|reader| reader.eat("she|he|they") && activities::activity(reader).is_some())
                || reader.ahead(|reader| reader.eat("her|him|them|mum|dad") && activities::activity(reader).is_some());
            if is_when {
                return false;
            }
            reader.at += 1;
        }
        true
    }

    fn says_no_more_time(&self, words: &[SentenceWord]) -> bool {
        let mut faults = Faults::of_trial();
        let (names, text) = (self.names, self.draft.text);
        let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text, part: None };
        while !reader.is_over() {
            if reader.ahead(|reader| Adverbs::default().next(reader)) || is_weekday(reader.peek(0)) {
                return false;
            }
            reader.at += 1;
        }
        true
    }

    fn is_plain(&self, from: usize, to: usize) -> bool {
        let joins = |at: usize| ["and", "but", "so"].contains(&self.words[at].text.as_str());
        let start = (from..to).find(|&at| self.words[at].token != Token::Comma && !joins(at)).unwrap_or(to);
        start < to && is_beside_the_point(self.names, self.draft, self.words, start, to)
    }

    fn span(&self, from: usize, to: usize) -> TextSpan {
        let part = trimmed(&self.words[from..to]);
        match (part.first(), part.last()) {
            (Some(first), Some(last)) => first.span.to(last.span),
            _ => TextSpan::default(),
        }
    }
}

fn word_of(text: &str, at: &SentenceWord) -> SentenceWord {
    SentenceWord { text: text.to_owned(), token: Token::Word, ..at.clone() }
}

pub fn attitude(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> Option<SentenceParts> {
    let mut faults = Faults::of_trial();
    let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    match subjects::subject(&mut reader) {
        Some(SentenceSubject::Person) | None => {}
        Some(_) => return None,
    }
    while reader.eat("also|still|always|only|ever|really|strongly|just|never|very|much|often|usually") {}
    if reader.ahead(|reader| activities::activity(reader).is_some()) {
        return None;
    }
    // "She is busy" may be anything.
    const LEAST: usize = 5;
    names.lexicon.list("ATTITUDES", |ahead| reader.peek(ahead)).filter(|_| words.len() >= LEAST)?;
    let is_when = |word: &SentenceWord| {
        !matches!(word.token, Token::Word | Token::Comma) || is_weekday(&word.text) || Adverbs::is_part(&word.text)
    };
    (!words.iter().any(is_when)).then(|| SentenceParts {
        lived: Vec::new(),
        remarks: vec![words.first().map_or(TextSpan::default(), |first| first.span.to(words[words.len() - 1].span))],
    })
}

fn is_something(routine: &Routine) -> bool {
    !(routine.habits.is_empty() && routine.changes.is_empty() && routine.rules.is_empty() && routine.person.is_none())
}

fn trimmed(words: &[SentenceWord]) -> &[SentenceWord] {
    let is_sign = |word: &SentenceWord| word.token == Token::Comma;
    let from = words.iter().position(|word| !is_sign(word)).unwrap_or(words.len());
    let to = words.iter().rposition(|word| !is_sign(word)).map_or(from, |last| last + 1);
    &words[from..to]
}

fn without_join(words: &[SentenceWord]) -> &[SentenceWord] {
    const JOINS: [&str; 12] =
        ["just", "and", "but", "so", "then", "yet", "although", "though", "whereas", "however", "therefore", "also"];
    let joins = |word: &SentenceWord| JOINS.contains(&word.text.as_str()) || word.token == Token::Comma;
    &words[words.iter().position(|word| !joins(word)).unwrap_or(words.len())..]
}
