use crate::alerts::AlertRuleMessage;
use crate::dates::DateMessage;
use crate::density::NoMap;
use crate::falls::rules::FallRuleMessage;
use crate::realism::NotComparable;
use crate::windows::WindowMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};

pub const MESSAGES: &[&[CatalogueEntry]] = &[
    NoMap::ENTRIES,
    NotComparable::ENTRIES,
    AlertRuleMessage::ENTRIES,
    FallRuleMessage::ENTRIES,
    DateMessage::ENTRIES,
    WindowMessage::ENTRIES,
];
