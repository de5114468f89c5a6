//! The productions: how the value of a phrase is made from those of its parts. The grammar names them.

mod clauses;
mod days;
mod frequency;
mod measures;
mod numbers;
mod rules;
mod times;
mod verbs;

use super::parts::{Parts, Slot};
use super::value::{Act, Value};
use super::words::{SentenceWord, TextSpan};
use homebody_core::problem::Diagnostic;
use std::sync::Arc;

pub use clauses::unsaid_chance;
pub use verbs::act_of;

/// Makes a value, or nothing where the words do not mean that.
pub type Production = fn(&mut Arguments) -> Option<Value>;

pub struct Kid {
    pub value: Arc<Value>,
    pub span: TextSpan,
}

pub struct Arguments<'a> {
    pub kids: &'a [Kid],
    pub constants: &'a [String],
    pub words: &'a [SentenceWord],
    pub span: TextSpan,
    pub text: &'a str,
    pub faults: Vec<(TextSpan, Diagnostic)>,
}

pub fn named(name: &str) -> Option<Production> {
    let tables: [fn(&str) -> Option<Production>; 8] = [
        numbers::named,
        times::named,
        days::named,
        frequency::named,
        measures::named,
        verbs::named,
        clauses::named,
        rules::named,
    ];
    tables.iter().find_map(|table| table(name))
}

/// The words of a place in the text, for messages.
pub fn said(text: &str, span: TextSpan) -> String {
    const LONGEST: usize = 60;
    let said = text.get(span.start..span.end).unwrap_or_default();
    let said: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
    if said.chars().count() <= LONGEST { said } else { said.chars().take(LONGEST).chain(['.', '.', '.']).collect() }
}

impl<'a> Arguments<'a> {
    fn fault(&mut self, span: TextSpan, message: impl Into<Diagnostic>) {
        self.faults.push((span, message.into()));
    }

    fn said(&self, span: TextSpan) -> String {
        said(self.text, span)
    }

    fn all<T>(&self, wanted: impl Fn(&Value) -> Option<T>) -> Vec<T> {
        self.kids.iter().filter_map(|kid| wanted(&kid.value)).collect()
    }

    fn one<T>(&self, wanted: impl Fn(&Value) -> Option<T>) -> Option<T> {
        self.kids.iter().find_map(|kid| wanted(&kid.value))
    }

    fn numbers(&self) -> Vec<f64> {
        self.all(|value| match value {
            Value::Number(number) => Some(*number),
            _ => None,
        })
    }

    fn constant(&self, at: usize) -> &str {
        self.constants.get(at).map_or("", String::as_str)
    }

    fn has(&self, constant: &str) -> bool {
        self.constants.iter().any(|one| one == constant)
    }

    fn number_constants(&self) -> Vec<f64> {
        self.constants.iter().filter_map(|constant| constant.parse().ok()).collect()
    }

    fn act(&self) -> Option<Act> {
        self.one(|value| match value {
            Value::Act(act) => Some(act.clone()),
            _ => None,
        })
    }

    fn name(&self) -> Option<String> {
        self.one(|value| match value {
            Value::Name(name) => Some(name.clone()),
            _ => None,
        })
    }

    fn slot<T>(&self, value: T) -> Option<Slot<T>> {
        Some(Slot { value, span: self.span, own: true })
    }

    /// The words of the phrase, in small letters.
    fn spoken(&self) -> String {
        self.words.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ")
    }
}

fn parts(parts: Parts) -> Option<Value> {
    Some(Value::Parts(Box::new(parts)))
}
