//! What is known of a suggestion while it is made.

use std::sync::Mutex;
use std::sync::atomic::AtomicU32;

/// The suggestion that is being made: one at a time, and how far it is, in thousandths.
#[derive(Default)]
pub struct Suggesting {
    pub making: Mutex<()>,
    pub done: AtomicU32,
}
