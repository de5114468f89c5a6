//! The messages of this crate, for lists of all messages.

use crate::begun::NewMessage;
use crate::calibration::CalibrationMessage;
use crate::cohort_members::CohortMessage;
use crate::error::Error;
use crate::find::{HoursMessage, Unfindable};
use crate::fleet::FleetMessage;
use crate::life_messages::LifeMessage;
use crate::open_messages::OpenMessage;
use crate::pace::PaceMessage;
use crate::profiles::ProfileMessage;
use crate::touched::OrderMessage;
use crate::translation::TranslationMessage;
use homebody_core::messages::{Catalogue, Entry};

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[
    Error::ENTRIES,
    Unfindable::ENTRIES,
    HoursMessage::ENTRIES,
    OpenMessage::ENTRIES,
    ProfileMessage::ENTRIES,
    CohortMessage::ENTRIES,
    FleetMessage::ENTRIES,
    OrderMessage::ENTRIES,
    PaceMessage::ENTRIES,
    LifeMessage::ENTRIES,
    NewMessage::ENTRIES,
    TranslationMessage::ENTRIES,
    CalibrationMessage::ENTRIES,
];

/// The messages of destinations and sources in crates of their own, as far as this build has them.
pub const ELSEWHERE: &[&[&[Entry]]] = &[
    #[cfg(feature = "parquet")]
    homebody_arrow::MESSAGES,
    #[cfg(feature = "postgresql")]
    homebody_postgres::MESSAGES,
    #[cfg(feature = "mqtt")]
    homebody_mqtt::MESSAGES,
];
