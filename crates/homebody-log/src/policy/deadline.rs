//! The time that a destination has to answer one request. The destination and its caller share this clock.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The time that a destination has for each request. A clone is another handle on the same clock.
///
/// A call to a [`Sink`](crate::Sink) may take several requests. A sink says by [`asks`](Deadline::asks) that it has got an answer and asks
/// for more: then it has the whole time again. One that never says so has that time for each call.
#[derive(Clone)]
pub struct Deadline(Arc<RequestClock>);

struct RequestClock {
    within: Duration,
    begun: Instant,
    /// When the last request was made, and until when its answer may come, in microseconds since `begun`.
    asked_us: AtomicU64,
    until_us: AtomicU64,
}

impl Default for Deadline {
    /// As long as files on a disk may take.
    fn default() -> Deadline {
        Deadline::new(Deadline::OF_FILES)
    }
}

impl fmt::Debug for Deadline {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_tuple("Deadline").field(&self.0.within).finish()
    }
}

impl Deadline {
    /// The time for files, and for all sinks without a time of their own.
    pub const OF_FILES: Duration = Duration::from_secs(120);

    /// The time for a server, or the reader of a pipe.
    pub const OF_SERVERS: Duration = Duration::from_secs(10);

    /// Answers may take so long, from now on.
    pub fn new(within: Duration) -> Deadline {
        let deadline = Deadline(Arc::new(RequestClock {
            within,
            begun: Instant::now(),
            asked_us: AtomicU64::new(0),
            until_us: AtomicU64::new(0),
        }));
        deadline.asks();
        deadline
    }

    /// The time for an answer.
    pub fn within(&self) -> Duration {
        self.0.within
    }

    /// Something is asked for now.
    pub fn asks(&self) {
        self.asks_for(self.0.within);
    }

    /// The same for what takes longer than usual.
    pub fn asks_for(&self, longest: Duration) {
        let now = self.0.begun.elapsed();
        self.0.asked_us.store(now.as_micros() as u64, Ordering::Relaxed);
        self.0.until_us.store(now.saturating_add(longest).as_micros() as u64, Ordering::Relaxed);
    }

    /// The time since the last answer.
    pub fn unanswered(&self) -> Duration {
        self.0.begun.elapsed().saturating_sub(Duration::from_micros(self.0.asked_us.load(Ordering::Relaxed)))
    }

    /// Whether the answer should have come so long ago.
    pub(crate) fn is_over_by(&self, grace: Duration) -> bool {
        let until = Duration::from_micros(self.0.until_us.load(Ordering::Relaxed));
        self.0.begun.elapsed() > until.saturating_add(grace)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_request_has_the_whole_time() {
        let deadline = Deadline::new(Duration::ZERO);
        std::thread::sleep(Duration::from_millis(5));
        assert!(deadline.is_over_by(Duration::ZERO) && !deadline.is_over_by(Duration::from_secs(600)));
        deadline.clone().asks_for(Duration::from_secs(600));
        assert!(!deadline.is_over_by(Duration::ZERO));
        deadline.asks();
        std::thread::sleep(Duration::from_millis(5));
        assert!(deadline.is_over_by(Duration::ZERO) && deadline.unanswered() >= Duration::from_millis(5));
    }
}
