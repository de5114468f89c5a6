//! The messages of this crate, for lists of all messages.

use crate::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[
    crate::scenario::json::JsonMessage::ENTRIES,
    crate::scenario::shape::SchemaMessage::ENTRIES,
    crate::scenario::inside::FileMessage::ENTRIES,
    crate::scenario::check::messages::NameMessage::ENTRIES,
    crate::scenario::check::messages::RangeMessage::ENTRIES,
    crate::calendar::TimeMessage::ENTRIES,
    crate::numbers::ParameterMessage::ENTRIES,
    crate::scenario::check::home::messages::HomeMessage::ENTRIES,
    crate::sensors::messages::SensorMessage::ENTRIES,
    crate::scenario::check::resident::ResidentMessage::ENTRIES,
    crate::scenario::check::path::PathMessage::ENTRIES,
    crate::scenario::check::input::InputMessage::ENTRIES,
    crate::scenario::check::link::LinkMessage::ENTRIES,
    crate::scenario::check::logger::LoggerMessage::ENTRIES,
    crate::scenario::scheme::PlaceMessage::ENTRIES,
    crate::problems::ProblemsMessage::ENTRIES,
    crate::drivers::error::DriverFault::ENTRIES,
    crate::outside::OutsideMessage::ENTRIES,
];
