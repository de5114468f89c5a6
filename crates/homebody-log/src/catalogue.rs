//! The messages of this crate, for lists of all messages.

use crate::error::LogError;
use homebody_core::messages::{Catalogue, Entry};

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[LogError::ENTRIES];
