//! Sentences that contradict each other.

use super::Draft;
use super::faults::Faults;

pub fn check(_draft: &Draft, _faults: &mut Faults) {}
