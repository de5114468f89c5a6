//! Interventions in a run from outside: a thing is used, a sensor fails, a resident falls.
//!
//! An intervention happens at the instant that the run has come to. The recording has it before any of its consequences is stored,
//! so a replay and a resumed run repeat it.

pub use homebody_core::intervention::{Intervention, SensorFailure, TimedIntervention};
use homebody_core::numbers::Numbers;
pub use homebody_core::outside::Refusal;
use homebody_core::outside::usual_time_on_floor;
use homebody_core::time::{RunTime, Span};

/// An order for an intervention, with a duration instead of an end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OrderedIntervention {
    /// Opens, closes, turns on or turns off a thing.
    Use {
        /// Its name.
        thing: String,
        /// Its state afterwards: open or on, or else closed or off.
        on: bool,
    },
    /// Lets a sensor fail from now on.
    Fail {
        /// Its name in the home.
        sensor: String,
        /// The kind of failure.
        failure: SensorFailure,
        /// The duration; `None` for the rest of the run.
        lasts: Option<Span>,
    },
    /// Lets a resident fall where they are.
    Fall {
        /// The name.
        resident: String,
        /// The time on the floor; `None` for the parameter `outside.lies`.
        lies: Option<Span>,
    },
}

/// A requested intervention. A run that is over drops the request without an answer.
pub struct InterventionRequest {
    /// The intervention.
    pub intervention: OrderedIntervention,
    /// Takes the time of the intervention, or the reason against it. The thread of the run calls it, so it must not block.
    pub answer: Box<dyn FnOnce(Result<RunTime, Refusal>) + Send>,
}

impl OrderedIntervention {
    /// The intervention at an instant.
    pub(crate) fn at(self, now: RunTime, numbers: &Numbers) -> Intervention {
        match self {
            OrderedIntervention::Use { thing, on } => Intervention::Use { thing, on },
            OrderedIntervention::Fail { sensor, failure, lasts } => {
                Intervention::Fail { sensor, failure, until_us: lasts.map(|lasts| now.saturating_add(lasts)) }
            }
            OrderedIntervention::Fall { resident, lies } => {
                Intervention::Fall { resident, lies_us: lies.unwrap_or_else(|| usual_time_on_floor(numbers)) }
            }
        }
    }
}
