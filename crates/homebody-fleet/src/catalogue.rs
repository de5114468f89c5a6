//! The messages of this crate, for lists of all messages.

use crate::error::FleetError;
use crate::setup::FleetMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};

pub const MESSAGES: &[&[CatalogueEntry]] = &[FleetError::ENTRIES, FleetMessage::ENTRIES];
