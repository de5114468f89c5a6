//! The arguments of a production, from which it makes a value.

use crate::language::parts::{Parts, Slot};
use crate::language::value::{Act, PhraseValue};
use crate::language::words::{SentenceWord, TextSpan};
use homebody_core::problem::Diagnostic;
use std::sync::Arc;

/// Makes a value, or nothing where the words do not mean that.
pub type Production = fn(&mut Arguments) -> Option<PhraseValue>;

pub struct Kid {
    pub value: Arc<PhraseValue>,
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

/// The words of a place in the text, for messages.
pub fn said(text: &str, span: TextSpan) -> String {
    const LONGEST: usize = 60;
    let said = text.get(span.start..span.end).unwrap_or_default();
    let said: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
    if said.chars().count() <= LONGEST { said } else { said.chars().take(LONGEST).chain(['.', '.', '.']).collect() }
}

impl<'a> Arguments<'a> {
    pub fn fault(&mut self, span: TextSpan, message: impl Into<Diagnostic>) {
        self.faults.push((span, message.into()));
    }

    pub fn said(&self, span: TextSpan) -> String {
        said(self.text, span)
    }

    pub fn all<T>(&self, wanted: impl Fn(&PhraseValue) -> Option<T>) -> Vec<T> {
        self.kids.iter().filter_map(|kid| wanted(&kid.value)).collect()
    }

    pub fn one<T>(&self, wanted: impl Fn(&PhraseValue) -> Option<T>) -> Option<T> {
        self.kids.iter().find_map(|kid| wanted(&kid.value))
    }

    pub fn numbers(&self) -> Vec<f64> {
        self.all(|value| match value {
            PhraseValue::Number(number) => Some(*number),
            _ => None,
        })
    }

    pub fn constant(&self, at: usize) -> &str {
        self.constants.get(at).map_or("", String::as_str)
    }

    pub fn has(&self, constant: &str) -> bool {
        self.constants.iter().any(|one| one == constant)
    }

    pub fn number_constants(&self) -> Vec<f64> {
        self.constants.iter().filter_map(|constant| constant.parse().ok()).collect()
    }

    pub fn act(&self) -> Option<Act> {
        self.one(|value| match value {
            PhraseValue::Act(act) => Some(act.clone()),
            _ => None,
        })
    }

    pub fn name(&self) -> Option<String> {
        self.one(|value| match value {
            PhraseValue::Name(name) => Some(name.clone()),
            _ => None,
        })
    }

    pub fn slot<T>(&self, value: T) -> Option<Slot<T>> {
        Some(Slot { value, span: self.span, own: true })
    }

    /// The words of the phrase, in small letters.
    pub fn spoken(&self) -> String {
        self.words.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ")
    }
}

pub fn parts(parts: Parts) -> Option<PhraseValue> {
    Some(PhraseValue::Parts(Box::new(parts)))
}
