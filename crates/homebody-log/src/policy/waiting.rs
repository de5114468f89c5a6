//! Repeats calls while a destination is away, for a limited time, and reports the wait.

use super::cancel::Cancel;
use super::metrics::SinkMetrics;
use crate::error::LogError;
use std::thread;
use std::time::{Duration, Instant};

/// Interval at which a waiting thread checks whether to stop (our choice).
const LOOK: Duration = Duration::from_millis(50);

/// The retries of calls to a destination that is away.
pub(crate) struct RetryWait<'a> {
    /// The name in errors.
    pub place: &'a str,
    pub meter: &'a SinkMetrics,
    /// Ends the wait.
    pub cancel: &'a Cancel,
    /// For how long a call is made again after an error that passes; zero for not at all.
    pub retry_for: Duration,
    /// The wait before the first retry; each further wait is twice as long, up to the longest.
    pub first: Duration,
    pub longest: Duration,
}

impl RetryWait<'_> {
    /// Makes a call, and makes it again while its error passes, there is time, and it is not over.
    pub fn call<T>(
        &self,
        is_over: impl Fn() -> bool,
        mut call: impl FnMut() -> Result<T, LogError>,
    ) -> Result<T, LogError> {
        let (begun, mut wait, mut is_away) = (Instant::now(), self.first, false);
        loop {
            let error = match call() {
                Err(error) if error.passes() && begun.elapsed() + wait <= self.retry_for => error,
                Err(error) => return Err(error),
                Ok(done) => {
                    // Of one whose rows are put aside, that a call has succeeded does not say that it is there.
                    if is_away {
                        self.meter.is_there(self.place);
                    }
                    return Ok(done);
                }
            };
            let waited = Instant::now();
            while waited.elapsed() < wait {
                if self.cancel.is_cancelled() {
                    return Err(error.of_stopped_run());
                }
                if is_over() {
                    return Err(error);
                }
                self.meter.is_away(self.place, &error, Some(self.retry_for));
                is_away = true;
                thread::sleep(LOOK.min(wait.saturating_sub(waited.elapsed())));
            }
            self.meter.tries_again();
            wait = (2 * wait).min(self.longest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn away() -> LogError {
        LogError::destination("there", "it is away").passing()
    }

    /// Repeats a call for so long.
    fn called<T>(
        retry_for: Duration,
        cancel: &Cancel,
        call: impl FnMut() -> Result<T, LogError>,
    ) -> (Result<T, LogError>, u64) {
        let meter = SinkMetrics::default();
        let first = Duration::from_millis(1);
        let waiting = RetryWait { place: "there", meter: &meter, cancel, retry_for, first, longest: retry_for };
        (waiting.call(|| false, call), meter.read().retries)
    }

    #[test]
    fn retries_only_errors_that_pass() {
        let (long, cancel) = (Duration::from_secs(5), Cancel::new());
        let mut calls = 0;
        let (done, retries) = called(long, &cancel, || {
            calls += 1;
            if calls < 4 { Err(away()) } else { Ok(calls) }
        });
        assert_eq!((done.unwrap(), retries), (4, 3));
        let mut calls = 0;
        let (failed, _) = called(long, &cancel, || -> Result<(), LogError> {
            calls += 1;
            Err(LogError::destination("there", "it is gone"))
        });
        assert!(failed.is_err() && calls == 1);
        assert!(called(Duration::ZERO, &cancel, || Err::<(), _>(away())).0.is_err());
    }

    #[test]
    fn a_cancelled_wait_ends() {
        let (begun, cancel) = (Instant::now(), Cancel::new());
        let stops = cancel.clone();
        thread::spawn(move || {
            thread::sleep(Duration::from_millis(200));
            stops.cancel();
        });
        let (stopped, retries) = called(Duration::from_secs(600), &cancel, || Err::<(), _>(away()));
        assert!(retries > 0 && begun.elapsed() < Duration::from_secs(30), "{retries} retries");
        let stopped = stopped.unwrap_err();
        assert!(matches!(&stopped, LogError::StoppedAway { .. }), "{stopped}");
        assert!(!stopped.passes());
    }
}
