//! The messages about routines and conditions, by the part of a text that they are about.

mod checks;
mod lexicon;
mod rules;
mod sentences;
mod times;
mod words;

pub use checks::CheckMessage;
pub use lexicon::LexiconMessage;
pub use rules::RuleSentenceMessage;
pub use sentences::SentenceMessage;
pub use times::TimeSentenceMessage;
pub use words::WordMessage;
