//! What is read in another thread while it is shown already, in order of time.

use crate::messages::PageMessage;
use crate::refusal::{Refusal, failed};
use homebody_core::problem::Diagnose;
use homebody_core::time::{RunTime, Span};
use homebody_log::{Cancel, LogError};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Longest wait for a part of a log that is not read yet (our choice).
const LONGEST_WAIT: Duration = Duration::from_secs(60);

/// What has come so far.
pub(super) trait Grows {
    /// How far that is.
    fn how_far(&self) -> &HowFar;

    /// Up to when nothing more comes; `None` once all has come. Or why it cannot.
    fn read_us(&self) -> Result<Option<RunTime>, Refusal> {
        let HowFar { last_us, late, ended } = self.how_far();
        match ended {
            None => Ok(Some(last_us.saturating_sub(*late))),
            Some(ended) => ended.clone().map(|()| None),
        }
    }
}

/// How far something has come.
pub(super) struct HowFar {
    /// The latest instant that has come.
    pub last_us: RunTime,
    /// So far before it something may still come.
    late: Span,
    /// Whether it has come to its end, or why it does not.
    pub ended: Option<Result<(), Refusal>>,
}

impl HowFar {
    /// Nothing has come yet.
    pub fn begun(late: Span) -> HowFar {
        HowFar { last_us: RunTime::MIN, late, ended: None }
    }

    /// All has come.
    pub fn whole() -> HowFar {
        HowFar { last_us: RunTime::MAX, late: Span::ZERO, ended: Some(Ok(())) }
    }
}

/// What comes in another thread.
pub(super) struct Coming<T>(Arc<Shared<T>>);

struct Shared<T> {
    known: Mutex<T>,
    grown: Condvar,
    /// Nobody wants the rest any more.
    ends: Cancel,
}

impl<T> Clone for Coming<T> {
    fn clone(&self) -> Coming<T> {
        Coming(self.0.clone())
    }
}

impl<T: Grows> Coming<T> {
    /// Of which so much has come.
    pub fn new(known: T) -> Coming<T> {
        Coming(Arc::new(Shared { known: Mutex::new(known), grown: Condvar::new(), ends: Cancel::new() }))
    }

    /// What is known now.
    pub fn known(&self) -> MutexGuard<'_, T> {
        self.0.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is known once all has come up to an instant, all of it for [`RunTime::MAX`]; whoever waits for it too long is told so.
    pub fn until(&self, instant: RunTime) -> Result<MutexGuard<'_, T>, Refusal> {
        let known = self.wait(instant, LONGEST_WAIT);
        match known.read_us()? {
            Some(read) if read < instant => Err(Refusal::Early(PageMessage::StillReading.diagnostic())),
            _ => Ok(known),
        }
    }

    /// Waits no longer than so for what comes up to an instant.
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

    /// Nobody wants the rest any more.
    pub fn stop(&self) {
        self.0.ends.cancel();
    }

    /// Has more come, unless nobody wants it any more.
    pub fn grow(&self, more: impl FnOnce(&mut T) -> Result<(), LogError>) -> Result<(), LogError> {
        if self.0.ends.is_cancelled() {
            return Err(LogError::Stopped { place: "the page".into() });
        }
        let grown = more(&mut self.known());
        self.0.grown.notify_all();
        grown
    }

    /// Has the last come.
    pub fn end(&self, last: impl FnOnce(&mut T)) {
        last(&mut self.known());
        self.0.grown.notify_all();
    }
}

/// Has something be read in a thread of this name.
pub(super) fn read_in(name: &str, read: impl FnOnce() + Send + 'static) -> Result<(), Refusal> {
    thread::Builder::new().name(name.into()).spawn(read).map(drop).map_err(failed)
}
