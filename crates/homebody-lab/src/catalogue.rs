//! The messages of this crate, for lists of all messages.

use crate::locating::LocatingError;
use crate::messages::ExperimentMessage;
use crate::{recogniser, sphere};
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[
    LocatingError::ENTRIES,
    recogniser::NotRecognised::ENTRIES,
    recogniser::FlatError::ENTRIES,
    sphere::Undone::ENTRIES,
    sphere::Unplaced::ENTRIES,
    sphere::RowMessage::ENTRIES,
    ExperimentMessage::ENTRIES,
];

/// Each message of this crate.
pub fn all() -> impl Iterator<Item = &'static CatalogueEntry> + Clone {
    MESSAGES.iter().copied().flatten()
}
