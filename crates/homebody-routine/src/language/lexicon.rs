//! The lexicon: read once from `english.words`, and from the words of a scenario's own, and compiled into rules of the grammar.
//!
//! A file has sections. Those of activities list ways of saying them, those in capitals list words that ways name, other
//! names of rooms and furniture, verbs without rules, and what is said in other words. `english.words` begins with how
//! these are written.

use super::chart::{Chart, MOST_STEPS};
use super::grammar::{Comma, Element, Grammar, Preceding, Rule, ValueMaker, Wanted};
use super::messages::LexiconMessage;
use super::productions;
use super::rewriting::Rewriting;
use super::tokens::Tokens;
use super::value::PhraseValue;
use super::verb_forms::{gerund, regular, third_person};
use super::words;
use crate::routine::Activity;
use homebody_core::nearest::nearest;
use homebody_core::problem::{Excerpt, Problem};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, LazyLock};

/// The languages of routines: their names, grammars and words. Sentences of a language are printed in the first.
const LANGUAGES: [(&str, &str, &str, &str); 2] = [
    ("english", "english.words", include_str!("english.grammar"), include_str!("english.words")),
    ("german|deutsch", "german.words", include_str!("german.grammar"), include_str!("german.words")),
];

pub const OWN_FILE: &str = "own.words";
/// Largest number of lines, and of characters of a line.
pub const MOST_LINES: usize = 2_000;
const LONGEST_LINE: usize = 300;

static BUILT_IN: [LazyLock<Lexicon>; LANGUAGES.len()] = [LazyLock::new(|| built_in(0)), LazyLock::new(|| built_in(1))];

fn built_in(at: usize) -> Lexicon {
    let (_, file, grammar, words) = LANGUAGES[at];
    let empty = LexiconWords { grammar: Grammar::read(grammar), ..LexiconWords::default() };
    let (words, problems) = empty.and(file, words);
    debug_assert!(problems.is_empty(), "{problems:?}");
    Lexicon(Arc::new(words))
}

#[derive(Clone)]
pub struct Lexicon(Arc<LexiconWords>);

impl PartialEq for Lexicon {
    fn eq(&self, other: &Lexicon) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0.lines == other.0.lines
    }
}

impl std::fmt::Debug for Lexicon {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Lexicon of {} lines", self.0.lines.len())
    }
}

impl Default for Lexicon {
    fn default() -> Lexicon {
        BUILT_IN[0].clone()
    }
}

impl std::ops::Deref for Lexicon {
    type Target = LexiconWords;

    fn deref(&self) -> &LexiconWords {
        &self.0
    }
}

impl Lexicon {
    pub fn built_in() -> &'static Lexicon {
        &BUILT_IN[0]
    }

    /// The words of a language, by a name of it such as "German" or "Deutsch".
    pub fn of_language(name: &str) -> Option<&'static Lexicon> {
        let name = name.to_lowercase();
        let at = LANGUAGES.iter().position(|(names, ..)| names.split('|').any(|known| known == name))?;
        Some(&BUILT_IN[at])
    }

    pub fn with(&self, file: &str, text: &str) -> (Lexicon, Vec<Problem>) {
        let (words, problems) = LexiconWords::clone(&self.0).and(file, text);
        (Lexicon(Arc::new(words)), problems)
    }
}

#[derive(Clone, Default)]
pub struct LexiconWords {
    pub grammar: Grammar,
    /// The ways of saying activities, as written.
    pub ways: Vec<(String, Activity)>,
    names: Vec<(LexiconEntry, Vec<String>)>,
    verbs: BTreeMap<String, String>,
    /// Words that the program asks for by the name of their list, such as those that deny.
    lists: BTreeMap<String, Vec<String>>,
    pub rewritings: Vec<Rewriting>,
    usual: Vec<(Activity, String)>,
    pub own: BTreeMap<String, OwnActivity>,
    lines: BTreeSet<String>,
}

/// Words, each with its alternatives.
type LexiconEntry = Vec<Vec<String>>;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct OwnActivity {
    pub minutes: Option<f64>,
    pub place: Option<String>,
    pub line: u32,
}

enum Section {
    Activity(Activity),
    List(String),
    Names,
    Verbs,
    Means,
    Meant,
    Words,
}

/// The form of the verb at the beginning of a way, as a category of the grammar.
const FORMS: [&str; 4] = ["Do", "Does", "Doing", "Done"];

impl LexiconWords {
    /// Other names of what the home calls by the second words.
    pub fn other_names<'w>(&self, words: impl Fn(usize) -> &'w str) -> Vec<(usize, &[String])> {
        let fits = |entry: &LexiconEntry| {
            entry.iter().enumerate().all(|(at, either)| either.iter().any(|one| one == words(at)))
        };
        let found = self.names.iter().filter(|(entry, _)| fits(entry));
        found.map(|(entry, name)| (entry.len(), name.as_slice())).collect()
    }

    pub fn usual(&self, activity: &Activity) -> Option<&str> {
        self.usual.iter().find(|(known, _)| known == activity).map(|(_, said)| said.as_str())
    }

    pub fn told(&self) -> impl Iterator<Item = &str> {
        self.usual.iter().map(|(_, said)| said.as_str())
    }

    pub fn words_of(&self, list: &str) -> impl Iterator<Item = &str> {
        self.lists.get(list).into_iter().flatten().map(String::as_str)
    }

    pub fn is_word(&self, list: &str, word: &str) -> bool {
        self.words_of(list).any(|one| one == word)
    }

    pub fn count(&self) -> usize {
        self.lines.len()
    }

    fn and(mut self, file: &str, text: &str) -> (LexiconWords, Vec<Problem>) {
        let mut problems = Vec::new();
        let mut section: Option<Section> = None;
        // Ways are made of the verbs of the whole file.
        let mut in_verbs = false;
        for line in text.lines().take(MOST_LINES).map(bare) {
            in_verbs = if line.starts_with('[') { line == "[VERBS]" } else { in_verbs };
            if let Some((verb, form)) = line.split_once(' ').filter(|_| in_verbs) {
                self.verbs.insert(verb.to_owned(), form.to_owned());
            }
        }
        for (index, written) in text.lines().enumerate() {
            let line = bare(written);
            let mut say = |message: LexiconMessage| {
                let excerpt = Some(Excerpt::around(written, 0).underlining(written.trim_end().chars().count().max(1)));
                let (line, column) = (index as u32 + 1, 1);
                problems.push(Problem { line, column, excerpt, ..Problem::of_file(file, message, None) });
            };
            if index >= MOST_LINES {
                say(LexiconMessage::TooManyLines { most: MOST_LINES });
                break;
            }
            if written.chars().count() > LONGEST_LINE {
                say(LexiconMessage::LongLine { most: LONGEST_LINE });
            } else if line.is_empty() {
            } else if let Some(head) = line.strip_prefix('[').filter(|_| line.contains(']') && !line.ends_with(')')) {
                match self.head(head, index as u32 + 1) {
                    Ok(found) => section = Some(found),
                    Err(message) => say(message),
                }
            } else if let Some(section) = &section {
                if let Err(message) = self.line(section, line) {
                    say(message);
                }
            } else {
                say(LexiconMessage::NoSection);
            }
        }
        (self, problems)
    }

    /// "[reading] reads", "[tending bonsai] tends the bonsai; 40 minutes; balcony".
    fn head(&mut self, head: &str, line: u32) -> Result<Section, LexiconMessage> {
        let (name, said) = head.split_once(']').unwrap_or((head, ""));
        let (name, said) = (name.trim(), said.trim());
        match name {
            "NAMES" => return Ok(Section::Names),
            "VERBS" => return Ok(Section::Verbs),
            "MEANS" => return Ok(Section::Means),
            "MEANT" => return Ok(Section::Meant),
            "WORDS" => return Ok(Section::Words),
            _ if is_list(name) => return Ok(Section::List(name.to_owned())),
            _ => {}
        }
        let mut parts = said.split(';').map(str::trim);
        let told = parts.next().unwrap_or_default();
        let known = Activity::from_label(name);
        if known.is_none() && !self.own.contains_key(name) && told.is_empty() {
            let labels: Vec<Activity> = Activity::all_of_table().collect();
            let near = nearest(name, labels.iter().map(Activity::label)).map(str::to_owned);
            return Err(LexiconMessage::UnknownActivity { label: name.to_owned(), near });
        }
        let activity = known.clone().unwrap_or_else(|| Activity::Other(name.to_owned()));
        if known.is_none() {
            let mut own = OwnActivity { line, ..OwnActivity::default() };
            for part in parts.filter(|part| !part.is_empty()) {
                match part.strip_suffix("minutes").map(|number| number.trim().parse::<f64>()) {
                    Some(Ok(minutes)) if (1.0..=1440.0).contains(&minutes) => own.minutes = Some(minutes),
                    Some(_) => {
                        return Err(LexiconMessage::Minutes { text: part.to_owned() });
                    }
                    None => own.place = Some(part.to_owned()),
                }
            }
            self.own.insert(name.to_owned(), own);
        }
        if !told.is_empty() && self.usual(&activity).is_none() {
            self.usual.push((activity.clone(), told.to_owned()));
        }
        Ok(Section::Activity(activity))
    }

    fn line(&mut self, section: &Section, line: &str) -> Result<(), LexiconMessage> {
        let sort = match section {
            Section::Activity(_) => "way",
            Section::List(name) => name,
            Section::Names => "name",
            Section::Verbs => "verb",
            Section::Means => "means",
            Section::Meant => "meant",
            Section::Words => "words",
        };
        if !self.lines.insert(format!("{sort}: {line}")) {
            return Err(LexiconMessage::SameLine { text: line.to_owned() });
        }
        match section {
            Section::Activity(activity) => {
                let constants = [activity.label().to_owned(), "place".to_owned()];
                match line.strip_prefix("= ") {
                    Some(noun) => self.phrase(noun, "Noun", &way(constants)),
                    None => {
                        self.ways.push((line.to_owned(), activity.clone()));
                        self.way(line, &way(constants));
                    }
                }
            }
            Section::List(name) => {
                let constant = ValueMaker::Constant(Arc::new(PhraseValue::Unit));
                self.phrase(line, name, &constant);
            }
            Section::Verbs => {}
            Section::Words => {
                if let Some((list, words)) = line.split_once(':') {
                    let words = words.split_whitespace().map(str::to_owned);
                    self.lists.entry(list.to_owned()).or_default().extend(words);
                }
            }
            Section::Meant => {
                let (said, meant) = line.split_once("=>").unwrap_or((line, ""));
                self.rewritings.push(Rewriting::new(said, meant));
            }
            Section::Names | Section::Means => {
                let Some((said, meant)) = line.split_once("=>") else {
                    return Err(LexiconMessage::NoMeaning { text: line.to_owned() });
                };
                let (said, meant) = (said.trim(), meant.trim());
                if let Section::Names = section {
                    self.names.push((entry(said), meant.split(' ').map(str::to_owned).collect()));
                } else {
                    match meaning_of(self, meant) {
                        Some(value @ PhraseValue::Parts(_)) => {
                            self.phrase(said, "Part", &ValueMaker::Constant(Arc::new(value)))
                        }
                        Some(value) => self.way(said, &ValueMaker::Constant(Arc::new(value))),
                        None => return Err(LexiconMessage::NoMeaning { text: line.to_owned() }),
                    }
                }
            }
        }
        Ok(())
    }

    /// A way that begins with a verb, in each of its forms.
    fn way(&mut self, written: &str, make: &ValueMaker) {
        let (first, rest) = written.split_once(' ').unwrap_or((written, ""));
        if !self.grammar.orders.is_empty() {
            let (verb, rest) = (self.grammar.any_of(first.trim_start_matches('~').split('|')), self.elements(rest));
            if let ValueMaker::By(_, constants) = make {
                self.grammar.ordered(&verb, &rest, &constants[0]);
            }
            return;
        }
        let Some(verbs) = first.strip_prefix('~') else {
            return FORMS.iter().for_each(|form| self.phrase(written, form, make));
        };
        let rest = self.elements(rest);
        let forms: Vec<[Vec<String>; 4]> = verbs.split('|').map(|verb| self.forms(verb)).collect();
        for (at, form) in FORMS.iter().enumerate() {
            let words: Vec<&str> = forms.iter().flat_map(|forms| &forms[at]).map(String::as_str).collect();
            let wanted = self.grammar.any_of(words);
            let first = Element { wanted, optional: false, comma: Comma::No, before: Preceding::Nothing };
            let elements = std::iter::once(first).chain(rest.iter().cloned()).collect();
            let category = self.grammar.category(form);
            self.grammar.add(Rule { category, elements, make: make.clone(), cost: 0 });
        }
    }

    fn phrase(&mut self, written: &str, category: &str, make: &ValueMaker) {
        let mut elements = self.elements(written);
        if let Some(first) = elements.first_mut().filter(|_| !written.starts_with('*')) {
            first.before = Preceding::Nothing;
        }
        // Describing words in front of a noun are a rule of their own.
        if written.starts_with('*') {
            elements[0].before = Preceding::Nothing;
            let describing = self.grammar.category("Describing");
            let front = Element {
                wanted: Wanted::Phrase(describing),
                optional: false,
                comma: Comma::No,
                before: Preceding::Nothing,
            };
            let mut described = elements.clone();
            described[0].before = Preceding::Describing;
            described.insert(0, front);
            let category = self.grammar.category(category);
            self.grammar.add(Rule { category, elements: described, make: make.clone(), cost: 0 });
        }
        let category = self.grammar.category(category);
        self.grammar.add(Rule { category, elements, make: make.clone(), cost: 0 });
    }

    fn elements(&mut self, written: &str) -> Vec<Element> {
        written.split_whitespace().map(|piece| self.piece(piece)).collect()
    }

    fn piece(&mut self, written: &str) -> Element {
        let optional = written.starts_with('[');
        let inner = written.trim_matches(['[', ']']);
        let before = if inner.starts_with('*') { Preceding::Describing } else { Preceding::Determiners };
        let inner = inner.trim_start_matches('*');
        let wanted = match inner {
            "SELF" => {
                let selves: Vec<String> = self.words_of("selves").map(str::to_owned).collect();
                self.grammar.any_of(selves.iter().map(String::as_str))
            }
            _ if inner.split('|').all(is_list) => {
                Wanted::Phrase(self.grammar.category(inner.split('|').next().unwrap_or_default()))
            }
            _ => match inner.strip_prefix('~') {
                Some(verbs) => {
                    let forms: Vec<String> = verbs.split('|').flat_map(|verb| self.forms(verb).concat()).collect();
                    self.grammar.any_of(forms.iter().map(String::as_str))
                }
                None => self.grammar.any_of(inner.split('|')),
            },
        };
        Element { wanted, optional, comma: Comma::No, before }
    }

    /// The forms of a verb: "get", "gets", "getting", "got".
    fn forms(&self, verb: &str) -> [Vec<String>; 4] {
        let list = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
        if verb == "be" {
            return [list(&["be", "are"]), list(&["is", "are"]), list(&["being"]), list(&["been"])];
        }
        let participle = self.verbs.get(verb).cloned().unwrap_or_else(|| regular(verb));
        [list(&[verb]), vec![third_person(verb)], vec![gerund(verb)], vec![participle]]
    }
}

fn way(constants: [String; 2]) -> ValueMaker {
    match productions::named("way") {
        Some(production) => ValueMaker::By(production, Arc::new(constants)),
        None => ValueMaker::Same,
    }
}

fn bare(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

fn is_list(name: &str) -> bool {
    name.len() > 1 && name.chars().all(|c| c.is_ascii_uppercase())
}

fn entry(line: &str) -> LexiconEntry {
    line.split(' ').map(|either| either.split('|').map(str::to_owned).collect()).collect()
}

/// The value of words that a lexicon gives as the meaning of others: a part of a sentence, or what is done.
pub fn meaning_of(lexicon: &LexiconWords, text: &str) -> Option<PhraseValue> {
    let words = words::of_name(text);
    let tokens = Tokens::new(&words);
    for category in ["Parts", "Does"] {
        let grammar = &lexicon.grammar;
        let mut chart = Chart::new(
            grammar,
            text,
            &tokens.words,
            &tokens.commas,
            &|list, word| lexicon.is_word(list, word),
            MOST_STEPS,
        );
        for (at, word) in tokens.words.iter().enumerate() {
            chart.give_digits(at, &word.token);
        }
        let found = chart.readings(category);
        if let Some(item) = found.iter().find(|item| item.faults.is_none()) {
            return Some(PhraseValue::clone(&item.value));
        }
    }
    None
}
