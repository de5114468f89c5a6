//! Ending runs from elsewhere: another thread, a signal's handler, a server.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Asks runs to end early. A clone is another handle on the same request.
///
/// A run that is cancelled ends between two batches; what it has stored by then is completed and stays. A destination that is away
/// is not waited for any more.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Nothing is asked for yet.
    pub fn new() -> Cancel {
        Cancel::default()
    }

    /// Asks all runs that have this handle to end; returns whether that was asked for before.
    pub fn cancel(&self) -> bool {
        self.0.swap(true, Ordering::Relaxed)
    }

    /// Whether they were asked to end.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
