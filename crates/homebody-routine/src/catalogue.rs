//! The messages of this crate and of scripts, by area.

use crate::language::messages::{
    CheckMessage, LexiconMessage, RuleSentenceMessage, SentenceMessage, TimeSentenceMessage, WordMessage,
};
use crate::messages::{HouseholdMessage, NeedMessage};
use homebody_core::messages::{Catalogue, CatalogueEntry};
use homebody_script::ScriptMessage;

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[
    WordMessage::ENTRIES,
    TimeSentenceMessage::ENTRIES,
    SentenceMessage::ENTRIES,
    RuleSentenceMessage::ENTRIES,
    CheckMessage::ENTRIES,
    LexiconMessage::ENTRIES,
    HouseholdMessage::ENTRIES,
    NeedMessage::ENTRIES,
    ScriptMessage::ENTRIES,
];
