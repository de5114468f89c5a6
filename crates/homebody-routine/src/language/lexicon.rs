//! The words of the language: read once from `english.words`, and from the words of a scenario's own.
//!
//! A file has sections. Those of activities list ways of saying them, those in capitals list words that ways name, other
//! names of rooms and furniture, verbs without rules, and what is said in other words. `english.words` begins with how
//! these are written.

use super::messages::LexiconMessage;
use super::words::{self, SentenceWord, Token};
use crate::routine::Activity;
use homebody_core::nearest::nearest;
use homebody_core::problem::{Excerpt, Problem};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, LazyLock};

const ENGLISH: &str = include_str!("english.words");

pub const OWN_FILE: &str = "own.words";
/// Largest number of lines, and of characters of a line.
pub const MOST_LINES: usize = 2_000;
const LONGEST_LINE: usize = 300;

static BUILT_IN: LazyLock<Lexicon> = LazyLock::new(|| {
    let (words, problems) = LexiconWords::default().and("english.words", ENGLISH);
    debug_assert!(problems.is_empty(), "{problems:?}");
    Lexicon(Arc::new(words))
});

#[derive(Clone, Debug, PartialEq)]
pub struct Lexicon(Arc<LexiconWords>);

impl Default for Lexicon {
    fn default() -> Lexicon {
        BUILT_IN.clone()
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
        &BUILT_IN
    }

    pub fn with(&self, file: &str, text: &str) -> (Lexicon, Vec<Problem>) {
        let (words, problems) = LexiconWords::clone(&self.0).and(file, text);
        (Lexicon(Arc::new(words)), problems)
    }
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct LexiconWords {
    pub ways: Vec<(LexiconPhrase, Activity)>,
    first: BTreeMap<String, Vec<usize>>,
    pub nouns: Vec<(LexiconPhrase, Activity)>,
    pub means: Vec<(LexiconPhrase, String)>,
    first_of_means: BTreeMap<String, Vec<usize>>,
    lists: BTreeMap<String, Vec<LexiconEntry>>,
    names: Vec<(LexiconEntry, Vec<String>)>,
    verbs: BTreeMap<String, String>,
    past: BTreeMap<String, String>,
    hints: Vec<(LexiconPhrase, String)>,
    roughly: Vec<(LexiconPhrase, String)>,
    usual: Vec<(Activity, String)>,
    pub own: BTreeMap<String, OwnActivity>,
    lines: BTreeSet<String>,
}

type LexiconEntry = Vec<Vec<String>>;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct OwnActivity {
    pub minutes: Option<f64>,
    pub place: Option<String>,
    pub line: u32,
}

#[derive(Clone, Debug, PartialEq)]
pub struct LexiconPhrase {
    pub pieces: Vec<PhrasePiece>,
    pub written: String,
}

#[derive(Clone, Debug, PartialEq)]
pub struct PhrasePiece {
    pub is: PieceKind,
    pub optional: bool,
    pub after_others: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub enum PieceKind {
    Verb(BTreeSet<String>),
    Word(Vec<String>),
    List(String),
    Oneself,
    Whom,
    Host,
    More,
}

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

impl LexiconWords {
    pub fn beginning<'a>(&'a self, word: &str) -> impl Iterator<Item = &'a (LexiconPhrase, Activity)> {
        self.first.get(word).into_iter().flatten().map(|&index| &self.ways[index])
    }

    pub fn meaning<'a>(&'a self, word: &str) -> impl Iterator<Item = &'a (LexiconPhrase, String)> {
        self.first_of_means.get(word).into_iter().flatten().map(|&index| &self.means[index])
    }

    pub fn list<'w>(&self, name: &str, words: impl Fn(usize) -> &'w str) -> Option<usize> {
        let fits = |entry: &&LexiconEntry| {
            entry.iter().enumerate().all(|(at, either)| either.iter().any(|one| one == words(at)))
        };
        self.lists.get(name)?.iter().filter(fits).map(Vec::len).max()
    }

    pub fn has_last(&self, name: &str, words: &str) -> bool {
        let last = words.rsplit(' ').next().unwrap_or_default();
        self.list(name, |at| if at == 0 { last } else { "" }).is_some()
    }

    pub fn other_names<'w>(&self, words: impl Fn(usize) -> &'w str) -> Vec<(usize, &[String])> {
        let fits = |entry: &LexiconEntry| {
            entry.iter().enumerate().all(|(at, either)| either.iter().any(|one| one == words(at)))
        };
        let found = self.names.iter().filter(|(entry, _)| fits(entry));
        let mut found: Vec<(usize, &[String])> = found.map(|(entry, name)| (entry.len(), name.as_slice())).collect();
        found.sort_by_key(|(length, _)| std::cmp::Reverse(*length));
        found
    }

    pub fn usual(&self, activity: &Activity) -> Option<&str> {
        self.usual.iter().find(|(known, _)| known == activity).map(|(_, said)| said.as_str())
    }

    pub fn told(&self) -> impl Iterator<Item = &str> {
        self.usual.iter().map(|(_, said)| said.as_str())
    }

    pub fn participle(&self, verb: &str) -> Option<&str> {
        self.verbs.get(verb).map(String::as_str)
    }

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

    pub fn verb_of_past(&self, word: &str) -> Option<String> {
        let of_list = self.past.get(word).cloned();
        let of_rule = || {
            let verb = self.verb_of_participle(word).filter(|verb| word.ends_with("ed") && regular(verb) == word)?;
            self.is_third_person(&third_person(&verb)).then_some(verb)
        };
        of_list.or_else(of_rule)
    }

    pub fn hinted<'a>(&'a self, word: &'a str) -> impl Iterator<Item = &'a (LexiconPhrase, String)> {
        self.hints.iter().filter(move |(way, _)| begins_with(way, word))
    }

    pub fn roughly<'a>(&'a self, word: &'a str) -> impl Iterator<Item = &'a (LexiconPhrase, String)> {
        self.roughly.iter().filter(move |(way, _)| begins_with(way, word))
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

    fn way(&self, written: &str) -> Result<LexiconPhrase, LexiconMessage> {
        let pieces: Vec<PhrasePiece> = written.split(' ').map(|piece| self.piece(piece)).collect();
        match pieces.first().map(|piece| (&piece.is, piece.optional)) {
            Some((PieceKind::Verb(_) | PieceKind::Word(_), false)) => {
                Ok(LexiconPhrase { pieces, written: written.to_owned() })
            }
            _ => Err(LexiconMessage::NoFirstWord { text: written.to_owned() }),
        }
    }

    fn piece(&self, written: &str) -> PhrasePiece {
        let optional = written.starts_with('[');
        let inner = written.trim_matches(['[', ']']);
        let after_others = inner.starts_with('*');
        let inner = inner.trim_start_matches('*');
        let is = match inner {
            "SELF" => PieceKind::Oneself,
            "WHOM" => PieceKind::Whom,
            "HOST" => PieceKind::Host,
            "..." => PieceKind::More,
            _ if inner.split('|').all(is_list) => {
                PieceKind::List(inner.split('|').next().unwrap_or_default().to_owned())
            }
            _ => match inner.strip_prefix('~') {
                Some(verbs) => PieceKind::Verb(verbs.split('|').flat_map(|verb| self.forms(verb)).collect()),
                None => PieceKind::Word(inner.split('|').map(str::to_owned).collect()),
            },
        };
        PhrasePiece { is, optional: optional || inner == "...", after_others }
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
        fn index<T>(ways: &[(LexiconPhrase, T)]) -> BTreeMap<String, Vec<usize>> {
            let mut first: BTreeMap<String, Vec<usize>> = BTreeMap::new();
            for (at, (way, _)) in ways.iter().enumerate() {
                match way.pieces.first().map(|piece| &piece.is) {
                    Some(PieceKind::Verb(forms)) => {
                        forms.iter().for_each(|word| first.entry(word.clone()).or_default().push(at))
                    }
                    Some(PieceKind::Word(either)) => {
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

fn is_form(way: &LexiconPhrase, word: &str) -> bool {
    matches!(way.pieces.first().map(|piece| &piece.is), Some(PieceKind::Verb(forms)) if forms.contains(word))
}

fn begins_with(way: &LexiconPhrase, word: &str) -> bool {
    match way.pieces.first().map(|piece| &piece.is) {
        Some(PieceKind::Verb(forms)) => forms.contains(word),
        Some(PieceKind::Word(either)) => either.iter().any(|one| one == word),
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

fn bare(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

fn is_list(name: &str) -> bool {
    name.len() > 1 && name.chars().all(|c| c.is_ascii_uppercase())
}

fn entry(line: &str) -> LexiconEntry {
    line.split(' ').map(|either| either.split('|').map(str::to_owned).collect()).collect()
}

pub fn words_of(text: &str, at: &SentenceWord) -> Vec<SentenceWord> {
    let words = words::of_name(text).into_iter();
    words
        .map(|word| SentenceWord { span: at.span, ..word })
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
