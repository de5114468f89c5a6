//! All messages of the program, in the order of `homebody explain`.

use crate::commands::catalogue;
use crate::failure::SimulationMessage;
use crate::pace::ControlMessage;
use crate::print::ResultMessage;
use crate::watched::MetricsMessage;
use homebody_core::messages::{Catalogue, Entry};

/// The messages of all crates, by area.
pub fn all() -> impl Iterator<Item = &'static Entry> + Clone {
    [
        homebody_core::catalogue::MESSAGES,
        homebody_log::catalogue::MESSAGES,
        homebody_routine::catalogue::MESSAGES,
        homebody_import::catalogue::MESSAGES,
        homebody_kit::catalogue::MESSAGES,
        homebody_analysis::catalogue::MESSAGES,
        homebody_picture::catalogue::MESSAGES,
        homebody_experiment::catalogue::MESSAGES,
        homebody_web::catalogue::MESSAGES,
        catalogue::MESSAGES,
        &[
            ControlMessage::ENTRIES,
            MetricsMessage::ENTRIES,
            ResultMessage::ENTRIES,
            SimulationMessage::ENTRIES,
            ExplainMessage::ENTRIES,
        ],
    ]
    .into_iter()
    .chain(homebody_kit::catalogue::ELSEWHERE.iter().copied())
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
