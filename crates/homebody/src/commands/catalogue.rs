//! The messages of the commands, for lists of all messages.

use homebody_core::messages::{Catalogue, CatalogueEntry};

const MESSAGES: &[&[CatalogueEntry]] = &[
    super::run_messages::RunMessage::ENTRIES,
    super::run_messages::ReplayMessage::ENTRIES,
    super::live::LiveMessage::ENTRIES,
    super::fleet::fleet_progress::FleetEndMessage::ENTRIES,
    super::routine::messages::RoutinesMessage::ENTRIES,
    super::life::messages::LifeMessage::ENTRIES,
    super::messages::NewHomeMessage::ENTRIES,
    super::parameters::ParametersMessage::ENTRIES,
    super::devices::DeviceMessage::ENTRIES,
    super::serve::ServeMessage::ENTRIES,
    super::messages::PictureMessage::ENTRIES,
    super::messages::LogContentMessage::ENTRIES,
    super::follow::FollowMessage::ENTRIES,
    super::fit::TrainingMessage::ENTRIES,
    super::density::DensityMessage::ENTRIES,
    super::measures::MeasuresMessage::ENTRIES,
    super::alerts::AlertsMessage::ENTRIES,
    super::messages::MomentMessage::ENTRIES,
    super::silhouettes::messages::SilhouettesMessage::ENTRIES,
    super::suggest_sensors::GoalsMessage::ENTRIES,
    super::doctor::DoctorMessage::ENTRIES,
    crate::pace::ControlMessage::ENTRIES,
    crate::metrics::MetricsMessage::ENTRIES,
    crate::print::ResultMessage::ENTRIES,
    crate::failure::SimulationMessage::ENTRIES,
    super::messages::ExplainMessage::ENTRIES,
    crate::old_names::GoneMessage::ENTRIES,
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
        homebody_life::catalogue::MESSAGES,
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
