//! Carries a log from one form into another.

use crate::error::LogError;
use crate::source::Log;
use crate::transfer::Transfer;

/// Writes a log to another place; returns the number of rows. `about` is its [`survey`](crate::source::survey); `progress` is told
/// how many rows have been written.
pub fn convert(transfer: &Transfer, about: &Log, mut progress: impl FnMut(u64)) -> Result<u64, LogError> {
    transfer.write(about, None, &mut |_, _, _, _, _| Ok(()), &mut progress)
}
