//! Data that a thread reads in the order of time, while pages show the part that is read.

use crate::messages::PageMessage;
use crate::request_error::{RequestError, failed};
use axum::http::StatusCode;
use homebody_core::time::{RunTime, Span};
use homebody_log::{Cancel, LogError};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Longest wait for a part of a log that is not read yet (our choice).
const LONGEST_WAIT: Duration = Duration::from_secs(60);

pub(super) trait PartlyRead {
    fn how_far(&self) -> &ReadProgress;

    /// The instant before which no more data comes; `None` at the end. Or the reason of a failure.
    fn read_us(&self) -> Result<Option<RunTime>, RequestError> {
        let ReadProgress { last_us, late, ended } = self.how_far();
        match ended {
            None => Ok(Some(last_us.saturating_sub(*late))),
            Some(ended) => ended.clone().map(|()| None),
        }
    }
}

pub(super) struct ReadProgress {
    pub last_us: RunTime,
    /// The largest delay of data after others.
    late: Span,
    pub ended: Option<Result<(), RequestError>>,
}

impl ReadProgress {
    pub fn begun(late: Span) -> ReadProgress {
        ReadProgress { last_us: RunTime::MIN, late, ended: None }
    }

    pub fn whole() -> ReadProgress {
        ReadProgress { last_us: RunTime::MAX, late: Span::ZERO, ended: Some(Ok(())) }
    }
}

pub(super) struct BackgroundRead<T>(Arc<Shared<T>>);

struct Shared<T> {
    known: Mutex<T>,
    grown: Condvar,
    /// Set when the rest is not needed any more.
    ends: Cancel,
}

impl<T> Clone for BackgroundRead<T> {
    fn clone(&self) -> BackgroundRead<T> {
        BackgroundRead(self.0.clone())
    }
}

impl<T: PartlyRead> BackgroundRead<T> {
    pub fn new(known: T) -> BackgroundRead<T> {
        BackgroundRead(Arc::new(Shared { known: Mutex::new(known), grown: Condvar::new(), ends: Cancel::new() }))
    }

    pub fn known(&self) -> MutexGuard<'_, T> {
        self.0.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the data up to an instant is read; [`RunTime::MAX`] is for all. An error if that takes too long.
    pub fn until(&self, instant: RunTime) -> Result<MutexGuard<'_, T>, RequestError> {
        let known = self.wait(instant, LONGEST_WAIT);
        match known.read_us()? {
            Some(read) if read < instant => {
                Err(RequestError::new(StatusCode::SERVICE_UNAVAILABLE, PageMessage::StillReading))
            }
            _ => Ok(known),
        }
    }

    pub fn wait(&self, instant: RunTime, longest: Duration) -> MutexGuard<'_, T> {
        let begun = Instant::now();
        let mut known = self.known();
        while matches!(known.read_us(), Ok(Some(read)) if read < instant) {
            let left = longest.saturating_sub(begun.elapsed());
            if left.is_zero() {
                break;
            }
            known = self.0.grown.wait_timeout(known, left).unwrap_or_else(PoisonError::into_inner).0;
        }
        known
    }

    pub fn stop(&self) {
        self.0.ends.cancel();
    }

    /// Adds data, unless the rest is not needed any more.
    pub fn grow(&self, more: impl FnOnce(&mut T) -> Result<(), LogError>) -> Result<(), LogError> {
        if self.0.ends.is_cancelled() {
            return Err(LogError::Stopped { place: "the page".into() });
        }
        let grown = more(&mut self.known());
        self.0.grown.notify_all();
        grown
    }

    pub fn end(&self, last: impl FnOnce(&mut T)) {
        last(&mut self.known());
        self.0.grown.notify_all();
    }
}

pub(super) fn read_in(name: &str, read: impl FnOnce() + Send + 'static) -> Result<(), RequestError> {
    thread::Builder::new().name(name.into()).spawn(read).map(drop).map_err(failed)
}
