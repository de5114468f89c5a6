use crate::people::PeopleError;
use crate::simulated::SimulatedLogError;
use homebody_core::messages::{Catalogue, CatalogueEntry};

pub const MESSAGES: &[&[CatalogueEntry]] = &[SimulatedLogError::ENTRIES, PeopleError::ENTRIES];
