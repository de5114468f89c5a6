//! The rules of a language, compiled from its grammar and its lexicon: the format is described in `english.grammar`.

use super::productions;
use super::productions::arguments::Production;
use super::value::PhraseValue;
use std::collections::BTreeMap;
use std::sync::Arc as Rc;

/// A category of phrases, as an index of `Grammar::categories`.
pub type Category = u16;

/// The commas before a phrase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comma {
    No,
    May,
    Must,
}

/// Words that may stand before a phrase without being written in the rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Preceding {
    Nothing,
    Determiners,
    /// Determiners and phrases of the category `Describing`.
    Describing,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// One of these words, sorted.
    Words(Vec<u32>),
    Phrase(Category),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    pub wanted: Wanted,
    pub optional: bool,
    pub comma: Comma,
    pub before: Preceding,
}

/// The value of a rule, made from those of its phrases.
#[derive(Clone)]
pub enum ValueMaker {
    By(Production, Rc<[String]>),
    /// The value of the only phrase that has one, or nothing.
    Same,
    Constant(Rc<PhraseValue>),
}

#[derive(Clone)]
pub struct Rule {
    pub category: Category,
    pub elements: Vec<Element>,
    pub make: ValueMaker,
    /// Of two readings, the cheaper one counts.
    pub cost: u32,
}

/// In a rule of the grammar, the verb of any way of the lexicon, and the rest of it.
pub const VERB: &str = "VERB";
pub const REST: &str = "REST";

#[derive(Clone, Default)]
pub struct Grammar {
    words: BTreeMap<String, u32>,
    categories: BTreeMap<String, Category>,
    pub rules: Vec<Rule>,
    /// Rules, and the place in them, that begin with a word or with a category.
    by_word: Vec<Vec<(u32, u8)>>,
    by_category: Vec<Vec<(u32, u8)>>,
    /// The number of words of the grammar itself, without those of the lexicon.
    closed: usize,
    /// The orders of a verb and the rest of its way in a clause: a category, and a rule as written. A language without orders
    /// makes each way a phrase.
    pub orders: Vec<(String, String)>,
}

impl Grammar {
    pub fn category(&mut self, name: &str) -> Category {
        let next = self.categories.len() as Category;
        *self.categories.entry(name.to_owned()).or_insert(next)
    }

    pub fn known_category(&self, name: &str) -> Option<Category> {
        self.categories.get(name).copied()
    }

    pub fn word(&mut self, word: &str) -> u32 {
        let next = self.words.len() as u32;
        *self.words.entry(word.to_owned()).or_insert(next)
    }

    pub fn known_word(&self, word: &str) -> Option<u32> {
        self.words.get(word).copied()
    }

    /// Whether the word is one of the grammar itself, such as "after".
    pub fn is_closed(&self, word: &str) -> bool {
        self.known_word(word).is_some_and(|word| (word as usize) < self.closed)
    }

    pub fn all_words(&self) -> impl Iterator<Item = &str> + Clone {
        self.words.keys().map(String::as_str)
    }

    pub fn starting_with_word(&self, word: u32) -> &[(u32, u8)] {
        self.by_word.get(word as usize).map_or(&[], Vec::as_slice)
    }

    pub fn starting_with(&self, category: Category) -> &[(u32, u8)] {
        self.by_category.get(category as usize).map_or(&[], Vec::as_slice)
    }

    pub fn category_count(&self) -> usize {
        self.categories.len()
    }

    /// Reads the text of a grammar. The text is part of the program, so that a mistake in it is one of the program.
    pub fn read(text: &str) -> Grammar {
        let mut grammar = Grammar::default();
        let mut category = None;
        for line in text.lines() {
            let line = line.split('#').next().unwrap_or_default().trim_end();
            if line.is_empty() {
                continue;
            }
            match line.strip_suffix(':').filter(|_| !line.starts_with(' ')) {
                Some(name) => category = Some(name),
                None if line.contains(VERB) => {
                    grammar.orders.push((category.unwrap_or_default().to_owned(), line.trim().to_owned()))
                }
                None => {
                    let category = category.map(|name| grammar.category(name));
                    grammar.line(category, line);
                }
            }
        }
        grammar.closed = grammar.words.len();
        grammar
    }

    fn line(&mut self, category: Option<Category>, line: &str) {
        let (pattern, made) = line.split_once("=>").unwrap_or((line, ""));
        let Some((cost, make)) = maker(made, &[]) else { return };
        let elements = self.pattern(pattern, &[]);
        debug_assert!(category.is_some() && elements.iter().any(|element| !element.optional), "{line}");
        if let Some(category) = category {
            self.add(Rule { category, elements, make, cost });
        }
    }

    /// Adds a way of saying an activity in each of the orders.
    pub fn ordered(&mut self, verb: &Wanted, rest: &[Element], label: &str) {
        for (category, line) in self.orders.clone() {
            let (pattern, made) = line.split_once("=>").unwrap_or((&line, ""));
            let Some((cost, make)) = maker(made, &[label]) else { continue };
            let first = Element { wanted: verb.clone(), optional: false, comma: Comma::No, before: Preceding::Nothing };
            let elements = self.pattern(pattern, &[(VERB, &[first]), (REST, rest)]);
            let category = self.category(&category);
            self.add(Rule { category, elements, make, cost });
        }
    }

    /// The elements of a pattern, where some words stand for others.
    fn pattern(&mut self, pattern: &str, others: &[(&str, &[Element])]) -> Vec<Element> {
        let mut comma = Comma::No;
        let mut elements = Vec::new();
        for written in pattern.split_whitespace() {
            match written {
                "," => comma = Comma::Must,
                "[,]" => comma = Comma::May,
                _ => {
                    let other = others.iter().find(|(name, _)| *name == written);
                    let of_word = match other {
                        Some((_, elements)) => elements.to_vec(),
                        None => vec![self.element(written)],
                    };
                    for element in of_word {
                        // If the phrase is missing, the comma stands before the next one.
                        let carried = if element.optional && comma != Comma::No { Comma::May } else { Comma::No };
                        elements.push(Element { comma, ..element });
                        comma = carried;
                    }
                }
            }
        }
        elements
    }

    fn element(&mut self, written: &str) -> Element {
        let optional = written.starts_with('[');
        let inner = written.trim_matches(['[', ']']);
        let wanted = match inner.starts_with(|first: char| first.is_uppercase()) {
            true => Wanted::Phrase(self.category(inner)),
            false => self.any_of(inner.split('|')),
        };
        Element { wanted, optional, comma: Comma::No, before: Preceding::Nothing }
    }

    pub fn any_of<'w>(&mut self, words: impl IntoIterator<Item = &'w str>) -> Wanted {
        let mut words: Vec<u32> = words.into_iter().map(|word| self.word(word)).collect();
        words.sort_unstable();
        Wanted::Words(words)
    }

    pub fn add(&mut self, rule: Rule) {
        let index = self.rules.len() as u32;
        for (at, element) in rule.elements.iter().enumerate() {
            match &element.wanted {
                Wanted::Words(words) => {
                    for &word in words {
                        at_index(&mut self.by_word, word as usize).push((index, at as u8));
                    }
                }
                Wanted::Phrase(category) => {
                    at_index(&mut self.by_category, *category as usize).push((index, at as u8));
                }
            }
            if !element.optional {
                break;
            }
        }
        self.rules.push(rule);
    }
}

/// The cost of a rule, and how its value is made: "!5 product 60".
fn maker(made: &str, first: &[&str]) -> Option<(u32, ValueMaker)> {
    let mut parts = made.split_whitespace();
    let (mut cost, mut name) = (0, parts.next().unwrap_or_default());
    if let Some(said) = name.strip_prefix('!') {
        (cost, name) = (said.parse().unwrap_or(0), parts.next().unwrap_or_default());
    }
    if name.is_empty() {
        return Some((cost, ValueMaker::Same));
    }
    let production = productions::named(name);
    debug_assert!(production.is_some(), "no production {name}");
    let constants = first.iter().copied().chain(parts).map(str::to_owned).collect();
    Some((cost, ValueMaker::By(production?, constants)))
}

fn at_index<T: Default>(list: &mut Vec<T>, index: usize) -> &mut T {
    if list.len() <= index {
        list.resize_with(index + 1, T::default);
    }
    &mut list[index]
}
