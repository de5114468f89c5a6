//! The messages of this crate and of scripts, for lists of all messages.

use crate::language::messages::{CheckMessage, LexiconMessage, RuleMessage, SentenceMessage, TimeMessage, WordMessage};
use crate::messages::{HouseholdMessage, NeedMessage};
use homebody_core::messages::{Catalogue, Entry};
use homebody_script::ScriptMessage;

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[
    WordMessage::ENTRIES,
    TimeMessage::ENTRIES,
    SentenceMessage::ENTRIES,
    RuleMessage::ENTRIES,
    CheckMessage::ENTRIES,
    LexiconMessage::ENTRIES,
    HouseholdMessage::ENTRIES,
    NeedMessage::ENTRIES,
    ScriptMessage::ENTRIES,
];
