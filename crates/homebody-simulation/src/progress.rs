//! The progress of a run.

use homebody_core::time::Span;

/// Progress of a run or a cohort.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunProgress {
    /// The simulated part.
    pub done: Span,
    /// The whole length.
    pub length: Span,
}
