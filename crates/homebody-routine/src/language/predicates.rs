//! Who does what: the subject of a sentence and its verb.

use super::activities;
use super::adverbs::Adverbs;
use super::amounts::{Unit, amount};
use super::faults::did_you_mean;
use super::measures::{Measure, Of, measure, rises_by};
use super::reader::{Reader, Sort, is_determiner};
use super::words::{Span, Token};
use crate::routine::{Activity, Kind};
use homebody_core::scenario::nearest::nearest;

/// Who or what a sentence is about.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// The person, by pronoun or name.
    Person,
    /// Somebody who visits, such as `daughter`.
    Visitor(String),
    /// A name that is not the person's.
    Stranger(String),
    /// At which hours things are done.
    Hours,
    Pulse,
    Breathing,
}

/// What is said of the subject.
#[derive(Clone, Debug, PartialEq)]
pub enum Predicate {
    Age(f64),
    Kind(Kind),
    /// "is", with a measure still to come.
    Is,
    /// "walks", with a measure or a speed still to come.
    Walks,
    Pace(super::amounts::Amount),
    Does(Activity),
    /// Words for something of the user's own.
    Own(String),
    Visits,
    Not(Activity),
    Skips(Activity),
    Shows(String, f64),
    Forgets(String),
    /// "sleeps" or "turns in bed", with a measure still to come.
    Sleeps,
    /// "vary", with a measure still to come.
    Vary,
    Rises(Measure),
    /// "breathes", with a measure still to come.
    Breathes,
}

const HOURS: &str = "hours|times|days|day|routine";
pub const VISITS: [&str; 9] = [
    "visits|visit her|him|them|it",
    "visits|visit",
    "comes|come to visit|help",
    "comes|come to see|visit her|him|them",
    "comes|come to help her|him|them",
    "comes|come by|over|round|in|around",
    "comes|come",
    "drops|drop by|in",
    "calls|call in|by|round",
];

/// The subject, if a sentence has one here.
pub fn subject(reader: &mut Reader) -> Option<Subject> {
    if reader.eat("she|he|they|it") || reader.eat("the person|resident|patient") {
        return Some(Subject::Person);
    }
    match reader.person() {
        Some(false) => return Some(Subject::Person),
        Some(true) => return of_the_person(reader),
        None => {}
    }
    if ["her", "his", "their", "its"].contains(&reader.peek(0)) {
        return reader.attempt(|reader| {
            reader.at += 1;
            of_the_person(reader)
        });
    }
    if is_determiner(reader.peek(0)) {
        return reader.attempt(|reader| {
            reader.at += 1;
            visitor(reader)
        });
    }
    None
}

/// "her daughter", "her pulse", "her hours".
fn of_the_person(reader: &mut Reader) -> Option<Subject> {
    if reader.eat("pulse") || reader.eat("heart rate") || reader.eat("heart beats|beat") || reader.eat("heart") {
        return Some(Subject::Pulse);
    }
    if reader.eat("breathing|respiration|breath") {
        return Some(Subject::Breathing);
    }
    if reader.eat(HOURS) {
        return Some(Subject::Hours);
    }
    visitor(reader)
}

/// A few words, up to the verb.
fn visitor(reader: &mut Reader) -> Option<Subject> {
    const MOST: usize = 5;
    let from = reader.at;
    while reader.at < from + MOST && reader.token(0) == Some(Token::Word) {
        let at = reader.at;
        if at > from {
            let mut between = Adverbs::default();
            between.all(reader);
            let visits = visits(reader);
            reader.at = at;
            if visits || activities::activity(reader).is_some() || reader.eat("is|has|does|stays") {
                reader.at = at;
                let words: Vec<&str> = reader.words[from..at].iter().map(|word| word.text.as_str()).collect();
                return Some(Subject::Visitor(words.join(" ")));
            }
        }
        reader.at += 1;
    }
    None
}

pub fn visits(reader: &mut Reader) -> bool {
    VISITS.iter().any(|phrase| reader.eat(phrase))
}

/// What is said of the person, if it is understood; `adverbs` takes what stands within.
pub fn predicate(reader: &mut Reader, adverbs: &mut Adverbs) -> Option<Predicate> {
    if reader.eat("is|are") {
        return Some(being(reader, adverbs));
    }
    let not = reader.eat("does|do not") || reader.eat("doesn't|don't|never") || reader.eat("no longer");
    if not {
        reader.eat("ever");
        return negated(reader);
    }
    for read in [walking, changing, illness, forgetting, skipping] {
        if let Some(found) = reader.attempt(read) {
            return Some(found);
        }
    }
    if let Some(activity) = activities::activity(reader) {
        if activity == Activity::ComeHome || activity == Activity::Leave {
            reader.attempt(|reader| (reader.eat("from") && reader.name(&[Sort::Place]).is_some()).then_some(()));
        }
        return Some(Predicate::Does(activity));
    }
    reader.eat("walks|walk").then_some(Predicate::Walks)
}

/// "walks" where a speed or a change of it follows.
fn walking(reader: &mut Reader) -> Option<Predicate> {
    if !reader.eat("walks|walk") {
        return None;
    }
    let pace = reader.attempt(|reader| {
        reader.eat("at");
        let pace = amount(reader).filter(|amount| amount.unit == Unit::Speed)?;
        (!["slower", "faster", "quicker"].contains(&reader.peek(0))).then_some(pace)
    });
    if pace.is_some() {
        return pace.map(Predicate::Pace);
    }
    let (at, faults) = (reader.at, reader.faults.count());
    let changes = measure(reader).is_some();
    reader.at = at;
    reader.faults.forget_since(faults);
    changes.then_some(Predicate::Walks)
}

fn being(reader: &mut Reader, adverbs: &mut Adverbs) -> Predicate {
    adverbs.all(reader);
    let kind = reader.attempt(|reader| {
        reader.skip_determiners();
        reader.eat_any(&[
            ("cat", Kind::Cat),
            ("dog", Kind::Dog),
            ("person|woman|man|lady|gentleman|human", Kind::Person),
        ])
    });
    if let Some(kind) = kind {
        return Predicate::Kind(kind);
    }
    let age = reader.attempt(|reader| {
        let age = amount(reader)?;
        let is_age = age.unit == Unit::Years || age.unit == Unit::None && reader.at >= reader.words.len();
        let is_age = is_age || age.unit == Unit::None && reader.token(0) == Some(Token::Comma);
        is_age.then_some(age)
    });
    if let Some(age) = age {
        if age.from <= 0.0 || age.to > 130.0 {
            let hint = "say the age in years, such as \"is 82\"".to_owned();
            reader.fault(age.span, format!("nobody is {}", reader.said(age.span)), hint);
        }
        return Predicate::Age(age.from);
    }
    if reader.eat("out|away|outside") {
        return Predicate::Does(Activity::Leave);
    }
    Predicate::Is
}

fn negated(reader: &mut Reader) -> Option<Predicate> {
    activities::activity(reader).map(Predicate::Not)
}

fn changing(reader: &mut Reader) -> Option<Predicate> {
    for phrase in ["sleeps|sleep", "turns|turn in bed", "turns|turn over in bed", "tosses|toss and turns|turn"] {
        if reader.eat(phrase) {
            reader.eat("in bed");
            return Some(Predicate::Sleeps);
        }
    }
    reader.eat("breathes|breathe").then_some(Predicate::Breathes)
}

/// What severity these words stand for; without one, a case is moderate.
pub const SEVERITIES: [(&str, f64); 3] =
    [("mild|slight|light", 0.5), ("moderate", 1.0), ("severe|serious|strong", 1.5)];

/// "has depression": only what is known, since much else can be had.
fn has_condition(reader: &mut Reader) -> Option<Predicate> {
    if !reader.eat("has|have") {
        return None;
    }
    reader.skip_determiners();
    let severity = reader.eat_any(&SEVERITIES).unwrap_or(1.0);
    reader.name(&[Sort::Condition]).map(|name| Predicate::Shows(name, severity))
}

fn illness(reader: &mut Reader) -> Option<Predicate> {
    if let Some(found) = reader.attempt(has_condition) {
        return Some(found);
    }
    if !(reader.eat("shows|show|develops|develop") || reader.eat("suffers|suffer from") || reader.eat("has signs of")) {
        return None;
    }
    reader.eat("signs of");
    reader.skip_determiners();
    let severity = reader.eat_any(&SEVERITIES).unwrap_or(1.0);
    if let Some(name) = reader.name(&[Sort::Condition]) {
        return Some(Predicate::Shows(name, severity));
    }
    let from = reader.at;
    let stops = |reader: &Reader| reader.is_over() || reader.token(0) != Some(Token::Word) || begins_adverb(reader);
    while !stops(reader) && reader.at < from + 4 {
        reader.at += 1;
    }
    let span = reader.span(from);
    let said = if reader.at == from { "this".to_owned() } else { format!("{:?}", reader.said(span)) };
    let hint = did_you_mean(&reader.said(span).to_lowercase(), reader.names.of(&[Sort::Condition]));
    reader.fault(span, format!("{said} is no condition that Homebody knows"), hint);
    Some(Predicate::Shows(String::new(), severity))
}

/// "forgets the stove", "leaves the fridge open".
fn forgetting(reader: &mut Reader) -> Option<Predicate> {
    if reader.eat("leaves|leave") {
        let thing = reader.name(&[Sort::Thing])?;
        return reader.eat("open|on|running|ajar").then_some(Predicate::Forgets(thing));
    }
    if !reader.eat("forgets|forget") {
        return None;
    }
    let verb = reader.eat("to turn|switch off") || reader.eat("to close|shut|turn|switch");
    let thing = thing(reader);
    if verb {
        reader.eat("off");
    }
    Some(Predicate::Forgets(thing))
}

/// A thing of this home; a fault where there is none.
pub fn thing(reader: &mut Reader) -> String {
    if let Some(thing) = reader.name(&[Sort::Thing]) {
        return thing;
    }
    unknown_name(reader, &[Sort::Thing], "nothing that this home has")
}

/// Passes over the words of a name that nothing has.
pub fn unknown_name(reader: &mut Reader, sorts: &[Sort], what: &str) -> String {
    reader.skip_determiners();
    let from = reader.at;
    while !reader.is_over() && reader.token(0) != Some(Token::Comma) && !begins_adverb(reader) && reader.at < from + 4 {
        reader.at += 1;
    }
    let span = if reader.at == from { reader.here() } else { reader.span(from) };
    let said = reader.said(span);
    let hint = did_you_mean(&said.to_lowercase(), reader.names.of(sorts));
    reader.fault(span, format!("{said:?} is {what}"), hint);
    said
}

fn skipping(reader: &mut Reader) -> Option<Predicate> {
    if !reader.eat("skips|skip|misses|miss") {
        return None;
    }
    activities::event(reader).map(Predicate::Skips)
}

/// What is said of a pulse, of breathing or of hours.
pub fn of_body(reader: &mut Reader, subject: &Subject) -> Option<Predicate> {
    match subject {
        Subject::Pulse => {
            reader.eat("beats|beat");
            let rises = rises_by(reader, Of::Beats);
            rises.or_else(|| measure(reader)).map(Predicate::Rises)
        }
        Subject::Breathing => {
            let rises = rises_by(reader, Of::Breaths);
            rises.or_else(|| measure(reader)).map(Predicate::Rises)
        }
        Subject::Hours => (reader.eat("vary|varies|change|changes|are|is")).then_some(Predicate::Vary),
        _ => None,
    }
}

/// Words of the user's own for something that is done, up to where or when it is done.
pub fn own_words(reader: &mut Reader) -> Option<(String, Span)> {
    const MOST: usize = 6;
    let from = reader.at;
    let goes_on = |reader: &Reader| reader.token(0) == Some(Token::Word) && !begins_adverb(reader);
    while goes_on(reader) && reader.at < from + MOST {
        reader.at += 1;
    }
    if reader.at == from || goes_on(reader) {
        reader.at = from;
        return None;
    }
    let words: Vec<&str> = reader.words[from..reader.at].iter().map(|word| word.text.as_str()).collect();
    Some((words.join(" "), reader.span(from)))
}

/// Words that begin a place, a time, how often or how much.
const BEGINNINGS: [&str; 53] = [
    "in",
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

pub fn begins_adverb(reader: &Reader) -> bool {
    matches!(reader.token(0), Some(Token::Number(_) | Token::Clock(..) | Token::Date(..)))
        || BEGINNINGS.contains(&reader.peek(0))
}

/// Says that nobody knows how to do this, with what was probably meant.
pub fn unknown_verb(reader: &mut Reader, words: &str, span: Span) {
    let example = "a new activity needs a place and a duration: \"she knits in the armchair for 1 hour\"";
    let hint = match meant(words) {
        Some(phrase) => format!("did you mean {phrase:?}? {}", capital(example)),
        None => example.to_owned(),
    };
    let said = reader.said(span);
    reader.fault(span, format!("{said:?} is nothing that Homebody knows how to do"), hint);
}

/// The phrase that these words are probably a slip of.
pub fn meant(words: &str) -> Option<String> {
    let words: Vec<&str> = words.split(' ').filter(|word| !is_determiner(word)).collect();
    let phrases = activities::all_phrases();
    let verbs = ["shows", "skips", "forgets", "sleeps", "breathes", "walks", "turns in bed", "prepares", "visits"];
    let all = phrases.iter().map(String::as_str).chain(verbs);
    // As many words of what was said as the phrase has; the longest phrase that is near wins.
    let mut best: Option<(usize, &str)> = None;
    for phrase in all {
        let length = phrase.split(' ').count();
        let said = words.get(..length).map(|words| words.join(" "));
        let is_near = said.is_some_and(|said| is_slip(&said, phrase) && nearest(&said, [phrase]).is_some());
        if is_near && best.is_none_or(|(longest, _)| length > longest) {
            best = Some((length, phrase));
        }
    }
    best.map(|(_, phrase)| phrase.to_owned())
}

/// Whether two phrases differ as slips do: most letters are the same, in order.
fn is_slip(said: &str, phrase: &str) -> bool {
    let (same, longer) = same_letters(said, phrase);
    same + 2 >= longer
}

/// Whether these words are a phrase but for a letter in each: too near to be something new.
pub fn is_nearly_known(words: &str) -> bool {
    let words: Vec<&str> = words.split(' ').filter(|word| !is_determiner(word)).collect();
    let near = |(said, known): (&&str, &str)| {
        let (same, longer) = same_letters(said, known);
        **said == *known || longer >= 4 && same + 1 >= longer
    };
    let is_near =
        |phrase: &String| phrase.split(' ').count() <= words.len() && words.iter().zip(phrase.split(' ')).all(near);
    activities::all_phrases().iter().any(is_near)
}

/// How many letters agree at the two ends of both, and how many the longer one has.
fn same_letters(a: &str, b: &str) -> (usize, usize) {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let shorter = a.len().min(b.len());
    let front = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
    let back = a.iter().rev().zip(b.iter().rev()).take(shorter - front).take_while(|(a, b)| a == b).count();
    (front + back, a.len().max(b.len()))
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|first| first.to_uppercase().chain(chars).collect()).unwrap_or_default()
}
