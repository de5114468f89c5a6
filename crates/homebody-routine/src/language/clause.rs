//! A clause: who does what, with what stands behind the verb in any order.

use super::adverbs::Adverbs;
use super::measures::AmountPhrase;
use super::predicate::Predicate;
use super::reader::{SentenceReader, Sort};
use super::subjects::SentenceSubject;
use super::words::TextSpan;

pub const PLACES: [Sort; 3] = [Sort::Place, Sort::Room, Sort::Thing];

#[derive(Clone, Debug)]
pub struct Clause {
    pub span: TextSpan,
    pub subject: SentenceSubject,
    pub predicate: Predicate,
    pub predicate_span: TextSpan,
    pub place: Option<(String, TextSpan)>,
    pub measure: Option<AmountPhrase>,
    pub adverbs: Adverbs,
    pub tends: bool,
    pub again: bool,
    pub beside: Vec<TextSpan>,
    pub finder: Option<(String, TextSpan)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClauseJoin {
    Then,
    And,
    Or,
}

/// "in the armchair".
pub fn place(reader: &mut SentenceReader) -> Option<(String, TextSpan)> {
    let start = reader.at;
    let name = reader.attempt(|reader| if eat_preposition(reader) { reader.name(&PLACES) } else { None })?;
    Some((name, reader.span(start)))
}

pub fn eat_preposition(reader: &mut SentenceReader) -> bool {
    reader.eat("in front of") || reader.eat("next to") || reader.eat("in|on|at|by|near|beside|to|from|into|onto")
}
