//! The messages of this crate, for lists of all messages.

use crate::messages::{Catalogue, Entry};

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[crate::scenario::scheme::PlaceMessage::ENTRIES];
