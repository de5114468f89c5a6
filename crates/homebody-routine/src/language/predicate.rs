//! Predicates, and the words that several forms of sentences share.

use super::activities;
use super::amounts::Amount;
use super::calendar::is_weekday;
use super::measures::AmountPhrase;
use super::reader::{SentenceReader, Sort, begins_adverb, is_determiner};
use super::words::{TextSpan, Token};
use crate::routine::{Activity, DayKind, Falling, ResidentKind, Shy};
use homebody_core::activity::Help;

#[derive(Clone, Debug, PartialEq)]
pub enum Predicate {
    Age(f64),
    Kind(ResidentKind),
    /// "is", with a measure still to come.
    Is,
    /// "walks", with a measure or a speed still to come.
    Walks,
    Pace(Amount),
    Does(Activity),
    Falls(Falling),
    Own(String),
    Visits,
    Not(Activity),
    Skips(Activity),
    Shows(String, f64),
    Forgets(String),
    /// "sleeps" or "turns in bed", with a measure still to come.
    Sleeps,
    /// "has a quiet day", "has very quiet days".
    Lively(DayKind, bool),
    /// "differ", of days, with a measure still to come.
    Differ,
    /// "sleeps in after late nights".
    SleepsIn,
    /// "vary", with a measure still to come.
    Vary,
    Rises(AmountPhrase),
    /// "breathes", with a measure still to come.
    Breathes,
    Shy(Shy),
    Helps(Activity, Help),
    HelpedBy(String, Activity),
    VisitedBy(String),
    Unfinished(Activity),
    Remark,
}

/// Passes over who is named, "district nurse", "Meals on Wheels", up to where or when something is.
pub fn named(reader: &mut SentenceReader) -> Option<String> {
    const MOST: usize = 4;
    let from = reader.at;
    while reader.token(0) == Some(Token::Word)
        && !begins_adverb(reader)
        && !is_weekday(reader.peek(0))
        && reader.at < from + MOST
    {
        // "Meals on Wheels" is one name.
        reader.at += reader.names.lexicon.list("PEOPLE", |ahead| reader.peek(ahead)).unwrap_or(1);
    }
    (reader.at > from).then(|| reader.passed(from))
}

pub fn own_words(reader: &mut SentenceReader) -> Option<(String, TextSpan)> {
    const MOST: usize = 6;
    let from = reader.at;
    let goes_on = |reader: &mut SentenceReader| {
        let is_object = reader.at > from && is_spoken_to(reader);
        reader.token(0) == Some(Token::Word) && (is_object || !begins_adverb(reader))
    };
    while goes_on(reader) && reader.at < from + MOST {
        reader.at += 1;
    }
    const NO_DOING: [&str; 9] = ["not", "never", "will", "would", "can", "cannot", "may", "might", "no"];
    let is_doing = !reader.words[from..reader.at].iter().any(|word| NO_DOING.contains(&word.text.as_str()));
    if reader.at == from || goes_on(reader) || !is_doing {
        reader.at = from;
        return None;
    }
    let words: Vec<&str> = reader.words[from..reader.at].iter().map(|word| word.text.as_str()).collect();
    Some((words.join(" "), reader.span(from)))
}

/// "to the radio", of who listens to it: no way to a place, and no purpose.
fn is_spoken_to(reader: &mut SentenceReader) -> bool {
    let verb = reader.at.checked_sub(1).and_then(|verb| reader.words.get(verb)).map_or("", |word| &word.text);
    let moves = ["go", "walk", "move", "come", "get", "sit"].iter().any(|known| activities::is_form(known, verb));
    let is_noun = is_determiner(reader.peek(1)) || reader.peek(1) == "music";
    !moves
        && reader.peek(0) == "to"
        && is_noun
        && !reader.ahead(|reader| {
            reader.at += 1;
            reader.name(&[Sort::Place, Sort::Room, Sort::Thing]).is_some()
        })
}
