//! All messages of the program, in the order of `homebody explain`.

use crate::commands::catalogue;
use crate::failure::SimulationMessage;
use crate::old_names::GoneMessage;
use crate::pace::ControlMessage;
use crate::print::ResultMessage;
use crate::watched::MetricsMessage;
use homebody_core::messages::{Catalogue, CatalogueEntry};

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
        catalogue::MESSAGES,
        &[
            ControlMessage::ENTRIES,
            MetricsMessage::ENTRIES,
            ResultMessage::ENTRIES,
            SimulationMessage::ENTRIES,
            ExplainMessage::ENTRIES,
            GoneMessage::ENTRIES,
        ],
    ]
    .into_iter()
    .chain(homebody_simulation::catalogue::EXTENSIONS.iter().copied())
    .flatten()
    .copied()
    .flatten()
}

homebody_core::messages! {
    /// Errors of `homebody explain`.
    pub enum ExplainMessage in "explain" {
        /// Messages have codes such as `log::exists`. No message has the code that was asked for.
        UnknownCode {
            /// The code asked for.
            code: String,
            /// The most similar code.
            nearest: Option<String>,
        } error "unknown-code" ("no message has the code {code:?}")
            advice (Some(match nearest {
                Some(nearest) => format!("did you mean {nearest}?"),
                None => "homebody explain lists all codes".to_owned(),
            }));
    }
}
