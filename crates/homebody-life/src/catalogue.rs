//! The messages of this crate, for lists of all messages.

use crate::messages::{FreeTextError, FreeTextWarning, ModelMessage};
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[FreeTextError::ENTRIES, FreeTextWarning::ENTRIES, ModelMessage::ENTRIES];
