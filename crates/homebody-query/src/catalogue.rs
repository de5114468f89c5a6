//! The messages of this crate, for lists of all messages.

use crate::error::QueryError;
use crate::search::{HoursMessage, SearchError};
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The errors of the area `kit`, which several crates share.
pub const ERRORS: &[CatalogueEntry] = QueryError::ENTRIES;

/// The other messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[SearchError::ENTRIES, HoursMessage::ENTRIES];
