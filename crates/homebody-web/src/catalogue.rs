//! The messages of this crate, for lists of all messages.

use crate::address_file::AddressFileError;
use crate::messages::{DraftMessage, LibraryMessage, PageMessage, StageMessage};
use crate::server::ServeError;
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[
    ServeError::ENTRIES,
    AddressFileError::ENTRIES,
    PageMessage::ENTRIES,
    LibraryMessage::ENTRIES,
    DraftMessage::ENTRIES,
    StageMessage::ENTRIES,
];
