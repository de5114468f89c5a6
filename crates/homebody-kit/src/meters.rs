//! What can be said from outside of a run while it is lived: how far it is, and what its destinations have taken.

use homebody_core::time::Micros;
use homebody_log::meter::{News, Reading, Tell};
use homebody_log::{Destination, Meter};
use jiff::Timestamp;
use std::sync::{Arc, Mutex, PoisonError};

/// Looks at a run that is lived elsewhere. A copy looks at the same run.
#[derive(Clone, Default)]
pub struct Meters {
    inner: Arc<Mutex<Inner>>,
    /// Who hears that a destination is away or back.
    tell: Option<Tell>,
}

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
    /// One that tells at once, from another thread, that a destination is away, that the reason is another, and that it is back.
    pub fn telling(tell: impl Fn(&News) + Send + Sync + 'static) -> Meters {
        Meters { tell: Some(Arc::new(tell)), ..Meters::default() }
    }

    /// What is to be seen now.
    pub fn look(&self) -> Seen {
        let inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        let now = inner.start.and_then(|start| Timestamp::from_microsecond(start.as_microsecond() + inner.lived).ok());
        let destinations = inner.destinations.iter().map(|(place, meter)| (place.clone(), meter.read())).collect();
        Seen { now, lived: inner.lived, destinations }
    }

    pub(crate) fn begin(&self, start: Timestamp, destinations: Vec<(String, Arc<Meter>)>) {
        *self.inner.lock().unwrap_or_else(PoisonError::into_inner) =
            Inner { start: Some(start), lived: 0, destinations };
    }

    pub(crate) fn lived(&self, now: Micros) {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).lived = now;
    }

    /// Has a destination tell, where somebody wants to hear.
    pub(crate) fn hear(&self, destination: &Destination) {
        if let Some(tell) = self.tell.clone() {
            destination.meter.telling(tell);
        }
    }
}
