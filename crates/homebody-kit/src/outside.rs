//! What is done to a run from outside while it is lived, by whoever may: a thing is used, a sensor fails, somebody falls.
//!
//! It is done at the instant to which the run has come. Before anything that comes of it is stored, it is in the run's recording:
//! so a run that is lived again, or gone on with, lives the same life.

pub use homebody_core::deed::{Deed, Failure, FromOutside};
use homebody_core::numbers::Numbers;
pub use homebody_core::outside::Refusal;
use homebody_core::outside::usual_lie;
use homebody_core::time::Micros;

/// What somebody wants to be done now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wish {
    /// A thing is opened, closed, turned on or off.
    Use {
        /// Its name.
        thing: String,
        /// How it is afterwards: open or on, or closed or off.
        on: bool,
    },
    /// A sensor fails from now on.
    Fail {
        /// Its name in the home.
        sensor: String,
        /// How.
        failure: Failure,
        /// For how long, in microseconds; None for the rest of the run.
        lasts: Option<Micros>,
    },
    /// Somebody falls where they are.
    Fall {
        /// Their name.
        resident: String,
        /// How long they lie, in microseconds; None for as long as the number `outside.lies` says.
        lies: Option<Micros>,
    },
}

/// A wish, and who is told what has become of it: when it was done, in microseconds since the run's start, or why not. Whoever is
/// told nothing has asked a run that is over.
pub struct Asked {
    /// What is to be done.
    pub wish: Wish,
    /// It is called on the run's own thread, so it must not wait.
    pub answer: Box<dyn FnOnce(Result<Micros, Refusal>) + Send>,
}

impl Wish {
    /// What is done at an instant.
    pub(crate) fn at(self, now: Micros, numbers: &Numbers) -> Deed {
        match self {
            Wish::Use { thing, on } => Deed::Use { thing, on },
            Wish::Fail { sensor, failure, lasts } => {
                Deed::Fail { sensor, failure, until_us: lasts.map(|lasts| now.saturating_add(lasts)) }
            }
            Wish::Fall { resident, lies } => {
                Deed::Fall { resident, lies_us: lies.unwrap_or_else(|| usual_lie(numbers)) }
            }
        }
    }
}
