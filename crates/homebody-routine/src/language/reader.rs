//! Goes through the words of a sentence, and knows which names it may meet.

use super::faults::Faults;
use super::known_names::KnownNames;
use super::lexicon::Lexicon;
use super::words::{self, SentenceWord, TextSpan, Token};
use crate::routine::PartOfDay;
use homebody_core::problem::Diagnostic;
use std::collections::BTreeMap;

const DETERMINERS: [&str; 10] = ["a", "an", "the", "her", "his", "their", "its", "some", "my", "own"];

pub fn is_determiner(word: &str) -> bool {
    DETERMINERS.contains(&word)
}

const DENIALS: [&str; 17] = [
    "not", "no", "never", "cannot", "hardly", "barely", "scarcely", "nor", "neither", "only", "unless", "except",
    "without", "refuses", "stops", "if", "when",
];

pub fn denies(word: &str) -> bool {
    DENIALS.contains(&word) || word.ends_with("n't")
}

const BEGINNINGS: [&str; 54] = [
    "in",
    "into",
    "on",
    "at",
    "by",
    "near",
    "beside",
    "to",
    "from",
    "until",
    "till",
    "over",
    "for",
    "after",
    "before",
    "with",
    "between",
    "during",
    "then",
    "about",
    "around",
    "every",
    "each",
    "once",
    "twice",
    "half",
    "almost",
    "nearly",
    "always",
    "never",
    "often",
    "usually",
    "sometimes",
    "rarely",
    "seldom",
    "most",
    "some",
    "several",
    "give",
    "plus",
    "fading",
    "daily",
    "now",
    "occasionally",
    "frequently",
    "and",
    "but",
    "while",
    "or",
    "has",
    "have",
    "is",
    "are",
    "been",
];

pub fn is_beginning(word: &str) -> bool {
    BEGINNINGS.contains(&word)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sort {
    Place,
    Thing,
    Room,
    Condition,
}

#[derive(Debug, Default)]
pub struct HomeNames {
    pub person: Option<String>,
    person_words: Vec<String>,
    pub lexicon: Lexicon,
    names: BTreeMap<String, Vec<(Vec<String>, Sort, String)>>,
}

impl HomeNames {
    pub fn new(known: &KnownNames) -> HomeNames {
        let mut names = HomeNames { lexicon: known.lexicon.clone(), ..HomeNames::default() };
        names.is_about(known.person.as_deref());
        let sorts = [
            (&known.places, Sort::Place),
            (&known.rooms, Sort::Room),
            (&known.things, Sort::Thing),
            (&known.conditions, Sort::Condition),
        ];
        for (list, sort) in sorts {
            for name in list {
                let words = name_words(name);
                if let Some(first) = words.first() {
                    names.names.entry(first.clone()).or_default().push((words, sort, name.clone()));
                }
            }
        }
        names
    }

    pub fn is_about(&mut self, person: Option<&str>) {
        self.person = person.map(str::to_owned);
        self.person_words = person.map(name_words).unwrap_or_default();
    }

    pub fn has(&self, name: &str, sort: Sort) -> bool {
        self.of(&[sort]).any(|known| known.to_lowercase() == name)
    }

    pub fn has_first(&self, word: &str) -> bool {
        self.names.contains_key(word)
    }

    pub fn of<'a>(&'a self, sorts: &'a [Sort]) -> impl Iterator<Item = &'a str> + Clone {
        let all = self.names.values().flatten();
        all.filter(|(_, sort, _)| sorts.contains(sort)).map(|(_, _, name)| name.as_str())
    }
}

fn name_words(name: &str) -> Vec<String> {
    let words = words::of_name(name).into_iter().filter(|word| word.token != Token::Comma);
    words.map(|word| word.text).skip_while(|word| is_determiner(word)).collect()
}

pub struct SentenceReader<'a> {
    pub words: &'a [SentenceWord],
    pub at: usize,
    pub names: &'a HomeNames,
    pub faults: &'a mut Faults,
    pub text: &'a str,
    pub part: Option<PartOfDay>,
}

impl SentenceReader<'_> {
    pub fn peek(&self, ahead: usize) -> &str {
        self.words.get(self.at + ahead).map_or("", |word| &word.text)
    }

    pub fn token(&self, ahead: usize) -> Option<Token> {
        self.words.get(self.at + ahead).map(|word| word.token)
    }

    pub fn is_over(&self) -> bool {
        self.at >= self.words.len()
    }

    pub fn skip_commas(&mut self) {
        while self.token(0) == Some(Token::Comma) {
            self.at += 1;
        }
    }

    pub fn skip_determiners(&mut self) {
        while is_determiner(self.peek(0)) {
            self.at += 1;
        }
    }

    pub fn eat(&mut self, phrase: &str) -> bool {
        let mut ahead = 0;
        // Bytes part faster than characters, and most phrases do not come next.
        for wanted in phrase.as_bytes().split(|&byte| byte == b' ') {
            let word = self.peek(ahead).as_bytes();
            if !wanted.split(|&byte| byte == b'|').any(|wanted| wanted == word) {
                return false;
            }
            ahead += 1;
        }
        self.at += ahead;
        true
    }

    pub fn eat_any<T: Copy>(&mut self, phrases: &[(&str, T)]) -> Option<T> {
        phrases.iter().find(|(phrase, _)| self.eat(phrase)).map(|(_, value)| *value)
    }

    pub fn span(&self, from: usize) -> TextSpan {
        let last = self.at.saturating_sub(1).max(from).min(self.words.len().saturating_sub(1));
        match (self.words.get(from.min(last)), self.words.get(last)) {
            (Some(first), Some(last)) => first.span.to(last.span),
            _ => TextSpan::default(),
        }
    }

    pub fn here(&self) -> TextSpan {
        self.words.get(self.at).or(self.words.last()).map_or(TextSpan::default(), |word| word.span)
    }

    pub fn passed(&self, from: usize) -> String {
        let words = self.words.get(from..self.at.min(self.words.len())).unwrap_or_default();
        words.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ")
    }

    pub fn said(&self, span: TextSpan) -> String {
        const LONGEST: usize = 60;
        let said = self.text.get(span.start..span.end).unwrap_or_default();
        let said: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
        if said.chars().count() <= LONGEST { said } else { said.chars().take(LONGEST).chain(['.', '.', '.']).collect() }
    }

    pub fn fault(&mut self, span: TextSpan, message: impl Into<Diagnostic>) {
        self.faults.add(span, message);
    }

    pub fn attempt<T>(&mut self, what: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        let (at, faults) = (self.at, self.faults.count());
        let result = what(self);
        if result.is_none() {
            self.at = at;
            self.faults.forget_since(faults);
        }
        result
    }

    pub fn ahead<T>(&mut self, what: impl FnOnce(&mut Self) -> T) -> T {
        let (at, faults) = (self.at, self.faults.count());
        let is_trial = std::mem::replace(&mut self.faults.is_trial, true);
        let result = what(self);
        self.faults.is_trial = is_trial;
        self.at = at;
        self.faults.forget_since(faults);
        result
    }

    pub fn name(&mut self, sorts: &[Sort]) -> Option<String> {
        let at = self.at;
        self.skip_determiners();
        if let Some((length, name)) = self.named(sorts) {
            self.at += length;
            return Some(name);
        }
        self.at = at;
        None
    }

    fn named(&self, sorts: &[Sort]) -> Option<(usize, String)> {
        let lexicon = &self.names.lexicon;
        let rank = |sort: &Sort| sorts.iter().position(|wanted| wanted == sort);
        let of_first = |first: &str| self.names.names.get(first).into_iter().flatten();
        let fits = |words: &[String]| words.iter().enumerate().all(|(i, word)| word == self.peek(i));
        let own = of_first(self.peek(0)).filter(|(words, ..)| fits(words));
        let own = own.map(|(words, sort, name)| (words.len(), sort, name));
        // A name may go on after a word that homes call otherwise: "tv room".
        let others = lexicon.other_names(|i| self.peek(i));
        let others = others.iter().flat_map(|(length, meant)| {
            let known = of_first(&meant[0]).filter(move |(words, ..)| {
                words.starts_with(meant)
                    && words[meant.len()..].iter().enumerate().all(|(i, word)| word == self.peek(length + i))
            });
            known.map(move |(words, sort, name)| (length + words.len() - meant.len(), sort, name))
        });
        let all = own.chain(others).filter(|(_, sort, _)| rank(sort).is_some());
        let found = all.max_by_key(|(length, sort, _)| (*length, std::cmp::Reverse(rank(sort))))?;
        Some((found.0, found.2.clone()))
    }

    pub fn person(&mut self) -> Option<bool> {
        let words = &self.names.person_words;
        let (last, first) = words.split_last()?;
        if !(0..first.len()).all(|i| first[i] == self.peek(i)) {
            return None;
        }
        let word = self.peek(first.len());
        let possessive = word != last;
        if possessive && word.strip_suffix("'s") != Some(last) {
            return None;
        }
        self.at += words.len();
        Some(possessive)
    }
}

pub fn begins_adverb(reader: &SentenceReader) -> bool {
    matches!(reader.token(0), Some(Token::Number(_) | Token::Clock(..) | Token::Date(..)))
        || is_beginning(reader.peek(0))
}
