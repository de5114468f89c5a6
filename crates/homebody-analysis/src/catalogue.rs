//! The messages of this crate, for lists of all messages.

use crate::alerts::RuleMessage;
use crate::dates::DateMessage;
use crate::density::NoMap;
use crate::falls::rules::FallRuleMessage;
use crate::realism::NotComparable;
use crate::windows::WindowMessage;
use homebody_core::messages::{Catalogue, Entry};

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[
    NoMap::ENTRIES,
    NotComparable::ENTRIES,
    RuleMessage::ENTRIES,
    FallRuleMessage::ENTRIES,
    DateMessage::ENTRIES,
    WindowMessage::ENTRIES,
];
