//! A sentence that is not understood in one is parted where a clause or a side remark begins, and each part is lived, kept as a
//! remark, or lets the whole be refused.
//!
//! Kept are reasons, purposes, what somebody thinks or says, what was, and what is said of others or of things; the first words
//! that tell them are lists of the lexicon. Besides what is lived, a clause of its own may be kept that is not understood, such as
//! "and won't let anyone else touch it": the user is told that it is not lived. Nothing is left out that limits the rest ("except",
//! "if", "only", "until"), that says when another part is, or that would be the whole sentence.

use super::activities;
use super::adverbs::Adverbs;
use super::alone::read_alone;
use super::aside::{is_beside_the_point, set_aside};
use super::calendar::is_weekday;
use super::draft::Draft;
use super::faults::Faults;
use super::joined::days_span;
use super::lexicon::third_person;
use super::reader::{Names, Reader, denies, is_determiner};
use super::rewording::reworded;
use super::shape::in_shape;
use super::skim::skim;
use super::subjects::{self, Subject};
use super::words::{Span, Token, Word};
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

/// What a sentence comes to: sentences that are lived, and what is kept beside them.
#[derive(Default)]
pub struct Parts {
    pub lived: Vec<Vec<Word>>,
    pub remarks: Vec<Span>,
}

/// What a part is.
#[derive(Clone, Debug)]
enum Kind {
    Lived(Vec<Word>, Vec<Span>),
    /// Understood as a remark by itself.
    Said,
    /// A remark on what stands beside it.
    Beside,
    /// A clause of its own that is not understood.
    LeftOut,
}

/// Parts a sentence, if something of it is understood and all else is surely a remark.
/// Whether clauses may be left out, `leaves_out` says.
pub fn in_parts(names: &Names, draft: &Draft, words: &[Word], leaves_out: bool) -> Option<Parts> {
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

/// The parts of a sentence, without what joins them.
pub fn parts_of<'w>(names: &Names, words: &'w [Word]) -> Vec<&'w [Word]> {
    let bounds = bounds(names, words);
    bounds.windows(2).map(|part| without_join(trimmed(&words[part[0]..part[1]]))).collect()
}

/// Where parts begin, and the end.
fn bounds(names: &Names, words: &[Word]) -> Vec<usize> {
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

/// What later parts take over from the beginning: on which days, and who, where that is a visitor.
struct Carried {
    days: Vec<Word>,
    visitor: Vec<Word>,
}

fn carried(names: &Names, draft: &Draft, words: &[Word]) -> Carried {
    let mut faults = Faults::of_trial();
    let mut reader = Reader { words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    let mut front = Adverbs::default();
    front.all(&mut reader);
    let from = reader.at;
    let is_visitor = matches!(subjects::subject(&mut reader), Some(Subject::Visitor(_)));
    let put_in = |words: &[Word]| -> Vec<Word> {
        let words = words.iter().filter(|word| word.token != Token::Comma);
        words.cloned().collect()
    };
    Carried {
        days: if days_span(&front).is_some() { put_in(&words[..from]) } else { Vec::new() },
        visitor: if is_visitor { put_in(&words[from..reader.at]) } else { Vec::new() },
    }
}

struct Parting<'a> {
    names: &'a Names,
    draft: &'a Draft<'a>,
    words: &'a [Word],
    bounds: Vec<usize>,
    carried: Carried,
    leaves_out: bool,
}

impl Parting<'_> {
    /// The sentence read in one, without one or two parts that are remarks.
    fn without_remarks(&self) -> Option<Parts> {
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
            let rest: Vec<Word> = (0..self.words.len()).filter(is_left).map(|at| self.words[at].clone()).collect();
            let Some(Kind::Lived(lived, aside)) = self.understood(trimmed(&rest)) else { return None };
            let remarks = left_out.iter().map(|&(from, to)| self.span(from, to)).chain(aside).collect();
            Some(Parts { lived: vec![lived], remarks })
        })
    }

    /// Part for part, from the beginning: as few as possible.
    fn one_by_one(&self) -> Option<Parts> {
        let last = self.bounds.len() - 1;
        let mut kinds: BTreeMap<(usize, usize), Option<Kind>> = BTreeMap::new();
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
                    Some(Kind::LeftOut) => LEFT_OUT + self.bounds[to] - self.bounds[from],
                    _ => 1,
                };
                if kind.is_some() && best[from].is_none_or(|(best, _)| more + cost < best) {
                    best[from] = Some((more + cost, to));
                }
                kinds.insert((from, to), kind);
            }
        }
        let (mut found, mut at, mut is_said, mut lived) = (Parts::default(), 0, false, 0);
        let mut is_left_out = false;
        while at < last {
            let (_, to) = best[at]?;
            match kinds.remove(&(at, to))?? {
                Kind::Lived(words, aside) => {
                    let then =
                        self.words[self.bounds[at]..self.bounds[to]].iter().take(3).find(|word| word.text == "then");
                    let then = then.filter(|_| !found.lived.is_empty()).cloned();
                    let then = then.or_else(|| self.goes_on(at, &found).then(|| word_of("then", &words[0])));
                    lived += self.bounds[to] - self.bounds[at];
                    found.lived.push(then.into_iter().chain(words).collect());
                    found.remarks.extend(aside);
                }
                kind => {
                    is_said |= matches!(kind, Kind::Said);
                    is_left_out |= matches!(kind, Kind::LeftOut);
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

    /// Whether what is left out says when, or how often, beside a fall: that one is lived as it is said, or not at all.
    fn lacks_time_of_fall(&self, parts: &Parts) -> bool {
        let falls = |words: &Vec<Word>| {
            let routine = read_alone(self.names, self.draft, self.draft.text, words).unwrap_or_default();
            routine.habits.iter().any(|habit| matches!(habit.activity, Activity::Fall | Activity::Stumble))
        };
        let says_time = |span: &Span| {
            let within = |word: &&Word| span.start <= word.span.start && word.span.end <= span.end;
            !self.says_no_time(&self.words.iter().filter(within).cloned().collect::<Vec<_>>())
        };
        parts.remarks.iter().any(says_time) && parts.lived.iter().any(falls)
    }

    /// "Wakes at 3, makes toast": what has no time of its own, and nobody else who does it, is done then.
    fn goes_on(&self, at: usize, found: &Parts) -> bool {
        let part = without_join(trimmed(&self.words[self.bounds[at]..self.bounds[at + 1]]));
        let begins_verb = part.first().is_some_and(|first| self.names.lexicon.is_third_person(&first.text));
        at > 0 && !found.lived.is_empty() && begins_verb && self.says_no_more_time(part)
    }

    /// What the words between two bounds are, if that is sure.
    fn kind(&self, from: usize, to: usize) -> Option<Kind> {
        if self.is_beside(from, to) {
            return Some(Kind::Beside);
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
            return Some(Kind::Beside);
        }
        (self.leaves_out && from > 0 && self.may_be_left_out(words)).then_some(Kind::LeftOut)
    }

    /// Whether the part that ends there is lived by itself.
    fn follows_what_is_lived(&self, at: usize) -> bool {
        let before = self.bounds.iter().rev().find(|bound| **bound < at).copied().unwrap_or(0);
        matches!(self.understood(without_join(trimmed(&self.words[before..at]))), Some(Kind::Lived(..)))
    }

    fn understood(&self, words: &[Word]) -> Option<Kind> {
        if words.len() < 2 {
            return None;
        }
        let (said, shaped) = in_shape(self.names, self.draft, words);
        let Some(routine) = read_alone(self.names, self.draft, self.draft.text, &shaped) else {
            if let Some(aside) = set_aside(self.names, self.draft, &said) {
                return Some(Kind::Lived(reworded(self.names, self.draft.text, &aside.words), aside.left_out));
            }
            let aside = skim(self.names, self.draft, &said)?;
            return Some(Kind::Lived(aside.words, aside.left_out));
        };
        if is_something(&routine) {
            return Some(Kind::Lived(shaped, Vec::new()));
        }
        (!routine.remarks.is_empty()).then_some(Kind::Said)
    }

    /// A later part with the days and the visitor of the first.
    fn with_carried(&self, words: &[Word]) -> Vec<Word> {
        let Some(first) = words.first() else { return Vec::new() };
        let lexicon = &self.names.lexicon;
        let begins_verb = lexicon.is_third_person(&first.text);
        // "I wake at five, make tea".
        let writes = self.words.iter().find(|word| word.text == "i");
        if let Some(writes) = writes.filter(|_| !begins_verb && lexicon.is_third_person(&third_person(&first.text))) {
            return [std::slice::from_ref(writes), words].concat();
        }
        let visitor: &[Word] = if begins_verb { &self.carried.visitor } else { &[] };
        [&self.carried.days, visitor, words].concat()
    }

    /// Whether no part leaves open whether the days of another are its own, too.
    fn are_of_one_time(&self, lived: &[Vec<Word>]) -> bool {
        let says_days = |words: &Vec<Word>| {
            let words = match words.first() {
                Some(first) if first.text == "then" => &words[1..],
                _ => &words[..],
            };
            let routine = read_alone(self.names, self.draft, self.draft.text, words).unwrap_or_default();
            routine.habits.iter().all(|habit| habit.days != crate::routine::Days::ALL)
        };
        lived.len() < 2 || lived.iter().all(says_days) || !lived.iter().any(says_days)
    }

    /// A reason, a purpose, what somebody thinks, or what changes nothing of what is done.
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
    fn is_when(&self, part: &[Word]) -> bool {
        let mut faults = Faults::of_trial();
        let (names, text) = (self.names, self.draft.text);
        let mut reader = Reader { words: part, at: 0, names, faults: &mut faults, text, part: None };
        let goes_with = |reader: &mut Reader| reader.eat("as she|he|they") && activities::activity(reader).is_some();
        reader.ahead(goes_with) || Adverbs::default().next(&mut reader)
    }

    /// Whether something else begins within, that is done and not the reason for it.
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
                        || matches!(self.understood(trimmed(&self.words[at..to])), Some(Kind::Lived(..))))
        })
    }

    /// What was: "but he gave that up when his hip went".
    fn is_past(&self, words: &[Word]) -> bool {
        let mut faults = Faults::of_trial();
        let (names, text) = (self.names, self.draft.text);
        let mut reader = Reader { words, at: 0, names, faults: &mut faults, text, part: None };
        if subjects::subject(&mut reader).is_none() {
            return false;
        }
        while reader.eat("also|still|always|never|once|already|only|just") {}
        let verb = reader.peek(0);
        ["was", "were", "had", "did"].contains(&verb) || names.lexicon.verb_of_past(verb).is_some() && verb != "put"
    }

    /// What is said of things and of others, "nothing would make her miss it", "the buttons make her cry".
    fn is_of_others(&self, from: usize, to: usize) -> bool {
        let words = without_join(trimmed(&self.words[from..to]));
        let Some(first) = words.first() else { return false };
        let has_last = |list: &str, word: &Word| self.names.lexicon.has_last(list, &word.text);
        let is_thing = is_determiner(&first.text)
            && words.len() > 3
            && !words.iter().take(3).any(|word| has_last("PEOPLE", word) || has_last("RELATIVES", word));
        let is_aid = words.iter().take(3).any(|word| has_last("AIDS", word) || has_last("EQUIPMENT", word));
        is_thing && self.is_plain(from, to) || (is_aid || has_last("OTHERS", first)) && self.says_no_time(words)
    }

    /// Whether these words are a clause of their own that limits nothing.
    fn may_be_left_out(&self, words: &[Word]) -> bool {
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
        let limits = |word: &Word| LIMITS.contains(&word.text.as_str()) && !(is_other && word.text == "only");
        let is_bare = |word: &Word| word.token == Token::Word;
        let denies_bare = |word: &Word| denies(&word.text) && !word.text.ends_with("n't");
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
        let is_clock = |word: &Word| !matches!(word.token, Token::Word | Token::Comma);
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

    /// Whether no word of these says when, how often or how many, and the person does nothing in them.
    fn says_no_time(&self, words: &[Word]) -> bool {
        let mut faults = Faults::of_trial();
        let (names, text) = (self.names, self.draft.text);
        let mut reader = Reader { words, at: 0, names, faults: &mut faults, text, part: None };
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

    /// Whether none of these words says when or how often.
    fn says_no_more_time(&self, words: &[Word]) -> bool {
        let mut faults = Faults::of_trial();
        let (names, text) = (self.names, self.draft.text);
        let mut reader = Reader { words, at: 0, names, faults: &mut faults, text, part: None };
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

    fn span(&self, from: usize, to: usize) -> Span {
        let part = trimmed(&self.words[from..to]);
        match (part.first(), part.last()) {
            (Some(first), Some(last)) => first.span.to(last.span),
            _ => Span::default(),
        }
    }
}

/// A word that is put in where another stands.
fn word_of(text: &str, at: &Word) -> Word {
    Word { text: text.to_owned(), token: Token::Word, ..at.clone() }
}

/// A sentence of which nothing can be lived, that says what somebody thinks, can do or needs, and no time: a remark as a whole.
pub fn attitude(names: &Names, draft: &Draft, words: &[Word]) -> Option<Parts> {
    let mut faults = Faults::of_trial();
    let mut reader = Reader { words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    match subjects::subject(&mut reader) {
        Some(Subject::Person) | None => {}
        Some(_) => return None,
    }
    while reader.eat("also|still|always|only|ever|really|strongly|just|never|very|much|often|usually") {}
    if reader.ahead(|reader| activities::activity(reader).is_some()) {
        return None;
    }
    // "She is busy" may be anything.
    const LEAST: usize = 5;
    names.lexicon.list("ATTITUDES", |ahead| reader.peek(ahead)).filter(|_| words.len() >= LEAST)?;
    let is_when = |word: &Word| {
        !matches!(word.token, Token::Word | Token::Comma) || is_weekday(&word.text) || Adverbs::is_part(&word.text)
    };
    (!words.iter().any(is_when)).then(|| Parts {
        lived: Vec::new(),
        remarks: vec![words.first().map_or(Span::default(), |first| first.span.to(words[words.len() - 1].span))],
    })
}

/// Whether a routine says more than remarks.
fn is_something(routine: &Routine) -> bool {
    !(routine.habits.is_empty() && routine.changes.is_empty() && routine.rules.is_empty() && routine.person.is_none())
}

/// Words without the signs around them.
fn trimmed(words: &[Word]) -> &[Word] {
    let is_sign = |word: &Word| word.token == Token::Comma;
    let from = words.iter().position(|word| !is_sign(word)).unwrap_or(words.len());
    let to = words.iter().rposition(|word| !is_sign(word)).map_or(from, |last| last + 1);
    &words[from..to]
}

/// A clause without what joins it with the one before.
fn without_join(words: &[Word]) -> &[Word] {
    const JOINS: [&str; 12] =
        ["just", "and", "but", "so", "then", "yet", "although", "though", "whereas", "however", "therefore", "also"];
    let joins = |word: &Word| JOINS.contains(&word.text.as_str()) || word.token == Token::Comma;
    &words[words.iter().position(|word| !joins(word)).unwrap_or(words.len())..]
}
