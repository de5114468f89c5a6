//! The progress of the suggestion that is being made.

use std::sync::Mutex;
use std::sync::atomic::AtomicU32;

/// One suggestion at a time.
#[derive(Default)]
pub struct SuggestionProgress {
    pub making: Mutex<()>,
    /// In thousandths.
    pub done: AtomicU32,
}
