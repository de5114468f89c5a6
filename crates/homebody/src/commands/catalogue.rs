//! The messages of the commands, for lists of all messages.

use super::alerts::AlertsMessage;
use super::density::DensityMessage;
use super::devices::DeviceMessage;
use super::doctor::DoctorMessage;
use super::fit::TrainingMessage;
use super::fleet::told::FleetEndMessage;
use super::follow::FollowMessage;
use super::live::LiveMessage;
use super::measures::MeasuresMessage;
use super::messages::{LogContentMessage, MomentMessage, NewHomeMessage, PictureMessage};
use super::parameters::ParametersMessage;
use super::routine::messages::RoutinesMessage;
use super::run_messages::{ReplayMessage, RunMessage};
use super::serve::ServeMessage;
use super::silhouettes::messages::SilhouettesMessage;
use super::suggest_sensors::GoalsMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &[
    RunMessage::ENTRIES,
    ReplayMessage::ENTRIES,
    LiveMessage::ENTRIES,
    FleetEndMessage::ENTRIES,
    RoutinesMessage::ENTRIES,
    NewHomeMessage::ENTRIES,
    ParametersMessage::ENTRIES,
    DeviceMessage::ENTRIES,
    ServeMessage::ENTRIES,
    PictureMessage::ENTRIES,
    LogContentMessage::ENTRIES,
    FollowMessage::ENTRIES,
    TrainingMessage::ENTRIES,
    DensityMessage::ENTRIES,
    MeasuresMessage::ENTRIES,
    AlertsMessage::ENTRIES,
    MomentMessage::ENTRIES,
    SilhouettesMessage::ENTRIES,
    GoalsMessage::ENTRIES,
    DoctorMessage::ENTRIES,
];
