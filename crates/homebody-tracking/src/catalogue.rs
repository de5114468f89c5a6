//! The messages of this crate, for lists of all messages.

use crate::calibration::CalibrationMessage;
use crate::error::TrackingError;
use crate::translation::TranslationMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] =
    &[TrackingError::ENTRIES, TranslationMessage::ENTRIES, CalibrationMessage::ENTRIES];
