//! The subject of a sentence: the person, a visitor, an unknown name, a pulse.

use super::activities;
use super::adverbs::Adverbs;
use super::help::{seeing_to, visiting};
use super::person_word::person_called;
use super::reader::{SentenceReader, is_determiner};
use super::remarks::remark;
use super::words::Token;

#[derive(Clone, Debug, PartialEq)]
pub enum SentenceSubject {
    Person,
    Visitor(String),
    Stranger(String),
    /// At which hours things are done.
    Hours,
    Pulse,
    Breathing,
}

pub const WRITERS: &str = "family";

/// "We visit her", "I ring Mum every night".
fn writers(reader: &mut SentenceReader) -> Option<SentenceSubject> {
    let others = ["her", "him", "she", "he", "mum", "mom", "dad"];
    let of_others = reader.words.iter().any(|word| others.contains(&word.text.as_str()));
    (reader.eat("we") || of_others && reader.eat("i")).then(|| SentenceSubject::Visitor(WRITERS.to_owned()))
}

pub fn called(reader: &mut SentenceReader) -> bool {
    person_called(reader) || reader.person() == Some(false)
}

const HOURS: &str = "hours|times|days|day|routine";

pub fn subject(reader: &mut SentenceReader) -> Option<SentenceSubject> {
    if reader.eat("she|he|they|it") || person_called(reader) {
        return Some(SentenceSubject::Person);
    }
    if let Some(writers) = reader.attempt(writers) {
        return Some(writers);
    }
    if let Some(owner) = reader.peek(0).strip_suffix("'s")
        && reader.names.lexicon.list("PERSON", |at| if at == 0 { owner } else { "" }).is_some()
    {
        return reader.attempt(|reader| {
            reader.at += 1;
            of_the_person(reader)
        });
    }
    let of_titled = |reader: &mut SentenceReader| {
        reader.eat("mr|mrs|ms|miss").then_some(())?;
        reader.peek(0).strip_suffix("'s")?;
        reader.at += 1;
        of_the_person(reader)
    };
    if let Some(of_person) = reader.attempt(of_titled) {
        return Some(of_person);
    }
    let of_called = |reader: &mut SentenceReader| {
        reader.eat("the|my|our").then_some(())?;
        let owner = reader.peek(0).strip_suffix("'s")?.to_owned();
        reader.names.lexicon.list("PERSON", |at| if at == 0 { &owner } else { "" })?;
        reader.at += 1;
        of_the_person(reader)
    };
    if let Some(of_person) = reader.attempt(of_called) {
        return Some(of_person);
    }
    if let Some(people) = reader.attempt(people).or_else(|| reader.attempt(relative)) {
        return Some(people);
    }
    if let Some(topic) = reader.attempt(topic) {
        return Some(topic);
    }
    match reader.person() {
        Some(false) => return Some(SentenceSubject::Person),
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
fn of_the_person(reader: &mut SentenceReader) -> Option<SentenceSubject> {
    if reader.eat("pulse") || reader.eat("heart rate") || reader.eat("heart beats|beat") || reader.eat("heart") {
        return Some(SentenceSubject::Pulse);
    }
    if reader.eat("breathing|respiration|breath") {
        return Some(SentenceSubject::Breathing);
    }
    if reader.eat(HOURS) {
        return Some(SentenceSubject::Hours);
    }
    visitor(reader)
}

/// "Mobility", "short term memory": what notes say something of.
fn topic(reader: &mut SentenceReader) -> Option<SentenceSubject> {
    const LONGEST: usize = 3;
    let from = reader.at;
    let lexicon = reader.names.lexicon.clone();
    while reader.at < from + LONGEST && reader.token(0) == Some(Token::Word) {
        let is_topic = lexicon.list("TOPICS", |at| if at == 0 { reader.peek(0) } else { "" }).is_some();
        reader.at += 1;
        if is_topic {
            return reader
                .ahead(|reader| reader.eat("is|are|has|have|can|remains|varies|was|fluctuates|gets|becomes"))
                .then(|| SentenceSubject::Visitor(reader.passed(from)));
        }
    }
    None
}

/// "Meals on Wheels", "two carers": those whom everybody knows.
fn people(reader: &mut SentenceReader) -> Option<SentenceSubject> {
    let from = reader.at;
    reader.eat("two|three|both|2|3");
    one_of(reader, "PEOPLE", from)
}

/// "Daughter visits", of notes.
fn relative(reader: &mut SentenceReader) -> Option<SentenceSubject> {
    let from = reader.at;
    one_of(reader, "RELATIVES", from)
}

fn one_of(reader: &mut SentenceReader, list: &str, from: usize) -> Option<SentenceSubject> {
    reader.at += reader.names.lexicon.list(list, |ahead| reader.peek(ahead))?;
    let name = reader.passed(from);
    reader.ahead(visitor_verb).then_some(SentenceSubject::Visitor(name))
}

fn visitor_verb(reader: &mut SentenceReader) -> bool {
    Adverbs::default().all(reader);
    reader.eat("also|usually|often|still|no");
    reader.ahead(|reader| visiting(reader).is_some())
        || reader.ahead(|reader| seeing_to(reader).is_some())
        || reader.ahead(|reader| activities::activity(reader).is_some())
        || reader.ahead(|reader| remark(reader).is_some())
        || reader.eat("is|are|has|does|stays|helps")
}

fn visitor(reader: &mut SentenceReader) -> Option<SentenceSubject> {
    const MOST: usize = 5;
    if let Some(people) = reader.attempt(people) {
        return Some(people);
    }
    let from = reader.at;
    while reader.at < from + MOST && reader.token(0) == Some(Token::Word) {
        if reader.at > from && reader.ahead(visitor_verb) {
            return Some(SentenceSubject::Visitor(reader.passed(from)));
        }
        // "Her niece lives nearby and visits" names no niece who lives nearby.
        if reader.peek(0) == "and" && !is_determiner(reader.peek(1)) {
            return None;
        }
        reader.at += 1;
    }
    None
}
