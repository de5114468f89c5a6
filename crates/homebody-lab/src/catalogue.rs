use crate::locating::LocatingError;
use crate::messages::ExperimentMessage;
use crate::{recogniser, sphere};
use homebody_core::messages::{Catalogue, CatalogueEntry};

pub const MESSAGES: &[&[CatalogueEntry]] = &[
    LocatingError::ENTRIES,
    recogniser::RecogniserError::ENTRIES,
    recogniser::FlatError::ENTRIES,
    sphere::SphereError::ENTRIES,
    sphere::PlacementError::ENTRIES,
    sphere::RowMessage::ENTRIES,
    ExperimentMessage::ENTRIES,
];

pub fn all() -> impl Iterator<Item = &'static CatalogueEntry> + Clone {
    MESSAGES.iter().copied().flatten()
}
