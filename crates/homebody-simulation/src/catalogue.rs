//! The messages of this crate, for lists of all messages.

use crate::cohort::members::CohortMessage;
use crate::error::SimulationError;
use crate::open_messages::OpenMessage;
use crate::pace::PaceMessage;
use crate::profiles::ProfileMessage;
use crate::scenario_warnings::ScenarioWarning;
use crate::simulation::orders::OrderMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The errors of the area `kit`, which several crates share.
pub const ERRORS: &[CatalogueEntry] = SimulationError::ENTRIES;

/// The other messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[
    OpenMessage::ENTRIES,
    ProfileMessage::ENTRIES,
    CohortMessage::ENTRIES,
    OrderMessage::ENTRIES,
    PaceMessage::ENTRIES,
    ScenarioWarning::ENTRIES,
];

/// The messages of destinations and sources in crates of their own, as far as this build has them.
pub const EXTENSIONS: &[&[&[CatalogueEntry]]] = &[
    #[cfg(feature = "parquet")]
    homebody_arrow::MESSAGES,
    #[cfg(feature = "postgresql")]
    homebody_postgres::MESSAGES,
    #[cfg(feature = "mqtt")]
    homebody_mqtt::MESSAGES,
];
