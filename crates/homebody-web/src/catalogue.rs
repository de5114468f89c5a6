//! The messages of this crate, for lists of all messages.

use crate::kept_address::Unkept;
use crate::messages::{DeskMessage, LibraryMessage, PageMessage, StageMessage};
use crate::server::ServeError;
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[
    ServeError::ENTRIES,
    Unkept::ENTRIES,
    PageMessage::ENTRIES,
    LibraryMessage::ENTRIES,
    DeskMessage::ENTRIES,
    StageMessage::ENTRIES,
];
