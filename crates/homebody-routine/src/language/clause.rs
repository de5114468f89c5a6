//! A clause: who does what, with what stands behind the verb in any order.

use super::adverbs::Adverbs;
use super::measures::Measure;
use super::reader::{Reader, Sort};
use super::said::Predicate;
use super::subjects::Subject;
use super::words::Span;

/// What a habit may be said to be done at.
pub const PLACES: [Sort; 3] = [Sort::Place, Sort::Room, Sort::Thing];

/// A clause with all that was said in it.
#[derive(Clone, Debug)]
pub struct Clause {
    pub span: Span,
    pub subject: Subject,
    pub predicate: Predicate,
    pub predicate_span: Span,
    pub place: Option<(String, Span)>,
    pub measure: Option<Measure>,
    pub adverbs: Adverbs,
    /// Whether it is what somebody likes to do, or mostly does.
    pub tends: bool,
    /// Whether it goes on with the verb of the clause before it.
    pub again: bool,
    /// What is said beside it and not lived: why it is so, or what stands between brackets.
    pub beside: Vec<Span>,
    /// Who finds them, of a fall, if it is said.
    pub finder: Option<(String, Span)>,
}

/// What joins a clause with another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Join {
    Then,
    And,
    Or,
}

/// "in the armchair".
pub fn place(reader: &mut Reader) -> Option<(String, Span)> {
    let start = reader.at;
    let name = reader.attempt(|reader| if eat_preposition(reader) { reader.name(&PLACES) } else { None })?;
    Some((name, reader.span(start)))
}

pub fn eat_preposition(reader: &mut Reader) -> bool {
    reader.eat("in front of") || reader.eat("next to") || reader.eat("in|on|at|by|near|beside|to|from|into|onto")
}
