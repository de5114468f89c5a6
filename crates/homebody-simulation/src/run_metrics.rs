//! Metrics of a run while it is simulated: its progress and its destinations.

use homebody_core::time::{RunTime, Span, UtcTime};
use homebody_log::policy::{MetricsReading, SinkNews, TellNews};
use homebody_log::{Destination, SinkMetrics};
use jiff::Timestamp;
use std::sync::{Arc, Mutex, PoisonError};

/// The metrics of a run in another thread. A clone is of the same run.
#[derive(Clone, Default)]
pub struct RunMetrics {
    inner: Arc<Mutex<RunMetricsState>>,
    /// Called when a destination is away or back.
    tell: Option<TellNews>,
}

#[derive(Debug, Default)]
struct RunMetricsState {
    start: Option<UtcTime>,
    done: Span,
    destinations: Vec<(String, Arc<SinkMetrics>)>,
}

/// The metrics at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct RunReading {
    /// The time of the home that the run has come to; `None` before it has started.
    pub now: Option<Timestamp>,
    /// The simulated time.
    pub done: Span,
    /// Each destination by its place.
    pub destinations: Vec<(String, MetricsReading)>,
}

impl RunMetrics {
    /// Metrics that report at once, from another thread, that a destination is away, with a changed reason, or back.
    pub fn telling(tell: impl Fn(&SinkNews) + Send + Sync + 'static) -> RunMetrics {
        RunMetrics { tell: Some(Arc::new(tell)), ..RunMetrics::default() }
    }

    /// The metrics now.
    pub fn read(&self) -> RunReading {
        let inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        let now = inner.start.and_then(|start| Timestamp::from_microsecond((start + inner.done).micros()).ok());
        let destinations = inner.destinations.iter().map(|(place, meter)| (place.clone(), meter.read())).collect();
        RunReading { now, done: inner.done, destinations }
    }

    pub(crate) fn begin(&self, start: Timestamp, destinations: Vec<(String, Arc<SinkMetrics>)>) {
        *self.inner.lock().unwrap_or_else(PoisonError::into_inner) =
            RunMetricsState { start: Some(start.into()), done: Span::ZERO, destinations };
    }

    pub(crate) fn simulated(&self, now: RunTime) {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).done = now.since_zero();
    }

    pub(crate) fn hear(&self, destination: &Destination) {
        if let Some(tell) = self.tell.clone() {
            destination.meter.telling(tell);
        }
    }
}
