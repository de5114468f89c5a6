//! The messages of the commands, for lists of all messages.

use super::alerts::AlertsMessage;
use super::density::DensityMessage;
use super::devices::DeviceMessage;
use super::doctor::DoctorMessage;
use super::fit::TrainingMessage;
use super::fleet::fleet_progress::FleetEndMessage;
use super::follow::FollowMessage;
use super::live::LiveMessage;
use super::measures::MeasuresMessage;
use super::messages::{ExplainMessage, LogContentMessage, MomentMessage, NewHomeMessage, PictureMessage};
use super::parameters::ParametersMessage;
use super::routine::messages::RoutinesMessage;
use super::run_messages::{ReplayMessage, RunMessage};
use super::serve::ServeMessage;
use super::silhouettes::messages::SilhouettesMessage;
use super::suggest_sensors::GoalsMessage;
use crate::failure::SimulationMessage;
use crate::metrics::MetricsMessage;
use crate::old_names::GoneMessage;
use crate::pace::ControlMessage;
use crate::print::ResultMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};

const MESSAGES: &[&[CatalogueEntry]] = &[
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
    ControlMessage::ENTRIES,
    MetricsMessage::ENTRIES,
    ResultMessage::ENTRIES,
    SimulationMessage::ENTRIES,
    ExplainMessage::ENTRIES,
    GoneMessage::ENTRIES,
];

/// The messages of all crates, by area.
pub fn all() -> impl Iterator<Item = &'static CatalogueEntry> + Clone {
    [
        homebody_core::catalogue::MESSAGES,
        homebody_log::catalogue::MESSAGES,
        homebody_routine::catalogue::MESSAGES,
        homebody_import::catalogue::MESSAGES,
        &[
            homebody_simulation::catalogue::ERRORS,
            homebody_query::catalogue::ERRORS,
            homebody_scaffold::catalogue::ERRORS,
        ],
        homebody_query::catalogue::MESSAGES,
        homebody_simulation::catalogue::MESSAGES,
        homebody_fleet::catalogue::MESSAGES,
        homebody_scaffold::catalogue::MESSAGES,
        homebody_tracking::catalogue::MESSAGES,
        homebody_analysis::catalogue::MESSAGES,
        homebody_picture::catalogue::MESSAGES,
        homebody_placement::catalogue::MESSAGES,
        homebody_web::catalogue::MESSAGES,
        MESSAGES,
    ]
    .into_iter()
    .chain(homebody_simulation::catalogue::EXTENSIONS.iter().copied())
    .flatten()
    .copied()
    .flatten()
}
