//! The messages of this crate, for lists of all messages.

use crate::error::NotImported;
use crate::from_log::Unsaid;
use homebody_core::messages::{Catalogue, Entry};

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[NotImported::ENTRIES, Unsaid::ENTRIES];
