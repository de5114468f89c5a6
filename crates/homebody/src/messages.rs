//! All messages of the program, in the order in which `homebody explain` lists them.

use homebody_core::messages::{Catalogue, Entry};

/// The messages of all crates, by area.
pub fn all() -> impl Iterator<Item = &'static Entry> + Clone {
    [
        homebody_core::messages::ALL,
        homebody_log::MESSAGES,
        homebody_import::MESSAGES,
        homebody_kit::MESSAGES,
        &[crate::commands::explain::ExplainMessage::ENTRIES],
    ]
    .into_iter()
    .chain(homebody_kit::MESSAGES_ELSEWHERE.iter().copied())
    .flatten()
    .copied()
    .flatten()
}
