//! What can be said from outside of a run while it is lived: how far it is, and what its destinations have taken.

use homebody_core::time::Micros;
use homebody_log::Meter;
use homebody_log::meter::Reading;
use jiff::Timestamp;
use std::sync::{Arc, Mutex, PoisonError};

/// Looks at a run that is lived elsewhere. A copy looks at the same run.
#[derive(Clone, Debug, Default)]
pub struct Meters(Arc<Mutex<Inner>>);

#[derive(Debug, Default)]
struct Inner {
    start: Option<Timestamp>,
    lived: Micros,
    destinations: Vec<(String, Arc<Meter>)>,
}

/// What is to be seen at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The instant of the world that the run has come to; None before it has begun.
    pub now: Option<Timestamp>,
    /// How much has been lived, in microseconds.
    pub lived: Micros,
    /// Each destination by its place.
    pub destinations: Vec<(String, Reading)>,
}

impl Meters {
    /// What is to be seen now.
    pub fn look(&self) -> Seen {
        let inner = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let now = inner.start.and_then(|start| Timestamp::from_microsecond(start.as_microsecond() + inner.lived).ok());
        let destinations = inner.destinations.iter().map(|(place, meter)| (place.clone(), meter.read())).collect();
        Seen { now, lived: inner.lived, destinations }
    }

    pub(crate) fn begin(&self, start: Timestamp, destinations: Vec<(String, Arc<Meter>)>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Inner { start: Some(start), lived: 0, destinations };
    }

    pub(crate) fn lived(&self, now: Micros) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).lived = now;
    }
}
