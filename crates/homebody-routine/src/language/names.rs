//! The names that a text may use, as words: of the person, and of the home.

use super::known_names::KnownNames;
use super::lexicon::Lexicon;
use super::words::{self, SentenceWord, Token};
use std::collections::BTreeMap;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sort {
    Place,
    Room,
    Floor,
    Thing,
    Condition,
}

#[derive(Debug, Default)]
pub struct HomeNames {
    pub person: Option<String>,
    person_words: Vec<String>,
    pub lexicon: Lexicon,
    pub rooms: Vec<String>,
    names: BTreeMap<String, Vec<(Vec<String>, Sort, String)>>,
}

impl HomeNames {
    pub fn new(known: &KnownNames) -> HomeNames {
        let mut names =
            HomeNames { lexicon: known.lexicon.clone(), rooms: known.rooms.clone(), ..HomeNames::default() };
        names.is_about(known.person.as_deref());
        let sorts = [
            (&known.places, Sort::Place),
            (&known.rooms, Sort::Room),
            (&known.floors, Sort::Floor),
            (&known.things, Sort::Thing),
            (&known.conditions, Sort::Condition),
        ];
        for (list, sort) in sorts {
            for name in list {
                let words = name_words(&names.lexicon, name);
                if let Some(first) = words.first() {
                    names.names.entry(first.clone()).or_default().push((words, sort, name.clone()));
                }
            }
        }
        names
    }

    pub fn is_about(&mut self, person: Option<&str>) {
        self.person = person.map(str::to_owned);
        self.person_words = person.map(|name| name_words(&self.lexicon, name)).unwrap_or_default();
    }

    pub fn of<'a>(&'a self, sorts: &'a [Sort]) -> impl Iterator<Item = &'a str> + Clone {
        let all = self.names.values().flatten();
        all.filter(|(_, sort, _)| sorts.contains(sort)).map(|(_, _, name)| name.as_str())
    }

    /// Whether a name has the word.
    pub fn is_word(&self, word: &str) -> bool {
        self.names.values().flatten().any(|(words, ..)| words.iter().any(|one| one == word))
    }

    /// The names that begin at a word: their lengths in words, and what they name.
    pub fn at<'n>(&'n self, words: &[SentenceWord], at: usize) -> Vec<(usize, Sort, &'n str)> {
        let word = |ahead: usize| words.get(at + ahead).map_or("", |word| word.text.as_str());
        let of_first = |first: &str| self.names.get(first).into_iter().flatten();
        let fits = |name: &[String], from: usize| name.iter().enumerate().all(|(i, wanted)| wanted == word(from + i));
        let mut found: Vec<(usize, Sort, &str)> = of_first(word(0))
            .filter(|(name, ..)| fits(name, 0))
            .map(|(name, sort, known)| (name.len(), *sort, known.as_str()))
            .collect();
        // A name may go on after a word that homes call otherwise: "tv room".
        for (length, meant) in self.lexicon.other_names(word) {
            for (name, sort, known) in of_first(&meant[0]) {
                if name.starts_with(meant) && fits(&name[meant.len()..], length) {
                    found.push((length + name.len() - meant.len(), *sort, known.as_str()));
                }
            }
        }
        found
    }

    /// The length of the person's name at a word, and whether it is "Margaret's".
    pub fn person_at(&self, words: &[SentenceWord], at: usize) -> Option<(usize, bool)> {
        let word = |ahead: usize| words.get(at + ahead).map_or("", |word| word.text.as_str());
        let (last, first) = self.person_words.split_last()?;
        if !first.iter().enumerate().all(|(i, wanted)| wanted == word(i)) {
            return None;
        }
        let possessive = word(first.len()) != last;
        let fits = !possessive || word(first.len()).strip_suffix("'s") == Some(last);
        fits.then_some((self.person_words.len(), possessive))
    }
}

fn name_words(lexicon: &Lexicon, name: &str) -> Vec<String> {
    let words = words::of_name(name).into_iter().filter(|word| word.token != Token::Comma);
    words.map(|word| word.text).skip_while(|word| lexicon.is_word("determiners", word)).collect()
}
