//! The reaction of a run to destinations that fail, hang or are slow.

pub(crate) mod cancel;
pub(crate) mod deadline;
pub(crate) mod metrics;
pub(crate) mod timed;
pub(crate) mod waiting;

pub(crate) use cancel::Cancel;
pub(crate) use deadline::Deadline;
pub use metrics::{MetricsReading, SinkAbsence, SinkMetrics, SinkNews, TellNews};
use std::time::Duration;
pub(crate) use timed::{Call, Job, STOPS_WITHIN, Timed};
pub(crate) use waiting::RetryWait;

/// The treatment of a destination.
#[derive(Clone, Debug, PartialEq)]
pub struct Policy {
    /// Whether its error ends the run. Otherwise the run continues without it, and reports its error at the end.
    pub required: bool,
    /// For how long a call is made again after an error that passes; zero for not at all.
    pub retry_for: Duration,
    /// Whether retries include the beginning; otherwise one that is away then is an error at once.
    pub retries_beginning: bool,
    /// The wait before the first retry; each further wait is twice as long, up to a minute.
    pub retry_after: Duration,
    /// The number of batches of at most 4,096 rows that may wait for it. With more, the run waits.
    pub batches_waiting: usize,
    /// The time that the destination has for one request. After it, the destination hangs: an error that passes, with retries like any
    /// other, but the call that hangs is not made twice.
    pub answers_within: Duration,
    /// Once the run is stopped, how long an answer is still waited for.
    pub stops_within: Duration,
}

/// The usual time before the first retry, and the usual number of batches that wait.
const RETRY_AFTER_MS: u64 = 100;
const BATCHES_WAITING: usize = 4;

impl Default for Policy {
    /// Required, without retries, with little waiting; it must answer within two minutes, also once the run is stopped.
    fn default() -> Policy {
        Policy {
            required: true,
            retry_for: Duration::ZERO,
            retries_beginning: true,
            retry_after: Duration::from_millis(RETRY_AFTER_MS),
            batches_waiting: BATCHES_WAITING,
            answers_within: Deadline::OF_FILES,
            stops_within: Deadline::OF_FILES,
        }
    }
}

/// Longest wait between two attempts.
const LONGEST_WAIT: Duration = Duration::from_secs(60);

impl Policy {
    /// A destination that the run can do without.
    pub fn optional() -> Policy {
        Policy { required: false, ..Policy::default() }
    }

    /// A server, or the reader of a pipe: it must answer within ten seconds, and soon once the run is stopped.
    pub fn of_server() -> Policy {
        Policy { answers_within: Deadline::OF_SERVERS, stops_within: STOPS_WITHIN, ..Policy::default() }
    }

    /// The retries for the destination while it is away.
    pub(crate) fn waiting<'a>(&self, place: &'a str, meter: &'a SinkMetrics, cancel: &'a Cancel) -> RetryWait<'a> {
        let (retry_for, first) = (self.retry_for, self.retry_after);
        RetryWait { place, meter, cancel, retry_for, first, longest: LONGEST_WAIT }
    }
}
