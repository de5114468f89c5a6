//! A bottom-up chart over the words of a sentence.
//!
//! Phrases are found from the cheapest on. A word that no rule covers costs much, a contradiction less, so that the first
//! reading of the whole sentence is the best one.

use super::grammar::{Category, Comma, Element, Grammar, Preceding, ValueMaker, Wanted};
use super::productions::arguments::{Arguments, Kid};
use super::value::{PhraseValue, Range};
use super::words::{SentenceWord, TextSpan, Token};
use homebody_core::problem::Diagnostic;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::sync::Arc as Rc;

/// Largest number of words of a sentence (our choice). The words left out are bits of a number.
pub const MOST_WORDS: usize = 60;
/// Largest number of steps in which the phrases of a sentence are found (our choice), which bounds the time.
pub const MOST_STEPS: usize = 100_000;

/// The cost of a contradiction, and of a word left out.
pub const FAULT_COST: u32 = 100;
pub const SKIP_COST: u32 = 1_000;
/// Largest number of words that a repair leaves out (our choice).
const MOST_SKIPPED: u32 = 6;

pub type PhraseFaults = Option<Rc<Vec<(TextSpan, Diagnostic)>>>;

#[derive(Clone)]
pub struct Phrase {
    pub category: Category,
    pub start: u8,
    pub end: u8,
    pub value: Rc<PhraseValue>,
    pub cost: u32,
    pub faults: PhraseFaults,
    /// A bit for each word left out.
    pub skipped: u64,
}

#[derive(Clone)]
struct Edge {
    rule: u32,
    dot: u8,
    start: u8,
    end: u8,
    kids: Option<Rc<PhraseList>>,
    cost: u32,
    skipped: u64,
}

struct PhraseList {
    item: Rc<Phrase>,
    before: Option<Rc<PhraseList>>,
}

/// The reason why an unfinished phrase waits: the next element, or words before it.
#[derive(Clone)]
struct Waiting {
    edge: Edge,
    describes: bool,
}

pub struct Chart<'a> {
    grammar: &'a Grammar,
    pub words: &'a [SentenceWord],
    /// Whether a comma stands before each word.
    commas: &'a [bool],
    ids: Vec<Option<u32>>,
    determiners: Vec<bool>,
    text: &'a str,
    by_start: Vec<Vec<Rc<Phrase>>>,
    known: BTreeMap<(Category, u8, u8), Vec<Rc<Phrase>>>,
    waiting: BTreeMap<(u8, Category), Vec<Waiting>>,
    agenda: BinaryHeap<(Reverse<u32>, Reverse<u32>)>,
    made: Vec<Option<Phrase>>,
    pub steps: usize,
    pub most_steps: usize,
    describing: Option<Category>,
}

impl<'a> Chart<'a> {
    pub fn new(
        grammar: &'a Grammar,
        text: &'a str,
        words: &'a [SentenceWord],
        commas: &'a [bool],
        is_word: &dyn Fn(&str, &str) -> bool,
        most_steps: usize,
    ) -> Chart<'a> {
        // A routine is about one person: "he" and "she" in one sentence are two.
        let is_pronoun = |word: &str| is_word("pronouns", word);
        let pronoun = words.iter().find(|word| is_pronoun(&word.text)).map_or("", |word| &word.text);
        let known = |word: &SentenceWord| match is_pronoun(&word.text) && word.text != pronoun {
            true => None,
            false => grammar.known_word(&word.text),
        };
        Chart {
            grammar,
            words,
            commas,
            ids: words.iter().map(known).collect(),
            determiners: words.iter().map(|word| is_word("determiners", &word.text)).collect(),
            text,
            by_start: vec![Vec::new(); words.len() + 1],
            known: BTreeMap::new(),
            waiting: BTreeMap::new(),
            agenda: BinaryHeap::new(),
            made: Vec::new(),
            steps: 0,
            most_steps,
            describing: grammar.known_category("Describing"),
        }
    }

    /// Adds a phrase that no rule makes, such as a number or the name of a place.
    pub fn give(&mut self, category: &str, start: usize, end: usize, value: PhraseValue, cost: u32) {
        let Some(category) = self.grammar.known_category(category) else { return };
        let skipped = if cost >= SKIP_COST { 1 << start } else { 0 };
        let (start, end, value) = (start as u8, end as u8, Rc::new(value));
        self.push(Phrase { category, start, end, value, cost, faults: None, skipped });
    }

    /// Gives a number or a time in digits.
    pub fn give_digits(&mut self, at: usize, token: &Token) {
        match *token {
            Token::Number(number) => self.give("NUMBER", at, at + 1, PhraseValue::Number(number), 0),
            Token::Clock(hours, minutes) => {
                let range = Range { from: f64::from(hours), to: f64::from(minutes), about: false };
                self.give("CLOCK", at, at + 1, PhraseValue::Range(range), 0);
            }
            _ => {}
        }
    }

    /// All readings of the whole sentence of the cheapest class: without faults, else with faults, else with words left out.
    /// A heading covers all of its words.
    pub fn readings(&mut self, category: &str) -> Vec<Rc<Phrase>> {
        let Some(category) = self.grammar.known_category(category) else { return Vec::new() };
        let heading = self.grammar.known_category("Heading");
        for start in 0..self.words.len() {
            let Some(word) = self.ids[start] else { continue };
            let grammar = self.grammar;
            for &(rule, dot) in grammar.starting_with_word(word) {
                let (start, end) = (start as u8, start as u8 + 1);
                self.step(Edge {
                    rule,
                    dot: dot + 1,
                    start,
                    end,
                    kids: None,
                    cost: grammar.rules[rule as usize].cost,
                    skipped: 0,
                });
            }
        }
        let whole = (category, 0, self.words.len() as u8);
        let mut class = u32::MAX;
        while let Some((Reverse(cost), Reverse(index))) = self.agenda.pop() {
            if cost > class || self.steps > self.most_steps {
                break;
            }
            let Some(item) = self.made[index as usize].take() else { continue };
            let item = Rc::new(item);
            let key = (item.category, item.start, item.end);
            let known = self.known.entry(key).or_default();
            if known.iter().any(|known| known.value == item.value) {
                continue;
            }
            known.push(item.clone());
            let is_heading = Some(key.0) == heading && (key.1, key.2) == (whole.1, whole.2) && item.skipped == 0;
            if key == whole || is_heading {
                class = match cost {
                    0..FAULT_COST => FAULT_COST - 1,
                    FAULT_COST..SKIP_COST => cost,
                    _ => cost + FAULT_COST,
                };
            }
            self.by_start[item.start as usize].push(item.clone());
            self.extend(&item);
        }
        let mut found = self.known.get(&whole).cloned().unwrap_or_default();
        let headings = heading.and_then(|heading| self.known.get(&(heading, whole.1, whole.2)));
        found.extend(headings.into_iter().flatten().filter(|item| item.skipped == 0).cloned());
        found
    }

    /// All phrases of a category.
    pub fn phrases(&self, category: &str) -> impl Iterator<Item = &Rc<Phrase>> {
        let category = self.grammar.known_category(category);
        self.by_start.iter().flatten().filter(move |item| Some(item.category) == category)
    }

    fn extend(&mut self, item: &Rc<Phrase>) {
        if let Some(waiting) = self.waiting.get(&(item.start, item.category)) {
            for Waiting { edge, describes } in waiting.clone() {
                self.consume(edge, item, describes);
            }
        }
        let grammar = self.grammar;
        for &(rule, dot) in grammar.starting_with(item.category) {
            let edge = Edge {
                rule,
                dot,
                start: item.start,
                end: item.start,
                kids: None,
                cost: grammar.rules[rule as usize].cost,
                skipped: 0,
            };
            self.consume(edge, item, false);
        }
    }

    fn consume(&mut self, edge: Edge, item: &Rc<Phrase>, describes: bool) {
        let cost = edge.cost + item.cost;
        if cost > MOST_SKIPPED * SKIP_COST {
            return;
        }
        let kids = Some(Rc::new(PhraseList { item: item.clone(), before: edge.kids.clone() }));
        let skipped = edge.skipped | item.skipped;
        let dot = edge.dot + u8::from(!describes);
        self.step(Edge { dot, end: item.end, kids, cost, skipped, ..edge });
    }

    fn element(&self, edge: &Edge) -> Option<&'a Element> {
        self.grammar.rules[edge.rule as usize].elements.get(edge.dot as usize)
    }

    fn step(&mut self, edge: Edge) {
        self.steps += 1;
        let Some(element) = self.element(&edge) else { return self.complete(&edge) };
        if element.optional {
            self.step(Edge { dot: edge.dot + 1, ..edge.clone() });
        }
        let comma = self.commas.get(edge.end as usize).copied().unwrap_or(false);
        let fits = match element.comma {
            Comma::No => !comma,
            Comma::May => true,
            Comma::Must => comma,
        };
        if fits {
            self.expect(edge, element);
        }
    }

    fn expect(&mut self, edge: Edge, element: &Element) {
        let at = edge.end as usize;
        if at >= self.words.len() {
            return;
        }
        match &element.wanted {
            Wanted::Words(words) => {
                if self.ids[at].is_some_and(|id| words.binary_search(&id).is_ok()) {
                    self.step(Edge { dot: edge.dot + 1, end: edge.end + 1, ..edge.clone() });
                }
            }
            Wanted::Phrase(category) => self.wait(&edge, *category, false),
        }
        if element.before == Preceding::Nothing {
            return;
        }
        if self.determiners[at] && !self.commas.get(at + 1).copied().unwrap_or(false) {
            self.expect(Edge { end: edge.end + 1, ..edge.clone() }, element);
        }
        if let (Preceding::Describing, Some(category)) = (element.before, self.describing) {
            self.wait(&edge, category, true);
        }
    }

    fn wait(&mut self, edge: &Edge, category: Category, describes: bool) {
        self.waiting.entry((edge.end, category)).or_default().push(Waiting { edge: edge.clone(), describes });
        let found: Vec<Rc<Phrase>> =
            self.by_start[edge.end as usize].iter().filter(|item| item.category == category).cloned().collect();
        for item in found {
            self.consume(edge.clone(), &item, describes);
        }
    }

    fn complete(&mut self, edge: &Edge) {
        let rule = &self.grammar.rules[edge.rule as usize];
        let (mut items, mut link) = (Vec::new(), edge.kids.as_ref());
        while let Some(PhraseList { item, before }) = link.map(Rc::as_ref) {
            items.push(item.clone());
            link = before.as_ref();
        }
        items.reverse();
        let mut faults: Vec<(TextSpan, Diagnostic)> =
            items.iter().filter_map(|item| item.faults.as_ref()).flat_map(|faults| faults.iter().cloned()).collect();
        let before = faults.len();
        let value = match &rule.make {
            ValueMaker::Constant(value) => value.clone(),
            ValueMaker::Same => {
                let said = items.iter().find(|item| *item.value != PhraseValue::Unit);
                said.map_or_else(|| Rc::new(PhraseValue::Unit), |item| item.value.clone())
            }
            ValueMaker::By(production, constants) => {
                let kids: Vec<Kid> = items
                    .iter()
                    .map(|item| Kid { value: item.value.clone(), span: self.span(item.start, item.end) })
                    .collect();
                let mut arguments = Arguments {
                    kids: &kids,
                    constants,
                    words: &self.words[edge.start as usize..edge.end as usize],
                    span: self.span(edge.start, edge.end),
                    text: self.text,
                    faults: Vec::new(),
                };
                let Some(value) = production(&mut arguments) else { return };
                faults.append(&mut arguments.faults);
                Rc::new(value)
            }
        };
        let cost = edge.cost + FAULT_COST * (faults.len() - before) as u32;
        let faults = if faults.is_empty() { None } else { Some(Rc::new(faults)) };
        let (category, start, end, skipped) = (rule.category, edge.start, edge.end, edge.skipped);
        self.push(Phrase { category, start, end, value, cost, faults, skipped });
    }

    fn push(&mut self, item: Phrase) {
        let known = self.known.get(&(item.category, item.start, item.end));
        if known.is_some_and(|known| known.iter().any(|known| known.value == item.value)) {
            return;
        }
        self.agenda.push((Reverse(item.cost), Reverse(self.made.len() as u32)));
        self.made.push(Some(item));
    }

    pub fn span(&self, start: u8, end: u8) -> TextSpan {
        match (self.words.get(start as usize), self.words.get((end as usize).saturating_sub(1))) {
            (Some(first), Some(last)) if start < end => first.span.to(last.span),
            _ => TextSpan::default(),
        }
    }
}
