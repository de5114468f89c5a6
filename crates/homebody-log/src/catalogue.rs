//! The messages of this crate, for lists of all messages.

use crate::error::LogError;
use crate::error::messages::*;
use crate::error::reason::OwnMessage;
use crate::source::messages::{FormMessage, TableMessage};
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[
    LogError::ENTRIES,
    OwnMessage::ENTRIES,
    FormMessage::ENTRIES,
    TableMessage::ENTRIES,
    LengthMessage::ENTRIES,
    TruthMessage::ENTRIES,
    OtherRunMessage::ENTRIES,
    ChangedMessage::ENTRIES,
    HoldMessage::ENTRIES,
    OutputMessage::ENTRIES,
    FileRefusal::ENTRIES,
    CountMessage::ENTRIES,
    ThreadMessage::ENTRIES,
    PackedMessage::ENTRIES,
    SensorTableMessage::ENTRIES,
    MappingMessage::ENTRIES,
];
