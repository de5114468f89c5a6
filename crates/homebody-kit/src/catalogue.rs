//! The messages of this crate, for lists of all messages.

use crate::error::Error;
use crate::find::Unfindable;
use homebody_core::messages::{Catalogue, Entry};

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[Error::ENTRIES, Unfindable::ENTRIES];
