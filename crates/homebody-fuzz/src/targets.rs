//! The targets: every reader of foreign data.

mod analysis;
mod cohort;
mod columns;
mod database;
mod home;
mod simulation;
mod log;
mod plan;
mod profile;
mod recording;
mod routine;
mod scenario;
mod script;
mod server;
mod source;
mod tables;
mod text;
mod messages;
mod trial;
mod truth;
mod wire;

use crate::target::Target;

pub const TARGETS: [Target; 17] = [
    scenario::TARGET,
    home::TARGET,
    routine::TARGET,
    script::TARGET,
    profile::TARGET,
    recording::TARGET,
    cohort::TARGET,
    log::TARGET,
    database::TARGET,
    columns::TARGET,
    source::TARGET,
    truth::TARGET,
    tables::TARGET,
    server::TARGET,
    plan::TARGET,
    text::TARGET,
    wire::TARGET,
];

/// The target with a name, also `trial`, which is not in the list and fails in each possible way.
pub fn named(name: &str) -> Option<Target> {
    TARGETS.into_iter().chain([trial::TARGET]).find(|target| target.name == name)
}
