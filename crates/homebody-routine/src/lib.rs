//! A life in plain language, and the living of it.
//!
//! In reading order:

// What a routine says: habits, rules, changes.
pub mod routine;

// How text becomes a routine.
pub mod language;
pub mod explain;
pub mod completion;

// How a diary becomes text.
pub mod rhythm;

// The living of it, and everybody of a scenario who does.
pub mod living;
mod room_for;
mod needs_of_home;
pub mod household;
mod messages;

// The furniture that a home needs besides its own.
pub mod furnished;

use homebody_core::messages::{Catalogue, Entry};
use language::messages as of_language;

/// The messages of this crate and of scripts, by area.
pub const MESSAGES: &[&[Entry]] = &[
    of_language::WordMessage::ENTRIES,
    of_language::TimeMessage::ENTRIES,
    of_language::SentenceMessage::ENTRIES,
    of_language::RuleMessage::ENTRIES,
    of_language::CheckMessage::ENTRIES,
    of_language::LexiconMessage::ENTRIES,
    messages::HouseholdMessage::ENTRIES,
    messages::NeedMessage::ENTRIES,
    homebody_script::ScriptMessage::ENTRIES,
];
