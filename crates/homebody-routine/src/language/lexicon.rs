//! The words of the language: read once from `english.words`, and from the words of a scenario's own.
//!
//! A file has sections. Those of activities list ways of saying them, those in capitals list words that ways name, other
//! names of rooms and furniture, verbs without rules, and what is said in other words. `english.words` begins with how
//! these are written.

use super::messages::LexiconMessage;
use super::words::{self, Token, Word};
use crate::routine::Activity;
use homebody_core::problem::{Excerpt, Problem};
use homebody_core::scenario::nearest::nearest;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, LazyLock};

const ENGLISH: &str = include_str!("english.words");

/// The name of a scenario's own file of words.
pub const OWN_FILE: &str = "own.words";
/// Largest number of lines, and of characters of a line.
pub const MOST_LINES: usize = 2_000;
const LONGEST_LINE: usize = 300;

static BUILT_IN: LazyLock<Lexicon> = LazyLock::new(|| {
    let (words, problems) = Words::default().and("english.words", ENGLISH);
    debug_assert!(problems.is_empty(), "{problems:?}");
    Lexicon(Arc::new(words))
});

/// All words that are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Lexicon(Arc<Words>);

impl Default for Lexicon {
    fn default() -> Lexicon {
        BUILT_IN.clone()
    }
}

impl std::ops::Deref for Lexicon {
    type Target = Words;

    fn deref(&self) -> &Words {
        &self.0
    }
}

impl Lexicon {
    pub fn built_in() -> &'static Lexicon {
        &BUILT_IN
    }

    /// These words and those of a text, as far as it is understood, with all that is wrong with it.
    pub fn with(&self, file: &str, text: &str) -> (Lexicon, Vec<Problem>) {
        let (words, problems) = Words::clone(&self.0).and(file, text);
        (Lexicon(Arc::new(words)), problems)
    }
}

/// What is in a lexicon.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Words {
    pub ways: Vec<(Way, Activity)>,
    /// Of each word that a way begins with, the ways.
    first: BTreeMap<String, Vec<usize>>,
    pub nouns: Vec<(Way, Activity)>,
    pub means: Vec<(Way, String)>,
    first_of_means: BTreeMap<String, Vec<usize>>,
    lists: BTreeMap<String, Vec<Entry>>,
    /// Other names, with the one that homes have.
    names: Vec<(Entry, Vec<String>)>,
    verbs: BTreeMap<String, String>,
    /// The past of verbs that have no rule, with the verb.
    past: BTreeMap<String, String>,
    /// What is not clear, and what could be said instead.
    hints: Vec<(Way, String)>,
    /// What is not said exactly, and how it is lived.
    roughly: Vec<(Way, String)>,
    /// How activities are told.
    usual: Vec<(Activity, String)>,
    /// Of activities that a user has named: where, and how many minutes.
    pub own: BTreeMap<String, Own>,
    /// Every line that says something, to find what is said twice.
    lines: BTreeSet<String>,
}

/// Words one after another, each with its alternatives.
type Entry = Vec<Vec<String>>;

/// What a user's own activity is where a sentence does not say it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Own {
    pub minutes: Option<f64>,
    pub place: Option<String>,
    pub line: u32,
}

/// A way of saying something.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    pub pieces: Vec<Piece>,
    pub written: String,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    pub is: Is,
    pub optional: bool,
    /// Whether other words may stand before it.
    pub after_others: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Is {
    /// The forms of verbs.
    Verb(BTreeSet<String>),
    Word(Vec<String>),
    /// One of a list, by its name.
    List(String),
    Oneself,
    Whom,
    Host,
    /// Some words more.
    More,
}

/// What the lines of a section are.
enum Section {
    Activity(Activity),
    List(String),
    Names,
    Verbs,
    Past,
    Means,
    Hints,
    Roughly,
}

impl Words {
    /// Ways that may begin with this word.
    pub fn beginning<'a>(&'a self, word: &str) -> impl Iterator<Item = &'a (Way, Activity)> {
        self.first.get(word).into_iter().flatten().map(|&index| &self.ways[index])
    }

    /// What may be meant by words of which this is the first.
    pub fn meaning<'a>(&'a self, word: &str) -> impl Iterator<Item = &'a (Way, String)> {
        self.first_of_means.get(word).into_iter().flatten().map(|&index| &self.means[index])
    }

    /// How many words one of a list takes, if one stands there: the longest that fits.
    pub fn list<'w>(&self, name: &str, words: impl Fn(usize) -> &'w str) -> Option<usize> {
        let fits =
            |entry: &&Entry| entry.iter().enumerate().all(|(at, either)| either.iter().any(|one| one == words(at)));
        self.lists.get(name)?.iter().filter(fits).map(Vec::len).max()
    }

    /// Whether the last word of these is one of a list.
    pub fn has_last(&self, name: &str, words: &str) -> bool {
        let last = words.rsplit(' ').next().unwrap_or_default();
        self.list(name, |at| if at == 0 { last } else { "" }).is_some()
    }

    /// What homes usually call what these words name, with how many words that takes; the longest first.
    pub fn other_names<'w>(&self, words: impl Fn(usize) -> &'w str) -> Vec<(usize, &[String])> {
        let fits =
            |entry: &Entry| entry.iter().enumerate().all(|(at, either)| either.iter().any(|one| one == words(at)));
        let found = self.names.iter().filter(|(entry, _)| fits(entry));
        let mut found: Vec<(usize, &[String])> = found.map(|(entry, name)| (entry.len(), name.as_slice())).collect();
        found.sort_by_key(|(length, _)| std::cmp::Reverse(*length));
        found
    }

    /// How an activity is told, if the words say so.
    pub fn usual(&self, activity: &Activity) -> Option<&str> {
        self.usual.iter().find(|(known, _)| known == activity).map(|(_, said)| said.as_str())
    }

    /// How the activities are told, in the order of the file.
    pub fn told(&self) -> impl Iterator<Item = &str> {
        self.usual.iter().map(|(_, said)| said.as_str())
    }

    /// What stands after "has", of a verb without a rule.
    pub fn participle(&self, verb: &str) -> Option<&str> {
        self.verbs.get(verb).map(String::as_str)
    }

    /// Whether a verb that is known stands in the form that goes with "she".
    pub fn is_third_person(&self, word: &str) -> bool {
        const OTHERS: [&str; 3] = ["is", "has", "does"];
        let ends = word.ends_with('s') && !word.ends_with("ss");
        let verb = self.list("VERB", |at| if at == 0 { word } else { "" }).is_some();
        let begins = || self.beginning(word).any(|(way, _)| is_form(way, word));
        let means = || self.meaning(word).any(|(way, _)| is_form(way, word));
        verb || OTHERS.contains(&word) || ends && (begins() || means())
    }

    /// The verb whose form in "-ing" this is, if it is known.
    pub fn verb_of_gerund(&self, word: &str) -> Option<String> {
        let stem = word.strip_suffix("ing")?;
        let candidates = [stem.to_owned(), format!("{stem}e"), undoubled(stem), stem.replace('y', "ie")];
        candidates.into_iter().find(|verb| gerund(verb) == word && self.is_third_person(&third_person(verb)))
    }

    /// The verb that stands so behind "has" or "is", if it is known.
    pub fn verb_of_participle(&self, word: &str) -> Option<String> {
        if let Some((verb, _)) = self.verbs.iter().find(|(_, form)| *form == word) {
            return Some(verb.clone());
        }
        let stem = word.strip_suffix("ed")?;
        let with_y = stem.strip_suffix('i').map(|stem| format!("{stem}y")).unwrap_or_default();
        [stem.to_owned(), format!("{stem}e"), undoubled(stem), with_y].into_iter().find(|verb| regular(verb) == word)
    }

    /// The verb of which this is the past, if it is known.
    pub fn verb_of_past(&self, word: &str) -> Option<String> {
        let of_list = self.past.get(word).cloned();
        let of_rule = || {
            let verb = self.verb_of_participle(word).filter(|verb| word.ends_with("ed") && regular(verb) == word)?;
            self.is_third_person(&third_person(&verb)).then_some(verb)
        };
        of_list.or_else(of_rule)
    }

    /// What could be said instead of words of which this is the first.
    pub fn hinted<'a>(&'a self, word: &'a str) -> impl Iterator<Item = &'a (Way, String)> {
        self.hints.iter().filter(move |(way, _)| begins_with(way, word))
    }

    /// How words are lived roughly of which this is the first.
    pub fn roughly<'a>(&'a self, word: &'a str) -> impl Iterator<Item = &'a (Way, String)> {
        self.roughly.iter().filter(move |(way, _)| begins_with(way, word))
    }

    /// How many lines of words there are.
    pub fn count(&self) -> usize {
        self.lines.len()
    }

    fn and(mut self, file: &str, text: &str) -> (Words, Vec<Problem>) {
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
        self.sort();
        (self, problems)
    }

    /// "[reading] reads", "[tending bonsai] tends the bonsai; 40 minutes; balcony".
    fn head(&mut self, head: &str, line: u32) -> Result<Section, LexiconMessage> {
        let (name, said) = head.split_once(']').unwrap_or((head, ""));
        let (name, said) = (name.trim(), said.trim());
        match name {
            "NAMES" => return Ok(Section::Names),
            "VERBS" => return Ok(Section::Verbs),
            "PAST" => return Ok(Section::Past),
            "HINTS" => return Ok(Section::Hints),
            "ROUGHLY" => return Ok(Section::Roughly),
            "MEANS" => return Ok(Section::Means),
            _ if is_list(name) => return Ok(Section::List(name.to_owned())),
            _ => {}
        }
        let mut parts = said.split(';').map(str::trim);
        let told = parts.next().unwrap_or_default();
        let known = Activity::of_label(name);
        if known.is_none() && !self.own.contains_key(name) && told.is_empty() {
            let labels: Vec<Activity> = Activity::OWN_WAYS.into_iter().chain(Activity::everyday()).collect();
            let near = nearest(name, labels.iter().map(Activity::label)).map(str::to_owned);
            return Err(LexiconMessage::UnknownActivity { label: name.to_owned(), near });
        }
        let activity = known.clone().unwrap_or_else(|| Activity::Other(name.to_owned()));
        if known.is_none() {
            let mut own = Own { line, ..Own::default() };
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
            Section::Past => "past",
            Section::Means => "means",
            Section::Hints => "hint",
            Section::Roughly => "rough",
        };
        if !self.lines.insert(format!("{sort}: {line}")) {
            return Err(LexiconMessage::SameLine { text: line.to_owned() });
        }
        match section {
            Section::Activity(activity) => match line.strip_prefix("= ") {
                Some(noun) => self.nouns.push((self.way(noun)?, activity.clone())),
                None => self.ways.push((self.way(line)?, activity.clone())),
            },
            Section::List(name) => self.lists.entry(name.clone()).or_default().push(entry(line)),
            Section::Verbs => {}
            Section::Past => {
                if let Some((verb, past)) = line.split_once(' ') {
                    self.past.insert(past.to_owned(), verb.to_owned());
                }
            }
            Section::Names | Section::Means | Section::Hints | Section::Roughly => {
                let Some((said, meant)) = line.split_once("=>") else {
                    return Err(LexiconMessage::NoMeaning { text: line.to_owned() });
                };
                let (said, meant) = (said.trim(), meant.trim());
                match section {
                    Section::Names => self.names.push((entry(said), meant.split(' ').map(str::to_owned).collect())),
                    Section::Hints => self.hints.push((self.way(said)?, meant.to_owned())),
                    Section::Roughly => self.roughly.push((self.way(said)?, meant.to_owned())),
                    _ => self.means.push((self.way(said)?, meant.to_owned())),
                }
            }
        }
        Ok(())
    }

    fn way(&self, written: &str) -> Result<Way, LexiconMessage> {
        let pieces: Vec<Piece> = written.split(' ').map(|piece| self.piece(piece)).collect();
        match pieces.first().map(|piece| (&piece.is, piece.optional)) {
            Some((Is::Verb(_) | Is::Word(_), false)) => Ok(Way { pieces, written: written.to_owned() }),
            _ => Err(LexiconMessage::NoFirstWord { text: written.to_owned() }),
        }
    }

    fn piece(&self, written: &str) -> Piece {
        let optional = written.starts_with('[');
        let inner = written.trim_matches(['[', ']']);
        let after_others = inner.starts_with('*');
        let inner = inner.trim_start_matches('*');
        let is = match inner {
            "SELF" => Is::Oneself,
            "WHOM" => Is::Whom,
            "HOST" => Is::Host,
            "..." => Is::More,
            _ if inner.split('|').all(is_list) => Is::List(inner.split('|').next().unwrap_or_default().to_owned()),
            _ => match inner.strip_prefix('~') {
                Some(verbs) => Is::Verb(verbs.split('|').flat_map(|verb| self.forms(verb)).collect()),
                None => Is::Word(inner.split('|').map(str::to_owned).collect()),
            },
        };
        Piece { is, optional: optional || inner == "...", after_others }
    }

    /// All forms of a verb: "get", "gets", "getting", "got".
    pub fn forms(&self, verb: &str) -> Vec<String> {
        if verb == "be" {
            return ["is", "are", "be", "being", "been"].map(str::to_owned).to_vec();
        }
        let participle = self.verbs.get(verb).cloned().unwrap_or_else(|| regular(verb));
        vec![verb.to_owned(), third_person(verb), gerund(verb), participle]
    }

    fn sort(&mut self) {
        fn index<T>(ways: &[(Way, T)]) -> BTreeMap<String, Vec<usize>> {
            let mut first: BTreeMap<String, Vec<usize>> = BTreeMap::new();
            for (at, (way, _)) in ways.iter().enumerate() {
                match way.pieces.first().map(|piece| &piece.is) {
                    Some(Is::Verb(forms)) => {
                        forms.iter().for_each(|word| first.entry(word.clone()).or_default().push(at))
                    }
                    Some(Is::Word(either)) => {
                        either.iter().for_each(|word| first.entry(word.clone()).or_default().push(at))
                    }
                    _ => {}
                }
            }
            first
        }
        self.first = index(&self.ways);
        self.first_of_means = index(&self.means);
    }
}

/// Whether a way begins with a form of a verb, and this is it.
fn is_form(way: &Way, word: &str) -> bool {
    matches!(way.pieces.first().map(|piece| &piece.is), Some(Is::Verb(forms)) if forms.contains(word))
}

fn begins_with(way: &Way, word: &str) -> bool {
    match way.pieces.first().map(|piece| &piece.is) {
        Some(Is::Verb(forms)) => forms.contains(word),
        Some(Is::Word(either)) => either.iter().any(|one| one == word),
        _ => false,
    }
}

/// "sit" of "sitt".
fn undoubled(stem: &str) -> String {
    let mut letters = stem.chars().rev();
    match (letters.next(), letters.next()) {
        (Some(last), Some(before)) if last == before => stem[..stem.len() - last.len_utf8()].to_owned(),
        _ => stem.to_owned(),
    }
}

/// A line without what is for people.
fn bare(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

fn is_list(name: &str) -> bool {
    name.len() > 1 && name.chars().all(|c| c.is_ascii_uppercase())
}

fn entry(line: &str) -> Entry {
    line.split(' ').map(|either| either.split('|').map(str::to_owned).collect()).collect()
}

/// The words of a text, all in the place of a word that was written.
pub fn words_of(text: &str, at: &Word) -> Vec<Word> {
    let words = words::of_name(text).into_iter();
    words
        .map(|word| Word { span: at.span, ..word })
        .filter(|word| word.token != Token::Comma || word.text == ",")
        .collect()
}

/// "watches" of "watch".
pub fn third_person(verb: &str) -> String {
    let consonant_y = verb.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u']));
    match verb {
        "have" => "has".into(),
        "be" => "is".into(),
        _ if consonant_y.is_some() => format!("{}ies", consonant_y.unwrap_or_default()),
        _ if ["s", "sh", "ch", "x", "o", "z"].iter().any(|end| verb.ends_with(end)) => format!("{verb}es"),
        _ => format!("{verb}s"),
    }
}

/// "watching" of "watch".
pub fn gerund(verb: &str) -> String {
    match verb {
        "lie" => "lying".into(),
        _ if is_doubled(verb) => format!("{verb}{}ing", &verb[verb.len() - 1..]),
        _ => match verb.strip_suffix('e') {
            Some(stem) if !stem.ends_with(['e', 'i', 'o']) => format!("{stem}ing"),
            _ => format!("{verb}ing"),
        },
    }
}

/// "watched" of "watch".
fn regular(verb: &str) -> String {
    match verb.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u'])) {
        Some(stem) => format!("{stem}ied"),
        None if verb.ends_with('e') => format!("{verb}d"),
        None if is_doubled(verb) => format!("{verb}{}ed", &verb[verb.len() - 1..]),
        None => format!("{verb}ed"),
    }
}

/// Whether the last letter comes twice in longer forms: one vowel, and a consonant after it.
fn is_doubled(verb: &str) -> bool {
    let is_vowel = |c: &char| "aeiou".contains(*c);
    let letters: Vec<char> = verb.chars().collect();
    let vowels = letters.iter().filter(|c| is_vowel(c)).count();
    match letters.as_slice() {
        [.., before, last] => {
            verb.is_ascii() && vowels == 1 && is_vowel(before) && !is_vowel(last) && !"wxy".contains(*last)
        }
        _ => false,
    }
}
