//! The messages of this crate, for lists of all messages.

use crate::{PdfError, PngError};
use homebody_core::messages::{Catalogue, Entry};

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[PngError::ENTRIES, PdfError::ENTRIES];
