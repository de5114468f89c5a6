//! The messages of this crate and of the inference of places, for lists of all messages.

use crate::calibration::CalibrationMessage;
use crate::error::TrackingError;
use crate::translation::TranslationMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};
use homebody_infer::ResponseError;

pub const MESSAGES: &[&[CatalogueEntry]] =
    &[TrackingError::ENTRIES, TranslationMessage::ENTRIES, CalibrationMessage::ENTRIES, ResponseError::ENTRIES];
