//! What becomes of a run when one of its destinations fails, hangs or is slow.

use crate::cancel::Cancel;
use crate::meter::Meter;
use crate::waiting::Waiting;
use std::time::Duration;

/// How a destination is treated.
#[derive(Clone, Debug, PartialEq)]
pub struct Policy {
    /// Whether its error ends the run. One that is not required is left behind: the others go on, and its error is told at
    /// the end.
    pub required: bool,
    /// For how long a call is made again after an error that passes; zero for not at all.
    pub retry_for: Duration,
    /// Whether it is begun again in the same way; otherwise one that is away at the beginning is an error at once.
    pub retries_beginning: bool,
    /// How long to wait before the first time again; each further wait is twice as long, up to a minute.
    pub retry_after: Duration,
    /// How many batches of at most 4,096 rows may wait for it. When they are that many, the run waits.
    pub batches_waiting: usize,
    /// A destination that does not begin within this time, or takes nothing for so long, hangs: that is an error, and nobody waits
    /// for it any more. Retries count: this should be longer than they may take.
    pub answers_within: Duration,
}

/// What a destination has that says nothing else: how long before the first retry, how many batches may wait for it, and how
/// long it may take to answer (ours).
const RETRY_AFTER_MS: u64 = 100;
const BATCHES_WAITING: usize = 4;
const ANSWERS_WITHIN_S: u64 = 120;

impl Default for Policy {
    /// Required, without retries, with little waiting; it must answer within two minutes.
    fn default() -> Policy {
        Policy {
            required: true,
            retry_for: Duration::ZERO,
            retries_beginning: true,
            retry_after: Duration::from_millis(RETRY_AFTER_MS),
            batches_waiting: BATCHES_WAITING,
            answers_within: Duration::from_secs(ANSWERS_WITHIN_S),
        }
    }
}

/// The longest wait between two tries.
const LONGEST_WAIT: Duration = Duration::from_secs(60);

impl Policy {
    /// A destination that the run can do without.
    pub fn optional() -> Policy {
        Policy { required: false, ..Policy::default() }
    }

    /// How the destination is waited for while it is away.
    pub(crate) fn waiting<'a>(&self, place: &'a str, meter: &'a Meter, cancel: &'a Cancel) -> Waiting<'a> {
        let (retry_for, first) = (self.retry_for, self.retry_after);
        Waiting { place, meter, cancel, retry_for, first, longest: LONGEST_WAIT }
    }
}
