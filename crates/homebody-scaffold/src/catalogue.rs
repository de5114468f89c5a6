//! The messages of this crate, for lists of all messages.

use crate::error::ScaffoldError;
use crate::messages::NewMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The errors of the area `kit`, which several crates share.
pub const ERRORS: &[CatalogueEntry] = ScaffoldError::ENTRIES;

pub const MESSAGES: &[&[CatalogueEntry]] = &[NewMessage::ENTRIES];
